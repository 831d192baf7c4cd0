// Story 8: anywhere, and with anything.
import { mkdtempSync, readFileSync, truncateSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "@playwright/test";
import { expect, mass, openField, setNumber, settled, shot, start, test } from "./studio.ts";

test("works without a network after the first visit", async ({ page, context }) => {
  await start(page);
  await page.evaluate(async () => {
    await navigator.serviceWorker.ready;
    while (!navigator.serviceWorker.controller) await new Promise((resolve) => setTimeout(resolve, 100));
  });
  await context.setOffline(true);
  await page.reload();
  await expect(page.locator("canvas")).toHaveAttribute("data-drawn", /\d+/, { timeout: 60_000 });
  await settled(page);
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  await expect(page.getByText("changed (1)")).toBeVisible();
});

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
type Violations = { violations: { id: string; impact: string; nodes: { html: string }[] }[] };

async function seriousFaults(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  const { violations } = (await page.evaluate("axe.run()")) as Violations;
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes[0]?.html.slice(0, 200)}`);
}

test("a screen reader's names, contrast and structure have no serious fault, light and dark", async ({ page }) => {
  test.setTimeout(240_000);
  await start(page);
  for (const scheme of ["light", "dark"] as const) {
    await page.emulateMedia({ colorScheme: scheme, reducedMotion: "reduce" });
    for (const tab of ["Checks", "Compare", "Fold", "Drop", "Diagnose", "Files"]) {
      await page.getByRole("tab", { name: tab }).click();
      await page.waitForTimeout(700);
      expect(await seriousFaults(page), `${scheme}, ${tab}`).toEqual([]);
    }
    await page.getByRole("tab", { name: "Frame file" }).click();
    expect(await seriousFaults(page), `${scheme}, frame file`).toEqual([]);
    await page.getByRole("tab", { name: "Values" }).click();
  }
  await page.getByRole("tab", { name: "Checks" }).click();
  await shot(page, "8-dark");
});

test("on a phone's width", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 800 });
  await start(page);
  await shot(page, "8-phone-model");
  await page.getByRole("button", { name: "Change", exact: true }).click();
  await expect(await openField(page, "rods.arm_rod_length_mm")).toBeVisible();
  await shot(page, "8-phone-change");
  await page.getByRole("button", { name: /^Know/ }).click();
  await expect(page.locator(".rule").first()).toBeVisible();
  await shot(page, "8-phone-know");
  // A finding leads to the picture, which is in another column.
  await page.locator(".rule .head").first().click();
  await page.locator(".place .link").first().click();
  await expect(page.getByRole("button", { name: "Model" })).toHaveAttribute("aria-pressed", "true");
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
});

test("by keyboard alone", async ({ page }) => {
  await start(page);
  const first = await mass(page);
  await page.getByLabel("Search parameters").focus();
  await page.keyboard.type("arm rod length");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  const range = page.locator('[id="p-rods.arm_rod_length_mm-range"]');
  for (let steps = 0; steps < 6 && !(await range.evaluate((element) => element === document.activeElement)); steps++)
    await page.keyboard.press("Tab");
  await expect(range).toBeFocused();
  for (let steps = 0; steps < 3; steps++) await page.keyboard.press("ArrowRight");
  await settled(page);
  expect(await mass(page)).not.toBe(first);
  await page.keyboard.press("Control+z");
  await settled(page);
  await page.getByRole("tab", { name: "Checks" }).focus();
  await page.keyboard.press("ArrowRight");
  await expect(page.getByRole("tab", { name: "Compare" })).toHaveAttribute("aria-selected", "true");
});

test("a reload restores the last state, and two tabs do not disturb each other", async ({ page, context }) => {
  await start(page);
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  const other = await context.newPage();
  await start(other);
  await setNumber(other, "rods.arm_rod_length_mm", "88");
  await page.reload();
  await expect(page.locator("canvas")).toHaveAttribute("data-drawn", /\d+/, { timeout: 60_000 });
  await settled(page);
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("84");
  await expect(await openField(other, "rods.arm_rod_length_mm")).toHaveValue("88");
});

test("a link in the address of the open page is a step, and a link copied at once is of what was chosen last", async ({
  page,
}) => {
  await start(page, "#p=cognifly&n=alpha&s=rods.arm_rod_length_mm:84,limits.mass_budget_g:241");
  await page.evaluate(() => (location.hash = "#p=cognifly-bamboo&n=mine"));
  await settled(page);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly-bamboo");
  expect(new URL(page.url()).hash).toBe("");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly");
  await page.getByRole("tab", { name: "Files" }).click();
  await page.getByLabel("Preset").selectOption("cognifly-mini");
  await page.getByRole("button", { name: "Copy the link" }).click();
  await expect(page.getByLabel("Link", { exact: true })).toHaveValue(/#p=cognifly-mini&n=cognifly-mini$/);
});

test("a corrupt link, hostile text, NaN and a table of 200 MB: a clear message, nothing executed, nothing lost", async ({
  page,
  faults,
}) => {
  page.on("dialog", (dialog) => faults.push(`a dialog: ${dialog.message()}`));
  for (const fragment of [
    "#p=nobody",
    "#p=cognifly&s=garbage",
    "#p=cognifly&s=rods.arm_rod_length_mm:",
    "#p=cognifly&s=__proto__:1",
  ]) {
    await page.goto("about:blank");
    await start(page, fragment);
    await expect(page.locator(".notice")).toContainText("The link cannot be read");
  }
  await page.getByRole("button", { name: "Close" }).click();
  const script = "<img src=x onerror=alert(1)><script>alert(2)</script>";
  await page.getByRole("tab", { name: "Frame file" }).click();
  const texts = [
    `base = ${JSON.stringify(script)}`,
    `base = "cognifly"\n"${script.replaceAll('"', "")}" = 1`,
    `base = "cognifly"\nrods.arm_rod_length_mm = nan`,
    `a = ${"[".repeat(5000)}`,
    "\u0000\u202e" + "x".repeat(200_000),
  ];
  for (const text of texts) {
    await page.locator("#toml").fill(text);
    await expect(page.locator("#toml-refusal .fault")).toBeVisible({ timeout: 40_000 });
    await page.waitForTimeout(500);
  }
  await shot(page, "8-hostile");
  await page.locator("#toml").fill('base = "cognifly"\n');
  await expect(page.locator("#toml-refusal")).toBeEmpty();
  await settled(page);
  const field = await openField(page, "rods.arm_rod_length_mm");
  for (const typed of ["NaN", "1e999", "x"]) {
    await field.fill(typed);
    await field.press("Enter");
  }
  await settled(page);
  await expect(page.locator(".refusal")).toHaveCount(0);
  const table = join(mkdtempSync(join(tmpdir(), "studio-")), "large.csv");
  writeFileSync(table, "");
  truncateSync(table, 200 << 20);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByLabel(/Open measured drops/).setInputFiles(table);
  await expect(page.locator(".notice")).toContainText("large.csv has 210 MB");
});

test("the policy allows nothing but the page itself and WebAssembly", async ({ page, baseURL, faults }) => {
  const asked = await page.goto("./");
  const stated = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content");
  for (const policy of [stated!, (await asked!.allHeaders())["content-security-policy"]!]) {
    const sources = policy.split(";").flatMap((directive) => directive.trim().split(/\s+/).slice(1));
    const allowed = ["'none'", "'self'", "'wasm-unsafe-eval'", "blob:"];
    expect(sources.filter((source) => !allowed.includes(source))).toEqual([]);
    expect(policy).toContain("default-src 'none'");
  }
  await start(page);
  expect(faults).toEqual([]);
  const outcomes = await page.evaluate(async (self) => {
    const refused = (work: () => unknown) =>
      Promise.resolve()
        .then(work)
        .then(
          () => "allowed",
          () => "refused",
        );
    const inline = document.createElement("script");
    inline.textContent = "window.executed = true";
    document.body.append(inline);
    const elsewhere = self.replace("127.0.0.1", "localhost");
    return {
      inline: "executed" in window,
      // What is evaluated from outside may do this, what it leaves for later may not.
      eval: await refused(async () => {
        await new Promise((resolve, reject) =>
          setTimeout(() => {
            try {
              resolve(new Function("1"));
            } catch (error) {
              reject(error as Error);
            }
          }),
        );
      }),
      request: await refused(() => fetch(elsewhere)),
      picture: await refused(() => Object.assign(new Image(), { src: `${elsewhere}icon.svg` }).decode()),
    };
  }, baseURL!);
  expect(outcomes).toEqual({ inline: false, eval: "refused", request: "refused", picture: "refused" });
  // The browser says so on the console.
  expect(faults.splice(0).length).toBeGreaterThan(2);
});
