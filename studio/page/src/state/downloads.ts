// Files to take away: what the engine makes, to the last byte, alone or in a ZIP.
import { type EngineFile, PACKED } from "../engine/messages.ts";
import type { Doc } from "./doc.ts";
import { checker, current, doc, whenTaken } from "./studio.ts";

const TYPES: Record<string, string> = {
  stl: "model/stl",
  glb: "model/gltf-binary",
  "3mf": "model/3mf",
  step: "model/step",
  csv: "text/csv",
  pdf: "application/pdf",
  toml: "application/toml",
  zip: "application/zip",
  json: "application/json",
};

/** Hands bytes to the browser under a name. */
export function save(name: string, bytes: Uint8Array<ArrayBuffer>): void {
  const url = URL.createObjectURL(
    new Blob([bytes], { type: TYPES[name.split(".").at(-1) ?? ""] ?? "application/octet-stream" }),
  );
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** The frame file with all that was changed: never a frame before it. */
export async function asChanged(): Promise<Doc> {
  await whenTaken();
  return doc.value;
}

/** Files of a frame file. */
export async function made(which: string[], of: Doc): Promise<EngineFile[]> {
  const { handle } = await current.opened(of);
  return (await checker.ask({ do: "files", handle, which })).files;
}

/** Makes files and saves them: one alone, several as a ZIP. */
export async function download(which: string[], zipName = which.join("-")): Promise<void> {
  const of = await asChanged();
  const { handle } = await current.opened(of);
  const [made] = (await checker.askPacked({ do: "files", handle, which })).files;
  if (!made) return;
  const last = made.path.split("/").at(-1);
  save(`${of.name}-${last === PACKED ? `${zipName}.zip` : last}`, made.bytes);
}

export async function saveText(): Promise<void> {
  const { name, text } = await asChanged();
  save(`${name}.toml`, new TextEncoder().encode(text));
}
