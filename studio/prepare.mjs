// Writes engine/prepared.bin beside the engine: the small results of all checks of every preset. The page hands it to its engines, which
// then do not compute the same again when a visitor opens a preset. They take it only from their own build.
//
//   node studio/prepare.mjs studio/dist/engine
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Engine } from "./engine.mjs";

const folder = process.argv[2];
const engine = await Engine.load(readFileSync(join(folder, "engine.wasm")));
const { files, refused } = engine.ask({ do: "collect-results" });
if (refused) throw new Error(refused.message);
const name = join(folder, files[0].path);
writeFileSync(`${name}.new`, files[0].bytes);
renameSync(`${name}.new`, name);
console.log(`${name}: ${files[0].bytes.length} bytes`);
