// How far a long piece of work is.
import type { Work } from "../state/work.ts";

export function Progress<T>({ of, words }: { of: Work<T>; words: string }) {
  const stage = of.stage.value;
  return (
    <div role="status" class="progress" data-working={of.running.value}>
      {of.running.value && (
        <>
          <progress aria-label={words} {...(stage ? { max: stage.of, value: stage.done } : {})} />
          {stage ? `${stage.name} (${stage.done + 1} of ${stage.of})` : `${words}…`}
        </>
      )}
      {of.failure.value && <p class="fault">{of.failure.value}</p>}
    </div>
  );
}
