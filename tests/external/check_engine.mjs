// node check_engine.mjs ENGINE PROGRAM BUILT SAME WORK: one line a result. ENGINE is the folder that studio/build.sh makes,
// PROGRAM the native program, BUILT the folder in which it built and folded every preset, SAME one with everything that it
// writes of the default frame, STEP too, and WORK a folder for files of this test. What the module gives has the same bytes.
import { execFileSync, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { isMainThread, Worker } from "node:worker_threads";
import { brotliCompressSync, constants } from "node:zlib";

const [folder, program, built, same, work] = process.argv.slice(2).map((path) => resolve(path));
const { Engine } = await import(pathToFileURL(join(folder, "engine.mjs")));
const { randomTexts } = await import("./random_texts.mjs");

/** Largest module over the wire, bytes. */
const MOST_BYTES = 2_500_000;
/** Largest file of results that are computed ahead, bytes. */
const MOST_AHEAD_BYTES = 500_000;
/** Random texts that must not stop the engine. */
const TEXTS = 2000;

let code = 0;
function tell(name, fault) {
  if (fault) code = 1;
  console.log(fault ? `FAILED engine: ${name}: ${fault}` : `ok engine: ${name}`);
}

const text = (path) => readFileSync(path, "utf8");
const digest = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** What the program prints as JSON; a violated limit and a refusal are answers, too. */
function asked(...args) {
  const { status, stdout, stderr } = spawnSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28, env: { ...process.env, FLEXFRAME_CACHE: "off" } });
  if (status === null || status > 2) throw new Error(`${args.join(" ")}: ${stderr}`);
  return JSON.parse(stdout);
}

/** The first place in which two values differ; the order of keys does not count. */
function difference(native, engine, at = "") {
  if (native === engine) return null;
  if (native === null || engine === null || typeof native !== "object" || typeof engine !== "object") {
    return `${at}: ${JSON.stringify(native)} natively, ${JSON.stringify(engine)} here`;
  }
  const keys = new Set([...Object.keys(native), ...Object.keys(engine)]);
  return [...keys].map((key) => difference(native[key], engine[key], `${at}/${key}`)).find(Boolean);
}

/** What is wrong with files: each must have the bytes of the program's. */
function otherBytes(files, native) {
  if (!files?.length) return "no files";
  const differ = files.filter(({ path, bytes }) => !existsSync(join(native, path)) || digest(bytes) !== digest(readFileSync(join(native, path))));
  return differ.length > 0 ? `other bytes than the program's: ${differ.map(({ path }) => path).join(", ")}` : null;
}

/** The answer, or why there is none. */
function answered(engine, request, files) {
  const reply = engine.ask(request, files);
  if (reply.refused) throw new Error(`refused: ${reply.refused.message}`);
  return reply;
}

/** Results that are computed ahead, as the page is built: an engine of the same build takes them, and no other. */
function prepared() {
  execFileSync("node", ["studio/prepare.mjs", folder]);
  return new Uint8Array(readFileSync(join(folder, "prepared.bin")));
}

function results(engine, bytes) {
  const { results } = answered(engine, { do: "use-results" }, { "prepared.bin": bytes }).answer;
  tell(`${results} results computed ahead, ${bytes.length} bytes`, results > 1000 && bytes.length < MOST_AHEAD_BYTES ? null : "too few, or too many bytes");
  const other = bytes.slice();
  other[5] ^= 1;
  const { refused } = engine.ask({ do: "use-results" }, { "prepared.bin": other });
  tell("results of another build", refused?.message.includes("this build") ? null : "are taken");
}

/** With results computed ahead by an engine that had none: the program finds the same. */
function presets(engine) {
  for (const { name } of answered(engine, { do: "presets" }).answer.frames) {
    const { handle } = answered(engine, { do: "open", frame: name }).answer;
    const files = (which) => answered(engine, { do: "files", handle, which }).files;
    tell(`${name}: STL, GLB, 3MF, bill`, otherBytes(files(["stl", "glb", "plates", "bill"]), join(built, name)));
    tell(`${name}: fold`, otherBytes(files(["fold", "fold-motion"]), join(built, `${name}-fold`)));
    const { answer } = answered(engine, { do: "findings", handle });
    tell(`${name}: findings`, difference(asked("check", name, "--json"), answer));
    const heights_m = [0.5, 1, 1.5];
    const drop = answered(engine, { do: "drop", model: "paper-corrected", handle, heights_m, trace: true });
    const native = asked("drop", name, "--model", "paper-corrected", "--height", heights_m.join(), "--trace", "--json", "-o", join(work, "drops"));
    tell(`${name}: drop`, difference(native, drop.answer) ?? otherBytes(drop.files, join(work, "drops", `drop-paper-corrected-${name}`)));
    answered(engine, { do: "close", handle });
  }
}

/** Everything of the default frame, with STEP, and its mechanics. */
function defaultFrame(engine) {
  const { handle } = answered(engine, { do: "open", frame: "cognifly" }).answer;
  tell("everything that build writes", otherBytes(answered(engine, { do: "files", handle, which: ["folder"] }).files, join(same, "cognifly")));
  const instructions = answered(engine, { do: "files", handle, which: ["instructions"] }).files;
  tell("instructions", otherBytes(instructions, join(same, "cognifly-fold")));
  tell("bill", difference(asked("bom", "--json"), answered(engine, { do: "bill", handle }).answer));
  const stiffness = JSON.parse(text(join(same, "cognifly-stiffness", "stiffness.json")));
  tell("stiffness", difference(stiffness, answered(engine, { do: "stiffness", handle }).answer));
  answered(engine, { do: "close", handle });
}

/** Drops of a known model, diagnosed here and there. */
async function diagnosis() {
  const stages = [];
  const engine = await Engine.load(module, (stage) => stages.push(stage));
  execFileSync(program, ["synthesize", "params/synthetic/bottoming.toml", "-q", "-o", work]);
  const [table] = readdirSync(work, { recursive: true }).filter((path) => path.endsWith("drops.csv"));
  const native = asked("diagnose", join(work, table), "--model", "paper", "--max-effects", "1", "--json", "-o", work);
  const drops = { [join(work, table)]: readFileSync(join(work, table)) };
  const { answer, files } = answered(engine, { do: "diagnose", model: "paper", max_effects: 1 }, drops);
  tell("diagnosis", difference(native, answer) ?? otherBytes(files, join(work, "diagnose-paper")));
  tell("stages of a diagnosis", stages.length === 4 ? null : `${stages.length} were told`);
}

/** The frames that the tests refuse: text, line and remedy as of the command line. */
function refusals(engine) {
  const paths = readdirSync("tests/frames").filter((name) => name.startsWith("refused-")).map((name) => `tests/frames/${name}/frame.toml`);
  const { frames } = asked("check", ...paths, "--json");
  const faults = paths.map((path, at) => {
    const { refused } = engine.ask({ do: "open", frame: path }, { [path]: readFileSync(path) });
    const { refused: message, remedy, place } = frames[at];
    return refused ? difference({ message, remedy, place }, refused, path) : `${path} is not refused`;
  });
  tell(`${paths.length} refusals`, faults.find(Boolean) ?? (paths.length > 10 ? null : "too few"));
}

/** Random texts: an answer or a refusal, never a panic. They run in a thread of their own, as they take as long as all else. */
function texts(engine) {
  const seen = { answered: 0, refused: 0 };
  for (const { request, files } of randomTexts(TEXTS)) {
    const { answer, refused } = engine.ask(request, files);
    seen[refused ? "refused" : "answered"] += 1;
    if (answer?.handle) engine.ask({ do: "close", handle: answer.handle });
  }
  const few = Object.entries(seen).find(([, count]) => count < TEXTS / 20);
  tell(`${TEXTS} random texts, ${seen.answered} answered and ${seen.refused} refused`, few ? `hardly any were ${few[0]}` : null);
}

/** Runs a test and tells of a failure that it did not foresee. */
async function run(name, test) {
  const begun = performance.now();
  try {
    await test();
  } catch (error) {
    tell(name, `${error.message}`.split("\n")[0]);
  }
  console.error(`engine: ${name}: ${((performance.now() - begun) / 1000).toFixed(1)} s`);
}

const module = readFileSync(join(folder, "engine.wasm"));
const start = () => Engine.load(module, () => {});

function size() {
  // Quality 9 takes a tenth of the time of 11 and gives a seventh more.
  const bytes = brotliCompressSync(module, { params: { [constants.BROTLI_PARAM_QUALITY]: 9, [constants.BROTLI_PARAM_LGWIN]: 24 } }).length;
  tell(`size, ${bytes} bytes with brotli`, bytes > MOST_BYTES ? `${MOST_BYTES} are the most` : null);
}

if (isMainThread) {
  rmSync(work, { recursive: true, force: true });
  mkdirSync(work, { recursive: true });
  const other = new Worker(new URL(import.meta.url), { argv: process.argv.slice(2) });
  const ended = new Promise((resolve) => other.on("exit", resolve).on("error", (error) => tell("random texts", error.message)));
  await run("size", size);
  await run("presets", async () => {
    const engine = await start();
    results(engine, prepared());
    presets(engine);
  });
  await run("default frame", async () => defaultFrame(await start()));
  await run("diagnosis", diagnosis);
  await run("refusals", async () => refusals(await start()));
  process.exit(Math.max(code, await ended));
} else {
  await run("random texts", async () => texts(await start()));
  process.exit(code);
}
