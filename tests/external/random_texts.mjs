// Requests with random and mutated texts: frames, models, tables of drops, and requests themselves. The seed is fixed.
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

/** Numbers from 0 to 1, the same in every run (G. Marsaglia, Xorshift RNGs, 2003). */
function generator(seed) {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}

const folder = (path, ending) => readdirSync(path).filter((name) => name.endsWith(ending)).map((name) => readFileSync(join(path, name), "utf8"));

const NUMBERS = ["0", "-1", "1e308", "nan", "-inf", "1e-300", "999999999999999999999", "0x10", "3.5", "2", "12", "true", "\"x\"", "[1, 2]", "{}"];
const WORDS = ["[", "]", "=", "\"", "'''", "\n", "\u0000", "é", "💥", "base = \"cognifly\"\n", "[override.parts.x]\n", "[rods]\n", "#", ".", ","];

/** Changes a text in one to three places. */
function mutated(text, random) {
  const pick = (list) => list[Math.floor(random() * list.length)];
  for (let times = 1 + Math.floor(random() * 3); times > 0; times -= 1) {
    const lines = text.split("\n");
    const at = Math.floor(random() * lines.length);
    const kinds = [
      () => lines.splice(at, 1),
      () => lines.splice(at, 0, pick(lines)),
      () => (lines[at] = lines[at].replace(/-?[0-9][0-9_.e+-]*/, () => pick(NUMBERS))),
      () => (lines[at] = lines[at].replace(/[0-9]+(\.[0-9]+)?/, (number) => String(Number(number) * (0.5 + random())))),
      () => (lines[at] = lines[at].slice(0, Math.floor(random() * lines[at].length)) + pick(WORDS) + lines[at].slice(Math.floor(random() * 9))),
    ];
    pick(kinds)();
    text = lines.join("\n");
  }
  return text;
}

function bytes(random) {
  return Uint8Array.from({ length: Math.floor(random() * 300) }, () => Math.floor(random() * 256));
}

function words(random) {
  return Array.from({ length: 1 + Math.floor(random() * 30) }, () => [...NUMBERS, ...WORDS][Math.floor(random() * (NUMBERS.length + WORDS.length))]).join(" ");
}

/** Refused when everything else is read, before the bodies are made, which takes a hundred times as long. */
const UNFINISHED = "\n[target]\nwidth_mm = 200\n";
/** One mutated frame in so many is made whole. */
const WHOLE = 6;

const TABLE = `trial,height_m,t_s,accel_g\n${Array.from({ length: 30 }, (_, at) => `${at % 3},0.5,${(at / 1000).toFixed(3)},${at}`).join("\n")}\n`;

/** So many requests, each with its files. */
export function* randomTexts(count) {
  const random = generator(20_260_101);
  const pick = (list) => list[Math.floor(random() * list.length)];
  const frames = folder("params/frames", ".toml");
  const models = folder("params/impact", ".toml");
  const drop = { do: "drop", model: "a.toml", heights_m: [1] };
  const diagnose = { do: "diagnose", model: "paper", max_effects: 1 };
  const open = { do: "open", frame: "a.toml" };
  const unfinished = () => (random() < 1 / WHOLE ? "" : UNFINISHED);
  const kinds = [
    () => ({ request: open, files: { "a.toml": `${mutated(pick(frames), random)}${unfinished()}` } }),
    () => ({ request: open, files: { "a.toml": `${mutated(pick(frames), random)}${UNFINISHED}` } }),
    () => ({ request: open, files: { "a.toml": `base = "b"\n${UNFINISHED}`, "b.toml": mutated(pick(frames), random) } }),
    () => ({ request: open, files: { "a.toml": bytes(random) } }),
    () => ({ request: open, files: { "a.toml": words(random) } }),
    () => ({ request: drop, files: { "a.toml": words(random) } }),
    () => ({ request: drop, files: { "a.toml": mutated(pick(models), random) } }),
    () => ({ request: { ...drop, heights_m: [pick([0, -1, 1e9, 0.01, 3])] }, files: { "a.toml": pick(models) } }),
    () => ({ request: diagnose, files: { "drops.csv": mutated(TABLE, random) } }),
    () => ({ request: diagnose, files: { "soft_050cm/1.bin": bytes(random) } }),
    () => ({ request: JSON.parse(pick(["null", "1", "[]", "{\"do\":1}", "{\"do\":\"close\",\"handle\":7}", "{\"do\":\"files\",\"handle\":-1}"])), files: {} }),
  ];
  for (let at = 0; at < count; at += 1) yield kinds[at % kinds.length]();
}
