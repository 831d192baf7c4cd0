// Story 6: diagnose.
import { readFileSync } from "node:fs";
import { expect, shot, start, test } from "./studio.ts";

test("synthetic drops at one click, a diagnosis with stages, its verdict and its files", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Diagnose" }).click();
  await page.getByRole("button", { name: "or try synthetic ones" }).click();
  await expect(page.locator(".diagnose table")).toContainText("20", { timeout: 60_000 });
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
  expect(readFileSync(await (await waiting).path(), "utf8")).toContain("bottoming");
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
