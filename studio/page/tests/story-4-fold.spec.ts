// Story 4: fold.
import { readFileSync } from "node:fs";
import {
  checked,
  differing,
  drawnShare,
  expect,
  litMiddle,
  pixels,
  setNumber,
  shot,
  start,
  test,
  touchesEdge,
} from "./studio.ts";

test("the assembly as a motion, with steps, captions and angles; the instructions", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  // What marks the assembled frame has nothing to act on.
  const marks = ["Envelope", "Centre of mass"].map((name) => page.getByRole("button", { name, exact: true }));
  for (const mark of marks) await expect(mark).toBeDisabled();
  await expect(page.locator(".fold h3")).toHaveText("Magnet into the bracket");
  // The camera looks at what the step shows.
  const small = await pixels(page);
  expect(touchesEdge(small)).toBe(false);
  expect(drawnShare(small)).toBeGreaterThan(0.1);
  await shot(page, "4-first");
  await page.getByRole("button", { name: "Bend the foot and close the triangle" }).click();
  await expect(page.locator(".fold table")).toContainText("113.2°");
  const slider = page.getByLabel("Time of the assembly");
  await slider.fill("56.2");
  await expect(page.getByText("Step 23 of")).toBeVisible();
  await page.waitForTimeout(1000);
  await shot(page, "4-fold");
  await slider.fill("69.0");
  await page.waitForTimeout(800);
  await shot(page, "4-ring");
  await page.getByRole("button", { name: "Play" }).click();
  await expect.poll(async () => Number(await slider.inputValue())).toBeGreaterThan(69.3);
  // Played at its end, it begins again.
  await slider.fill("1000");
  await page.getByRole("button", { name: "Play" }).click();
  await expect(page.getByRole("button", { name: "Stop" })).toBeVisible();
  await expect.poll(async () => Number(await slider.inputValue())).toBeLessThan(60);
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: /instructions/ }).click();
  const file = await waiting;
  expect(file.suggestedFilename()).toBe("cognifly-instructions.pdf");
  expect(
    readFileSync(await file.path())
      .subarray(0, 5)
      .toString(),
  ).toBe("%PDF-");
  await page.getByRole("tab", { name: "Checks" }).click();
  await expect(page.locator(".picked")).toHaveCount(0);
  for (const mark of marks) await expect(mark).toBeEnabled();
  // The assembly goes on where it was, in another frame, too; what is chosen at once is shown.
  await page.getByRole("tab", { name: "Fold" }).click();
  const step = page.locator(".fold .steps button");
  await step.nth(20).click();
  await expect(page.getByText("Step 21 of")).toBeVisible();
  await setNumber(page, "rods.arm_rod_length_mm", "83");
  await expect(page.locator(".fold > .old")).toHaveCount(0, { timeout: 60_000 });
  await expect(page.getByText("Step 21 of")).toBeVisible();
  await page.getByRole("tab", { name: "Checks" }).click();
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 21 of")).toBeVisible();
  await expect.poll(async () => litMiddle(await pixels(page)).count).toBeGreaterThan(60);
});

test("a frame of the screen that began before Play was pressed shows no time before the first step", async ({
  page,
}) => {
  await page.addInitScript(() => {
    const real = window.requestAnimationFrame.bind(window);
    const begun = performance.now();
    // And slowly, so that the first step is seen while it is played.
    window.requestAnimationFrame = (draw) => real((now) => draw(begun + (now - begun) / 20 - 500));
  });
  await start(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  const slider = page.getByLabel("Time of the assembly");
  await slider.fill("1000");
  await page.getByRole("button", { name: "Play" }).click();
  await expect.poll(async () => Number(await slider.inputValue())).toBeLessThan(60);
  await expect(page.getByText("Step 1 of")).toBeVisible();
  await page.getByRole("button", { name: "Stop" }).click();
});

test("the picture follows the steps: it differs between them, and the part that a step names moves", async ({
  page,
}) => {
  await start(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  const slider = page.getByLabel("Time of the assembly");
  const at = async (seconds: number) => {
    await slider.fill(String(seconds));
    return pixels(page);
  };
  const perStep = 2.5;
  // Between steps: each shows more than the one before.
  const pictures = [];
  for (const step of [1, 22, 27, 32, 38]) pictures.push(await at((step - 0.5) * perStep));
  for (let one = 1; one < pictures.length; one++)
    expect(differing(pictures[one - 1]!, pictures[one]!), `between pictures ${one} and ${one + 1}`).toBeGreaterThan(
      2000,
    );
  // Within a step: what it names is lit, and its middle goes elsewhere.
  for (const [step, title] of [
    [26, "Bottom corner onto the lower strut"],
    [27, "Bend the foot and close the triangle"],
    [30, "Plugs of four modules into the hub"],
    [32, "Top ring onto the struts"],
  ] as const) {
    const before = await at((step - 1) * perStep + 0.02);
    await expect(page.locator(".fold h3")).toHaveText(title);
    if (step === 27) await shot(page, "4-before");
    const after = await at(step * perStep - 0.1);
    await expect(page.locator(".fold h3")).toHaveText(title);
    if (step === 27) await shot(page, "4-after");
    const [from, to] = [litMiddle(before), litMiddle(after)];
    expect(Math.min(from.count, to.count), `${title}: pixels of what it names`).toBeGreaterThan(60);
    expect(differing(before, after), `${title}: pixels that change`).toBeGreaterThan(300);
    const way = Math.hypot(to.x - from.x, to.y - from.y);
    expect(way, `${title}: pixels that the middle of what it names goes`).toBeGreaterThan(4);
  }
  // The last step shows the propellers that it puts on.
  const bare = await at(38 * perStep - 0.1);
  const whole = await at(39 * perStep - 0.1);
  await expect(page.locator(".fold h3")).toHaveText("Propellers");
  expect(touchesEdge(whole)).toBe(false);
  expect(drawnShare(whole)).toBeGreaterThan(1.3 * drawnShare(bare));
  await shot(page, "4-propellers");
  // The same time gives the same picture again, and nothing stays lit when the assembly is left.
  expect(differing(pictures[2]!, await at(26.5 * perStep))).toBeLessThan(50);
  await page.getByRole("tab", { name: "Checks" }).click();
  await expect.poll(async () => litMiddle(await pixels(page)).count).toBeLessThan(20);
});

test("what is in the way of a step stands above the steps, with the reason of the command line", async ({ page }) => {
  await start(page);
  await setNumber(page, "corner.notch_half_angle_deg", "30");
  await checked(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  const way = page.locator(".in-the-way");
  await expect(way).toContainText("53.2 deg beyond the closing of their notch");
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  await shot(page, "4-in-the-way");
  await page.getByRole("button", { name: "Undo" }).click();
  await checked(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(way).toHaveCount(0);
});

test("a frame that cannot be folded has no steps, and not those of the frame before", async ({ page }) => {
  await start(page);
  const first = await pixels(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  await setNumber(page, "hub_joint.plug_length_mm", "5");
  await expect(page.locator(".fold .progress .fault")).toContainText("cannot be folded", { timeout: 60_000 });
  await expect(page.getByText("There are no steps to show")).toBeVisible();
  await expect(page.getByText("Step 1 of")).toHaveCount(0);
  await expect(page.getByRole("button", { name: "Envelope", exact: true })).toBeEnabled();
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  await expect(page.getByText("There are no steps to show")).toHaveCount(0);
  await page.getByRole("tab", { name: "Checks" }).click();
  expect(differing(first, await pixels(page))).toBeLessThan(50);
});
