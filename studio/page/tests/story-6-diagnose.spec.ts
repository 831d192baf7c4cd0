// Story 6: diagnose.
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drag, expect, shot, start, test } from "./studio.ts";

test("synthetic drops at one click, a diagnosis with stages, its verdict and its files", async ({ page }) => {
  test.setTimeout(700_000);
  await start(page);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByRole("button", { name: "or try synthetic ones" }).click();
  await expect(page.locator(".diagnose table")).toContainText("20", { timeout: 60_000 });
  await expect(page.getByLabel("Effects at most")).toHaveValue("3");
  await page.getByLabel("Effects at most").selectOption("1");
  await page.getByRole("button", { name: "Diagnose" }).click();
  await expect(page.locator(".diagnose .progress").last()).toContainText(" of 4)");
  await expect(page.locator("[data-verdict]")).toHaveAttribute("data-verdict", "named", { timeout: 300_000 });
  await expect(page.locator("[data-verdict] h3")).toContainText("bottoming");
  await expect(page.locator("[data-verdict]")).toContainText("Mass 241 g and gap 16 mm of the model paper.");
  await expect(page.locator("[data-verdict]")).toContainText("The same at each height, predicted from the others");
  await expect(page.locator("[data-verdict]")).toContainText(/Refitted: .*k = \d/);
  // What is chosen next is not what was judged.
  await page.getByLabel("Effects at most").selectOption("3");
  await expect(page.locator("[data-verdict]")).toContainText("Of the model paper, with at most 1 effect.");
  await shot(page, "6-verdict");
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: "Download model.toml" }).click();
  const model = readFileSync(await (await waiting).path(), "utf8");
  expect(model).toContain("bottoming");
  // A decimal comma is told, and what was found before is not shown beside the refusal.
  await page.getByLabel("Heights held out, m").fill("1,5,0");
  await page.getByRole("button", { name: "Diagnose", exact: true }).click();
  await expect(page.locator(".diagnose .fault")).toContainText("a comma stands between numbers, a point in them");
  await expect(page.locator("[data-verdict]")).toHaveCount(0);
  await page.getByLabel("Heights held out, m").fill("2");
  await page.getByLabel("Effects at most").selectOption("1");
  await page.getByLabel("Mass and gap of").selectOption("frame");
  await page.getByRole("button", { name: "Diagnose", exact: true }).click();
  await expect(page.locator("[data-verdict]")).toContainText("The same at 2 m, which no fit saw", { timeout: 300_000 });
  await expect(page.locator("[data-verdict]")).toContainText("Mass 233.3 g and gap 11.5 mm of the frame cognifly.");
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
  // One folder after the other; many files are told by their folders.
  await page.getByRole("button", { name: "Close these drops" }).click();
  await expect(page.locator(".diagnose table")).toHaveCount(0);
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  const [head, ...rows] = lines;
  for (const height of ["0.5", "1"]) {
    mkdirSync(join(folder, `${height} m`));
    const own = rows.filter((row) => row.split(",")[1] === height);
    for (let file = 0; file < 6; file++) {
      const named = own.map((row) => `${file} ${row}`);
      writeFileSync(join(folder, `${height} m`, `${file}.csv`), [head, ...named].join("\n"));
    }
    await page.getByLabel("or a folder of them").setInputFiles(join(folder, `${height} m`));
    await expect(page.getByRole("row", { name: new RegExp(`${height} m`) })).toContainText("18", { timeout: 60_000 });
  }
  await expect(page.getByText(/^12 files in 0\.5 m, 1 m$/)).toBeVisible();
  await page.getByRole("button", { name: "Leave out 0.5 m" }).click();
  await expect(page.getByRole("row", { name: /0\.5 m/ })).toHaveCount(0, { timeout: 60_000 });
  await expect(page.getByRole("row", { name: /1 m/ })).toContainText("18");
});
