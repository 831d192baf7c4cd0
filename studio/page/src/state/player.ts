// A motion in the picture: its time, playing and stopped.
import { batch, effect, signal } from "@preact/signals";
import { stage, viewer } from "../view/scene_state.ts";

export const seconds = signal(0);
export const length = signal(0);
export const playing = signal(false);
/** Whose motion is shown. */
export const owner = signal<"fold" | "drop" | null>(null);

/** Changes what the picture shows: a bed and a motion end where something else begins. */
export function enter(next: "frame" | "bed" | "motion"): void {
  if (next !== "bed") viewer.value?.replace(null);
  if (next !== "motion") {
    owner.value = null;
    playing.value = false;
    void viewer.value?.move(null);
  }
  stage.value = next;
}

/** Seconds of the motion in a second. */
let rate = 1;

type Shown = {
  /** It plays so many times slower than its file says. */
  slower?: number;
  /** How long each step of an assembly is, s. */
  stepSeconds?: number;
  /** Where it begins, s, when it has been read. */
  at?: () => number;
};

/** Shows a motion. */
export async function showMotion(
  by: "fold" | "drop",
  bytes: Uint8Array<ArrayBuffer>,
  shown: Shown = {},
): Promise<void> {
  const { slower = 1, stepSeconds = null, at = () => 0 } = shown;
  const taken = await viewer.value?.move(bytes.slice(), { stepSeconds, at: at() });
  // Something else was asked for while the motion was read.
  if (taken === null) return;
  batch(() => {
    length.value = taken ?? 0;
    rate = 1 / slower;
    seconds.value = Math.min(at(), length.value);
    owner.value = by;
    enter("motion");
  });
}

/** Puts the motion at a time, by hand. */
export function goTo(at: number): void {
  playing.value = false;
  seconds.value = at;
}

export function hideMotion(by: "fold" | "drop"): void {
  if (owner.value === by) enter("frame");
}

/** Plays, from the beginning where the end was reached, or stops. */
export function play(): void {
  if (!owner.value) return;
  if (!playing.value && seconds.value >= length.value) seconds.value = 0;
  playing.value = !playing.value;
}

effect(() => {
  const at = seconds.value;
  if (owner.value) viewer.value?.moveTo(at);
});

effect(() => {
  if (!playing.value) return;
  // A frame's time is that of its beginning, which may lie before this call: the first frame says from when time runs.
  let last: number | null = null;
  let stopped = false;
  const tick = (now: number) => {
    if (stopped) return;
    const next = seconds.peek() + ((now - (last ?? now)) / 1000) * rate;
    last = now;
    seconds.value = Math.min(next, length.peek());
    if (next >= length.peek()) playing.value = false;
    else requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  return () => (stopped = true);
});
