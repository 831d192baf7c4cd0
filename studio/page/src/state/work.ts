// A long piece of work as a panel shows it: running, at a stage, done, or failed in words.
import { signal } from "@preact/signals";
import { Refused, Stopped } from "../engine/client.ts";
import type { Stage } from "../engine/messages.ts";
import { inPageWords } from "../ui/words.ts";

export class Work<T> {
  readonly result = signal<T | null>(null);
  readonly failure = signal<string | null>(null);
  readonly running = signal(false);
  readonly stage = signal<Stage | null>(null);
  #number = 0;
  #before: Promise<unknown> = Promise.resolve();

  /**
   * Does it, once what was begun before has ended, as an engine's request cannot be interrupted. What was begun before counts no more, and what
   * waits where something newer is asked for is left out. Whether it was the last, of which the result is.
   */
  async run(work: (onStage: (stage: Stage) => void, latest: () => boolean) => Promise<T>): Promise<boolean> {
    const number = ++this.#number;
    const latest = () => number === this.#number;
    this.running.value = true;
    this.failure.value = null;
    await this.#before;
    if (!latest()) return false;
    const own = this.#done(work, latest);
    this.#before = own;
    await own;
    return latest();
  }

  async #done(
    work: (onStage: (stage: Stage) => void, latest: () => boolean) => Promise<T>,
    latest: () => boolean,
  ): Promise<void> {
    try {
      const result = await work((stage) => {
        if (latest()) this.stage.value = stage;
      }, latest);
      if (latest()) this.result.value = result;
    } catch (error) {
      if (!(error instanceof Refused || error instanceof Stopped)) console.error(error);
      const remedy = error instanceof Refused ? error.refused.remedy : null;
      const message = error instanceof Error ? error.message : String(error);
      if (latest()) this.failure.value = inPageWords([message, remedy].filter(Boolean).join(" – "));
    } finally {
      if (latest()) {
        this.running.value = false;
        this.stage.value = null;
      }
    }
  }

  clear(): void {
    this.#number += 1;
    this.result.value = null;
    this.failure.value = null;
    this.running.value = false;
    this.stage.value = null;
  }
}
