// Story 5: drop.
import type { Locator, Page } from "@playwright/test";
import { dropped, expect, peakOfDrop, setNumber, shot, start, test } from "./studio.ts";

/** Waits for a peak that is the expected one but for the last digits of another machine's arithmetic. */
async function expectPeak(shown: Locator, expected: number, timeout: number): Promise<void> {
  const peak = async () => Number(await shown.getAttribute("data-peak", { timeout }));
  await expect.poll(async () => Math.abs((await peak()) / expected - 1), { timeout }).toBeLessThan(1e-9);
}

// Numbers are written alike in every language.
test.use({ locale: "de-DE" });

type Written = { text: string; ink: string };

/** Keeps what is written into drawings, and how. */
async function keepWriting(page: Page): Promise<() => Promise<Written[]>> {
  await page.addInitScript(() => {
    const written: Written[] = [];
    const own = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
      written.push({ text, ink: String(this.fillStyle) });
      own.call(this, text, ...place);
    };
    Object.assign(window, { written });
  });
  return () => page.evaluate(() => (window as unknown as { written: Written[] }).written.splice(0));
}

test("a drop by a model, a higher one, and beside the preset", async ({ page }) => {
  const written = await keepWriting(page);
  await start(page);
  await page.getByLabel("Colours of the page").selectOption("dark");
  await setNumber(page, "limits.mass_budget_g", "245");
  await page.getByRole("tab", { name: "Drop" }).click();
  const peak = page.locator("[data-peak]").first();
  const expected = peakOfDrop("cognifly", "paper-corrected", 1);
  await expectPeak(peak, expected, 60_000);
  await expect(peak).toContainText(`${expected.toPrecision(3)} g`);
  await expect(page.locator(".plot canvas").first()).toBeVisible();
  await expect(peak).toHaveClass(/invalid/);
  await expect(peak).toContainText(/Not valid: the battery hits the ground at 11\.5 mm/);
  await page.locator("#drop-height").fill("2");
  await page.locator("#drop-height").press("Enter");
  await expectPeak(peak, peakOfDrop("cognifly", "paper-corrected", 2), 60_000);
  await page.getByLabel(/beside it/).check();
  await expect(page.locator("[data-peak]")).toHaveCount(2, { timeout: 60_000 });
  // a(t) and F(x), each with both variants; F(x) goes in and out.
  const curves = (title: string) => page.locator(".plot", { hasText: title }).locator(".u-legend .u-series .u-label");
  await expect(curves("Acceleration")).toHaveText(["my-cognifly", "cognifly (before)"]);
  await expect(curves("Force of the ground")).toHaveText([
    "my-cognifly, in",
    "my-cognifly, out",
    "cognifly (before), in",
    "cognifly (before), out",
  ]);
  const lines = page.locator(".plot", { hasText: "Force of the ground" }).locator(".u-legend .u-series .u-marker");
  const styles = await lines.evaluateAll((keys) => keys.map((key) => getComputedStyle(key).borderTopStyle));
  expect(styles.slice(-4)).toEqual(["solid", "dashed", "solid", "dashed"]);
  const before = Number(await peak.getAttribute("data-peak"));
  // Most force is the mass times the peak of what the frame feels, which the command line gives.
  const { mass_kg, peak_proper_g } = dropped("cognifly", "paper-corrected", 2);
  const named = await page.locator(".plot [role=img]").nth(1).getAttribute("aria-label");
  const most = Number(/cognifly \(before\), in: at most ([\d.]+)/.exec(named ?? "")?.[1]);
  expect(most / (mass_kg * peak_proper_g * 9.80665)).toBeGreaterThan(0.98);
  expect(most / (mass_kg * peak_proper_g * 9.80665)).toBeLessThan(1.001);
  // Another frame is beside it.
  await setNumber(page, "rods.strut_rod_length_mm", "56");
  await page.getByRole("tab", { name: "Drop" }).click();
  await expect.poll(async () => Number(await peak.getAttribute("data-peak")), { timeout: 60_000 }).not.toBe(before);
  await page.locator(".plot").last().scrollIntoViewIfNeeded();
  await shot(page, "5-model");
  const axes = await written();
  expect(axes.filter(({ text }) => /\d,\d/.test(text))).toEqual([]);
  expect(axes.some(({ text }) => /\d\.\d/.test(text))).toBe(true);
  // On paper they are dark, though the page is not.
  const paper = "#1b222b";
  expect(axes.some(({ ink }) => ink === paper)).toBe(false);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const printed = await written();
  expect(printed.length).toBeGreaterThan(4);
  expect(printed.every(({ ink }) => ink === paper)).toBe(true);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  await page.getByLabel("Colours of the page").selectOption("system");
  // A height that cannot be has no peak.
  await page.locator("#drop-height").fill("0");
  await page.locator("#drop-height").press("Enter");
  await expect(page.locator(".drop .progress .fault")).toContainText("A height of 0 m is out of bounds");
  await expect(page.locator("[data-peak]")).toHaveCount(0);
});

test("the frame's own mechanics, with the motion slowed down", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Drop" }).click();
  await page.getByLabel("Model of the drop").selectOption("frame");
  const { peak_sensor_g, touches } = dropped("cognifly", "frame", 1);
  await expectPeak(page.locator("[data-peak]").first(), peak_sensor_g, 80_000);
  await expect(page.locator(".peak.invalid")).toHaveCount(0);
  if (!touches) throw new Error("the command line's lowest body does not reach the ground");
  await expect(page.locator(".drop .caution")).toHaveText(
    `The lowest body, ${Number(touches.gap_mm.toFixed(1))} mm above the ground, reaches it after ${Number(touches.at_ms.toFixed(1))} ms at ${Number(touches.speed_m_s.toFixed(2))} m/s. The peak does not include that impact.`,
  );
  await expect(page.locator(".plot")).toHaveCount(2);
  await page.getByRole("button", { name: /Slow motion/ }).click();
  const time = page.getByLabel("Time of the impact");
  await expect(time).toBeVisible();
  await time.fill("0.35");
  await page.waitForTimeout(800);
  await shot(page, "5-mechanics");
});
