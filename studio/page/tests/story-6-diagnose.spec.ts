// Story 6: diagnose.
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drag, expect, shot, start, test } from "./studio.ts";

test("synthetic drops at one click, a diagnosis with stages, its verdict and its files", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByRole("button", { name: "or try synthetic ones" }).click();
  await expect(page.locator(".diagnose table")).toContainText("20", { timeout: 60_000 });
  await expect(page.getByLabel("Effects at most")).toHaveValue("3");
  await page.getByLabel("Effects at most").selectOption("1");
  await page.getByRole("button", { name: "Diagnose" }).click();
  await expect(page.locator(".diagnose .progress").last()).toContainText(" of 4)");
  await expect(page.locator("[data-verdict]")).toHaveAttribute("data-verdict", "named", { timeout: 85_000 });
  await expect(page.locator("[data-verdict] h3")).toContainText("bottoming");
  // What is chosen next is not what was judged.
  await page.getByLabel("Effects at most").selectOption("3");
  await expect(page.locator("[data-verdict]")).toContainText("Of the model paper, with at most 1 effect.");
  await shot(page, "6-verdict");
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: "Download model.toml" }).click();
  const model = readFileSync(await (await waiting).path(), "utf8");
  expect(model).toContain("bottoming");
  // It is no frame.
  await drag(page, "canvas", [{ name: "model.toml", text: model }]);
  await expect(page.locator(".notice")).toContainText("model.toml is an impact model and no frame file");
  await expect(page.locator(".refusal")).toHaveCount(0);
});

test("a diagnosis can be cancelled, and files that are no drops are refused in words", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByRole("button", { name: "or try synthetic ones" }).click();
  await page.getByRole("button", { name: "Diagnose" }).click();
  await page.getByRole("button", { name: "Cancel" }).click();
  await expect(page.getByText("The diagnosis was cancelled.")).toBeVisible();
  const open = page.getByLabel(/Open measured drops/);
  await open.setInputFiles({
    name: "<script>alert(1)</script>.csv",
    mimeType: "text/csv",
    buffer: Buffer.from("trial,height_m,t_s,accel_g\na,1,0,NaN\n"),
  });
  await expect(page.locator(".diagnose .fault").first()).toContainText("<script>", { timeout: 30_000 });
  await shot(page, "6-refused");
});

test("a table of another logger is read by what is said of its columns and units", async ({ page }) => {
  const lines = ["name,h,Time,Acc_Z"];
  for (const [height, name] of [0.5, 1].flatMap((h) => [0, 1, 2].map((i) => [h, `${h}m ${i}`] as const))) {
    const peak = 900 * Math.sqrt(height);
    for (let ms = 0; ms < 700; ms += 1) {
      const at = ms - 500;
      const read = at >= 0 && at < 12 ? peak * Math.sin((Math.PI * at) / 12) : 0.2 * Math.sin(7 * ms + height);
      lines.push(`${name},${height},${ms},${(-read).toFixed(3)}`);
    }
  }
  await start(page);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByLabel(/Open measured drops/).setInputFiles({
    name: "logger.csv",
    mimeType: "text/csv",
    buffer: Buffer.from(lines.join("\n")),
  });
  await expect(page.locator(".diagnose .fault").first()).toContainText("--columns", { timeout: 30_000 });
  await page.getByLabel("Columns").fill("trial=name,h=h,t=Time,a=-Acc_Z");
  await page.getByLabel("Units").fill("ms,m/s2");
  await page.getByLabel("Samples a second").fill("fast");
  await page.getByLabel("Samples a second").press("Enter");
  await expect(page.locator(".diagnose .fault").first()).toContainText("fast is no list of numbers");
  await page.getByLabel("Samples a second").fill("");
  await page.getByLabel("Samples a second").press("Enter");
  await expect(page.getByRole("row", { name: /0.5 m/ })).toContainText("3", { timeout: 30_000 });
  await expect(page.getByRole("row", { name: /0.5 m/ })).toContainText(/6[0-9](\.\d)? g/);
  await shot(page, "6-another-logger");
  // Many files are told by their folders.
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  for (let file = 0; file < 12; file++) {
    mkdirSync(join(folder, `${file % 2} m`), { recursive: true });
    writeFileSync(join(folder, `${file % 2} m`, `${file}.csv`), lines.join("\n"));
  }
  await page.getByLabel("or a folder of them").setInputFiles(folder);
  await expect(page.getByText(/^12 files in .*\/0 m, .*\/1 m$/)).toBeVisible({ timeout: 60_000 });
});
