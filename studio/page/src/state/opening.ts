// A frame file of the user's: one file, on a preset.
import { baseName } from "./doc.ts";
import { left } from "./focus.ts";
import { nearestName, plainName } from "./link.ts";
import { complain, tell } from "./notice.ts";
import { latest, presets, take } from "./studio.ts";

/** More than any frame file has, bytes. */
const LARGEST_BYTES = 1 << 20;

/** The preset of this name. */
export function presetNamed(base: string | undefined): string | undefined {
  return presets.value?.frames.find(({ name }) => name === base)?.name;
}

/** Takes a frame file; several, or one on a file that is not there, are refused and change nothing. */
export async function openFrame(files: File[]): Promise<void> {
  const file = files[0];
  if (!file) return;
  if (files.length > 1) {
    complain(
      `${files.length} frame files were given. The studio takes one, whose base is a preset; put what the others state into it. flexframe build takes a frame on several files.`,
    );
    return;
  }
  if (file.size > LARGEST_BYTES) {
    complain(`${file.name} has ${(file.size / 1e6).toFixed(1)} MB; a frame file may have 1 MB.`);
    return;
  }
  let text: string;
  try {
    text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
  } catch (error) {
    const why =
      error instanceof TypeError ? "it is not UTF-8 text" : error instanceof Error ? error.message : String(error);
    complain(`${file.name} cannot be read: ${why}.`);
    return;
  }
  if (/^\s*\[(sensor|effects)[\].]/m.test(text)) {
    complain(
      `${file.name} is an impact model and no frame file. flexframe drop --model ${file.name} drops a frame by it; the page has ${presets.value?.models.join(" and ")}.`,
    );
    return;
  }
  const base = baseName(text);
  const preset = presetNamed(base);
  if (base !== undefined && !preset) {
    const names = presets.value?.frames.map(({ name }) => name).join(", ");
    complain(
      `${file.name} has the base “${base.slice(0, 80)}”, which is no preset. The studio takes one file whose base is one of ${names}; flexframe build takes a frame on several files.`,
    );
    return;
  }
  left.value = "text";
  const given = file.name.replace(/\.toml$/i, "");
  const name = plainName(given) ?? nearestName(given) ?? "opened";
  take({ preset: preset ?? latest().preset, name, text });
  if (name !== given) tell(`The frame is called “${name}”: a frame's name has letters, digits, “-”, “_” and “.” only.`);
}
