// The bodies of a picture: GLB bytes as objects of three.js, each with what the file says of it.
import { Box3, LineSegments, Mesh, SkinnedMesh, Vector3 } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { AnimationClip, Group, Object3D } from "three";
import type { BodyFacts } from "./body_facts.ts";

export type Body = { facts: BodyFacts; mesh: Mesh; rest: Vector3; middle: Vector3 };

export type Picture = { root: Group; bodies: Body[]; clips: AnimationClip[] };

const loader = new GLTFLoader();

/** Reads a GLB of the engine. */
export async function readPicture(bytes: Uint8Array<ArrayBuffer>): Promise<Picture> {
  const { scene, animations } = await loader.parseAsync(bytes.buffer, "");
  const bodies: Body[] = [];
  scene.updateMatrixWorld(true);
  scene.traverse((object: Object3D) => {
    if (!(object instanceof Mesh)) return;
    const extras = object.userData as Partial<BodyFacts>;
    const part = extras.part ?? object.name;
    const facts: BodyFacts = {
      name: (object.userData as { name?: string }).name ?? object.name,
      part,
      kind: extras.kind ?? "",
      material: extras.material ?? "",
      quantity: extras.quantity ?? 1,
      mass_each_g: extras.mass_each_g ?? null,
      module: extras.module ?? null,
    };
    // In the axes of the node `frame`, in which bodies are moved apart.
    const box = new Box3().setFromObject(object);
    const middle = object.parent ? object.parent.worldToLocal(box.getCenter(new Vector3())) : new Vector3();
    bodies.push({ facts, mesh: object, rest: object.position.clone(), middle });
  });
  return { root: scene, bodies, clips: animations };
}

/** Frees what a picture holds on the graphics card. Materials are those of all pictures, unless they are its `own`. */
export function dispose(root: Object3D, { own = false } = {}): void {
  root.traverse((object) => {
    if (!(object instanceof Mesh || object instanceof LineSegments)) return;
    object.geometry.dispose();
    if (object instanceof SkinnedMesh) object.skeleton.dispose();
    if (own) for (const material of [object.material].flat()) material.dispose();
  });
}

/** Length, width and height of a body in its own axes, mm. */
export function sizeMm(body: Body): [number, number, number] {
  body.mesh.geometry.computeBoundingBox();
  const size = body.mesh.geometry.boundingBox!.getSize(new Vector3()).multiplyScalar(1000);
  return [size.x, size.y, size.z];
}
