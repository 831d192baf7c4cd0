// Story 3: before and after, against the preset or a pinned variant; what is better or worse, and the other frame through this one.
import { computed, effect, signal } from "@preact/signals";
import { Refused, Stopped } from "../engine/client.ts";
import type { Changed, Difference } from "../engine/answers.ts";
import type { Doc } from "../state/doc.ts";
import { identity, ofPreset } from "../state/doc.ts";
import { FrameSlot } from "../state/frame_slot.ts";
import { right } from "../state/focus.ts";
import { checker, current, doc, shownDoc } from "../state/studio.ts";
import { inPageWords } from "../ui/words.ts";
import { ghost, viewer } from "../view/scene_state.ts";

/** The variant that is held against the frame; none: the preset. */
export const pinned = signal<Doc | null>(null);
/** The frame that is compared: while the file is refused, the last good one. */
const after = computed(() => shownDoc.value ?? doc.value);
export const before = computed(() => pinned.value ?? ofPreset(after.value.preset));
export const other = new FrameSlot(checker);
const difference = signal<{ of: Difference; before: string; after: string } | null>(null);
const failure = signal<string | null>(null);
const working = signal(false);

let running: Promise<void> = Promise.resolve();
/** Which frame is in the picture through the shown one. */
let overlaid: string | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

// Compared when the panel is open and nothing was changed for a moment.
effect(() => {
  // Read apart: a value behind one that is true would not be followed.
  const [panel, through] = [right.value === "compare", ghost.value];
  const [of, against, open] = [shownDoc.value, before.value, panel || through];
  clearTimeout(timer);
  if (of && open) timer = setTimeout(() => (running = running.then(() => compare(against, of))), 300);
});

async function compare(against: Doc, of: Doc): Promise<void> {
  if (shownDoc.value !== of || before.value !== against) return;
  working.value = true;
  try {
    if (overlaid !== identity(against)) await viewer.value?.overlay(null);
    const { handle } = await other.opened(against);
    const { files } = await checker.ask({ do: "files", handle, which: ["glb"] });
    if (ghost.value && files[0]) {
      await viewer.value?.overlay(files[0].bytes);
      overlaid = identity(against);
    }
    // Both as they are meant: a panel may have changed an open frame to another meanwhile.
    const [then, now] = await Promise.all([other.opened(against), current.opened(of)]);
    const { answer } = await checker.ask<Difference>({ do: "difference", before: then.handle, after: now.handle });
    difference.value = { of: answer, before: identity(against), after: identity(of) };
    failure.value = null;
  } catch (error) {
    if (!(error instanceof Refused || error instanceof Stopped)) console.error(error);
    failure.value = error instanceof Error ? error.message : String(error);
    overlaid = null;
    await viewer.value?.overlay(null);
  } finally {
    working.value = false;
  }
}

export function Compare() {
  const found = difference.value?.of;
  const { before: against, after: shown } = difference.value ?? {};
  const old = !shownDoc.value || shown !== identity(shownDoc.value) || against !== identity(before.value);
  const busy = working.value || (old && found !== undefined && failure.value === null);
  const changed = found?.measures.filter(({ trend, reported }) => trend !== "neither" || reported[0] !== reported[1]);
  const lists = found && [found.broken, found.mended, changed ?? [], found.parameters, found.masses, found.volumes];
  const unchanged = lists?.every(({ length }) => length === 0);
  return (
    <div class="compare">
      <div class="row">
        <span>
          Against <b>{pinned.value ? pinned.value.name : `the preset ${after.value.preset}`}</b>
        </span>
        <button type="button" onClick={() => (pinned.value = after.value)}>
          Pin this variant
        </button>
        {pinned.value && (
          <button type="button" onClick={() => (pinned.value = null)}>
            Against the preset
          </button>
        )}
      </div>
      <label>
        <input type="checkbox" checked={ghost} onChange={(event) => (ghost.value = event.currentTarget.checked)} /> show
        it through the model (blue)
      </label>
      {failure.value && <p class="fault">{failure.value}</p>}
      <p role="status" class="state" data-state={busy || old ? "working" : "done"}>
        {busy ? "Comparing…" : ""}
      </p>
      {found && (
        <div class={old ? "old" : ""}>
          {unchanged && (
            <p class="empty">Nothing differs from {pinned.value ? pinned.value.name : "the preset"} yet.</p>
          )}
          {found.broken.length > 0 && <List title="Now violated" items={found.broken} kind="worse" />}
          {found.mended.length > 0 && <List title="No longer violated" items={found.mended} kind="better" />}
          <Table title="What got better or worse" rows={changed ?? []} />
          {found.not_compared.map((why) => (
            <p key={why}>{why}</p>
          ))}
          <Table title="Values" rows={found.parameters} />
          <Table title="Masses, g" rows={found.masses} />
          <Table title="Printed volumes, mm³" rows={found.volumes} />
          <p class="about">{inPageWords(found.peak)}</p>
        </div>
      )}
    </div>
  );
}

function List({ title, items, kind }: { title: string; items: string[]; kind: string }) {
  return (
    <>
      <h3>{title}</h3>
      <ul class={kind}>
        {items.map((item) => (
          <li key={item}>{item}</li>
        ))}
      </ul>
    </>
  );
}

const TREND = { better: "▲ better", worse: "▼ worse", neither: "" };

function Table({ title, rows }: { title: string; rows: Changed[] }) {
  if (rows.length === 0) return null;
  return (
    <table>
      <caption>{title}</caption>
      <thead>
        <tr>
          <th scope="col">what</th>
          <th scope="col">before</th>
          <th scope="col">after</th>
          <th scope="col">
            <span class="hidden">trend</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {rows.map((row) => (
          <tr key={row.name} class={row.trend} data-name={row.name}>
            <th scope="row">{row.name}</th>
            <td>{row.reported[0] || "–"}</td>
            <td>
              {row.reported[1] || "–"} {row.unit}
            </td>
            <td>{TREND[row.trend]}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
