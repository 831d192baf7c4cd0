// Story 6: measured drops, judged; what a model lacks to explain them. An engine of its own, which can be ended at any time.
import { signal, type Signal } from "@preact/signals";
import plan from "../../../../params/synthetic/bottoming.toml?raw";
import { EngineClient, Refused } from "../engine/client.ts";
import type { Diagnosed, Measured } from "../engine/outcomes.ts";
import type { Attached, EngineFile } from "../engine/messages.ts";
import { complain, quiet } from "../state/notice.ts";
import { FrameSlot } from "../state/frame_slot.ts";
import { shownDoc } from "../state/studio.ts";
import { Work } from "../state/work.ts";
import { LastGood } from "../ui/last_good.tsx";
import { ModelSelect } from "../ui/model_select.tsx";
import { Progress } from "../ui/progress.tsx";
import { Records } from "./records.tsx";
import { Verdict } from "./verdict.tsx";

/** Larger tables are no drops of a frame; a browser would run out of memory on them. */
const LARGEST_BYTES = 64 << 20;

/** Names of files of drops. */
const RECORDS = /\.(csv|tsv|bin|bhn)$/i;

/** What is said of a table that another logger wrote, and what is done with its drops: what the command line's options take, as text. */
const OPTIONS = [
  { key: "columns", option: "--columns", label: "Columns", example: "t=Time,z=-Acc_Z" },
  { key: "units", option: "--units", label: "Units", example: "m/s2,ms" },
  { key: "zero_g", option: "--zero", label: "Readings in free fall, g", example: "0.4,-0.3,2" },
  { key: "rate_hz", option: "--rate", label: "Samples a second", example: "3200" },
  { key: "turn_deg", option: "--turn", label: "Sensor turned by, degrees", example: "45" },
] as const;

type Option = (typeof OPTIONS)[number]["key"];

const diagnoser = new EngineClient("diagnoser");
const written = Object.fromEntries(OPTIONS.map(({ key }) => [key, signal("")])) as Record<Option, Signal<string>>;
/** What is being typed: it stays when drops were read meanwhile. */
const typed = Object.fromEntries(OPTIONS.map(({ key }) => [key, signal("")])) as Record<Option, Signal<string>>;
const heldOut = signal("");
const drops = signal<Attached>({});
/** Whether they were made here, and are of no use beside others. */
const synthetic = signal(false);
/** Drops that the engine could not read, however they are written. */
let unreadable: Attached | null = null;
/** Whose mass and gap the model has. */
const bodyOf = signal<"model" | "frame">("model");
const judged = new FrameSlot(diagnoser);
/** The model that is usual for such drops. */
const USUAL = "";
const model = signal(USUAL);
const most = signal(3);
const making = new Work<void>();
const reading = new Work<Measured>();
const diagnosing = new Work<{ found: Diagnosed; files: EngineFile[]; of: string }>();

/** What was chosen in a field; the same files again are a choice, too. */
function takeChosen(input: HTMLInputElement): void {
  const chosen = [...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
  input.value = "";
  quiet();
  void takeDrops(chosen);
}

/** The drops that others are put beside: those of several folders, one a height. What could not be read is replaced. */
function kept(): Attached {
  return synthetic.value || drops.value === unreadable ? {} : drops.value;
}

/** Takes measured drops: files, each with its path, whose folder says the height of a logger's file. */
export async function takeDrops(given: { path: string; file: File }[]): Promise<void> {
  const taken: Attached = {};
  let sum = Object.values(kept()).reduce((bytes, { length }) => bytes + length, 0);
  // A folder holds other things, too.
  const files = given.filter(({ path }) => !path.includes("/") || RECORDS.test(path));
  for (const { file } of files) {
    sum += file.size;
    if (sum > LARGEST_BYTES) {
      complain(
        `With ${file.name} the drops have ${sum >> 20} MB; all files together may have ${LARGEST_BYTES >> 20} MB. Nothing was read: give fewer drops.`,
      );
      return;
    }
  }
  if (files.length === 0) {
    complain("There are no drops among these files: tables end in .csv or .tsv, a logger's files in .bin or .bhn.");
    return;
  }
  try {
    for (const { path, file } of files) taken[path] = new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    complain(`This cannot be read: ${error instanceof Error ? error.message : String(error)}`);
    return;
  }
  // Others may have been taken while these were read.
  const all = { ...kept(), ...taken };
  synthetic.value = false;
  await read(all);
}

/** Forgets the drops that are open. */
function clear(): void {
  if (diagnosing.running.value) diagnoser.end("The drops were closed.");
  drops.value = {};
  synthetic.value = false;
  reading.clear();
  diagnosing.clear();
}

/** Leaves files out of what is open. */
function leaveOut(files: string[]): void {
  const kept = Object.entries(drops.value).filter(([path]) => !files.includes(path));
  void read(Object.fromEntries(kept));
}

async function read(taken: Attached): Promise<void> {
  if (diagnosing.running.value) diagnoser.end("Other drops were opened.");
  diagnosing.clear();
  reading.result.value = null;
  drops.value = taken;
  await reading.run(async () => {
    const how = asWritten();
    try {
      return (await diagnoser.ask<Measured>({ do: "measure", written: how }, taken)).answer;
    } catch (error) {
      unreadable = taken;
      throw error;
    }
  });
}

/** What stands between commas. */
function list(text: string): string[] {
  return text
    .split(",")
    .map((one) => one.trim())
    .filter(Boolean);
}

function refused(message: string, remedy: string): Refused {
  return new Refused({ message, place: null, remedy });
}

/** The numbers between commas, of which some are good; an example says how they are written. */
function numbers(
  text: string,
  what: string,
  example: string,
  isGood: (number: number) => boolean = () => true,
): number[] {
  const found = list(text).map(Number);
  if (!found.every(Number.isFinite)) throw refused(`${what}: ${text} is no list of numbers`, `write ${example}`);
  if (!found.every(isGood))
    throw refused(
      `${what}: ${text} holds a number that is not above zero`,
      `write ${example}; a comma stands between numbers, a point in them`,
    );
  return found;
}

const isAboveZero = (number: number) => number > 0;

/** The one number of a field; null where there is none. */
function one(text: string, what: string, example: string, isGood?: (number: number) => boolean): number | null {
  const [first, ...more] = numbers(text, what, example, isGood);
  if (more.length > 0) throw refused(`${what}: this is one number`, `write ${example}`);
  return first ?? null;
}

function asWritten() {
  return {
    columns: list(written.columns.value),
    units: list(written.units.value),
    zero_g: numbers(written.zero_g.value, "Readings in free fall, g", "0.4 or 0.4,-0.3,2"),
    rate_hz: one(written.rate_hz.value, "Samples a second", "3200", isAboveZero),
    turn_deg: one(written.turn_deg.value, "Sensor turned by, degrees", "45") ?? 0,
  };
}

async function example(): Promise<void> {
  await making.run(async () => {
    const { files } = await diagnoser.ask({ do: "synthesize", plan: "bottoming.toml" }, { "bottoming.toml": plan });
    synthetic.value = true;
    await read({ "synthetic-drops.csv": files[0]!.bytes });
  });
}

async function diagnose(): Promise<void> {
  await diagnosing.run(async (onStage) => {
    const held = numbers(heldOut.value, "Heights held out, m", "1.5 or 0.5,1.5", isAboveZero);
    const frame = bodyOf.value === "frame" ? shownDoc.value : null;
    const request = {
      do: "diagnose",
      handle: frame && (await judged.opened(frame)).handle,
      ...(model.value !== USUAL && { model: model.value }),
      max_effects: most.value,
      hold_out_heights_m: held,
      written: asWritten(),
    };
    const without = held.length > 0 ? `; no fit sees the drops from ${held.join(", ")} m` : "";
    const effects = `${most.value} ${most.value === 1 ? "effect" : "effects"}`;
    const { answer, files } = await diagnoser.ask<Diagnosed>(request, drops.value, onStage);
    return { found: answer, files, of: `Of the model ${answer.base.model}, with at most ${effects}${without}` };
  });
}

export function Diagnose() {
  const measured = reading.result.value;
  const names = Object.keys(drops.value);
  return (
    <div class="diagnose">
      <div class="row dropzone">
        <Files words="Open measured drops (CSV)" accept=".csv,.tsv" />
        <Files words="or a folder of them (CSV, .bin, .bhn)" folder />
        <span>or drag them here,</span>
        <button type="button" onClick={() => void example()}>
          or try synthetic ones
        </button>
        {names.length > 0 && (
          <button type="button" onClick={clear}>
            Close these drops
          </button>
        )}
      </div>
      {names.length > 0 && <HowWritten />}
      <Progress of={making} words="Making drops" />
      <Progress of={reading} words="Reading" />
      {measured && <Records measured={measured} names={names} onLeaveOut={leaveOut} />}
      {measured && (
        <div class="row">
          <ModelSelect label="Model of the diagnosis" model={model} own={[USUAL, "as the drops' axes suit"]} />
          <label>
            Effects at most{" "}
            <select
              aria-label="Effects at most"
              value={most}
              onChange={(event) => (most.value = Number(event.currentTarget.value))}
            >
              {[1, 2, 3].map((count) => (
                <option key={count} value={count}>
                  {count}
                </option>
              ))}
            </select>
          </label>
          <label>
            Heights held out, m{" "}
            <input
              type="text"
              size={8}
              placeholder="1.5"
              value={heldOut}
              onInput={(event) => (heldOut.value = event.currentTarget.value)}
            />
          </label>
          <label>
            Mass and gap of{" "}
            <select
              aria-label="Mass and gap of"
              value={bodyOf}
              onChange={(event) => (bodyOf.value = event.currentTarget.value as "model" | "frame")}
            >
              <option value="model">the model</option>
              <option value="frame">the frame {shownDoc.value?.name ?? ""}</option>
            </select>
          </label>
          {bodyOf.value === "frame" && <LastGood />}
          <button type="button" disabled={diagnosing.running.value} onClick={() => void diagnose()}>
            Diagnose
          </button>
          {diagnosing.running.value && (
            <button type="button" onClick={() => diagnoser.end("The diagnosis was cancelled.")}>
              Cancel
            </button>
          )}
        </div>
      )}
      <Progress of={diagnosing} words="Diagnosing" />
      {diagnosing.result.value && diagnosing.failure.value === null && (
        <div class={diagnosing.running.value ? "old" : ""}>
          <Verdict {...diagnosing.result.value} />
        </div>
      )}
    </div>
  );
}

/** A field for files, or for the files of a folder. Its own words, which say that none is chosen, are hidden: it is emptied once they are taken. */
function Files({ words, accept, folder = false }: { words: string; accept?: string; folder?: boolean }) {
  return (
    <label class="file">
      {words}
      <input
        type="file"
        multiple
        accept={accept}
        aria-label={words}
        ref={(input) => {
          if (folder) input?.setAttribute("webkitdirectory", "");
        }}
        onChange={(event) => takeChosen(event.currentTarget)}
      />
    </label>
  );
}

/** What another logger's table needs to be read. A change reads the drops again. */
function HowWritten() {
  const isAsked = (reading.result.value?.notes ?? []).some((note) =>
    OPTIONS.some(({ option }) => note.includes(option)),
  );
  return (
    <details open={isAsked || reading.failure.value !== null || OPTIONS.some(({ key }) => written[key].value !== "")}>
      <summary>Another logger's table</summary>
      <div class="row">
        {OPTIONS.map(({ key, option, label, example }) => (
          <label key={key}>
            {label} (<code>{option}</code>){" "}
            <input
              type="text"
              size={16}
              placeholder={example}
              value={typed[key]}
              onInput={(event) => (typed[key].value = event.currentTarget.value)}
              onChange={(event) => {
                written[key].value = event.currentTarget.value;
                void read(drops.value);
              }}
            />
          </label>
        ))}
      </div>
    </details>
  );
}
