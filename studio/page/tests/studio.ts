// What the stories share: a page that must not ask anybody else for anything, and must not complain.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { test as bare, expect } from "@playwright/test";
import type { Page } from "@playwright/test";

export { expect };

/** The command line that the page has to agree with. */
export const program = resolve(process.env["FLEXFRAME"] ?? "../../target/release/flexframe");

type Peaks = { peak_sensor_g: number; peak_proper_g: number };
/** When the lowest body reaches the ground, in a drop of the frame's own mechanics. */
type Touches = { touches?: { at_ms: number; speed_m_s: number; gap_mm: number } | null };
type Dropped = { mass_kg: number } & Peaks & Touches;

/** The peak that the command line gives for a drop of a frame, g. */
export function peakOfDrop(frame: string, model: string, height: number): number {
  return dropped(frame, model, height).peak_sensor_g;
}

/** What the command line gives for a drop of a frame. */
export function dropped(frame: string, model: string, height: number): Dropped {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  const options = ["drop", frame, "--model", model, "--height", String(height), "--json", "-q", "-o", folder];
  const answer = JSON.parse(execFileSync(program, options, { encoding: "utf8" })) as {
    body?: { mass_kg: number };
    heights: (Peaks & Touches)[];
  };
  return { mass_kg: answer.body?.mass_kg ?? NaN, ...answer.heights[0]! };
}

type Found = { rule: string; verdict: string; margin: number; message: string };

/** The findings of the command line for a frame. */
export function nativeFindings(frame: string, ...options: string[]): Found[] {
  const asked = ["check", frame, "--json", "--no-cache", ...options];
  // A violated limit is an answer, too.
  const { stdout } = spawnSync(program, asked, { encoding: "utf8", maxBuffer: 1 << 28 });
  const answer = JSON.parse(stdout) as { frames: { findings: Found[] }[] };
  return answer.frames[0]!.findings;
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

export type Pixels = { width: number; height: number; rgb: Uint8Array };

/** The drawn picture: red, green and blue of its pixels, row by row. */
export async function pixels(page: Page): Promise<Pixels> {
  // What was asked for is drawn with the next frame.
  await page.waitForTimeout(700);
  const png = await page.locator("canvas").first().screenshot();
  const { width, height, text } = await page.evaluate(async (coded) => {
    const bytes = Uint8Array.from(atob(coded), (one) => one.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d")!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let at = 0; at < data.length; at += 4) text += String.fromCharCode(data[at]!, data[at + 1]!, data[at + 2]!);
    return { width: image.width, height: image.height, text: btoa(text) };
  }, png.toString("base64"));
  return { width, height, rgb: new Uint8Array(Buffer.from(text, "base64")) };
}

/** Whether anything that is drawn reaches the edge of the picture, whose ground is that of its corner; the page's lines may lie on the edge. */
export function touchesEdge({ width, height, rgb }: Pixels): boolean {
  const near = 3;
  const ground = near * (width + 1);
  for (let at = 0; at < rgb.length / 3; at++) {
    const [x, y] = [at % width, Math.floor(at / width)];
    const inside = Math.min(x, y, width - 1 - x, height - 1 - y);
    if (inside === near && [0, 1, 2].some((of) => Math.abs(rgb[3 * at + of]! - rgb[3 * ground + of]!) > 24))
      return true;
  }
  return false;
}

/** The share of a picture that is not its ground. */
export function drawnShare({ width, rgb }: Pixels): number {
  const ground = 3 * (width + 1);
  let count = 0;
  for (let at = 0; at < rgb.length / 3; at++)
    if ([0, 1, 2].some((of) => Math.abs(rgb[3 * at + of]! - rgb[3 * ground + of]!) > 12)) count += 1;
  return (3 * count) / rgb.length;
}

/** How many pixels of two pictures differ. */
export function differing(a: Pixels, b: Pixels): number {
  let count = 0;
  for (let at = 0; at < a.rgb.length; at += 3)
    if ([0, 1, 2].some((of) => Math.abs(a.rgb[at + of]! - b.rgb[at + of]!) > 24)) count += 1;
  return count;
}

/** The middle of what is lit, which alone is blue, and how many pixels it has. */
export function litMiddle({ width, rgb }: Pixels): { x: number; y: number; count: number } {
  let [x, y, count] = [0, 0, 0];
  for (let at = 0; at < rgb.length / 3; at++) {
    const [red, green, blue] = [rgb[3 * at]!, rgb[3 * at + 1]!, rgb[3 * at + 2]!];
    if (blue < red + 50 || blue < green + 30) continue;
    [x, y, count] = [x + (at % width), y + Math.floor(at / width), count + 1];
  }
  return { x: x / count, y: y / count, count };
}

/** Drags files onto an element and lets them go. */
export async function drag(page: Page, onto: string, files: { name: string; text: string }[]): Promise<void> {
  const transfer = await page.evaluateHandle((files) => {
    const made = new DataTransfer();
    for (const { name, text } of files) made.items.add(new File([text], name));
    return made;
  }, files);
  for (const type of ["dragover", "drop"])
    await page.locator(onto).first().dispatchEvent(type, { dataTransfer: transfer });
}

/** Keeps a picture of the page for somebody to look at. */
export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}
