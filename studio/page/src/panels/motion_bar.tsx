// What is played, below the picture on a narrow screen, where the panel that began it is not in sight.
import { owner, play, playing } from "../state/player.ts";
import { MotionTime } from "../ui/motion_time.tsx";
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
        <MotionTime label="Time of the motion" />
      )}
    </div>
  );
}
