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
  // It is compiled while it comes, if the server says what it is.
  return response.headers.get("content-type")?.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}
