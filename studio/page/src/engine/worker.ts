// One engine in a worker. It answers questions in the order in which they come; a request cannot be interrupted.
import { Engine } from "../../../engine.mjs";
import type { Message, Question } from "./messages.ts";

const post = (message: Message, transfer: Transferable[] = []) => self.postMessage(message, { transfer });
let current = 0;

async function start(): Promise<Engine> {
  const response = await fetch(new URL("../engine/engine.wasm", self.location.href));
  if (!response.ok) throw new Error(`engine.wasm: ${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  return Engine.load(module, (stage) => post({ kind: "stage", id: current, stage }));
}

function answer(engine: Engine, { id, request, files }: Question): void {
  current = id;
  const begun = performance.now();
  try {
    const reply = engine.ask(request, files);
    if (reply.refused) {
      post({ kind: "refused", id, refused: reply.refused });
      return;
    }
    // Files of one answer are views of one buffer: copied, so that each can be handed over alone.
    const copies = (reply.files ?? []).map(({ path, bytes }) => ({ path, bytes: bytes.slice() }));
    const ms = performance.now() - begun;
    post(
      { kind: "answer", id, answer: reply.answer, files: copies, ms },
      copies.map(({ bytes }) => bytes.buffer),
    );
  } catch (error) {
    post({ kind: "stopped", id, message: error instanceof Error ? error.message : String(error) });
  }
}

const starting = start();
starting.then(
  () => post({ kind: "ready" }),
  (error: unknown) => post({ kind: "unusable", message: error instanceof Error ? error.message : String(error) }),
);
self.onmessage = async ({ data }: MessageEvent<Question>) => answer(await starting, data);
