// Story 3: know.
import {
  checked,
  differing,
  expect,
  litMiddle,
  nativeFindings,
  pixels,
  setNumber,
  settled,
  shot,
  start,
  test,
} from "./studio.ts";

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
  await expect(page.locator("[data-gauge=size]")).toHaveClass(/over/);
  await expect(page.locator("[data-gauge=size] svg")).toHaveAttribute("aria-label", /width \d.* mm of 210 mm/);
  await place.getByRole("button").first().click();
  await page.waitForTimeout(600);
  await shot(page, "3-place");
  await page.locator('[data-rule="envelope"] .levers button').first().click();
  await expect(page.locator('[id="p-rods.cage_rod_length_mm"]')).toBeFocused();
  await setNumber(page, "rods.cage_rod_length_mm", "190");
  await checked(page);
  await expect(page.locator('[data-rule="envelope"]')).not.toHaveClass(/violated/);
});

test("notes are warnings beyond their figure only, as on the command line", async ({ page }) => {
  await start(page);
  await checked(page);
  const warned = nativeFindings("cognifly").filter(({ verdict, margin }) => verdict === "note" && margin < 0);
  const rules = [...new Set(warned.map(({ rule }) => rule))].sort();
  const marked = await page
    .locator(".rule.warns")
    .evaluateAll((shown) => shown.map((one) => one.getAttribute("data-rule")!));
  expect(marked.sort()).toEqual(rules);
  await expect(page.locator('[data-rule="envelope"]')).toHaveClass(/holds/);
  // What no body is named after leads to the box of the limits, or to what its values drive.
  const envelope = page.locator('[data-rule="envelope"]');
  await envelope.locator(".head").click();
  await envelope.getByRole("button", { name: "height without propellers" }).click();
  await expect(page.getByRole("button", { name: "Envelope", exact: true })).toHaveAttribute("aria-pressed", "true");
  await page.getByRole("button", { name: "Envelope", exact: true }).click();
  const strain = page.locator('[data-rule="hinge_strain"]');
  await strain.locator(".head").click();
  await strain.getByRole("button", { name: "corner notch" }).first().click();
  await expect.poll(async () => litMiddle(await pixels(page)).count).toBeGreaterThan(60);
});

test("strength is computed on demand, with the findings of the command line, and again after a change", async ({
  page,
}) => {
  await start(page);
  await checked(page);
  const rule = page.locator('[data-rule="design_drop"]');
  await expect(rule).toHaveCount(0);
  const strength = page.locator("[data-strength]");
  await expect(strength).toHaveAttribute("data-strength", "off");
  const shown = async () => {
    await expect(strength).toHaveAttribute("data-strength", "done", { timeout: 60_000 });
    const head = rule.getByRole("button", { expanded: false }).first();
    if (await head.isVisible()) await head.click();
    return (await rule.locator(".place > p:not(.levers)").allInnerTexts()).sort();
  };
  await page.getByLabel("strength, too").check();
  await expect(strength).toHaveAttribute("data-strength", "computing");
  await expect(strength).toContainText("computing…");
  const native = nativeFindings("cognifly", "--strength").filter(({ rule }) => rule === "design_drop");
  expect(native.length).toBeGreaterThan(2);
  expect(await shown()).toEqual(native.map(({ message }) => message).sort());
  await rule.scrollIntoViewIfNeeded();
  await shot(page, "3-strength");
  const before = await shown();
  await setNumber(page, "rods.strut_rod_length_mm", "54");
  await expect(strength).toHaveAttribute("data-strength", "computing");
  await expect(rule).toHaveCount(0);
  expect(await shown()).not.toEqual(before);
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
  // The other frame goes and comes with its tick, also after the comparison.
  const through = page.getByLabel(/show it through the model/);
  const shown = await pixels(page);
  await through.uncheck();
  const alone = await pixels(page);
  expect(differing(shown, alone)).toBeGreaterThan(200);
  await through.check();
  await expect.poll(async () => differing(await pixels(page), alone), { timeout: 30_000 }).toBeGreaterThan(200);
  await page.getByRole("button", { name: "Pin this variant" }).click();
  // What was compared before is not what the heading says.
  await expect(page.locator(".compare")).toContainText("Nothing differs from my-cognifly yet.", { timeout: 60_000 });
  await setNumber(page, "rods.strut_rod_length_mm", "54");
  await page.getByRole("tab", { name: "Compare" }).click();
  await expect(measure).toHaveClass(/better/, { timeout: 60_000 });
});

test("a lever leads to its field, even where a search left it out", async ({ page }) => {
  await start(page);
  await setNumber(page, "limits.mass_budget_g", "200");
  await checked(page);
  await page.getByLabel("Search parameters").fill("hinge");
  await page.locator(".levers .link").first().click();
  await expect(page.getByLabel("Search parameters")).toHaveValue("");
  await expect(page.locator(".parameters [data-key] :focus")).toHaveCount(1);
});

test("a lever that follows a bought part leads to that part", async ({ page }) => {
  await start(page, "#p=cognifly&n=wide&s=bought.propeller:propeller-4-inch");
  await checked(page);
  const rule = page.locator('[data-rule="propeller_clearance"]');
  await expect(rule.locator(".levers").first()).toContainText("Propeller");
  await expect(rule.locator(".levers").first()).not.toContainText("Propeller diameter");
  await rule.locator(".levers button").first().click();
  await expect(page.locator('[id="c-bought.propeller"]')).toBeFocused();
});
