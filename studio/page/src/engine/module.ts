// The engine's module, compiled once: all workers share its code, so a second engine, or one that replaces another, starts at once.

let compiled: Promise<WebAssembly.Module> | undefined;

/** The module; the first call asks the server for it. What could not be loaded is asked for again. */
export function engineModule(): Promise<WebAssembly.Module> {
  if (!compiled) {
    compiled = load();
    compiled.catch(() => (compiled = undefined));
  }
  return compiled;
}

async function load(): Promise<WebAssembly.Module> {
  const response = await fetch("./engine/engine.wasm");
  if (!response.ok) throw new Error(`engine.wasm: ${response.status} ${response.statusText}`);
  // Read at once and not while it is compiled: a server that answers one request after another is free for the scripts again.
  return WebAssembly.compile(await response.arrayBuffer());
}
