// What is played, below the picture on a narrow screen, where the panel that began it is not in sight.
import { goTo, length, owner, play, playing, seconds } from "../state/player.ts";
import { goToStep, now } from "./fold.tsx";

export function MotionBar() {
  if (!owner.value) return null;
  const step = owner.value === "fold" ? now.value : null;
  return (
    <div class="motion-bar" role="group" aria-label="The motion">
      <button type="button" onClick={play}>
        {playing.value ? "Stop" : "Play"}
      </button>
      {step ? (
        <>
          <button type="button" aria-label="Step before" disabled={step.at === 0} onClick={() => goToStep(step.at - 1)}>
            ◀
          </button>
          <button
            type="button"
            aria-label="Next step"
            disabled={step.at === step.of - 1}
            onClick={() => goToStep(step.at + 1)}
          >
            ▶
          </button>
          <span>
            {step.step.number}: {step.step.title}
          </span>
        </>
      ) : (
        <input
          type="range"
          aria-label="Time of the motion"
          min="0"
          max={length.value}
          step="0.01"
          value={seconds.value}
          onInput={(event) => goTo(Number(event.currentTarget.value))}
        />
      )}
    </div>
  );
}
