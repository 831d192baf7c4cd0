// The state of the page: what is edited, and what the engines said of it. Newer input replaces older that still waits.
import { batch, computed, effect, signal } from "@preact/signals";
import { EngineClient, Refused, Stopped } from "../engine/client.ts";
import type { Catalogue, Checked, Edited, Finding, Opened, Presets, Read } from "../engine/answers.ts";
import type { Refusal } from "../engine/messages.ts";
import type { Doc } from "./doc.ts";
import { baseName, identity, isUnchanged, keyAtLine, ofPreset, source } from "./doc.ts";
import { followed } from "./follows.ts";
import { FrameSlot } from "./frame_slot.ts";
import { History } from "./history.ts";
import type { Setting } from "./link.ts";
import { fromFragment } from "./link.ts";
import { complain, quiet } from "./notice.ts";
import { borrow, restored, store } from "./storage.ts";

/** Draws: pictures first, then quick checks. */
export const shower = new EngineClient("shower");
/** Everything that takes long: all checks, comparisons, folds, drops, files. */
export const checker = new EngineClient("checker");
export const shown = new FrameSlot(shower);
export const current = new FrameSlot(checker);

export const presets = signal<Presets | null>(null);
export const catalogue = signal<Catalogue | null>(null);
export const doc = signal<Doc>(ofPreset("cognifly"));
/** The preset, as it is read. */
export const base = signal<Read | null>(null);
/** The frame of the picture: the last that was good. */
export const frame = signal<Opened | null>(null);
export const shownDoc = signal<Doc | null>(null);
export const picture = signal<Uint8Array<ArrayBuffer> | null>(null);
/** Why the frame file is refused; `editable`: whether values can be set in it, as it is TOML. */
export const refused = signal<{ refusal: Refusal; key: string | null; editable: boolean } | null>(null);
export const computing = signal(false);
/** Values that are not those of the picture: set and not in the text yet, or of a file that is refused. */
export const pending = signal<Record<string, Setting | null>>({});
/** The name that the frame file gets, until it has it. */
const renamed = signal<string | null>(null);
/** The frame file's name as it was given last. */
export const fileName = computed(() => renamed.value ?? doc.value.name);
/** What the checks found; `strength`: with the drop by the frame's own mechanics. */
export const findings = signal<{ of: Finding[]; all: boolean; strength: boolean; identity: string } | null>(null);
/** How many limits are violated, as far as is known. */
export const violations = computed(
  () => findings.value?.of.filter(({ verdict }) => verdict === "violated").length ?? 0,
);
/** Whether the drop by the frame's own mechanics is asked for after all checks: it takes as long as they do. */
export const withStrength = signal(false);
/** Why it could not be computed. */
export const strengthFailure = signal<string | null>(null);
/** Why there are quick checks only. */
export const checksFailure = signal<string | null>(null);
export const checking = signal<{ done: number; of: number; name: string } | null>(null);

const history = new History();
export const canUndo = history.canUndo;
export const canRedo = history.canRedo;

/** What a key is now: as it was just set, or as it is in the frame. */
export function valueOf(key: string): Setting | null {
  const set = pending.value[key];
  if (set !== undefined && set !== null) return set;
  // What follows from something else is not known before the engine has computed it.
  const read = set === null && followsFrom(key) === null ? base.value : frame.value;
  return read?.values[key] ?? read?.choices[key] ?? null;
}

/** What it is in the preset. */
export function baseOf(key: string): Setting | null {
  return base.value?.values[key] ?? base.value?.choices[key] ?? null;
}

/** What a key follows from in words, if it does where the frame file does not state it; `null` where it is the preset's then. */
export function followsFrom(key: string): string | null {
  return base.value?.stated.includes(key) ? null : followed(key, catalogue.value);
}

export function same(a: Setting | null, b: Setting | null): boolean {
  return typeof a === "number" && typeof b === "number" ? Math.abs(a - b) < 1e-9 : a === b;
}

/** The keys that the frame file states otherwise than the preset, or instead of letting them follow. What follows from them is not among them. */
export const changedKeys = computed(() => {
  const set = Object.keys(pending.value).filter((key) => pending.value[key] !== null);
  const keys = [...(frame.value?.stated ?? []).filter((key) => pending.value[key] !== null), ...set];
  const differs = (key: string) => followsFrom(key) !== null || !same(valueOf(key), baseOf(key));
  return new Set(keys.filter((key) => baseOf(key) !== null && differs(key)));
});

/** Whether the findings are those of the picture. */
export const findingsAreOfPicture = computed(
  () => findings.value !== null && shownDoc.value !== null && findings.value.identity === identity(shownDoc.value),
);
/** Whether they are also those of the frame file: a refused file has none, and the picture is of the last good frame. */
export const findingsAreCurrent = computed(() => findingsAreOfPicture.value && refused.value === null);

/** A change of the frame file; changes of one gesture are one step of undo. */
type Change = { set: Record<string, Setting | null>; name?: string; gesture: number };

type Wanted = {
  doc: Doc;
  /** The gesture by which `doc` takes the place of the frame file; `null` where it is no step of undo. */
  gesture: number | null;
  /** What is changed of it then, in this order. */
  changes: Change[];
  /** Whether it changes the frame file that is there then, and does not take its place. */
  onTop: boolean;
  group: string | null;
  begun: number;
  /** Whether it is the frame of a link. */
  linked?: boolean;
};
let wanted: Wanted | null = null;
let running = false;
/** A change that is not in the frame file yet, and in the history. */
let underway: Wanted | null = null;
/** Who waits until every change is in the history, or in the frame file. */
const forHistory: (() => void)[] = [];
const forFile: (() => void)[] = [];
/** Counts what replaces the text from elsewhere than the text's own field. */
export const replaced = signal(0);

/** What is written of a value into a frame file; `null` takes the key out of it. */
function written(key: string, value: Setting | null, text: string): Setting | null {
  // Out of the file it would follow again, whatever was typed.
  if (followsFrom(key) !== null) return value;
  // Without a base nothing would be there then.
  if (baseName(text) === undefined) return value ?? baseOf(key);
  return same(value, baseOf(key)) ? null : value;
}

/** Sets values; `null` gives a key back to the preset, or to what it follows from. */
export function set(values: Record<string, Setting | null>): void {
  const { text } = latest();
  const entries = Object.entries(values).map(([key, value]) => [key, written(key, value, text)] as const);
  quiet();
  pending.value = { ...pending.value, ...Object.fromEntries(entries) };
  replaced.value += 1;
  const group = entries.length === 1 ? (entries[0]?.[0] ?? null) : null;
  change({ set: Object.fromEntries(entries), gesture: history.gesture(group) }, group);
}

/** Gives the frame file another name. */
export function rename(to: string): void {
  quiet();
  renamed.value = to;
  change({ set: {}, name: to, gesture: history.gesture(null) }, null);
}

/** Changes the frame file as it was left last, after what waits already. */
function change(next: Change, group: string | null): void {
  const begun = performance.now();
  const waits = wanted ?? { doc: doc.value, gesture: null, changes: [], onTop: true };
  const last = waits.changes.at(-1);
  const goesOn = last?.gesture === next.gesture;
  const changes = goesOn
    ? [...waits.changes.slice(0, -1), { ...next, set: { ...last.set, ...next.set } }]
    : [...waits.changes, next];
  want({ ...waits, changes, group, begun, linked: false });
}

/** The frame file as it was left last: with its new text and name, without the values that are still to be set in it. */
export function latest(): Doc {
  const waits = [underway, wanted].filter((one) => one !== null);
  const of = waits.findLast(({ onTop }) => !onTop)?.doc ?? doc.value;
  const since = waits.slice(wanted?.onTop ? 0 : -1).flatMap(({ changes }) => changes);
  return { ...of, name: since.findLast(({ name }) => name !== undefined)?.name ?? of.name };
}

/** Goes on once the frame file has every change that was made before. */
export async function whenTaken(): Promise<void> {
  if (underway || wanted) await new Promise<void>((resolve) => forFile.push(resolve));
}

/** Takes another document: an edited text, another preset. Quick changes of one `group` are one step of undo. */
export function take(next: Doc, { record = true, group = null as string | null } = {}): void {
  quiet();
  pending.value = {};
  renamed.value = null;
  if (group !== "text") replaced.value += 1;
  const gesture = history.gesture(group);
  want({ doc: next, gesture: record ? gesture : null, changes: [], onTop: false, group, begun: performance.now() });
}

export function undo(): void {
  void step(() => history.undo());
}

export function redo(): void {
  void step(() => history.redo());
}

/** A step of the history, once all that was changed before is in it. */
async function step(move: () => Doc | undefined): Promise<void> {
  if (isStep(underway) || isStep(wanted)) await new Promise<void>((resolve) => forHistory.push(resolve));
  const to = move();
  if (to) take(to, { record: false });
}

/** Whether something is in the history after it. */
function isStep(of: Wanted | null): boolean {
  return of !== null && (of.gesture !== null || of.changes.length > 0);
}

/** A change is in the frame file: whoever waited for the last one goes on. */
function settled(): void {
  underway = null;
  if (!wanted?.changes.some(({ name }) => name !== undefined)) renamed.value = null;
  if (!isStep(wanted)) for (const go of forHistory.splice(0)) go();
  if (!wanted) for (const go of forFile.splice(0)) go();
}

function want(next: Wanted): void {
  wanted = next;
  if (!running) void run();
}

async function run(): Promise<void> {
  running = true;
  computing.value = true;
  while (wanted) {
    const now: Wanted = wanted;
    wanted = null;
    underway = now;
    try {
      await show(now);
    } catch (error) {
      if (error instanceof Stopped) {
        complain(`The engine stopped and was started again: ${error.message}`);
        if (shownDoc.value !== doc.value) stopped(error.message);
        else checksFailure.value = error.message;
        if (!shownDoc.value) await showPreset(doc.value.preset).catch(() => undefined);
      } else if (error instanceof Refused) {
        await refuse(error.refused, now.group);
        if (!shownDoc.value) await showPreset(doc.value.preset).catch((failure: unknown) => complain(String(failure)));
      } else {
        complain(`This went wrong in the page: ${error instanceof Error ? error.message : String(error)}`);
        console.error(error);
      }
    }
    // A change that failed before it was recorded is no step.
    settled();
  }
  computing.value = false;
  running = false;
}

/** A frame at which the engine stops is none: what is shown is of the last good one. */
function stopped(message: string): void {
  const refusal = {
    message: `the engine stopped at this frame: ${message}`,
    place: null,
    remedy: "undo the last change",
  };
  refused.value = { refusal, key: null, editable: true };
}

/** Keeps why the frame file is refused. */
async function refuse(refusal: Refusal, group: string | null): Promise<void> {
  const { name, text } = doc.value;
  const stated = await statedBy(text);
  const editable = stated !== null;
  // The fields show what the file states. A value that cannot be written anywhere must not look as if it were set.
  const waits = wanted?.changes.map(({ set }) => set) ?? [];
  pending.value = stated ? Object.assign(ofFile(stated), ...waits) : {};
  const { place } = refusal;
  // Why it cannot be written was found of the text before, with its line.
  if (!editable && !place && refused.value) return;
  const atLine = place && place.file === `${name}.toml` ? keyAtLine(text, place.line) : null;
  refused.value = { refusal, key: atLine ?? group, editable };
}

/** What a refused file states, and `null` for what only the frame of the picture states. */
function ofFile(stated: Record<string, Setting>): Record<string, Setting | null> {
  const gone = (frame.value?.stated ?? []).filter((key) => !(key in stated)).map((key) => [key, null] as const);
  return { ...Object.fromEntries(gone), ...stated };
}

/** The numbers and words that a text states, good or not; `null` where it is no TOML, in which values can be set. */
async function statedBy(text: string): Promise<Record<string, Setting> | null> {
  return shower.ask<Edited>({ do: "edit", text, set: {} }).then(
    ({ answer }) => answer.stated,
    (error: unknown) => (error instanceof Refused ? null : {}),
  );
}

/** The preset's picture and values where the first frame file is refused, so that what is typed has something beside it. */
async function showPreset(preset: string): Promise<void> {
  const next = ofPreset(preset);
  const opened = await shown.opened(next);
  if (!wanted) await draw(next, opened);
}

/** When a picture was shown last, and how long a newer wish may keep the next one away, ms. */
let drawnAt = 0;
const LONGEST_REST_MS = 200;

/** Shows an opened frame; whether there is a picture of it. */
async function draw(next: Doc, opened: Opened): Promise<boolean> {
  const { files } = await shower.ask({ do: "files", handle: opened.handle, which: ["glb"] });
  const bytes = files[0]?.bytes;
  if (!bytes) return false;
  batch(() => {
    drawnAt = performance.now();
    frame.value = opened;
    shownDoc.value = next;
    picture.value = bytes;
    // A preset in the place of a refused file leaves the refusal.
    if (next !== doc.value) return;
    refused.value = null;
    if (!wanted) pending.value = {};
  });
  return true;
}

async function changed(of: Doc, { set, name }: Change): Promise<Doc> {
  let next = of;
  if (Object.keys(set).length > 0) {
    const { answer } = await shower.ask<Edited>({ do: "edit", text: of.text, set });
    next = { ...of, text: answer.text, name: of.name === of.preset ? `my-${of.preset}` : of.name };
  }
  return name === undefined ? next : { ...next, name };
}

async function show(now: Wanted): Promise<void> {
  let next = now.doc;
  const steps: [Doc, number][] = now.gesture === null ? [] : [[next, now.gesture]];
  for (const change of now.changes) {
    next = await changed(next, change);
    steps.push([next, change.gesture]);
  }
  if (base.value === null || next.preset !== doc.value.preset || base.value.name !== next.preset) {
    base.value = (await shower.ask<Read>({ do: "read", frame: next.preset })).answer;
  }
  doc.value = next;
  // What was set in the meantime belongs on top of this text.
  if (wanted?.onTop) wanted.doc = next;
  for (const step of steps) history.record(...step);
  settled();
  if (now.linked) borrow(next);
  store(next);
  const opened = await shown.opened(next);
  // A newer wish makes this picture useless, unless wishes come faster than pictures.
  if (wanted && performance.now() - drawnAt < LONGEST_REST_MS) return;
  if (!(await draw(next, opened))) return;
  performance.measure("change", { start: now.begun, end: performance.now() });
  if (wanted) return;
  // The second engine has nothing of the first frame yet: it makes it while nothing is changed.
  if (!findings.value) current.opened(next).catch(() => undefined);
  const { answer } = await shower.ask<Checked>({ do: "findings", handle: opened.handle, quick: true });
  const known = findings.value;
  const found = answer.frames[0]?.findings ?? [];
  if (!(known?.all && known.identity === identity(next)))
    findings.value = { of: found, all: false, strength: false, identity: identity(next) };
}

/** All checks, in the second engine, when nothing was changed for a moment. */
let resting: ReturnType<typeof setTimeout> | undefined;
effect(() => {
  const of = shownDoc.value;
  void withStrength.value;
  clearTimeout(resting);
  // What failed was another frame, or is asked for once more.
  checksFailure.value = null;
  strengthFailure.value = null;
  if (of) resting = setTimeout(() => void checkAll(of), 500);
});

/** Checks again what could not be checked. */
export function checkAgain(): void {
  checksFailure.value = null;
  strengthFailure.value = null;
  if (shownDoc.value) void checkAll(shownDoc.value);
}

let checkRuns = false;
async function checkAll(of: Doc): Promise<void> {
  if (checkRuns) {
    resting = setTimeout(() => void checkAll(of), 200);
    return;
  }
  checkRuns = true;
  const known = findings.peek();
  const begun = performance.now();
  try {
    if (!(known?.all && known.identity === identity(of))) {
      if (!(await found(of, false))) return;
      performance.measure("all checks", { start: begun, end: performance.now() });
    }
    if (withStrength.peek() && !findings.peek()?.strength) await checkStrength(of);
  } catch (error) {
    if (error instanceof Stopped) complain(`The second engine stopped and was started again: ${error.message}`);
    else if (!(error instanceof Refused)) throw error;
    const found = findings.peek();
    if (shownDoc.peek() === of && !(found?.all && found.identity === identity(of))) checksFailure.value = error.message;
  } finally {
    checking.value = null;
    checkRuns = false;
  }
}

/** A frame without a model of its mechanics keeps its other findings. */
async function checkStrength(of: Doc): Promise<void> {
  strengthFailure.value = null;
  try {
    await found(of, true);
  } catch (error) {
    if (!(error instanceof Refused || error instanceof Stopped)) throw error;
    if (shownDoc.peek() === of) strengthFailure.value = error.message;
    if (error instanceof Stopped) throw error;
  }
}

/** Asks the second engine for findings; whether they are of what is still shown. */
async function found(of: Doc, strength: boolean): Promise<boolean> {
  const { handle } = await current.opened(of);
  const request = { do: "findings", handle, strength };
  const { answer } = await checker.ask<Checked>(request, {}, (stage) => (checking.value = stage));
  const still = shownDoc.value !== null && identity(shownDoc.value) === identity(of);
  if (still) findings.value = { of: answer.frames[0]?.findings ?? [], all: true, strength, identity: identity(of) };
  return still;
}

type Opening = { doc: Doc; values: Record<string, Setting | null> };

/** Takes the frame of a link with its values, as one step. */
function takeLinked({ doc: of, values }: Opening, begun: number): void {
  pending.value = values;
  renamed.value = null;
  replaced.value += 1;
  const changes = [{ set: values, gesture: history.gesture(null) }];
  want({ doc: of, gesture: null, changes, onTop: false, group: null, begun, linked: true });
}

/** Asks for the frame that the page most likely begins with, so that the engine makes it while the page is still drawn. */
function expect(): { preset: string; read: Promise<Read> } | null {
  if (location.hash) return null;
  const likely = restored() ?? doc.value;
  const read = shower.ask<Read>({ do: "read", frame: likely.preset }).then(({ answer }) => answer);
  // What goes wrong here goes wrong again when it is asked for, and is told then.
  read.catch(() => undefined);
  shown.opened(likely).catch(() => undefined);
  return { preset: likely.preset, read };
}

/** The frame of the link in the address, which is taken out of it; `null` where there is none, or it cannot be read. */
function openedLink(): Opening | null {
  const [frames, listed] = [presets.value?.frames ?? [], catalogue.value];
  try {
    const keys = new Set([...(listed?.parameters ?? []), ...(listed?.choices ?? [])].map(({ key }) => key));
    const linked = fromFragment(location.hash, { presets: frames.map(({ name }) => name), keys });
    const of = linked && ofPreset(linked.preset);
    return of && { doc: { ...of, name: linked.name, text: linked.text ?? of.text }, values: linked.set };
  } catch (error) {
    complain(
      `The link cannot be read: ${error instanceof Error ? error.message : String(error)}. The frame of before is shown.`,
    );
    return null;
  } finally {
    if (location.hash) window.history.replaceState(null, "", location.pathname + location.search);
  }
}

/** A link that is put into the address of the open page is a step like any other. */
addEventListener("hashchange", () => {
  const linked = catalogue.value && openedLink();
  if (linked) takeLinked(linked, performance.now());
});

/** Starts: a link's frame on top of the one of before, the one of before, or the first preset. */
export async function begin(): Promise<void> {
  const asked = performance.now();
  const answers = Promise.all([shower.ask<Presets>({ do: "presets" }), shower.ask<Catalogue>({ do: "catalogue" })]);
  const expected = expect();
  const [known, listed] = await answers;
  presets.value = known.answer;
  catalogue.value = listed.answer;
  const first = known.answer.frames[0]?.name ?? "cognifly";
  const linked = openedLink();
  const names = known.answer.frames.map(({ name }) => name);
  const own = restored(names);
  const start = linked?.doc ?? own ?? ofPreset(first);
  doc.value = start;
  if (expected?.preset === start.preset) base.value = await expected.read;
  // Undo gives back what the link, or the preset, took the place of.
  const former = linked ? own : isUnchanged(start) ? restored(names, true) : null;
  if (former) history.record(former, history.gesture(null));
  if (linked) takeLinked(linked, asked);
  else {
    const gesture = history.gesture(null);
    want({ doc: start, gesture, changes: [], onTop: false, group: null, begun: asked });
  }
}

export { identity, isUnchanged, source };
