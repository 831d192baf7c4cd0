// Colours of bodies: by material, by part, or by what the checks found. Shapes and words say the same, so nobody has to tell colours apart.
import { DoubleSide, MeshLambertMaterial } from "three";
import type { Plane } from "three";
import type { Standing } from "../state/standing.ts";
import type { BodyFacts } from "./body_facts.ts";
import { isDisc } from "./body_facts.ts";

export type ColourBy = "material" | "part" | "finding";

/** Colours that people with colour blindness tell apart: after P. Tol, "Colour schemes" (2021), muted and bright. */
const PALETTE = [
  0x4477aa, 0xee6677, 0x228833, 0xccbb44, 0x66ccee, 0xaa3377, 0xee8866, 0x99ddff, 0x44bb99, 0xddcc77, 0x882255,
  0x999933,
];

const MATERIALS: Record<string, number> = { printed: 0xe8862e, rod: 0x3b3f45, bought: 0x8fa3b5 };

const STANDINGS: Record<Standing, number> = { violated: 0xd1344b, warns: 0xd9a520, holds: 0x4c9f70 };

/** Where a section opens a body, its inner faces are seen, all in one colour without light, so that it looks solid. */
function fillCut(material: MeshLambertMaterial): void {
  material.side = DoubleSide;
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      "if (!gl_FrontFacing) outgoingLight = 0.75 * diffuse + 0.08;\n#include <opaque_fragment>",
    );
  };
}

export class Colours {
  #cache = new Map<string, MeshLambertMaterial>();
  #parts: string[] = [];
  #materials: string[] = [];
  clipping: Plane[] = [];

  /** Parts of a motion, which may have others than the frame; colours of parts that stay do not change. */
  knowParts(facts: BodyFacts[]): void {
    for (const { part } of facts) if (!this.#parts.includes(part)) this.#parts.push(part);
  }

  /** A frame's parts, and its materials alone: one that another frame was printed of has no place among them. */
  know(facts: BodyFacts[]): void {
    this.knowParts(facts);
    const printed = facts.filter(({ kind }) => kind === "printed").map(({ material }) => material);
    this.#materials = [...new Set(printed)];
  }

  material(
    facts: BodyFacts,
    by: ColourBy,
    standing: Standing | undefined,
    lit: boolean,
    ghost: boolean,
  ): MeshLambertMaterial {
    const colour = ghost ? 0x5566ff : lit ? 0x2f7bff : this.#colour(facts, by, standing);
    const cut = this.clipping.length > 0;
    const key = `${colour} ${ghost} ${isDisc(facts)} ${cut}`;
    const known = this.#cache.get(key);
    if (known) return known;
    const seeThrough = ghost || isDisc(facts);
    const made = new MeshLambertMaterial({
      color: colour,
      flatShading: true,
      transparent: seeThrough,
      opacity: ghost ? 0.28 : isDisc(facts) ? 0.22 : 1,
      depthWrite: !seeThrough,
      clippingPlanes: this.clipping,
    });
    if (cut && !seeThrough) fillCut(made);
    this.#cache.set(key, made);
    return made;
  }

  #colour(facts: BodyFacts, by: ColourBy, standing: Standing | undefined): number {
    if (by === "finding") return standing ? STANDINGS[standing] : 0xb9c0c8;
    if (by === "part") return PALETTE[this.#parts.indexOf(facts.part) % PALETTE.length] ?? 0x999999;
    if (facts.kind === "printed" && this.#materials.indexOf(facts.material) > 0) return 0x4a5568;
    return MATERIALS[facts.kind] ?? 0x999999;
  }
}
