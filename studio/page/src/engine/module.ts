// The engine's module and what was computed ahead for it. The module is compiled once: all workers share its code, so a second engine, or
// one that replaces another, starts at once.

let compiled: Promise<WebAssembly.Module> | undefined;

/** The module; the first call asks the server for it. What could not be loaded is asked for again. */
export function engineModule(): Promise<WebAssembly.Module> {
  if (!compiled) {
    compiled = load();
    compiled.catch(() => (compiled = undefined));
  }
  return compiled;
}

let ahead: Promise<Uint8Array | undefined> | undefined;

/**
 * Results that were computed ahead for this module. Asked for after it, as a frame can be made without them; a page that was published
 * without them has none.
 */
export function preparedResults(): Promise<Uint8Array | undefined> {
  return (ahead ??= engineModule()
    .then(() => answered("./engine/prepared.bin", 1))
    .then(async (response) => (response.ok ? new Uint8Array(await response.arrayBuffer()) : undefined))
    .catch(() => undefined));
}

/** A server that says nothing for this long is asked again, ms: a connection can be taken and never be answered. */
const PATIENCE_MS = 8000;
const TRIES = 4;

async function load(): Promise<WebAssembly.Module> {
  const response = await answered("./engine/engine.wasm", TRIES);
  if (!response.ok) throw new Error(`engine.wasm: ${response.status} ${response.statusText}`);
  // Read at once and not while it is compiled: a server that answers one request after another is free for the scripts again.
  return WebAssembly.compile(await response.arrayBuffer());
}

/** The answer as soon as its head is there; reading it may take as long as it takes. */
async function answered(url: string, tries: number, waitedMs = 0): Promise<Response> {
  const ending = new AbortController();
  const timer = setTimeout(() => ending.abort(), PATIENCE_MS);
  try {
    return await fetch(url, { signal: ending.signal });
  } catch (error) {
    if (!ending.signal.aborted) throw error;
    const waited = waitedMs + PATIENCE_MS;
    if (tries <= 1) throw new Error(`${url}: no answer in ${waited / 1000} s`, { cause: error });
    return await answered(url, tries - 1, waited);
  } finally {
    clearTimeout(timer);
  }
}
