// What the stories share: a page that must not ask anybody else for anything, and must not complain.
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { test as bare, expect } from "@playwright/test";
import type { Page } from "@playwright/test";

export { expect };

/** The command line that the page has to agree with. */
export const program = resolve(process.env["FLEXFRAME"] ?? "../../target/release/flexframe");

/** The peak that the command line gives for a drop of a frame, g. */
export function peakOfDrop(frame: string, model: string, height: number): number {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  const options = ["drop", frame, "--model", model, "--height", String(height), "--json", "-q", "-o", folder];
  const answer = JSON.parse(execFileSync(program, options, { encoding: "utf8" })) as {
    heights: { peak_sensor_g: number }[];
  };
  return answer.heights[0]!.peak_sensor_g;
}

const shots = join(process.env["STUDIO_WORK"] ?? "test-results", "..", "studio-pictures");

/** A page on which a request to elsewhere, a violation of the policy or an error on the console is a failure. */
export const test = bare.extend<{ faults: string[] }>({
  faults: [
    async ({ page, baseURL }, use) => {
      const faults: string[] = [];
      page.on("request", (request) => {
        const url = request.url();
        if (!url.startsWith(baseURL ?? "") && !url.startsWith("blob:")) faults.push(`asks ${url}`);
      });
      page.on("console", (message) => {
        // Software drawing is slow, and the driver says so.
        if (message.type() === "error" && !message.text().includes("GPU stall")) faults.push(message.text());
      });
      page.on("pageerror", (error) => faults.push(error.message));
      await use(faults);
      expect(faults).toEqual([]);
    },
    { auto: true },
  ],
});

/** Waits until the picture is that of what was last asked for. */
export async function settled(page: Page): Promise<void> {
  await expect(page.locator("[data-computing]")).toHaveAttribute("data-computing", "false", { timeout: 60_000 });
}

/** Waits until all checks are those of the picture. */
export async function checked(page: Page): Promise<void> {
  await settled(page);
  await page.getByRole("tab", { name: "Checks" }).click();
  await expect(page.locator("[data-state]")).toHaveAttribute("data-state", "all", { timeout: 60_000 });
}

export async function start(page: Page, fragment = ""): Promise<void> {
  await page.goto(`./${fragment}`);
  await expect(page.locator("canvas")).toHaveAttribute("data-drawn", /\d+/, { timeout: 60_000 });
  await settled(page);
  // Before the first frame is asked for, nothing is being computed either.
  await expect(page.locator("[data-gauge=size]")).toBeVisible({ timeout: 60_000 });
  await settled(page);
}

/** Sets a number as a person does: the group is opened, the field filled. */
export async function setNumber(page: Page, key: string, value: string): Promise<void> {
  const field = await openField(page, key);
  await field.fill(value);
  await field.press("Enter");
  await settled(page);
}

export async function openField(page: Page, key: string) {
  await page.getByRole("tab", { name: "Values" }).click();
  const field = page.locator(`[id="p-${key}"]`);
  if (!(await field.isVisible())) await page.locator(`details[data-table="${key.split(".")[0]}"] > summary`).click();
  return field;
}

export async function mass(page: Page): Promise<number> {
  return Number.parseFloat((await page.locator("[data-gauge=mass] b").innerText()).replace(" g", ""));
}

/** Keeps a picture of the page for somebody to look at. */
export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}
