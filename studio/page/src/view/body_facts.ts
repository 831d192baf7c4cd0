// What the file of a frame says of its bodies.

/** What the file says of a body. */
export type BodyFacts = {
  name: string;
  part: string;
  kind: string;
  material: string;
  quantity: number;
  mass_each_g: number | null;
  module: string | null;
};

/** Whether a body is what a propeller sweeps. */
export function isDisc(facts: BodyFacts): boolean {
  return facts.part.startsWith("propeller");
}
