// node validate_gltf.mjs MODULE FILE.glb...: one line a file, what the Khronos validator says. Errors and
// warnings both fail; MODULE is the folder of the npm package gltf-validator.
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { basename, dirname, resolve } from "node:path";

const [module, ...files] = process.argv.slice(2);
const validator = createRequire(import.meta.url)(resolve(module));

const SEVERITIES = ["error", "warning", "information", "hint"];

async function problems(file) {
  const bytes = new Uint8Array(await readFile(file));
  const report = await validator.validateBytes(bytes, { uri: basename(file), maxIssues: 20 });
  const { numErrors, numWarnings, messages } = report.issues;
  if (numErrors + numWarnings === 0) return null;
  const first = messages
    .filter((issue) => issue.severity < 2)
    .slice(0, 3)
    .map((issue) => `${SEVERITIES[issue.severity]} ${issue.code} at ${issue.pointer ?? `byte ${issue.offset}`}`);
  return `${numErrors} errors, ${numWarnings} warnings: ${first.join("; ")}`;
}

let code = 0;
for (const file of files) {
  const name = `Khronos validator ${basename(dirname(file))}/${basename(file)}`;
  const found = await problems(file).catch((error) => `${error}`.split("\n")[0]);
  if (found) code = 1;
  console.log(found ? `FAILED ${name}: ${found}` : `ok ${name}`);
}
process.exit(code);
