// A frame in a link: the preset's name, its file's name and the values that differ, in the fragment, which no server sees.
//
// `#p=cognifly&n=mine&s=rods.arm_rod_length_mm:80,bought.battery:battery-2s-850`. Text that says more than such values is carried as a whole.

export type Setting = number | string;
export type Linked = { preset: string; name: string; set: Record<string, Setting>; text?: string };

/** What a link may say at the most, letters: programs that hand it on cut longer ones. */
export const LONGEST_LINK = 100_000;

const NUMBER = /^-?\d+(\.\d+)?(e-?\d+)?$/i;

export function toFragment({ preset, name, set, text }: Linked): string {
  const parts = new URLSearchParams({ p: preset, n: name });
  const listed = Object.entries(set).map(([key, value]) => `${key}:${value}`);
  if (text !== undefined) parts.set("t", text);
  else if (listed.length > 0) parts.set("s", listed.join(","));
  // Commas and colons may stand in a fragment as they are.
  return parts.toString().replaceAll("%2C", ",").replaceAll("%3A", ":");
}

/** What a fragment says; `null` where it is none of ours. Throws where it is damaged. */
export function fromFragment(fragment: string, known: { presets: string[]; keys: Set<string> }): Linked | null {
  const plain = fragment.replace(/^#/, "");
  if (!/(^|&)p=/.test(plain)) return null;
  if (plain.length > LONGEST_LINK) throw new Error("the link is too long");
  const parts = new URLSearchParams(plain);
  const preset = parts.get("p") ?? "";
  if (!known.presets.includes(preset)) throw new Error(`there is no preset “${preset}”`);
  const name = plainName(parts.get("n") ?? "") ?? preset;
  const text = parts.get("t");
  if (text !== null) return { preset, name, set: {}, text };
  const set: Record<string, Setting> = {};
  for (const item of (parts.get("s") ?? "").split(",").filter(Boolean)) {
    const at = item.indexOf(":");
    const [key, value] = [item.slice(0, at), item.slice(at + 1)];
    if (at < 1 || value === "" || !known.keys.has(key))
      throw new Error(`“${item.slice(0, 80)}” is no value of a frame`);
    const setting = NUMBER.test(value) ? Number(value) : value;
    if (setting === Infinity || setting === -Infinity) throw new Error(`“${item.slice(0, 80)}” is no value of a frame`);
    set[key] = setting;
  }
  return { preset, name, set };
}

/** The nearest name that can be a file's: letters without their marks, and `-` for what is none; `null` where nothing is left. */
export function nearestName(name: string): string | null {
  const plain = name.normalize("NFD").replace(/\p{M}/gu, "");
  const joined = plain.replace(/[^A-Za-z0-9._-]+/g, "-").replace(/^[.-]+|-+$/g, "");
  return plainName(joined.slice(0, 100));
}

/** A name that can be a file's; `null` for any other. */
export function plainName(name: string): string | null {
  return /^[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}$/.test(name) ? name : null;
}
