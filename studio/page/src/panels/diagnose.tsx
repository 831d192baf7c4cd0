// Story 6: measured drops, judged; what a model lacks to explain them. An engine of its own, which can be ended at any time.
import { signal } from "@preact/signals";
import plan from "../../../../params/synthetic/bottoming.toml?raw";
import { EngineClient, Refused } from "../engine/client.ts";
import type { Diagnosed, Measured } from "../engine/outcomes.ts";
import type { Attached, EngineFile } from "../engine/messages.ts";
import { save } from "../state/downloads.ts";
import { complain, quiet } from "../state/notice.ts";
import { Work } from "../state/work.ts";
import { ModelSelect } from "../ui/model_select.tsx";
import { Progress } from "../ui/progress.tsx";
import { short } from "../ui/words.ts";

/** Larger tables are no drops of a frame; a browser would run out of memory on them. */
const LARGEST_BYTES = 64 << 20;

/** As many names are told one by one. */
const FEW = 6;

/** Names of files of drops. */
const RECORDS = /\.(csv|tsv|bin|bhn)$/i;

/** What is said of a table that another logger wrote, and what is done with its drops: what the command line's options take, as text. */
const OPTIONS = [
  { key: "columns", option: "--columns", label: "Columns", example: "t=Time,z=-Acc_Z" },
  { key: "units", option: "--units", label: "Units", example: "m/s2,ms" },
  { key: "zero_g", option: "--zero", label: "Readings in free fall, g", example: "0.4,-0.3,2" },
  { key: "rate_hz", option: "--rate", label: "Samples a second", example: "3200" },
] as const;

const diagnoser = new EngineClient("diagnoser");
const written = { columns: signal(""), units: signal(""), zero_g: signal(""), rate_hz: signal("") };
const heldOut = signal("");
const drops = signal<Attached>({});
const model = signal("paper");
const most = signal(3);
const making = new Work<void>();
const reading = new Work<Measured>();
const diagnosing = new Work<{ found: Diagnosed; files: EngineFile[]; of: string }>();

/** What was chosen in a field; the same files again are a choice, too. */
function takeChosen(input: HTMLInputElement): void {
  const chosen = [...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
  input.value = "";
  void takeDrops(chosen);
}

/** Takes measured drops: files, each with its path, whose folder says the height of a logger's file. */
export async function takeDrops(given: { path: string; file: File }[]): Promise<void> {
  quiet();
  const taken: Attached = {};
  let sum = 0;
  // A folder holds other things, too.
  const files = given.filter(({ path }) => !path.includes("/") || RECORDS.test(path));
  for (const { file } of files) {
    sum += file.size;
    if (sum > LARGEST_BYTES) {
      complain(
        `${file.name} has ${Math.round(file.size / 1e6)} MB; all files together may have ${LARGEST_BYTES >> 20} MB. Nothing was read: give fewer drops at a time.`,
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
  await read(taken);
}

async function read(taken: Attached): Promise<void> {
  if (diagnosing.running.value) diagnoser.end("Other drops were opened.");
  diagnosing.clear();
  reading.result.value = null;
  drops.value = taken;
  await reading.run(async () => (await diagnoser.ask<Measured>({ do: "measure", written: asWritten() }, taken)).answer);
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

/** The numbers between commas. */
function numbers(text: string, what: string): number[] {
  const found = list(text).map(Number);
  if (!found.every(Number.isFinite)) throw refused(`${what}: ${text} is no list of numbers`, "write 0.4,-0.3,2");
  return found;
}

function asWritten() {
  const [rate, ...more] = numbers(written.rate_hz.value, "Samples a second");
  if (more.length > 0) throw refused("Samples a second: this is one number", "write 3200");
  return {
    columns: list(written.columns.value),
    units: list(written.units.value),
    zero_g: numbers(written.zero_g.value, "Readings in free fall"),
    rate_hz: rate ?? null,
  };
}

async function example(): Promise<void> {
  await making.run(async () => {
    const { files } = await diagnoser.ask({ do: "synthesize", plan: "bottoming.toml" }, { "bottoming.toml": plan });
    await read({ "synthetic-drops.csv": files[0]!.bytes });
  });
}

function diagnose(): Promise<void> {
  return diagnosing.run(async (onStage) => {
    const held = numbers(heldOut.value, "Heights held out");
    const request = {
      do: "diagnose",
      model: model.value,
      max_effects: most.value,
      hold_out_heights_m: held,
      written: asWritten(),
    };
    const without = held.length > 0 ? `; no fit sees the drops from ${held.join(", ")} m` : "";
    const of = `Of the model ${model.value}, with at most ${most.value} ${most.value === 1 ? "effect" : "effects"}${without}`;
    const { answer, files } = await diagnoser.ask<Diagnosed>(request, drops.value, onStage);
    return { found: answer, files, of };
  });
}

const VERDICTS: Record<Diagnosed["verdict"], string> = {
  named: "The model lacks",
  ambiguous: "Several explanations fit",
  none_suffices: "No known effect explains the drops",
  nothing_missing: "Nothing is missing: the model explains the drops",
};

export function Diagnose() {
  const measured = reading.result.value;
  const names = Object.keys(drops.value);
  return (
    <div class="diagnose">
      <div class="row dropzone">
        <label class="file">
          Open measured drops (CSV, .bin, .bhn)
          <input
            type="file"
            multiple
            accept=".csv,.tsv,.bin,.bhn"
            onChange={(event) => takeChosen(event.currentTarget)}
          />
        </label>
        <label class="file">
          or a folder of them
          <input
            type="file"
            multiple
            ref={(input) => input?.setAttribute("webkitdirectory", "")}
            onChange={(event) => takeChosen(event.currentTarget)}
          />
        </label>
        <span>or drag them here,</span>
        <button type="button" onClick={() => void example()}>
          or try synthetic ones
        </button>
      </div>
      {names.length > 0 && <HowWritten />}
      <Progress of={making} words="Making drops" />
      <Progress of={reading} words="Reading" />
      {measured && <Records measured={measured} names={names} />}
      {measured && (
        <div class="row">
          <ModelSelect label="Model of the diagnosis" model={model} />
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
      {diagnosing.result.value && <Verdict {...diagnosing.result.value} />}
    </div>
  );
}

/** What another logger's table needs to be read. A change reads the drops again. */
function HowWritten() {
  return (
    <details open={reading.failure.value !== null || OPTIONS.some(({ key }) => written[key].value !== "")}>
      <summary>Another logger's table</summary>
      <div class="row">
        {OPTIONS.map(({ key, option, label, example }) => (
          <label key={key}>
            {label} (<code>{option}</code>){" "}
            <input
              type="text"
              size={16}
              placeholder={example}
              value={written[key]}
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

/** Files in words: their names, or how many there are in which folders. */
function inShort(names: string[]): string {
  if (names.length <= FEW) return names.join(", ");
  const folders = [...new Set(names.map((name) => name.split("/").slice(0, -1).join("/")))].filter(Boolean).sort();
  const more = folders.length > FEW ? ` and ${folders.length - FEW} more` : "";
  const where = folders.length > 0 ? ` in ${folders.slice(0, FEW).join(", ")}${more}` : "";
  return `${names.length} files${where}`;
}

function Records({ measured, names }: { measured: Measured; names: string[] }) {
  const flagged = measured.drops.filter(({ flags }) => flags.length > 0);
  return (
    <>
      <p class="about">{inShort(names)}</p>
      <table>
        <caption>Records</caption>
        <thead>
          <tr>
            <th scope="col">height</th>
            <th scope="col">drops</th>
            <th scope="col">clean</th>
            <th scope="col">median peak</th>
          </tr>
        </thead>
        <tbody>
          {measured.heights.map((of) => (
            <tr key={`${of.frame} ${of.height_m}`}>
              <th scope="row">
                {of.frame} {short(of.height_m)} m
              </th>
              <td>{of.drops}</td>
              <td>{of.clean}</td>
              <td>{of.clean_peak_axial_g ? `${short(of.clean_peak_axial_g.median, 1)} g` : "–"}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {flagged.length > 0 && (
        <details>
          <summary>{flagged.length} records are flagged</summary>
          <ul>
            {flagged.map(({ trial, height_m, flags }) => (
              <li key={`${trial} ${height_m}`}>
                {trial}, {short(height_m)} m: {flags.map(({ reason }) => reason).join("; ")}
              </li>
            ))}
          </ul>
        </details>
      )}
      {measured.notes.map((note) => (
        <p key={note} class="caution">
          {note}
        </p>
      ))}
    </>
  );
}

function Verdict({ found, files, of }: { found: Diagnosed; files: EngineFile[]; of: string }) {
  const { gap, where } = found;
  const full = Math.max(gap.before, gap.after, gap.floor) || 1;
  const largest = [...where.cells].sort((a, b) => size(b) / b.error_g - size(a) / a.error_g).slice(0, 5);
  return (
    <div class="verdict" data-verdict={found.verdict}>
      <h3>
        {VERDICTS[found.verdict]}{" "}
        {found.verdict === "named" && found.effects.map(({ id }) => id.replaceAll("_", " ")).join(" and ")}
      </h3>
      <p class="about">{of}.</p>
      {found.reasons.map((reason) => (
        <p key={reason}>{reason}</p>
      ))}
      <table>
        <caption>Gap between mean wave and model, {gap.unit}</caption>
        <tbody>
          {(
            [
              ["before", gap.before, "bad"],
              ["after", gap.after, "good"],
              ["floor: what the drops can show", gap.floor, "track"],
            ] as const
          ).map(([words, value, kind]) => (
            <tr key={words}>
              <th scope="row">{words}</th>
              <td>{short(value, 2)}</td>
              <td>
                <svg class="bar" viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
                  <rect class={kind} width={(100 * value) / full} height="8" />
                </svg>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {found.effects.map(({ id, parameters }) => (
        <p key={id}>
          {id.replaceAll("_", " ")}:{" "}
          {Object.entries(parameters)
            .map(
              ([key, { value, unit, ci95 }]) =>
                `${key} = ${value.toPrecision(4)} ${unit} (${ci95.map((end) => end.toPrecision(4)).join(" to ")})`,
            )
            .join(", ")}
        </p>
      ))}
      <table>
        <caption>Ranking: what each leaves of the other heights</caption>
        <thead>
          <tr>
            <th scope="col">effects</th>
            <th scope="col">left, g</th>
            <th scope="col">why not</th>
          </tr>
        </thead>
        <tbody>
          {found.ranking.slice(0, 8).map(({ id, left_out_g, reason_rejected }) => (
            <tr key={id}>
              <th scope="row">{id.replaceAll("_", " ")}</th>
              <td>{short(left_out_g, 2)}</td>
              <td>{reason_rejected}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <table>
        <caption>Where model and drops differ most</caption>
        <tbody>
          {largest.map((cell) => (
            <tr key={`${cell.height_m} ${cell.phase}`}>
              <th scope="row">
                {short(cell.height_m)} m, {cell.phase.replaceAll("_", " ")}
              </th>
              <td>{short(size(cell), 1)} g</td>
              <td>± {short(cell.error_g, 1)} g</td>
            </tr>
          ))}
        </tbody>
      </table>
      {found.next_experiment && (
        <p>
          <b>Next:</b> {found.next_experiment.what}; it tells {found.next_experiment.between.join(" from ")}.
        </p>
      )}
      <div class="row">
        {files.map(({ path, bytes }) => (
          <button key={path} type="button" onClick={() => save(path, bytes)}>
            Download {path}
          </button>
        ))}
      </div>
    </div>
  );
}

function size({ apart_g, residual_g }: { apart_g?: number; residual_g?: number }): number {
  return apart_g ?? residual_g ?? 0;
}
