// Files in a ZIP.
import { zipSync } from "fflate";
import type { EngineFile } from "./messages.ts";

/** A ZIP with the paths of the program's folder; the same files give the same bytes. */
export function zipped(files: EngineFile[]): Uint8Array<ArrayBuffer> {
  const entries = Object.fromEntries(files.map(({ path, bytes }) => [path, bytes]));
  return zipSync(entries, { level: 6, mtime: new Date(1980, 0, 1) }) as Uint8Array<ArrayBuffer>;
}
