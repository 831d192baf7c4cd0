// One engine in a worker. It answers questions in the order in which they come; a request cannot be interrupted.
import { Engine } from "../../../engine.mjs";
import { type EngineFile, type Message, PACKED, type Question, type Start } from "./messages.ts";
import { zipped } from "./zipped.ts";

const post = (message: Message, transfer: Transferable[] = []) => self.postMessage(message, { transfer });
let current = 0;

/** Files of one answer are views of one buffer: copied, or packed, so that each can be handed over alone. */
function handed(files: EngineFile[], zip: boolean): EngineFile[] {
  if (zip && files.length > 1) return [{ path: PACKED, bytes: zipped(files) }];
  return files.map(({ path, bytes }) => ({ path, bytes: bytes.slice() }));
}

function answer(engine: Engine, { id, request, files, zip = false }: Question): void {
  current = id;
  const begun = performance.now();
  try {
    const reply = engine.ask(request, files);
    if (reply.refused) {
      post({ kind: "refused", id, refused: reply.refused });
      return;
    }
    const copies = handed(reply.files ?? [], zip);
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
