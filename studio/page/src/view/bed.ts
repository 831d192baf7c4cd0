// The printed parts as they lie on the printer's bed: plate by plate, each part from its STL file.
import {
  BufferAttribute,
  BufferGeometry,
  EdgesGeometry,
  CircleGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  PlaneGeometry,
  Quaternion,
} from "three";
import { effect } from "@preact/signals";
import { Refused, Stopped } from "../engine/client.ts";
import type { Beds } from "../engine/answers.ts";
import { enter } from "../state/player.ts";
import { complain } from "../state/notice.ts";
import { checker, current, shownDoc } from "../state/studio.ts";
import { laying, plate, stage, viewer } from "./scene_state.ts";

let at = 0;
/** How often a bed was laid. */
let lays = 0;

/** Shows a plate, or the frame again. */
export async function showBed(shown: boolean, number = 0): Promise<void> {
  at = number;
  enter(shown ? "bed" : "frame");
  if (shown) await lay();
}

// Another frame lies otherwise.
effect(() => {
  if (shownDoc.value && stage.peek() === "bed") void lay();
});

async function lay(): Promise<void> {
  const of = shownDoc.peek();
  if (!of) return;
  const number = ++lays;
  laying.value = true;
  try {
    const { handle } = await current.opened(of);
    // Asked for at once: between two answers the open frame may be changed to another.
    const [{ answer: beds }, { files }] = await Promise.all([
      checker.ask<Beds>({ do: "beds", handle }),
      checker.ask({ do: "files", handle, which: ["stl"] }),
    ]);
    // A newer frame is laid by a call of its own.
    if (stage.value !== "bed" || shownDoc.peek() !== of) return;
    const meshes = new Map(
      files.map(({ path, bytes }) => [
        path
          .split("/")
          .at(-1)!
          .replace(/\.stl$/, ""),
        geometry(bytes),
      ]),
    );
    plate.value = { of: beds.plates.map(({ name }) => name), at: Math.min(at, beds.plates.length - 1) };
    viewer.value?.replace(drawn(beds, plate.value.at, meshes));
  } catch (error) {
    if (!(error instanceof Refused || error instanceof Stopped)) console.error(error);
    complain(error instanceof Error ? error.message : String(error));
    if (stage.value === "bed") enter("frame");
  } finally {
    if (number === lays) laying.value = false;
  }
}

/** The facets of a binary STL file. */
function geometry(bytes: Uint8Array): BufferGeometry {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = view.getUint32(80, true);
  const positions = new Float32Array(9 * count);
  for (let facet = 0; facet < count; facet++) {
    for (let number = 0; number < 9; number++)
      positions[9 * facet + number] = view.getFloat32(84 + 50 * facet + 12 + 4 * number, true);
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
}

const COLOURS: Record<string, number> = { tpu: 0xe8862e };

/** A plate, in the scene's axes, its middle at the origin. */
function drawn(beds: Beds, number: number, meshes: Map<string, BufferGeometry>): Group {
  const { round, size_mm } = beds.printer;
  const plate = beds.plates[number];
  const inMm = new Group();
  const flat = round ? new CircleGeometry(size_mm[0] / 2, 64) : new PlaneGeometry(...size_mm);
  const bed = new Mesh(flat, new MeshLambertMaterial({ color: 0x6b7785 }));
  bed.position.set(0, 0, -0.4);
  const rim = new LineSegments(new EdgesGeometry(flat), new LineBasicMaterial({ color: 0xffffff }));
  const [dx, dy] = round ? [0, 0] : [-size_mm[0] / 2, -size_mm[1] / 2];
  inMm.add(bed, rim);
  for (const { part, at_mm, turn } of plate?.items ?? []) {
    const own = meshes.get(part);
    if (!own) continue;
    const mesh = new Mesh(
      own,
      new MeshLambertMaterial({ color: COLOURS[plate!.material.split("-")[0]!] ?? 0x39506b, flatShading: true }),
    );
    mesh.name = part;
    mesh.position.set(at_mm[0]! + dx, at_mm[1]! + dy, at_mm[2]!);
    mesh.quaternion.copy(new Quaternion(...(turn as [number, number, number, number])));
    inMm.add(mesh);
  }
  inMm.rotation.x = -Math.PI / 2;
  inMm.scale.setScalar(0.001);
  const group = new Group();
  group.add(inMm);
  return group;
}
