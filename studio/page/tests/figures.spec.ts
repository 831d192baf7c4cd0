// Sizes over the wire, which have limits, and times, which depend on the machine and are only reported.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { brotliCompressSync } from "node:zlib";
import { expect, settled, shot, start, test } from "./studio.ts";

/** Most JavaScript over the wire, bytes. */
const MOST_BYTES = 400_000;

test("JavaScript over the wire", () => {
  const folder = "../dist/assets";
  const scripts = readdirSync(folder).filter((name) => name.endsWith(".js"));
  const bytes = scripts.reduce((sum, name) => sum + brotliCompressSync(readFileSync(join(folder, name))).length, 0);
  console.log(`studio: ${bytes} bytes of JavaScript with brotli`);
  expect(bytes).toBeLessThan(MOST_BYTES);
});

type Entry = { startTime: number; duration: number };

test("the first model and changes, in milliseconds", async ({ page }) => {
  test.setTimeout(300_000);
  await page.addInitScript(() => {
    const long: number[] = [];
    Object.assign(window, { long });
    new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => long.push(duration))).observe({
      type: "longtask",
      buffered: true,
    });
  });
  await start(page);
  const entries = () =>
    page.evaluate(() =>
      performance.getEntriesByName("change").map(({ startTime, duration }) => ({ startTime, duration })),
    );
  const [first] = await entries();
  const ready = first!.startTime + first!.duration;
  await page.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
  await page.waitForTimeout(4000);
  const keys = await page
    .locator("[data-table] .field")
    .evaluateAll((fields) => fields.map((field) => (field as HTMLElement).dataset["key"] ?? ""));
  const every = Number(process.env["STUDIO_EVERY"] ?? 12);
  await page.evaluate(() => (window as unknown as { long: number[] }).long.splice(0));
  for (const key of keys.filter((_, at) => at % every === 0)) {
    const range = page.locator(`[id="p-${key}-range"]`);
    await range.focus();
    await page.keyboard.press("ArrowRight");
    await settled(page);
    await page.keyboard.press("ArrowLeft");
    await settled(page);
  }
  const times = (await entries())
    .slice(1)
    .map(({ duration }: Entry) => duration)
    .sort((a, b) => a - b);
  const share = (of: number) => Math.round(times[Math.floor(of * (times.length - 1))] ?? NaN);
  const long = await page.evaluate(() => Math.max(0, ...(window as unknown as { long: number[] }).long));
  console.log(
    `studio: first model ${Math.round(ready)} ms after the page was asked for; ${times.length} changes: p50 ${share(0.5)} ms, p95 ${share(0.95)} ms; longest task of the main thread ${Math.round(long)} ms`,
  );
  expect(times.length).toBeGreaterThan(10);
});

test("the picture of the documentation", async ({ page }) => {
  await page.setViewportSize({ width: 1280, height: 760 });
  await start(page);
  await page.getByLabel("Preset").selectOption("cognifly-v8");
  await settled(page);
  await page.getByLabel("Colour by").selectOption("finding");
  await page.waitForTimeout(2500);
  await shot(page, "studio");
  // STUDIO_PICTURE=../../docs/pictures/studio.png npx playwright test figures makes the one of README.
  const place = process.env["STUDIO_PICTURE"];
  if (place) writeFileSync(resolve(place), await page.screenshot());
});
