// The engine as the page depends on it: it is replaced when it fails, and its memory does not grow with the changes.
import { readFileSync } from "node:fs";
import type { Browser } from "@playwright/test";
import { checked, expect, mass, openField, setNumber, settled, shot, start, test } from "./studio.ts";

test.describe("an engine that fails", () => {
  // A service worker would hand out the script of the worker that the test changes.
  test.use({ serviceWorkers: "block" });

  /** The value at which the changed engine fails as a panic does: WebAssembly's `unreachable`. */
  const FATAL = "arm_rod_length_mm = 84.5";
  /** The value at which the one that checks fails when all checks are asked for. */
  const UNCHECKED = "arm_rod_length_mm = 84.25";
  const TRAP = `
    // (module (func (export "trap") unreachable))
    const bytes = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 7, 8, 1, 4, 116, 114, 97, 112, 0, 0, 10, 5, 1, 3, 0, 0, 11];
    const trap = () => new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(bytes))).exports.trap();
    const instantiate = WebAssembly.instantiate;
    WebAssembly.instantiate = async (module, imports) => {
      const { exports } = await instantiate(module, imports);
      let room = 0;
      let frame = "";
      return { exports: {
        ...exports,
        request_room: (length) => (room = exports.request_room(length)),
        ask: (length) => {
          const asked = new TextDecoder().decode(new Uint8Array(exports.memory.buffer, room >>> 0, length + 400));
          if (asked.includes('"do":"open"') || asked.includes('"do":"change"')) {
            frame = asked;
            if (asked.includes(${JSON.stringify(FATAL)})) trap();
          }
          const checksAll = self.name === "checker" && asked.includes('"do":"findings"');
          if (checksAll && frame.includes(${JSON.stringify(UNCHECKED)})) trap();
          return exports.ask(length);
        },
      } };
    };
  `;

  test("is replaced: the page says so, the picture stays, and the next change is right", async ({ page, faults }) => {
    await page.route("**/assets/worker-*.js", async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: `${TRAP}\n${await response.text()}` });
    });
    await start(page);
    const first = await mass(page);
    await setNumber(page, "rods.arm_rod_length_mm", "84.5");
    await expect(page.locator(".notice")).toContainText("The engine stopped and was started again");
    expect(await mass(page)).toBe(first);
    await expect(page.locator("canvas")).toHaveAttribute("data-drawn", /\d+/);
    // What is shown is of another frame than the file, and no files are made of it.
    await expect(page.locator(".refusal")).toContainText("the engine stopped at this frame");
    await expect(page.locator(".last-good")).toBeVisible();
    await shot(page, "9-stopped");
    // Changes of one value within 0.9 s are one step of undo; these are two steps, however quick the engine is.
    await page.waitForTimeout(1000);
    await setNumber(page, "rods.arm_rod_length_mm", "90");
    const changed = await mass(page);
    expect(changed).not.toBe(first);
    // What was said of the change before goes with the next one.
    await checked(page);
    await expect(page.locator(".notice")).toHaveCount(0);
    await page.getByRole("button", { name: "Undo" }).click();
    await expect(page.locator(".notice")).toContainText("The engine stopped and was started again");
    await page.getByRole("button", { name: "Close" }).click();
    await expect(page.locator(".notice")).toHaveCount(0);
    await page.getByRole("button", { name: "Undo" }).click();
    await settled(page);
    expect(await mass(page)).toBe(first);
    expect(faults).toEqual([]);
  });

  test("leaves quick checks where it fails in the others, and says so", async ({ page, faults }) => {
    await page.route("**/assets/worker-*.js", async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: `${TRAP}\n${await response.text()}` });
    });
    await start(page);
    await checked(page);
    await setNumber(page, "rods.arm_rod_length_mm", "84.25");
    await page.getByRole("tab", { name: "Checks" }).click();
    await expect(page.locator(".checks .state")).toContainText("the others failed");
    await expect(page.locator("[data-state]")).toHaveAttribute("data-state", "some");
    await page.getByRole("button", { name: "Check again" }).click();
    await expect(page.locator(".checks .state")).toContainText("the others failed");
    await setNumber(page, "rods.arm_rod_length_mm", "90");
    await checked(page);
    await expect(page.getByRole("button", { name: "Check again" })).toHaveCount(0);
    expect(faults).toEqual([]);
  });

  test("is asked for again where a server takes the request and never answers", async ({ page }) => {
    let asked = 0;
    await page.route("**/engine.wasm", async (route) => {
      asked += 1;
      if (asked > 1) await route.continue();
    });
    await start(page);
    expect(asked).toBe(2);
    await expect(page.locator(".notice")).toHaveCount(0);
  });
});

/** Resident memory of the page's process, with its workers, MB. */
async function residentMb(browser: Browser): Promise<number> {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  const sizes = processInfo
    .filter(({ type }) => type === "renderer")
    .map(({ id }) => Number(/VmRSS:\s+(\d+) kB/.exec(readFileSync(`/proc/${id}/status`, "utf8"))?.[1] ?? 0) / 1024);
  return Math.max(...sizes);
}

/** Most memory of the page's process, MB. */
const MOST_MB = 500;
/** Changes after which what is kept for later ones is there: code, results of steps, the second engine's frame. */
const WARM = 10;

test("memory stays bounded while values change", async ({ page, browser }) => {
  // 1000 changes are the claim; a run of all tests makes fewer, and prints what each of them adds.
  const changes = Number(process.env["STUDIO_CHANGES"] ?? 30);
  test.setTimeout(60_000 + 3_000 * changes);
  await start(page);
  // One part is made anew at each change, and with it the picture, the masses and the quick checks.
  await openField(page, "motor_mount.motor_skirt_wall_mm");
  await page.locator('[id="p-motor_mount.motor_skirt_wall_mm-range"]').focus();
  const change = async (count: number) => {
    for (let at = 0; at < count; at++) {
      await page.keyboard.press(at % 20 < 10 ? "ArrowRight" : "ArrowLeft");
      await settled(page);
    }
  };
  await change(WARM);
  const before = await residentMb(browser);
  await change(changes - WARM);
  const after = await residentMb(browser);
  const each = Math.max(0, after - before) / (changes - WARM);
  console.log(
    `studio: ${before.toFixed(0)} MB after ${WARM} changes, ${after.toFixed(0)} MB after ${changes}: ${each.toFixed(2)} MB a change`,
  );
  expect(after).toBeLessThan(MOST_MB);
  expect(await page.evaluate(() => performance.getEntriesByName("change").length)).toBeGreaterThan(changes / 2);
});
