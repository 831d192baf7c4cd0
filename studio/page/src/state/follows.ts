// Numbers that follow from a bought part or from another number, unless a frame file states them.
import type { Catalogue } from "../engine/answers.ts";

/** What a number follows from, in words: a bought part, or another number without its table and unit; `null` for one that does not. */
export function followed(key: string, catalogue: Catalogue | null): string | null {
  const from = catalogue?.parameters.find((parameter) => parameter.key === key)?.follows;
  return from?.replace(/^.*\./, "").replace(/_mm$/, "").replaceAll("_", " ") ?? null;
}
