// Story 2: see.
import type { Page } from "@playwright/test";
import { differing, expect, openField, pixels, setNumber, settled, shot, start, test, touchesEdge } from "./studio.ts";

/** Clicks the picture in places around its middle until a body is hit. */
async function clickBody(page: Page, again = 0): Promise<void> {
  const box = (await page.locator("canvas").boundingBox())!;
  for (const [x, y] of [
    [0.5, 0.5],
    [0.5, 0.55],
    [0.47, 0.52],
    [0.53, 0.5],
    [0.5, 0.45],
    [0.45, 0.5],
  ].slice(again)) {
    await page.mouse.click(box.x + box.width * x!, box.y + box.height * y!);
    if (await page.locator(".picked, .distance").first().isVisible()) return;
  }
}

test("assembled, apart and on the bed, in three colourings", async ({ page }) => {
  await start(page);
  await page.getByLabel("Show", { exact: true }).selectOption("exploded");
  await page.getByLabel("Colour by").selectOption("part");
  await shot(page, "2-exploded");
  await page.getByLabel("Show", { exact: true }).selectOption("bed");
  await expect(page.getByLabel("Plate", { exact: true })).toBeVisible({ timeout: 60_000 });
  await page.waitForTimeout(1500);
  await shot(page, "2-bed");
  await page.getByLabel("Show", { exact: true }).selectOption("assembled");
  await page.getByLabel("Preset").selectOption("cognifly-v8");
  await settled(page);
  await page.getByLabel("Colour by").selectOption("finding");
  await page.getByRole("button", { name: "Envelope", exact: true }).click();
  await page.getByRole("button", { name: "Propeller discs", exact: true }).click();
  await page.getByRole("button", { name: "Centre of mass", exact: true }).click();
  await page.waitForTimeout(1000);
  await shot(page, "2-finding");
});

test("a click names a part and what drives it; a parameter lights its parts; distances; a section", async ({
  page,
}) => {
  await start(page);
  await clickBody(page);
  await expect(page.locator(".picked")).toContainText("mm");
  await expect(page.locator(".picked")).toContainText(" g each");
  await shot(page, "2-picked");
  await page.getByRole("button", { name: "Close" }).click();
  await (await openField(page, "motor_mount.motor_skirt_wall_mm")).focus();
  await page.waitForTimeout(500);
  await shot(page, "2-lit");
  await page.getByLabel("Section", { exact: true }).selectOption("y");
  await page.waitForTimeout(500);
  await shot(page, "2-section");
  await page.getByLabel("Section", { exact: true }).selectOption("");
  await page.getByRole("button", { name: "Distance" }).click();
  const box = (await page.locator("canvas").boundingBox())!;
  for (let at = 0; at < 40 && !/Distance \d/.test(await page.locator(".distance").innerText()); at++) {
    await page.mouse.click(
      box.x + box.width * (0.4 + 0.01 * (at % 20)),
      box.y + box.height * (0.45 + 0.1 * Math.floor(at / 20)),
    );
    await page.waitForTimeout(60);
  }
  await expect(page.locator(".distance")).toContainText(/Distance \d+(\.\d+)? mm/);
  await shot(page, "2-distance");
});

test("the camera stays where it is when something changes", async ({ page }) => {
  await start(page);
  const canvas = page.locator("canvas");
  await canvas.focus();
  for (let turns = 0; turns < 6; turns++) await page.keyboard.press("ArrowLeft");
  const turned = await pixels(page);
  await shot(page, "2-turned");
  // A limit changes no body: a picture is drawn anew, and it is the same.
  await setNumber(page, "limits.mass_budget_g", "245");
  await expect(page.getByText("changed (1)")).toBeVisible();
  expect(differing(turned, await pixels(page))).toBeLessThan(50);
  await setNumber(page, "rods.strut_rod_length_mm", "52");
  const changed = differing(turned, await pixels(page));
  await shot(page, "2-turned-changed");
  await page.getByRole("button", { name: "Fit", exact: true }).click();
  await canvas.focus();
  for (let turns = 0; turns < 6; turns++) await page.keyboard.press("ArrowRight");
  const back = differing(turned, await pixels(page));
  expect(changed).toBeGreaterThan(500);
  // Another direction differs more than another frame.
  expect(back).toBeGreaterThan(1.5 * changed);
});

test("the picture is not clipped: after the assembly, apart, on the bed, in a narrow window; one's own view stays", async ({
  page,
}) => {
  await start(page);
  const whole = async (when: string) => expect(touchesEdge(await pixels(page)), when).toBe(false);
  const first = await pixels(page);
  expect(touchesEdge(first)).toBe(false);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  await page.getByRole("tab", { name: "Checks" }).click();
  expect(differing(first, await pixels(page)), "after the assembly").toBeLessThan(50);
  const show = page.getByLabel("Show", { exact: true });
  await show.selectOption("exploded");
  await page.getByLabel("How far apart").fill("1.5");
  await whole("apart");
  await show.selectOption("bed");
  await expect(page.getByLabel("Plate", { exact: true })).toBeVisible({ timeout: 60_000 });
  await page.waitForTimeout(1500);
  await whole("on the bed");
  await shot(page, "2-bed-whole");
  await show.selectOption("assembled");
  for (const [width, height] of [
    [1050, 900],
    [390, 844],
  ] as const) {
    await page.setViewportSize({ width, height });
    if (width < 1000) await page.getByRole("button", { name: "Model" }).click();
    await whole(`${width} wide`);
    await shot(page, `2-${width}`);
  }
  await page.setViewportSize({ width: 1400, height: 900 });
  expect(differing(first, await pixels(page)), "wide again").toBeLessThan(50);
  // A view of one's own is the same after the bed and after the assembly.
  await page.locator("canvas").focus();
  for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "+", "+"]) await page.keyboard.press(key);
  const own = await pixels(page);
  await show.selectOption("bed");
  await expect(page.getByLabel("Plate", { exact: true })).toBeVisible({ timeout: 60_000 });
  await page.waitForTimeout(1500);
  await show.selectOption("assembled");
  expect(differing(own, await pixels(page)), "after the bed").toBeLessThan(50);
  await page.setViewportSize({ width: 1050, height: 900 });
  await page.setViewportSize({ width: 1400, height: 900 });
  expect(differing(own, await pixels(page)), "after another width").toBeLessThan(50);
});
