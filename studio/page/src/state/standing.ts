// How a finding stands, as the command line tells it: a note is a warning only beyond its figure.
import type { Finding } from "../engine/answers.ts";

export type Standing = "violated" | "warns" | "holds";

export function standing({ verdict, margin }: Finding): Standing {
  if (verdict === "violated") return "violated";
  return verdict === "note" && margin < 0 ? "warns" : "holds";
}
