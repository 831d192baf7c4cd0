// The time of the motion in the picture, as a slider.
import { goTo, length, seconds } from "../state/player.ts";

export function MotionTime({ label }: { label: string }) {
  return (
    <input
      type="range"
      aria-label={label}
      min="0"
      max={length.value}
      step="0.01"
      value={seconds.value}
      onInput={(event) => goTo(Number(event.currentTarget.value))}
    />
  );
}
