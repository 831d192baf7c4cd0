// Story 7: take away.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import type { Page } from "@playwright/test";
import { unzipSync } from "fflate";
import { hasComment } from "../src/state/doc.ts";
import { checked, drag, expect, mass, program, settled, shot, start, test } from "./studio.ts";

const PRESETS = ["cognifly", "cognifly-v8", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"];

async function downloaded(page: Page, button: string | RegExp): Promise<Map<string, Uint8Array>> {
  const waiting = page.waitForEvent("download", { timeout: 300_000 });
  await page.getByRole("button", { name: button }).click();
  const file = await waiting;
  const bytes = readFileSync(await file.path());
  const name = file.suggestedFilename();
  return name.endsWith(".zip") ? new Map(Object.entries(unzipSync(bytes))) : new Map([[name, bytes]]);
}

test("downloads have the bytes of the command line, for every preset", async ({ page }) => {
  test.setTimeout(900_000);
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  await start(page);
  await page.getByRole("tab", { name: "Files" }).click();
  await shot(page, "7-files");
  for (const preset of PRESETS) {
    execFileSync(program, ["build", preset, "--no-pictures", "-q", "-o", folder]);
    const native = (path: string) => readFileSync(join(folder, preset, path));
    await page.getByLabel("Preset").selectOption(preset);
    await settled(page);
    for (const [path, bytes] of await downloaded(page, /^STL, every part/))
      expect(native(path).equals(bytes), `${preset} ${path}`).toBe(true);
    for (const [path, bytes] of await downloaded(page, /^3MF plates/))
      expect(native(path).equals(bytes), `${preset} ${path}`).toBe(true);
    const glb = await downloaded(page, /^GLB/);
    expect(native("frame.glb").equals(glb.get(`${preset}-frame.glb`)!), preset).toBe(true);
    const bill = await downloaded(page, /^Bill/);
    expect(native("bom.csv").equals(bill.get(`${preset}-bom.csv`)!), preset).toBe(true);
  }
});

test("the whole folder, the STEP files and a single STL have the bytes of the command line", async ({ page }) => {
  test.setTimeout(900_000);
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  execFileSync(program, ["build", "cognifly", "--step", "-q", "-o", folder]);
  const root = join(folder, "cognifly");
  const built = readdirSync(root, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map(({ parentPath, name }) => relative(root, join(parentPath, name)));
  await start(page);
  await page.getByRole("tab", { name: "Files" }).click();
  const all = await downloaded(page, /^Folder of/);
  expect([...all.keys()].sort()).toEqual(built.sort());
  for (const [path, bytes] of all) expect(readFileSync(join(root, path)).equals(bytes), path).toBe(true);
  const report = await downloaded(page, /^Report/);
  const toRead = built.filter((path) => path.endsWith(".md") || path.startsWith("pictures/"));
  expect(toRead).toContain("report.md");
  expect([...report.keys()].sort()).toEqual(toRead);
  for (const [path, bytes] of report) expect(readFileSync(join(root, path)).equals(bytes), path).toBe(true);
  const steps = await downloaded(page, /^STEP/);
  expect([...steps.keys()].sort()).toEqual(built.filter((path) => path.endsWith(".step")));
  for (const [path, bytes] of steps) expect(readFileSync(join(root, path)).equals(bytes), path).toBe(true);
  await expect(page.locator(".files > .about").first()).toContainText(
    "flexframe build cognifly --step writes, the assembly's those of flexframe fold cognifly",
  );
  await page.getByText("One part as STL").click();
  const [[name, bytes]] = [...(await downloaded(page, "knee.stl"))] as [[string, Uint8Array]];
  expect(name).toBe("knee.stl");
  expect(readFileSync(join(root, "parts/knee.stl")).equals(bytes)).toBe(true);
  const listed = await page.locator(".files details button").allInnerTexts();
  expect(listed.map((name) => `parts/${name}`)).toEqual(built.filter((path) => path.endsWith(".stl")).sort());
});

test("a link holds 20 changes in 2 kB and opens the same model; the frame file is that of the command line", async ({
  page,
  context,
}) => {
  await start(page);
  const listed = JSON.parse(execFileSync(program, ["params", "cognifly", "--json"], { encoding: "utf8" })) as {
    key: string;
    value: number;
    max: number;
    drives: string[];
  }[];
  const chosen = listed
    .filter(({ value, max, drives, key }) => drives.length > 0 && value + 0.01 < max && !key.startsWith("fit."))
    .slice(0, 20);
  expect(chosen.length).toBe(20);
  await page.getByRole("tab", { name: "Frame file" }).click();
  const lines = chosen.map(({ key, value }) => `${key} = ${(value + 0.01).toFixed(3)}`);
  await page.locator("#toml").fill(['base = "cognifly"', ...lines, ""].join("\n"));
  await expect(page.locator("#toml-refusal")).toBeEmpty();
  await page.getByRole("tab", { name: "Values" }).click();
  await expect(page.getByText("changed (20)")).toBeVisible({ timeout: 40_000 });
  await settled(page);
  await page.getByRole("tab", { name: "Files" }).click();
  await page.getByRole("button", { name: "Copy the link" }).click();
  const link = await page.getByLabel("Link", { exact: true }).inputValue();
  expect(link.length).toBeLessThan(2000);
  await expect(page.locator(".notice")).toHaveText(/link/);
  const mine = await downloaded(page, /^GLB/);
  const text = await downloaded(page, /^Frame file/);
  const other = await context.newPage();
  await start(other, link.slice(link.indexOf("#")));
  await expect(other.getByText("changed (20)")).toBeVisible();
  await other.getByRole("tab", { name: "Files" }).click();
  const theirs = await downloaded(other, /^GLB/);
  expect(Buffer.from(theirs.get("my-cognifly-frame.glb")!).equals(mine.get("my-cognifly-frame.glb")!)).toBe(true);
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  writeFileSync(join(folder, "my-cognifly.toml"), text.get("my-cognifly.toml")!);
  execFileSync(program, ["build", join(folder, "my-cognifly.toml"), "--no-pictures", "-q", "-o", folder]);
  expect(readFileSync(join(folder, "my-cognifly", "frame.glb")).equals(mine.get("my-cognifly-frame.glb")!)).toBe(true);
});

test("a link to a frame file with a comment holds its text", async ({ page }) => {
  for (const [text, has] of [
    ["a = 1 # one", true],
    ["# one\na = 1", true],
    ["a = \"#1\"\nb = '#2'", false],
    ['a = "\\"# no" # yes', true],
    ['a = """\n# "no\n"""', false],
    ["a = \'\'\'\n# \'no\n\'\'\' # it\'s", true],
  ] as const)
    expect(hasComment(text), text).toBe(has);
  await start(page);
  await page.getByRole("tab", { name: "Frame file" }).click();
  const text = 'base = "cognifly"\n[rods]\narm_rod_length_mm = 85.0 # eleven of 1 m\n';
  await page.locator("#toml").fill(text);
  await settled(page);
  await expect(page.locator("[data-gauge=size] b")).not.toContainText("NaN");
  await page.getByRole("tab", { name: "Files" }).click();
  await expect(page.getByLabel("Name of the frame's file")).toHaveValue("my-cognifly");
  await settled(page);
  await page.getByRole("button", { name: "Copy the link" }).click();
  const link = new URL(await page.getByLabel("Link", { exact: true }).inputValue());
  expect(new URLSearchParams(link.hash.slice(1)).get("t")).toBe(text);
  // A link that nobody could open is not made.
  await page.getByRole("tab", { name: "Frame file" }).click();
  await page.locator("#toml").fill(`${text}# ${"ä".repeat(40_000)}\n`);
  await settled(page);
  await page.getByRole("button", { name: "Copy the link" }).click();
  await expect(page.locator(".notice")).toContainText("A link to this frame would have");
  await expect(page.getByLabel("Link", { exact: true })).toHaveCount(0);
});

test("of a refused frame file there are no files, and the link and the frame file hold what was typed", async ({
  page,
  context,
}) => {
  await start(page);
  await page.getByRole("tab", { name: "Frame file" }).click();
  const good = 'base = "cognifly"\nrods.cage_rod_length_mm = 185.0\n';
  const typed = `${good}rods.arm_rod_length_mm = 45\n`;
  await page.locator("#toml").fill(good);
  await expect(page.locator("[data-gauge=size] b")).toContainText("202.5");
  await page.locator("#toml").fill(typed);
  await expect(page.locator("#toml-refusal")).toContainText("the way left");
  await page.getByRole("tab", { name: "Files" }).click();
  await expect(page.locator(".files > .caution")).toContainText(
    "my-cognifly.toml is refused, so no files are made of it",
  );
  await expect(page.locator(".files > .caution")).toContainText("the way left");
  for (const button of [/^STL, every part/, /^GLB/, /^Bill/, /^Folder of/])
    await expect(page.getByRole("button", { name: button })).toBeDisabled();
  const text = await downloaded(page, /^Frame file/);
  expect(Buffer.from(text.get("my-cognifly.toml")!).toString()).toBe(typed);
  await page.getByRole("button", { name: "Copy the link" }).click();
  const link = await page.getByLabel("Link", { exact: true }).inputValue();
  await shot(page, "7-held");
  // Whoever opens it has the text with its refusal, and the preset's picture.
  const other = await context.newPage();
  await start(other, link.slice(link.indexOf("#")));
  await expect(other.locator(".refusal")).toContainText("the way left");
  await shot(other, "7-held-linked");
  await other.getByRole("tab", { name: "Frame file" }).click();
  await expect(other.locator("#toml")).toHaveValue(typed);
  await other.locator("#toml").fill(good);
  await expect(other.locator(".refusal")).toHaveCount(0);
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.getByRole("button", { name: /^GLB/ })).toBeEnabled();
  await expect(page.getByLabel("Link", { exact: true })).toHaveCount(0);
});

test("a frame file of one's own is opened or dragged in, its differences are against the preset that it names", async ({
  page,
}) => {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  const text = 'base = "cognifly-mini"\n\n[rods]\n# shorter\nstrut_rod_length_mm = 49.0\n';
  const path = join(folder, "Own.mini-1.toml");
  writeFileSync(path, text);
  execFileSync(program, ["build", path, "--no-pictures", "-q", "-o", folder]);
  await start(page);
  const first = await mass(page);
  await page.getByRole("tab", { name: "Files" }).click();
  await page.getByLabel("Open a .toml file").setInputFiles(path);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly-mini");
  await expect(page.locator("#toml")).toHaveValue(text);
  await settled(page);
  await page.getByRole("tab", { name: "Values" }).click();
  await expect(page.getByText("changed (1)")).toBeVisible();
  const glb = await downloaded(page, /^GLB/);
  expect(readFileSync(join(folder, "Own.mini-1", "frame.glb")).equals(glb.get("Own.mini-1-frame.glb")!)).toBe(true);
  await shot(page, "7-opened");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  expect(await mass(page)).toBe(first);
  await expect(page.getByText("changed (0)")).toBeVisible();
  await drag(page, "canvas", [{ name: "v8.toml", text: 'base = "cognifly-v8"\nlimits.mass_budget_g = 240.0\n' }]);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly-v8");
  await settled(page);
  await expect(page.locator("[data-gauge=mass]")).toContainText("of 240 g");
  await drag(page, "canvas", [{ name: "Küche Rahmen (1).toml", text: 'base = "cognifly-v8"\n' }]);
  await expect(page.getByLabel("Name of the frame's file")).toHaveValue("Kuche-Rahmen-1");
  await checked(page);
  await page.getByRole("tab", { name: "Files" }).click();
  await page.getByRole("button", { name: "Show them" }).click();
  await expect(page.getByRole("tab", { name: /^Checks \(\d+\)$/ })).toHaveAttribute("aria-selected", "true");
});

test("a frame file of Windows, or with its table in a line, is read as any other", async ({ page }) => {
  await start(page);
  const stated = page.locator('[data-key="rods.arm_rod_length_mm"] input[type=text]');
  await drag(page, ".app", [{ name: "dos.toml", text: 'base = "cognifly"\r\n[rods]\r\narm_rod_length_mm = 4000\r\n' }]);
  await expect(page.locator(".refusal")).toContainText("4000");
  await page.getByRole("tab", { name: "Values" }).click();
  await expect(stated).toHaveValue("4000");
  await expect(page.getByText("changed (1)")).toBeVisible();
  await drag(page, ".app", [{ name: "line.toml", text: 'base = "cognifly"\nrods = { arm_rod_length_mm = 5000 }\n' }]);
  await expect(page.locator(".refusal")).toContainText("5000");
  await page.getByRole("tab", { name: "Values" }).click();
  await expect(stated).toHaveValue("5000");
});

test("frame files that cannot be opened are refused in words, and nothing changes", async ({ page }) => {
  await start(page);
  const first = await mass(page);
  const script = "<img src=x onerror=alert(1)>";
  const refused = page.locator(".notice");
  await drag(page, "canvas", [
    { name: "a.toml", text: 'base = "b"\n' },
    { name: "b.toml", text: 'base = "cognifly"\n' },
  ]);
  await expect(refused).toContainText("2 frame files were given. The studio takes one");
  await drag(page, "canvas", [{ name: "a.toml", text: `base = '${script}'\n` }]);
  await expect(refused).toContainText(`a.toml has the base “${script}”, which is no preset`);
  await expect(refused).toContainText("cognifly-mini");
  await shot(page, "7-refused-base");
  await drag(page, ".gauges", [{ name: "large.toml", text: "#".repeat(2 << 20) }]);
  await expect(refused).toContainText("large.toml has 2.1 MB");
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly");
  await expect(page.getByRole("button", { name: "Undo" })).toBeDisabled();
  expect(await mass(page)).toBe(first);
  // What is no TOML stands as text with its refusal; the picture stays, and undo goes back.
  await drag(page, "canvas", [{ name: "bad.toml", text: 'base = "cognifly"\n[rods\narm = 1\n' }]);
  await expect(refused).toHaveCount(0);
  await expect(page.locator("#toml-refusal")).toContainText("line 2");
  await page.getByRole("tab", { name: "Values" }).click();
  await page.locator(".refusal").getByRole("button", { name: "bad.toml, line 2" }).click();
  await expect(page.locator("#toml")).toBeVisible();
  await shot(page, "7-refused-text");
  expect(await mass(page)).toBe(first);
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.locator(".refusal")).toHaveCount(0);
  // Measured drops that are dragged in are for the diagnosis, whatever panel is open.
  await drag(page, "canvas", [{ name: "drops.csv", text: "trial,height_m,t_s,accel_g\na,1,0,NaN\n" }]);
  await expect(page.getByRole("tab", { name: "Diagnose" })).toHaveAttribute("aria-selected", "true");
  await expect(page.locator(".diagnose .fault").first()).toContainText("drops.csv", { timeout: 30_000 });
});
