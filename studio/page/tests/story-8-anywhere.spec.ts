// Story 8: anywhere, and with anything.
import { mkdtempSync, readFileSync, truncateSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { runInNewContext } from "node:vm";
import type { Page } from "@playwright/test";
import { checked, expect, mass, openField, setNumber, settled, shot, start, test } from "./studio.ts";

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

test("what is kept for that is of one version, asked for past the browser's own cache", async ({ page, baseURL }) => {
  const source = await (await page.request.get("./sw.js")).text();
  /** Installs with the files as they are served, one of them as another version has it. */
  const installed = async (other: string | null) => {
    const [kept, modes]: [string[], Set<string>] = [[], new Set()];
    let name = "";
    let install: ((event: object) => void) | undefined;
    const listen = (type: string, on: (event: object) => void) => type === "install" && (install = on);
    const ask = async ({ url, cache }: { url: string; cache: string }) => {
      modes.add(cache);
      const body = await (await page.request.get(url)).body();
      return new Response(url === other ? "another" : new Uint8Array(body));
    };
    runInNewContext(source, {
      self: { addEventListener: listen, registration: { scope: baseURL } },
      caches: {
        open: (opened: string) => {
          name = opened;
          return Promise.resolve({ put: (file: string) => Promise.resolve(void kept.push(file)) });
        },
      },
      Request: class {
        readonly cache: string;
        constructor(
          readonly url: string,
          init: { cache: string },
        ) {
          this.cache = init.cache;
        }
      },
      fetch: ask,
      crypto,
      URL,
    });
    let done: Promise<void> = Promise.resolve();
    install?.({ waitUntil: (work: Promise<void>) => (done = work) });
    const failure = await done.then(
      () => null,
      (error: Error) => error.message,
    );
    return { kept, name, failure, modes: [...modes] };
  };
  const whole = await installed(null);
  expect(whole.failure, baseURL).toBeNull();
  expect(whole.kept).toContain("./");
  expect(whole.kept).toContain("engine/engine.wasm");
  expect(whole.modes).toEqual(["no-cache"]);
  // Another studio of this origin has caches of its own.
  expect(whole.name).toContain(`studio ${baseURL} `);
  for (const other of ["./", "engine/engine.wasm"])
    expect(await installed(other)).toMatchObject({ kept: [], failure: `${other} is not the file of this version` });
});

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
type Violations = { violations: { id: string; impact: string; nodes: { html: string }[] }[] };

async function seriousFaults(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  const { violations } = (await page.evaluate("axe.run()")) as Violations;
  return violations
    .filter(({ id, impact }) => impact === "serious" || impact === "critical" || id.includes("heading"))
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
  // So it is while a value is refused, and in a narrow window.
  await setNumber(page, "rods.arm_rod_length_mm", "4000");
  await page.setViewportSize({ width: 900, height: 900 });
  expect(await seriousFaults(page), "refused, narrow").toEqual([]);
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
  await expect(page.locator("canvas")).toBeFocused();
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  // What is played is seen, and can be stopped there.
  await page.getByRole("button", { name: /^Know/ }).click();
  await page.getByRole("tab", { name: "Fold" }).click();
  await page.getByRole("button", { name: "Play" }).click({ timeout: 60_000 });
  const motion = page.getByRole("group", { name: "The motion" });
  await expect(page.locator("canvas")).toBeVisible();
  await motion.getByRole("button", { name: "Stop" }).click({ timeout: 60_000 });
  await motion.getByRole("button", { name: "Next step" }).click();
  await expect(motion).toContainText(/^Play◀▶\d+: /);
  await shot(page, "8-phone-motion");
  await page.getByLabel("Show", { exact: true }).selectOption("assembled");
  await expect(motion).toHaveCount(0);
  // All switches are there, and the header is of two rows.
  const fit = (await page.getByRole("button", { name: "Fit", exact: true }).boundingBox())!;
  expect(fit.x + fit.width).toBeLessThanOrEqual(390);
  expect((await page.locator(".header").boundingBox())!.height).toBeLessThan(90);
  // A refusal leads to its line.
  await page.getByRole("button", { name: "Change", exact: true }).click();
  await setNumber(page, "rods.arm_rod_length_mm", "4000");
  await page.getByRole("button", { name: "Model" }).click();
  await shot(page, "8-phone-refused");
  const line = page.locator(".refusal .link").first();
  await line.focus();
  await line.press("Enter");
  await expect(page.locator("#toml")).toBeFocused();
  expect(await page.evaluate(() => getSelection()!.toString())).toContain("arm_rod_length_mm");
  // A long name makes nothing wider.
  const name = page.getByLabel("Name of the frame's file");
  await name.fill("a".repeat(64));
  await name.press("Enter");
  await settled(page);
  await page.getByRole("button", { name: /^Know/ }).click();
  await page.getByRole("tab", { name: "Files" }).click();
  expect(await page.locator(".right .scroll").evaluate((panel) => panel.scrollWidth - panel.clientWidth)).toBe(0);
  await shot(page, "8-phone-files");
  await page.setViewportSize({ width: 844, height: 390 });
  await page.getByRole("button", { name: "Model" }).click();
  expect((await page.locator(".picture").boundingBox())!.height).toBeGreaterThan(200);
  await shot(page, "8-phone-side");
});

test("in the system's colours it is seen what is chosen and what was changed", async ({ page }) => {
  await page.emulateMedia({ forcedColors: "active" });
  await start(page);
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  await page.getByRole("button", { name: "Envelope", exact: true }).click();
  const style = (selector: string, name: string) =>
    page
      .locator(selector)
      .first()
      .evaluate((element, name) => getComputedStyle(element).getPropertyValue(name), name);
  expect(await style('.toolbar [aria-pressed="true"]', "background-color")).not.toBe(
    await style('.toolbar [aria-pressed="false"]', "background-color"),
  );
  for (const [one, other] of [
    ['.right [aria-selected="true"]', '.right [aria-selected="false"]'],
    [".field.changed", ".field:not(.changed)"],
  ] as const) {
    const side = one.startsWith(".right") ? "border-bottom-color" : "border-left-color";
    expect(await style(one, side)).not.toBe(await style(other, side));
  }
  expect(await style(".key.kind-printed", "background-color")).toBe("rgb(232, 134, 46)");
  await shot(page, "8-forced");
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
  await page.keyboard.press("End");
  await expect(page.getByRole("tab", { name: "Files" })).toBeFocused();
  await page.keyboard.press("Home");
  await expect(page.getByRole("tab", { name: "Checks" })).toBeFocused();
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

test("one's own frame comes back by undo where a preset took its place before a reload", async ({ page }) => {
  await start(page);
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  await page.getByLabel("Preset").selectOption("cognifly-mini");
  await settled(page);
  await page.reload();
  await expect(page.locator("[data-gauge=size]")).toBeVisible({ timeout: 60_000 });
  await settled(page);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly-mini");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.getByLabel("Preset")).toHaveValue("cognifly");
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("84");
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
  // With the values in it, it is one step, too.
  await page.evaluate(() => (location.hash = "#p=cognifly&n=beta&s=rods.arm_rod_length_mm:85"));
  await settled(page);
  await expect(page.getByLabel("Name of the frame's file")).toHaveValue("beta");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.getByLabel("Name of the frame's file")).toHaveValue("alpha");
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("84");
  await page.getByRole("tab", { name: "Files" }).click();
  await page.getByLabel("Preset").selectOption("cognifly-mini");
  await page.getByRole("button", { name: "Copy the link" }).click();
  await expect(page.getByLabel("Link", { exact: true })).toHaveValue(/#p=cognifly-mini&n=cognifly-mini$/);
});

test("somebody's link takes no place of one's own frame: undo and new tabs give it back", async ({ page, context }) => {
  await start(page);
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  const link = "#p=cognifly-mini&n=friend&s=rods.strut_rod_length_mm:49";
  const other = await context.newPage();
  await start(other, link);
  await expect(other.getByLabel("Preset")).toHaveValue("cognifly-mini");
  // Neither opening it nor reloading it keeps it for other tabs.
  await other.reload();
  await expect(other.locator("[data-gauge=size]")).toBeVisible({ timeout: 60_000 });
  await settled(other);
  await expect(other.getByLabel("Name of the frame's file")).toHaveValue("friend");
  const third = await context.newPage();
  await start(third);
  await expect(await openField(third, "rods.arm_rod_length_mm")).toHaveValue("84");
  const fourth = await context.newPage();
  await start(fourth, link);
  await fourth.getByRole("button", { name: "Undo" }).click();
  await settled(fourth);
  await expect(fourth.getByLabel("Preset")).toHaveValue("cognifly");
  await expect(await openField(fourth, "rods.arm_rod_length_mm")).toHaveValue("84");
  // Changed, it is one's own.
  await setNumber(other, "limits.mass_budget_g", "240");
  const fifth = await context.newPage();
  await start(fifth);
  await expect(fifth.getByLabel("Name of the frame's file")).toHaveValue("friend");
});

test("on paper: the picture, its figures and the checks, on white, without what is to be pressed", async ({ page }) => {
  await start(page);
  await page.getByLabel("Colours of the page").selectOption("dark");
  await checked(page);
  await page.emulateMedia({ media: "print" });
  for (const shown of ["canvas", "[data-gauge=mass]", ".rule"]) await expect(page.locator(shown).first()).toBeVisible();
  for (const hidden of [".toolbar", ".tabs", ".left"]) await expect(page.locator(hidden).first()).toBeHidden();
  expect(await page.evaluate(() => getComputedStyle(document.querySelector(".right")!).backgroundColor)).toBe(
    "rgb(255, 255, 255)",
  );
  await page.emulateMedia({ media: null });
  const drawn = () => page.locator("canvas").evaluate((canvas) => Number((canvas as HTMLElement).dataset["drawn"]));
  const before = await drawn();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  expect(await drawn()).toBeGreaterThan(before);
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
  await expect(page.locator(".notice")).toContainText("With large.csv the drops have 200 MB");
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
