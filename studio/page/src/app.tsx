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
import { Parameters } from "./panels/parameters.tsx";
import { Source } from "./panels/source.tsx";
import { Selection, Toolbar } from "./panels/toolbar.tsx";
import { column, left, right } from "./state/focus.ts";
import { dropped } from "./state/dropped.ts";
import { openFrame } from "./state/opening.ts";
import { computing, findings, frame, notice, pending, refused } from "./state/studio.ts";
import { LastGood } from "./ui/last_good.tsx";
import { Tabs } from "./ui/tabs.tsx";
import { join } from "./view/scene_state.ts";

/** `results`: what the panel shows is computed of the frame. */
const PANELS: { id: typeof right.value; words: string; of: ComponentType; results?: true }[] = [
  { id: "checks", words: "Checks", of: Checks, results: true },
  { id: "compare", words: "Compare", of: Compare, results: true },
  { id: "fold", words: "Fold", of: Fold, results: true },
  { id: "drop", words: "Drop", of: Drop, results: true },
  { id: "diagnose", words: "Diagnose", of: Diagnose },
  { id: "files", words: "Files", of: Files },
];

/** Whether what is refused was typed into the frame file: the fields show what they were set to otherwise. */
const isTyped = computed(() => Object.keys(pending.value).length === 0);

const violations = computed(() => findings.value?.of.filter(({ verdict }) => verdict === "violated").length ?? 0);

/** Text that is dragged is for the fields. */
function holdsFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

/** Files that are dragged onto the page: frame files are opened, everything else are measured drops. */
function takeFiles(event: DragEvent): void {
  if (!holdsFiles(event)) return;
  event.preventDefault();
  void dropped(event.dataTransfer).then((files) => {
    const frames = files.filter(({ path }) => path.toLowerCase().endsWith(".toml"));
    const drops = files.filter((file) => !frames.includes(file));
    if (frames.length > 0) void openFrame(frames.map(({ file }) => file));
    if (drops.length > 0) {
      right.value = "diagnose";
      void takeDrops(drops);
    }
  });
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
      <section class="left" aria-label="Change the frame">
        <Tabs
          name="How it is changed"
          tabs={[
            { id: "values", words: "Values" },
            { id: "text", words: "Frame file" },
          ]}
          at={left}
        />
        <div class="scroll" id="panel-values" role="tabpanel" aria-labelledby={`tab-${left.value}`} tabIndex={-1}>
          {left.value === "values" && isTyped.value && <LastGood />}
          {left.value === "values" ? <Parameters /> : <Source />}
        </div>
      </section>
      <main class="middle">
        <Toolbar />
        <Picture />
        <Gauges />
      </main>
      <section class="right" aria-label="Know the frame">
        <Tabs name="What is known" tabs={PANELS} at={right} />
        <div class="scroll" role="tabpanel" aria-labelledby={`tab-${right.value}`} tabIndex={-1}>
          {results && <LastGood />}
          <Panel />
        </div>
      </section>
      <Notice />
    </div>
  );
}

/** To the text of the frame file. */
function showLine(): void {
  left.value = "text";
  column.value = "left";
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
        notice.value = `This browser cannot draw in three dimensions (${error instanceof Error ? error.message : String(error)}); everything else works.`;
      });
  }, []);
  const refusal = refused.value?.refusal;
  return (
    <div class="picture">
      <canvas
        ref={canvas}
        tabIndex={0}
        role="img"
        aria-label={`The frame ${frame.value?.name ?? ""}; arrow keys turn it, plus and minus zoom`}
      />
      <Selection />
      <p class={`busy ${computing.value ? "on" : ""}`} role="status" data-computing={computing.value}>
        {computing.value ? (frame.value ? "Computing…" : "The first model is being made…") : ""}
      </p>
      {refusal && <RefusalNote of={refusal} />}
    </div>
  );
}

/** One line at the foot of the picture, which leaves the picture to see; the reason in full opens above it. */
function RefusalNote({ of }: { of: Refusal }) {
  const open = useSignal(false);
  return (
    <div class={`refusal ${open.value ? "open" : ""}`} role="alert">
      <p>
        <b>The picture is of the last good frame.</b>{" "}
        {of.place && (
          <>
            <button type="button" class="link" onClick={() => showLine()}>
              {of.place.file}, line {of.place.line}
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
  if (!notice.value) return null;
  return (
    <div class="notice" role="alert">
      {notice.value}
      <button type="button" onClick={() => (notice.value = null)}>
        Close
      </button>
    </div>
  );
}
