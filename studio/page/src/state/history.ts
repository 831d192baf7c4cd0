// Undo and redo of documents. Quick changes of one value after another are one step.
import { computed, signal } from "@preact/signals";
import type { Doc } from "./doc.ts";

/** Changes of the same group within this are one, ms. */
const TOGETHER_MS = 900;
const LONGEST = 200;

export class History {
  #docs = signal<Doc[]>([]);
  #at = signal(-1);
  #last = { group: "" as string | null, at: -Infinity };
  readonly canUndo = computed(() => this.#at.value > 0);
  readonly canRedo = computed(() => this.#at.value < this.#docs.value.length - 1);

  record(doc: Doc, group: string | null): void {
    const now = performance.now();
    const together = group !== null && group === this.#last.group && now - this.#last.at < TOGETHER_MS;
    this.#last = { group, at: now };
    const kept = this.#docs.value.slice(0, this.#at.value + (together && this.#at.value > 0 ? 0 : 1));
    const top = kept.at(-1);
    const same = top && top.text === doc.text && top.name === doc.name && top.preset === doc.preset;
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
    this.#last.group = "";
    return doc;
  }
}
