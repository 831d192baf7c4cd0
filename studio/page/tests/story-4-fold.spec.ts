// Story 4: fold.
import { readFileSync } from "node:fs";
import { expect, shot, start, test } from "./studio.ts";

test("the assembly as a motion, with steps, captions and angles; the instructions", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Fold" }).click();
  await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
  await expect(page.locator(".fold h3")).toHaveText("Magnet into the bracket");
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
});
