// Story 2: see.
import type { Page } from "@playwright/test";
import {
  checked,
  differing,
  drawnShare,
  expect,
  openField,
  pixels,
  setNumber,
  settled,
  shot,
  start,
  test,
  touchesEdge,
} from "./studio.ts";

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
  await expect(page.getByLabel("Section", { exact: true })).toBeDisabled();
  await expect(page.getByRole("button", { name: "Distance" })).toBeDisabled();
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
  // The same without pointing at it.
  await page.getByLabel("Part", { exact: true }).selectOption("knee_FR");
  await expect(page.locator(".picked")).toContainText("knee_FR");
  await page.getByLabel("Part", { exact: true }).selectOption("");
  await expect(page.locator(".picked")).toHaveCount(0);
  await (await openField(page, "motor_mount.motor_skirt_wall_mm")).focus();
  await page.waitForTimeout(500);
  await shot(page, "2-lit");
  await page.getByLabel("Section", { exact: true }).selectOption("z");
  // What is cut shows its inner faces: the rods of the arms lie halfway below the level.
  const cut = await pixels(page);
  expect(drawnShare(cut)).toBeGreaterThan(0.03);
  await shot(page, "2-section-level");
  await page.getByLabel("Section", { exact: true }).selectOption("y");
  await page.waitForTimeout(500);
  await shot(page, "2-section");
  // Moved to the rear end, which lies farther out than the top: across the height it ends there.
  const slider = page.getByLabel("Where the section is, mm");
  await slider.press("End");
  const rear = Number(await slider.inputValue());
  await page.getByLabel("Section", { exact: true }).selectOption("z");
  const top = Number(await slider.getAttribute("max"));
  expect(rear).toBeGreaterThan(top);
  await expect(slider.locator("..")).toContainText(`${top} mm`);
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
  // At the pole the picture stays as it is, and does not turn over.
  for (let turns = 0; turns < 30; turns++) await page.keyboard.press("ArrowUp");
  const above = await pixels(page);
  for (let turns = 0; turns < 3; turns++) await page.keyboard.press("ArrowUp");
  expect(differing(above, await pixels(page))).toBeLessThan(50);
  await page.reload();
  await start(page);
  await canvas.focus();
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

test("bed and assembly end where the other begins, and a changed frame is drawn on the bed", async ({ page }) => {
  await start(page);
  const first = await pixels(page);
  const show = page.getByLabel("Show", { exact: true });
  const fold = async () => {
    await page.getByRole("tab", { name: "Fold" }).click();
    await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
    await page.waitForTimeout(1000);
  };
  await fold();
  await show.selectOption("bed");
  await expect(page.getByLabel("Plate", { exact: true })).toBeVisible({ timeout: 60_000 });
  const bed = await pixels(page);
  await page.getByRole("tab", { name: "Checks" }).click();
  await expect(show).toHaveValue("bed");
  expect(differing(bed, await pixels(page)), "the bed without the assembly").toBeLessThan(50);
  await setNumber(page, "hub.hub_mouth_mm", "30");
  await expect.poll(async () => differing(bed, await pixels(page)), "a changed hub").toBeGreaterThan(50);
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await fold();
  await expect(show).toHaveValue("motion");
  const slider = page.getByLabel("Time of the assembly");
  await slider.fill("56.2");
  const early = await pixels(page);
  await slider.fill("69");
  expect(differing(early, await pixels(page)), "two steps after the bed").toBeGreaterThan(2000);
  await page.getByRole("tab", { name: "Checks" }).click();
  expect(differing(first, await pixels(page)), "the frame after all").toBeLessThan(50);
});

test("the size is that of the frame in its place, also while it is shown apart", async ({ page }) => {
  await start(page);
  const size = page.locator("[data-gauge=size] b");
  const first = await size.innerText();
  await page.getByLabel("Show", { exact: true }).selectOption("exploded");
  await setNumber(page, "limits.mass_budget_g", "245");
  await expect(page.locator("[data-gauge=mass]")).toContainText("of 245 g");
  await page.waitForTimeout(1000);
  await expect(size).toHaveText(first);
});

test("parts of another flexible material have the colour of flexible parts", async ({ page }) => {
  await start(page);
  const orange = async () => {
    const { rgb } = await pixels(page);
    let count = 0;
    for (let at = 0; at < rgb.length; at += 3)
      if (rgb[at]! > rgb[at + 2]! + 60 && rgb[at]! > rgb[at + 1]! + 20) count += 1;
    return count;
  };
  const before = await orange();
  expect(before).toBeGreaterThan(300);
  await page.getByText("Bought parts, materials, printer, sleeve").click();
  await page.locator('[id="c-materials.flexible"]').selectOption("tpu-85a");
  await settled(page);
  expect(await orange()).toBeGreaterThan(before / 2);
});

test("the picture is there again after the graphics card was lost, and frees what is gone", async ({ page }) => {
  await page.addInitScript(() => {
    const held = { buffers: 0, textures: 0 };
    const gl = WebGL2RenderingContext.prototype;
    const count = (name: "createBuffer" | "deleteBuffer" | "createTexture" | "deleteTexture") => {
      const own = gl[name] as (...given: unknown[]) => unknown;
      const [of, by] = [name.endsWith("Buffer") ? "buffers" : "textures", name.startsWith("create") ? 1 : -1] as const;
      Object.assign(gl, {
        [name]: function (this: unknown, ...given: unknown[]) {
          held[of] += by;
          return own.apply(this, given);
        },
      });
    };
    for (const name of ["createBuffer", "deleteBuffer", "createTexture", "deleteTexture"] as const) count(name);
    Object.assign(window, { held });
  });
  await start(page);
  const held = () => page.evaluate(() => ({ ...(window as unknown as { held: Record<string, number> }).held }));
  await page.getByRole("button", { name: "Envelope", exact: true }).click();
  await page.getByRole("button", { name: "Centre of mass", exact: true }).click();
  await openField(page, "rods.arm_rod_length_mm");
  const fold = async () => {
    await page.getByRole("tab", { name: "Fold" }).click();
    await expect(page.getByText("Step 1 of")).toBeVisible({ timeout: 60_000 });
    await page.waitForTimeout(1500);
    for (let times = 0; times < 5; times++) {
      await page.locator('[data-key="rods.arm_rod_length_mm"]').hover();
      await page.waitForTimeout(60);
      await page.locator("h1").hover();
      await page.waitForTimeout(60);
    }
    await page.getByRole("tab", { name: "Checks" }).click();
    await page.waitForTimeout(1000);
  };
  await fold();
  const once = await held();
  for (let times = 0; times < 2; times++) await fold();
  expect(await held()).toEqual(once);
  await checked(page);
  const first = await pixels(page);
  await page.evaluate(async () => {
    const lose = document.querySelector("canvas")!.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
    lose.loseContext();
    await new Promise((resolve) => setTimeout(resolve, 300));
    lose.restoreContext();
  });
  await page.waitForTimeout(1000);
  expect(differing(first, await pixels(page))).toBeLessThan(50);
});
