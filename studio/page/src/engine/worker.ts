// One engine in a worker. It answers questions in the order in which they come; a request cannot be interrupted.
import { Engine } from "../../../engine.mjs";
import type { Message, Question, Start } from "./messages.ts";

const post = (message: Message, transfer: Transferable[] = []) => self.postMessage(message, { transfer });
let current = 0;

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

async function load(module: WebAssembly.Module): Promise<Engine> {
  try {
    return await Engine.load(module, (stage) => post({ kind: "stage", id: current, stage }));
  } catch (error) {
    post({ kind: "unusable", message: error instanceof Error ? error.message : String(error) });
    throw error;
  }
}

let starting: Promise<Engine> | undefined;
self.onmessage = async ({ data }: MessageEvent<Start | Question>) => {
  if ("module" in data) starting = load(data.module);
  else if (starting) answer(await starting, data);
};
