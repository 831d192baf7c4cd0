// The page: what is changed on the left, the picture in the middle, what is known of it on the right.
import { computed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { ComponentType } from "preact";
import type { Refusal } from "./engine/messages.ts";
import { Checks } from "./panels/checks.tsx";
import { Compare } from "./panels/compare.tsx";
import { Diagnose, takeDrops } from "./panels/diagnose.tsx";
import { Drop } from "./panels/drop.tsx";
import { Files } from "./panels/files.tsx";
import { Fold } from "./panels/fold.tsx";
import { Gauges } from "./panels/gauges.tsx";
import { Header } from "./panels/header.tsx";
import { MotionBar } from "./panels/motion_bar.tsx";
import { Parameters } from "./panels/parameters.tsx";
import { Source } from "./panels/source.tsx";
import { Selection, Toolbar } from "./panels/toolbar.tsx";
import { column, left, right, showLine } from "./state/focus.ts";
import type { Dropped } from "./state/dropped.ts";
import { dropped } from "./state/dropped.ts";
import { complain, notice, quiet } from "./state/notice.ts";
import { openFrame } from "./state/opening.ts";
import { computing, frame, refused, violations } from "./state/studio.ts";
import { LastGood } from "./ui/last_good.tsx";
import { Tabs } from "./ui/tabs.tsx";
import { join, laying } from "./view/scene_state.ts";

/** `results`: what the panel shows is computed of the frame. */
const PANELS: { id: typeof right.value; words: string; of: ComponentType; results?: true }[] = [
  { id: "checks", words: "Checks", of: Checks, results: true },
  { id: "compare", words: "Compare", of: Compare, results: true },
  { id: "fold", words: "Fold", of: Fold, results: true },
  { id: "drop", words: "Drop", of: Drop, results: true },
  { id: "diagnose", words: "Diagnose", of: Diagnose },
  { id: "files", words: "Files", of: Files },
];

/** Whether the fields cannot show what the frame file states, as it is no TOML. */
const isUnread = computed(() => refused.value?.editable === false);

/** The panels' names, with how many limits are violated. */
const tabs = computed(() =>
  PANELS.map((panel) =>
    panel.id === "checks" && violations.value > 0 ? { ...panel, words: `Checks (${violations.value})` } : panel,
  ),
);

/** Text that is dragged is for the fields. */
function holdsFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

/** Files that are dragged onto the page: frame files are opened, everything else are measured drops. */
function takeFiles(event: DragEvent): void {
  if (!holdsFiles(event)) return;
  event.preventDefault();
  quiet();
  dropped(event.dataTransfer)
    .then(takeDropped)
    .catch((error: unknown) =>
      complain(`These files cannot be read: ${error instanceof Error ? error.message : String(error)}.`),
    );
}

async function takeDropped(files: Dropped[]): Promise<void> {
  const frames = files.filter(({ path }) => path.toLowerCase().endsWith(".toml"));
  const drops = files.filter((file) => !frames.includes(file));
  if (frames.length > 0) await openFrame(frames.map(({ file }) => file));
  if (drops.length === 0) return;
  right.value = "diagnose";
  await takeDrops(drops);
}

export function App() {
  const { of: Panel, results } = PANELS.find(({ id }) => id === right.value)!;
  return (
    <div
      class={`app show-${column.value}`}
      onDragOver={(event) => holdsFiles(event) && event.preventDefault()}
      onDrop={takeFiles}
    >
      <Header />
      <nav class="columns" aria-label="Parts of the page">
        {(["left", "middle", "right"] as const).map((id) => (
          <button key={id} type="button" aria-pressed={column.value === id} onClick={() => (column.value = id)}>
            {
              { left: "Change", middle: "Model", right: violations.value > 0 ? `Know (${violations.value})` : "Know" }[
                id
              ]
            }
          </button>
        ))}
      </nav>
      <section class="left" aria-labelledby="head-left">
        <h2 class="hidden" id="head-left">
          Change the frame
        </h2>
        <Tabs
          name="How it is changed"
          panel="panel-left"
          tabs={[
            { id: "values", words: "Values" },
            { id: "text", words: "Frame file" },
          ]}
          at={left}
        />
        <div class="scroll" id="panel-left" role="tabpanel" aria-labelledby={`tab-${left.value}`} tabIndex={0}>
          {left.value === "values" && isUnread.value && <LastGood />}
          {left.value === "values" ? <Parameters /> : <Source />}
        </div>
      </section>
      <main class="middle">
        <Toolbar />
        <Picture />
        <MotionBar />
        <Gauges />
      </main>
      <section class="right" aria-labelledby="head-right">
        <h2 class="hidden" id="head-right">
          Know the frame
        </h2>
        <Tabs name="What is known" panel="panel-right" tabs={tabs.value} at={right} />
        <div class="scroll" id="panel-right" role="tabpanel" aria-labelledby={`tab-${right.value}`} tabIndex={0}>
          {results && <LastGood />}
          <Panel />
        </div>
      </section>
      <Notice />
    </div>
  );
}

function Picture() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const on = canvas.current;
    if (!on) return;
    // What draws is most of the script: the page is there before it.
    void import("./view/viewer.ts")
      .then(({ Viewer }) => join(new Viewer(on)))
      .catch((error: unknown) => {
        complain(
          `This browser cannot draw in three dimensions (${error instanceof Error ? error.message : String(error)}). What is measured in the picture and what moves in it is missing; everything else works.`,
        );
      });
  }, []);
  const refusal = refused.value?.refusal;
  const busy = computing.value || laying.value;
  return (
    <div class="picture">
      <canvas
        ref={canvas}
        tabIndex={0}
        role="application"
        aria-roledescription="three-dimensional picture"
        aria-label={`The frame ${frame.value?.name ?? ""}; arrow keys turn it, plus and minus zoom`}
      />
      <Selection />
      <p class={`busy ${busy ? "on" : ""}`} role="status" data-computing={computing.value}>
        {busy ? (frame.value ? "Computing…" : "The first model is being made…") : ""}
      </p>
      {refusal && <RefusalNote of={refusal} />}
    </div>
  );
}

/** One line at the foot of the picture, which leaves the picture to see; the reason in full opens above it. */
function RefusalNote({ of }: { of: Refusal }) {
  const open = useSignal(false);
  const { place } = of;
  return (
    <div class={`refusal ${open.value ? "open" : ""}`} role="alert">
      <p>
        <b>The picture is of the last good frame.</b>{" "}
        {place && (
          <>
            <button type="button" class="link" onClick={() => showLine(place.line)}>
              {place.file}, line {place.line}
            </button>
            :{" "}
          </>
        )}
        {of.message}
        {of.remedy && <span class="remedy">{of.remedy}</span>}
      </p>
      <button type="button" class="link" aria-expanded={open} onClick={() => (open.value = !open.value)}>
        {open.value ? "Less" : "More"}
      </button>
    </div>
  );
}

function Notice() {
  const said = notice.value;
  const line = said && (
    <div class={`notice ${said.good ? "good" : ""}`} role={said.good ? undefined : "alert"}>
      {said.words}
      <button type="button" onClick={quiet}>
        Close
      </button>
    </div>
  );
  // A status is read out where it stood before it had words; an alert is read out as it comes.
  return (
    <>
      <div role="status">{said?.good && line}</div>
      {!said?.good && line}
    </>
  );
}
