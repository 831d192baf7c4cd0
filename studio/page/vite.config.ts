import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";
import { defineConfig } from "vite";

/** What is beside the page's own files: the engine, and the results that were computed ahead for it. */
const BESIDE = ["icon.svg", "manifest.webmanifest", "engine/engine.wasm", "engine/prepared.bin"];

function sha256(of: string | Uint8Array): string {
  return createHash("sha256").update(of).digest("hex");
}

/** Writes sw.js with all files of the build as they were written, and a version that changes when one of them does. */
function serviceWorker(): Plugin {
  return {
    name: "service-worker",
    apply: "build",
    writeBundle({ dir = "../dist" }, bundle) {
      const beside = BESIDE.filter((name) => existsSync(join(dir, name)));
      const files = [...Object.keys(bundle), ...beside].map((name) => [
        name === "index.html" ? "./" : name,
        sha256(readFileSync(join(dir, name))),
      ]);
      const listed = JSON.stringify(Object.fromEntries(files));
      const source = readFileSync("src/service_worker.js", "utf8")
        .replace('VERSION"}', `${sha256(listed).slice(0, 16)}"}`)
        .replace('{ FILES: "" }', listed);
      writeFileSync(join(dir, "sw.js"), source);
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
