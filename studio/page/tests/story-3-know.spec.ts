// Story 3: know.
import { checked, expect, setNumber, settled, shot, start, test } from "./studio.ts";

test("every rule, violated first, with margins; a click goes to the place and to the parameters", async ({ page }) => {
  await start(page);
  await page.getByLabel("Preset").selectOption("cognifly-v8");
  await settled(page);
  await checked(page);
  const rules = page.locator(".rule");
  await expect(rules.first()).toHaveClass(/violated/);
  expect(await rules.count()).toBeGreaterThan(15);
  await expect(page.locator("[data-state]")).toContainText("violated");
  await shot(page, "3-checks");
  const place = page.locator('[data-rule="propeller_clearance"] .place.violated').first();
  await place.getByRole("button").first().click();
  await page.waitForTimeout(600);
  await shot(page, "3-place");
  await page.locator('[data-rule="envelope"] .levers button').first().click();
  await expect(page.locator('[id="p-rods.cage_rod_length_mm"]')).toBeFocused();
  await setNumber(page, "rods.cage_rod_length_mm", "190");
  await checked(page);
  await expect(page.locator('[data-rule="envelope"]')).not.toHaveClass(/violated/);
});

test("before and after, against the preset and a pinned variant", async ({ page }) => {
  await start(page);
  await setNumber(page, "rods.strut_rod_length_mm", "56");
  await page.getByRole("tab", { name: "Compare" }).click();
  await page.getByLabel(/show it through the model/).check();
  const measure = page.locator('[data-name="envelope.height"]');
  await expect(measure).toHaveClass(/worse/, { timeout: 60_000 });
  await expect(page.locator(".compare [data-state]")).toHaveAttribute("data-state", "done", { timeout: 60_000 });
  await page.waitForTimeout(500);
  await shot(page, "3-compare");
  await page.getByRole("button", { name: "Pin this variant" }).click();
  await setNumber(page, "rods.strut_rod_length_mm", "54");
  await page.getByRole("tab", { name: "Compare" }).click();
  await expect(measure).toHaveClass(/better/, { timeout: 60_000 });
});
