// Story 5: drop.
import { expect, setNumber, shot, start, test } from "./studio.ts";

test("a drop by a model, a higher one, and beside the preset", async ({ page }) => {
  await start(page);
  await setNumber(page, "limits.mass_budget_g", "245");
  await page.getByRole("tab", { name: "Drop" }).click();
  const peak = page.locator("[data-peak]").first();
  await expect(peak).toContainText("83.4 g", { timeout: 60_000 });
  await expect(page.locator(".plot canvas").first()).toBeVisible();
  await page.locator("#drop-height").fill("2");
  await page.locator("#drop-height").press("Enter");
  await expect(peak).not.toContainText("83.4 g");
  await page.getByLabel(/beside it/).check();
  await expect(page.locator("[data-peak]")).toHaveCount(2, { timeout: 60_000 });
  await shot(page, "5-model");
});

test("the frame's own mechanics, with the motion slowed down", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Drop" }).click();
  await page.getByLabel("Model of the drop").selectOption("frame");
  await expect(page.locator("[data-peak]").first()).toContainText("162 g", { timeout: 80_000 });
  await expect(page.locator(".plot")).toHaveCount(2);
  await page.getByRole("button", { name: /Slow motion/ }).click();
  const time = page.getByLabel("Time of the impact");
  await expect(time).toBeVisible();
  await time.fill("0.35");
  await page.waitForTimeout(800);
  await shot(page, "5-mechanics");
});
