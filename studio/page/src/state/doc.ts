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

/** The key that each line of a frame file states, with its table, and what stands behind the `=`; `null` where a line states none. */
function statements(text: string): ({ key: string; behind: string } | null)[] {
  let table = "";
  return text.split(/\r?\n/).map((line) => {
    const named = /^\s*\[([^\]]+)\]/.exec(line)?.[1];
    if (named !== undefined) table = `${named.trim()}.`;
    const [, key, behind] = /^\s*([\w."-]+)\s*=(.*)$/.exec(line) ?? [];
    return key === undefined || behind === undefined ? null : { key: `${table}${key}`, behind: behind.trim() };
  });
}

/** The key that a line of a frame file states, with its table; `null` where it states none. */
export function keyAtLine(text: string, line: number): string | null {
  return statements(text)[line - 1]?.key ?? null;
}

/** The bought parts that a frame file describes itself, with their kinds. */
export function ownParts(text: string): { name: string; kind: string }[] {
  return statements(text).flatMap((one) => {
    const [, name] = /^override\.parts\.(.+)\.kind$/.exec(one?.key ?? "") ?? [];
    const [, double, single] = WORDS.exec(one?.behind ?? "") ?? [];
    const kind = double ?? single;
    return name === undefined || kind === undefined ? [] : [{ name: name.replaceAll('"', ""), kind }];
  });
}

const WORDS = /^(?:"([^"\\]*)"|'([^']*)')\s*(?:#.*)?$/;
