// The last state, kept in this browser: a tab has its own, a new tab begins with the last of all.
import type { Doc } from "./doc.ts";
import { identity, isUnchanged } from "./doc.ts";
import { plainName } from "./link.ts";

const KEY = "flexframe-studio";
/** The last frame that is no preset as it comes: another preset takes its place in `KEY`, and not here. */
const OWN = "flexframe-studio-own";
const BORROWED = "flexframe-studio-borrowed";

/** The frame of a link, until something is changed of it: it does not take the place of one's own in other tabs. */
export function borrow(doc: Doc): void {
  put(() => sessionStorage.setItem(BORROWED, identity(doc)));
}

export function store(doc: Doc): void {
  const text = JSON.stringify(doc);
  for (const key of isUnchanged(doc) ? [KEY] : [KEY, OWN]) {
    put(() => sessionStorage.setItem(key, text));
    put(() => {
      if (sessionStorage.getItem(BORROWED) !== identity(doc)) localStorage.setItem(key, text);
    });
  }
}

/** A browser that keeps nothing has nothing to restore. */
function put(into: () => void): void {
  try {
    into();
  } catch {
    return;
  }
}

/** The state of before, or the last frame of one's `own`, if it is sound; on one of those presets, where they are known. */
export function restored(presets?: string[], own = false): Doc | null {
  const key = own ? OWN : KEY;
  try {
    const kept: unknown = JSON.parse(sessionStorage.getItem(key) ?? localStorage.getItem(key) ?? "null");
    if (typeof kept !== "object" || kept === null) return null;
    const { preset, name, text } = kept as Record<string, unknown>;
    const sound = typeof preset === "string" && typeof name === "string" && typeof text === "string";
    if (!sound || !plainName(name) || text.length >= 1 << 20) return null;
    const found = { preset, name, text };
    if (presets?.includes(preset) ?? true) return found;
    // A preset of another version: what was stated on it stays, to be refused in words.
    const [first] = presets ?? [];
    return first === undefined || isUnchanged(found) ? null : { ...found, preset: first };
  } catch {
    return null;
  }
}
