// What is edited: a preset, the text of a frame file on it, and the file's name.
import type { Attached } from "../engine/messages.ts";

export type Doc = { preset: string; name: string; text: string };

/** The frame file that changes nothing of a preset. */
export function unchangedText(preset: string): string {
  return `base = ${JSON.stringify(preset)}\n`;
}

export function ofPreset(preset: string): Doc {
  return { preset, name: preset, text: unchangedText(preset) };
}

export function isUnchanged(doc: Doc): boolean {
  return doc.name === doc.preset && doc.text.trim() === unchangedText(doc.preset).trim();
}

/** The base that a frame file states, ahead of its tables. */
export function baseName(text: string): string | undefined {
  const head = text.split(/^\s*\[/m)[0] ?? "";
  return /^\s*base\s*=\s*["']([^"'\n]*)["']/m.exec(head)?.[1];
}

/** A string of TOML, or the `#` that begins a comment, whichever comes first. */
const STRING_OR_COMMENT = /"""(?:\\[\s\S]|[^\\])*?"""|'''[\s\S]*?'''|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#/g;

/** Whether a frame file has a comment, on a line of its own or behind a value. */
export function hasComment(text: string): boolean {
  return text.match(STRING_OR_COMMENT)?.includes("#") ?? false;
}

/** What two documents share when they mean the same frame. */
export function identity(doc: Doc): string {
  return isUnchanged(doc) ? doc.preset : `${doc.name}\n${doc.text}`;
}

/** The document as an engine's request names it: a preset that nothing was changed of is the preset itself, to the last byte. */
export function source(doc: Doc): { frame: string; files: Attached } {
  if (isUnchanged(doc)) return { frame: doc.preset, files: {} };
  const path = `${doc.name}.toml`;
  return { frame: path, files: { [path]: doc.text } };
}

/** The key that a line of a frame file states, with its table; `null` where it states none. */
export function keyAtLine(text: string, line: number): string | null {
  const lines = text.split("\n").slice(0, line);
  const stated = /^\s*([\w."-]+)\s*=/.exec(lines.at(-1) ?? "")?.[1];
  if (!stated) return null;
  const table = lines.map((one) => /^\s*\[([^\]]+)\]/.exec(one)?.[1]).findLast(Boolean);
  return table ? `${table}.${stated}` : stated;
}
