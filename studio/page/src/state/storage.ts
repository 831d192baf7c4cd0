// The last state, kept in this browser: a tab has its own, a new tab begins with the last of all.
import type { Doc } from "./doc.ts";
import { plainName } from "./link.ts";

const KEY = "flexframe-studio";

export function store(doc: Doc): void {
  for (const storage of [sessionStorage, localStorage]) {
    try {
      storage.setItem(KEY, JSON.stringify(doc));
    } catch {
      // A browser that keeps nothing has nothing to restore.
    }
  }
}

/** The state of before, if it is sound; its preset has to be one of those, where they are known. */
export function restored(presets?: string[]): Doc | null {
  try {
    const kept: unknown = JSON.parse(sessionStorage.getItem(KEY) ?? localStorage.getItem(KEY) ?? "null");
    if (typeof kept !== "object" || kept === null) return null;
    const { preset, name, text } = kept as Record<string, unknown>;
    const sound = typeof preset === "string" && typeof name === "string" && typeof text === "string";
    return sound && (presets?.includes(preset) ?? true) && plainName(name) && text.length < 1 << 20
      ? { preset, name, text }
      : null;
  } catch {
    return null;
  }
}
