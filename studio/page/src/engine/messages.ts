// What goes between the page and an engine's worker.
import type { EngineFile, Refusal, Stage } from "../../../engine.mjs";

export type { EngineFile, Refusal, Stage };

/** Files of a request: a path and its text or bytes. */
export type Attached = Record<string, Uint8Array | string>;

/** To the worker, after the module. With `zip`, several files of the answer come as one ZIP. */
export type Question = { id: number; request: object; files: Attached; zip?: boolean };

/** Path of that ZIP. */
export const PACKED = "files.zip";

/** To the worker, once: what it runs. */
export type Start = { module: WebAssembly.Module };

/** From the worker: stages and one end for each question. */
export type Message =
  | { kind: "unusable"; message: string }
  | { kind: "stage"; id: number; stage: Stage }
  | { kind: "answer"; id: number; answer: unknown; files: EngineFile[]; ms: number }
  | { kind: "refused"; id: number; refused: Refusal }
  | { kind: "stopped"; id: number; message: string };
