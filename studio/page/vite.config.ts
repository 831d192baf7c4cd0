import { createHash } from "node:crypto";
import { existsSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import type { Plugin } from "vite";
import { defineConfig } from "vite";

/** The engine, and the results that were computed ahead for it. */
const ENGINE = ["engine/engine.wasm", "engine/prepared.bin"];

/** Writes sw.js with the list of all files of the build, and a version that changes when one of them does. */
function serviceWorker(): Plugin {
  return {
    name: "service-worker",
    apply: "build",
    enforce: "post",
    generateBundle(_, bundle) {
      const own = Object.values(bundle);
      const hash = createHash("sha256");
      for (const file of own) hash.update(file.fileName).update(file.type === "asset" ? file.source : file.code);
      const engine = ENGINE.filter((name) => existsSync(resolve("../dist", name)));
      for (const name of engine) hash.update(readFileSync(resolve("../dist", name)));
      const files = [
        "./",
        ...own.map(({ fileName }) => fileName).filter((name) => name !== "index.html"),
        "icon.svg",
        "manifest.webmanifest",
        ...engine,
      ];
      const source = readFileSync("src/service_worker.js", "utf8")
        .replace('VERSION"}', `${hash.digest("hex").slice(0, 16)}"}`)
        .replace('["FILES"]', JSON.stringify(files));
      this.emitFile({ type: "asset", fileName: "sw.js", source });
    },
  };
}

// Paths are relative, so that the page works in any folder of a static host.
export default defineConfig({
  base: "./",
  plugins: [serviceWorker()],
  build: {
    outDir: "../dist",
    emptyOutDir: false,
    target: "es2022",
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    modulePreload: { polyfill: false },
  },
  worker: { format: "es" },
  server: { fs: { allow: [".."] } },
});
