// Undo and redo of documents. Changes of one gesture, such as a drag of a slider, are one step.
import { computed, signal } from "@preact/signals";
import type { Doc } from "./doc.ts";

/** A change of the same value or text within this after the last one goes on with its gesture, ms. */
const TOGETHER_MS = 900;
const LONGEST = 200;

export class History {
  #docs = signal<Doc[]>([]);
  #at = signal(-1);
  /** What was changed last, and when, by the hand: a result may come much later. */
  #input = { group: null as string | null, at: -Infinity, gesture: 0 };
  /** The gesture that the last step is of. */
  #last = 0;
  readonly canUndo = computed(() => this.#at.value > 0);
  readonly canRedo = computed(() => this.#at.value < this.#docs.value.length - 1);

  /** The gesture that a change of a value or text belongs to; without a group it is one of its own. */
  gesture(group: string | null): number {
    const at = performance.now();
    const goesOn = group !== null && group === this.#input.group && at - this.#input.at < TOGETHER_MS;
    this.#input = { group, at, gesture: this.#input.gesture + (goesOn ? 0 : 1) };
    return this.#input.gesture;
  }

  record(doc: Doc, gesture: number): void {
    const together = gesture === this.#last;
    const kept = this.#docs.value.slice(0, this.#at.value + (together && this.#at.value > 0 ? 0 : 1));
    const top = kept.at(-1);
    const same = top && top.text === doc.text && top.name === doc.name && top.preset === doc.preset;
    // Where a gesture is back at what was before it, what it does next is a step of its own.
    this.#last = same ? 0 : gesture;
    // What is the same as the step before is no step; a step that it ended together with others is none any more, either.
    if (same && !together) return;
    this.#docs.value = same ? kept : [...kept, doc].slice(-LONGEST);
    this.#at.value = this.#docs.value.length - 1;
  }

  undo(): Doc | undefined {
    return this.#step(-1);
  }

  redo(): Doc | undefined {
    return this.#step(1);
  }

  #step(by: number): Doc | undefined {
    const doc = this.#docs.value[this.#at.value + by];
    if (doc) this.#at.value += by;
    this.#last = 0;
    return doc;
  }
}
