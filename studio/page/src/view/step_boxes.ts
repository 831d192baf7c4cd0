// What bounds what each step of an assembly shows, so that the camera can look at it: parts of later steps are there, without size.
import { Box3, SkinnedMesh, Vector3 } from "three";
import type { AnimationMixer } from "three";
import type { Body, Picture } from "./bodies.ts";

/** When a step is looked at, as shares of its time: what it moves is in between at the same places. */
const MOMENTS = [0.02, 0.5, 0.98];
/** How many corners of a body that bends are looked at. */
const CORNERS = 80;
/** What is smaller is not shown yet, m. */
const SMALLEST_M = 0.0005;
/** Room around the smallest parts, m: a step is seen with what is beside it. */
const ROOM_M = 0.004;

export class StepBoxes {
  #known = new Map<number, Box3>();

  constructor(
    readonly picture: Picture,
    readonly mixer: AnimationMixer,
    readonly stepSeconds: number,
    readonly seconds: number,
  ) {}

  /** The step of a time, from 0. */
  stepAt(seconds: number): number {
    return Math.floor(Math.min(seconds, this.seconds) / this.stepSeconds + 1e-6);
  }

  /** What bounds a step. The motion is at another time after this. */
  box(step: number): Box3 {
    const known = this.#known.get(step);
    if (known) return known;
    const box = new Box3();
    for (const moment of MOMENTS) {
      this.mixer.setTime(Math.min((step + moment) * this.stepSeconds, this.seconds));
      this.picture.root.updateMatrixWorld(true);
      for (const body of this.picture.bodies) {
        const own = boundsOf(body);
        if (own.getSize(new Vector3()).length() > SMALLEST_M) box.union(own);
      }
    }
    box.expandByScalar(ROOM_M);
    this.#known.set(step, box);
    return box;
  }
}

function boundsOf({ mesh }: Body): Box3 {
  const box = new Box3();
  if (!(mesh instanceof SkinnedMesh)) {
    if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
    return box.copy(mesh.geometry.boundingBox!).applyMatrix4(mesh.matrixWorld);
  }
  const { count } = mesh.geometry.attributes["position"]!;
  const at = new Vector3();
  for (let corner = 0; corner < count; corner += Math.max(1, Math.floor(count / CORNERS)))
    box.expandByPoint(mesh.getVertexPosition(corner, at).applyMatrix4(mesh.matrixWorld));
  return box;
}
