// An engine as the page sees it: questions in, promises out. An engine that stopped is replaced by a new one, and says so.
import { signal } from "@preact/signals";
import type { Attached, EngineFile, Message, Question, Refusal, Stage, Start } from "./messages.ts";
import { engineModule, preparedResults } from "./module.ts";

/** The engine refused: the words of the command line. */
export class Refused extends Error {
  constructor(readonly refused: Refusal) {
    super(refused.message);
  }
}

/** The engine failed, or was ended by `EngineClient.end`. */
export class Stopped extends Error {}

export type Answered<T> = { answer: T; files: EngineFile[]; ms: number };

type Waiting = {
  resolve: (answered: Answered<unknown>) => void;
  reject: (error: Error) => void;
  onStage?: ((stage: Stage) => void) | undefined;
};

/** Of a question whose answer nobody waits for. */
const UNASKED = 0;

export class EngineClient {
  /** How many questions have no answer yet. */
  readonly busy = signal(0);
  /** How often the engine was replaced: what was open in a former one is gone. */
  readonly generation = signal(0);
  /** What the last one that failed said. */
  readonly lastWords = signal("");
  #worker: Worker | undefined;
  #waiting = new Map<number, Waiting>();
  #last = 0;

  constructor(readonly name: string) {}

  ask<T>(request: object, files: Attached = {}, onStage?: (stage: Stage) => void): Promise<Answered<T>> {
    return this.#asked({ id: ++this.#last, request, files }, onStage);
  }

  /** As `ask`; several files come as one ZIP, which is packed where it holds up nothing that is shown. */
  askPacked<T>(request: object): Promise<Answered<T>> {
    return this.#asked({ id: ++this.#last, request, files: {}, zip: true });
  }

  #asked<T>(question: Question, onStage?: (stage: Stage) => void): Promise<Answered<T>> {
    const { id } = question;
    return new Promise<Answered<T>>((resolve, reject) => {
      this.#waiting.set(id, { resolve: resolve as Waiting["resolve"], reject, onStage });
      this.busy.value = this.#waiting.size;
      this.#send(question);
    });
  }

  /** Ends the worker, and with it what it computes; the next question starts another. */
  end(why = "ended"): void {
    this.#worker?.terminate();
    this.#worker = undefined;
    this.generation.value += 1;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    this.busy.value = 0;
    for (const { reject } of waiting) reject(new Stopped(why));
  }

  /** Sends a question as soon as there is a module; questions keep their order. */
  #send(question: Question): void {
    const worker = (this.#worker ??= this.#started());
    engineModule().then(
      () => worker.postMessage(question),
      (error: unknown) => {
        if (this.#worker === worker) this.#fail(error instanceof Error ? error.message : String(error));
      },
    );
  }

  #started(): Worker {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name: this.name });
    // What an ended worker still says is not about its successor.
    const own = () => this.#worker === worker;
    worker.onmessage = ({ data }: MessageEvent<Message>) => own() && this.#hear(data);
    worker.onerror = (event) => own() && this.#fail(event.message || "the engine cannot be loaded");
    void engineModule().then(
      (module) => worker.postMessage({ module } satisfies Start),
      () => undefined,
    );
    void preparedResults().then((bytes) => {
      if (!bytes) return;
      worker.postMessage({
        id: UNASKED,
        request: { do: "use-results" },
        files: { "prepared.bin": bytes },
      } satisfies Question);
    });
    return worker;
  }

  #hear(message: Message): void {
    if (message.kind === "unusable" || message.kind === "stopped") {
      this.#fail(message.message);
      return;
    }
    const waiting = this.#waiting.get(message.id);
    if (message.kind === "stage") {
      waiting?.onStage?.(message.stage);
      return;
    }
    this.#waiting.delete(message.id);
    this.busy.value = this.#waiting.size;
    if (message.kind === "answer") waiting?.resolve(message);
    else waiting?.reject(new Refused(message.refused));
  }

  #fail(message: string): void {
    this.lastWords.value = message;
    this.end(message);
  }
}
