// Where a finding is: its subject names bodies and parts in words.
import type { BodyFacts } from "../view/body_facts.ts";

/** Names of the bodies and parts that words name; bodies before parts, as they are the closer place. */
export function touched(words: string, facts: BodyFacts[]): string[] {
  const plain = spaced(words);
  const named = (of: (facts: BodyFacts) => string) =>
    [...new Set(facts.map(of))].filter((name) => plain.includes(spaced(name)));
  const bodies = named(({ name }) => name);
  const parts = named(({ part }) => part);
  // "hub joint" is not also the hub.
  const all = bodies.length > 0 ? bodies : parts;
  return all.filter(
    (name) =>
      !all.some(
        (other) =>
          other !== name &&
          spaced(other).includes(spaced(name)) &&
          !plain.replaceAll(spaced(other), " ").includes(spaced(name)),
      ),
  );
}

const known = new Map<string, string>();

/** In small letters and single spaces, one at either end, so that whole words are found. */
function spaced(words: string): string {
  const before = known.get(words);
  if (before !== undefined) return before;
  const made = ` ${words
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, " ")
    .trim()} `;
  // Names come again, sentences do not.
  if (words.length < 40) known.set(words, made);
  return made;
}
