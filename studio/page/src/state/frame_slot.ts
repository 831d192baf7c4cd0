// A frame that is held open in an engine, and changed in place: parts that stay the same are not made again.
import type { EngineClient } from "../engine/client.ts";
import { Refused } from "../engine/client.ts";
import type { Opened } from "../engine/answers.ts";
import type { Doc } from "./doc.ts";
import { identity, source } from "./doc.ts";

export class FrameSlot {
  #held: { identity: string; generation: number; opened: Promise<Opened> } | undefined;
  #last: { generation: number; handle: number } | undefined;

  constructor(readonly client: EngineClient) {}

  /** The frame of a document, opened or changed to it. */
  opened(doc: Doc): Promise<Opened> {
    const wanted = identity(doc);
    const generation = this.client.generation.value;
    if (this.#held?.identity === wanted && this.#held.generation === generation) return this.#held.opened;
    const opened = this.#open(doc, generation);
    this.#held = { identity: wanted, generation, opened };
    opened.catch(() => {
      if (this.#held?.opened === opened) this.#held = undefined;
    });
    return opened;
  }

  async #open(doc: Doc, generation: number): Promise<Opened> {
    // What was asked before is answered first: its handle is the one to change.
    await this.#held?.opened.catch((error: unknown) => {
      if (!(error instanceof Refused)) throw error;
    });
    const { frame, files } = source(doc);
    const handle = this.#last?.generation === generation ? this.#last.handle : undefined;
    const request = handle === undefined ? { do: "open", frame } : { do: "change", handle, frame };
    const { answer } = await this.client.ask<Opened>(request, files);
    this.#last = { generation: this.client.generation.value, handle: answer.handle };
    return answer;
  }
}
