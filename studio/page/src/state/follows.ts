// Numbers that follow from a bought part or from another number, unless a frame file states them.
import type { Catalogue } from "../engine/answers.ts";

/** Those that follow from another number; of the others the catalogue says it. */
const FROM_NUMBERS: Record<string, string> = { "limits.envelope_depth_mm": "envelope width" };

/** What a number follows from, in words; `null` for one that does not. */
export function followed(key: string, catalogue: Catalogue | null): string | null {
  const role = catalogue?.parameters.find((parameter) => parameter.key === key)?.follows;
  return role?.replaceAll("_", " ") ?? FROM_NUMBERS[key] ?? null;
}
