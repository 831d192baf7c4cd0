// Story 4: the assembly as a motion, step by step, with captions and angles.
import { computed, effect, signal } from "@preact/signals";
import type { Fold as Sequence } from "../engine/outcomes.ts";
import type { Doc } from "../state/doc.ts";
import { identity } from "../state/doc.ts";
import { right, showPicture } from "../state/focus.ts";
import { hideMotion, length, owner, play, playing, seconds, showMotion } from "../state/player.ts";
import { checker, current, findings, findingsAreOfPicture, refused, shownDoc } from "../state/studio.ts";
import { Work } from "../state/work.ts";
import { download } from "../state/downloads.ts";
import { Progress } from "../ui/progress.tsx";
import { label, short } from "../ui/words.ts";
import { handled, stage } from "../view/scene_state.ts";

type Folded = { sequence: Sequence; motion: Uint8Array<ArrayBuffer>; of: string };
const work = new Work<Folded>();
const instructions = new Work<null>();
let timer: ReturnType<typeof setTimeout> | undefined;

/** Where the assembly stands, s: it stays there while something else is shown, and when the frame changes. */
const place = signal(0);
effect(() => {
  if (owner.value === "fold") place.value = seconds.value;
});
/** What is in the picture, or being put there. */
let shown: Folded["motion"] | null = null;

let wasOpen = false;
effect(() => {
  const [of, open] = [shownDoc.value, right.value === "fold"];
  clearTimeout(timer);
  // A changed frame does not take the picture from the bed; whoever opens the panel means the motion.
  const onBed = wasOpen && stage.peek() === "bed";
  wasOpen = open;
  if (!open) hideMotion("fold");
  else if (of) timer = setTimeout(() => void fold(of, onBed), 250);
});

async function fold(of: Doc, onBed: boolean): Promise<void> {
  const known = work.result.value;
  const isLatest = await work.run(() => (known?.of === identity(of) ? Promise.resolve(known) : folded(of)));
  // Another frame or another panel was asked for meanwhile.
  if (!isLatest || shownDoc.peek() !== of || right.peek() !== "fold") return;
  if (work.failure.value !== null) hideMotion("fold");
  else if (!onBed) await showFold();
}

async function folded(of: Doc): Promise<Folded> {
  const { handle } = await current.opened(of);
  // Asked for at once: between two answers the open frame may be changed to another.
  const [steps, { files }] = await Promise.all([
    checker.ask<Sequence>({ do: "fold-steps", handle }),
    checker.ask({ do: "files", handle, which: ["fold-motion"] }),
  ]);
  return { sequence: steps.answer, motion: files[0]!.bytes, of: identity(of) };
}

async function showFold(): Promise<void> {
  const folded = work.result.value;
  if (!folded || (owner.value === "fold" && shown === folded.motion)) return;
  shown = folded.motion;
  await showMotion("fold", folded.motion, { stepSeconds: folded.sequence.step_shown_s, at: () => place.value });
  // Another panel was opened while the motion was read.
  if (right.peek() !== "fold") hideMotion("fold");
}

/** Puts the assembly at a time, s, whether it is in the picture already or the bed took its place. */
async function putAt(time: number): Promise<void> {
  place.value = time;
  if (owner.value === "fold") seconds.value = time;
  else await showFold();
}

/** Puts the assembly at the beginning of a step. */
export function goToStep(at: number): void {
  const of = work.result.value?.sequence;
  if (of) void putAt(at * of.step_shown_s);
}

async function playOrStop(): Promise<void> {
  showPicture();
  await showFold();
  play();
}

/** The steps; none after a refusal, as those of before are another frame's. */
const folding = computed(() => (work.failure.value === null ? work.result.value : null));

/** The step that is shown. */
export const now = computed(() => {
  const sequence = folding.value?.sequence;
  if (!sequence) return null;
  const at = Math.min(sequence.steps.length - 1, Math.floor(place.value / sequence.step_shown_s + 1e-6));
  return {
    step: sequence.steps[at]!,
    at,
    of: sequence.steps.length,
    share: place.value / sequence.step_shown_s - at,
  };
});

const bodies = computed(() => {
  const step = owner.value === "fold" ? now.value?.step : undefined;
  return (step ? [...step.bends, ...step.joins] : []).map(({ body }) => body).join(" ");
});
effect(() => {
  handled.value = new Set(bodies.value.split(" ").filter(Boolean));
});

export function Fold() {
  const sequence = folding.value?.sequence;
  const old = shownDoc.value === null || folding.value?.of !== identity(shownDoc.value);
  return (
    <div class="fold">
      {folding.value && <InTheWay />}
      <Progress of={work} words="Folding" />
      {work.failure.value !== null && (
        <p class="about">There are no steps to show: the picture is of the frame as it is put together.</p>
      )}
      {sequence && now.value && (
        <div class={old ? "old" : ""}>
          <div class="row">
            <button type="button" onClick={() => void playOrStop()}>
              {playing.value ? "Stop" : "Play"}
            </button>
            <button
              type="button"
              aria-label="Step before"
              disabled={now.value.at === 0}
              onClick={() => goToStep(now.value!.at - 1)}
            >
              ◀
            </button>
            <button
              type="button"
              aria-label="Next step"
              disabled={now.value.at === now.value.of - 1}
              onClick={() => goToStep(now.value!.at + 1)}
            >
              ▶
            </button>
            <span role="status">
              Step {now.value.step.number} of {now.value.of}
              <span class="hidden">: {now.value.step.title}</span>
            </span>
          </div>
          <input
            type="range"
            aria-label="Time of the assembly"
            min="0"
            max={length.value}
            step="0.02"
            value={place.value}
            onInput={(event) => {
              playing.value = false;
              void putAt(Number(event.currentTarget.value));
            }}
          />
          <h3>{now.value.step.title}</h3>
          <p>{now.value.step.text}</p>
          {now.value.step.caution && <p class="caution">{now.value.step.caution}</p>}
          {now.value.step.bends.length > 0 && (
            <table>
              <caption>Bends</caption>
              <tbody>
                {now.value.step.bends.map((bend) => (
                  <tr key={`${bend.body} ${bend.hinge}`}>
                    <th scope="row">
                      {label(bend.body)}, {bend.hinge}
                    </th>
                    <td>
                      {short(bend.from_deg, 1)}° to {short(bend.to_deg, 1)}°
                    </td>
                    <td>
                      now{" "}
                      {short(
                        bend.from_deg + (bend.to_deg - bend.from_deg) * Math.max(0, Math.min(1, now.value!.share)),
                        1,
                      )}
                      °
                    </td>
                    <td>{bend.load ? `strain ${short(bend.load.strain_percent, 0)} %` : ""}</td>
                  </tr>
                ))}
              </tbody>
            </table>
          )}
          <p class="about">
            {now.value.step.repeats > 1 && `${now.value.step.repeats} times. `}With {now.value.step.tool},{" "}
            {short(now.value.step.minutes)} minutes; all steps {short(sequence.minutes)} minutes.
          </p>
          <ol class="steps">
            {sequence.steps.map((step, at) => (
              <li key={step.number}>
                <button
                  type="button"
                  class="link"
                  aria-current={at === now.value?.at ? "step" : undefined}
                  onClick={() => goToStep(at)}
                >
                  {step.title}
                </button>
              </li>
            ))}
          </ol>
        </div>
      )}
      <button
        type="button"
        disabled={refused.value !== null || instructions.running.value}
        onClick={() => void instructions.run(() => download(["instructions"]).then(() => null))}
      >
        Download the instructions (PDF)
      </button>
      <Progress of={instructions} words="Drawing the instructions" />
    </div>
  );
}

const ways = computed(() =>
  findingsAreOfPicture.value
    ? (findings.value?.of ?? []).filter(({ rule, verdict }) => rule === "fold_sequence" && verdict === "violated")
    : [],
);

/** What the checks say against the steps: they are shown all the same, so that one sees where. */
function InTheWay() {
  if (ways.value.length === 0) return null;
  return (
    <div class="in-the-way" role="status">
      <p class="fault">These steps cannot be done as they are shown, on the screen and in the instructions:</p>
      <ul>
        {ways.value.map(({ subject, message }) => (
          <li key={`${subject} ${message}`} class="fault">
            {message}
          </li>
        ))}
      </ul>
    </div>
  );
}
