// The engine in a page or in Node: one object around the WebAssembly module, requests in, answers out.
//
// `Engine.load(bytes)` starts one. `ask(request, files)` takes a request of studio/wasm/src/request.rs and files
// `{ path: Uint8Array or string }`; it gives `{ answer, files }`, or `{ refused: { message, remedy, place } }`. Nothing is
// thrown for wrong input; an `EngineStopped` is thrown when the module itself failed, and then a new engine has to be loaded.

export class EngineStopped extends Error {}

export class Engine {
  #module;
  #stopped = false;

  /** Starts an engine from the module's bytes or from a compiled module; `onStage({ done, of, name })` hears of long requests. */
  static async load(source, onStage = () => {}) {
    const engine = new Engine();
    const stage = (done, of, at, length) => onStage({ done, of, name: new TextDecoder().decode(engine.#read(at, length)) });
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
    const { exports } = await WebAssembly.instantiate(module, { studio: { stage } });
    engine.#module = exports;
    return engine;
  }

  /** Bytes of the module's memory, copied: memory may move with the next request. */
  #read(at, length) {
    return new Uint8Array(this.#module.memory.buffer, at >>> 0, length >>> 0).slice();
  }

  /** Answers a request. */
  ask(request, files = {}) {
    if (this.#stopped) throw new EngineStopped("the engine stopped before");
    const encoder = new TextEncoder();
    const attached = Object.entries(files).map(([path, file]) => [path, typeof file === "string" ? encoder.encode(file) : file]);
    const listed = attached.map(([path, bytes]) => ({ path, length: bytes.length }));
    const text = encoder.encode(JSON.stringify({ request, attached: listed }));
    try {
      return this.#answer(text, attached.map(([, bytes]) => bytes));
    } catch (error) {
      // A RangeError is a stack or a memory that is full.
      if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
      this.#stopped = true;
      throw new EngineStopped(this.#lastWords() || error.message, { cause: error });
    }
  }

  #answer(text, attached) {
    const module = this.#module;
    const room = module.request_room(attached.reduce((sum, bytes) => sum + bytes.length, text.length)) >>> 0;
    const memory = new Uint8Array(module.memory.buffer);
    let at = room;
    for (const bytes of [text, ...attached]) {
      memory.set(bytes, at);
      at += bytes.length;
    }
    const refused = module.ask(text.length) !== 0;
    const { answer, files } = JSON.parse(new TextDecoder().decode(this.#read(module.text(), module.text_length())));
    if (refused) return { refused: answer };
    const all = this.#read(module.bytes(), module.bytes_length());
    let from = 0;
    const cut = ({ path, length }) => ({ path, bytes: all.subarray(from, (from += length)) });
    return { answer, files: files.map(cut) };
  }

  #lastWords() {
    this.#module.last_words();
    return new TextDecoder().decode(this.#read(this.#module.text(), this.#module.text_length()));
  }
}
