// Story 1: choose and change.
import { readFileSync } from "node:fs";
import { checked, expect, mass, openField, setNumber, settled, shot, start, test } from "./studio.ts";

test("a preset is chosen, values change the frame, and each can be reset", async ({ page }) => {
  await start(page);
  await shot(page, "1-first");
  const first = await mass(page);
  await page.getByLabel("Preset").selectOption("cognifly-mini");
  await settled(page);
  await expect(page.locator("[data-gauge=mass] b")).not.toHaveText(`${first} g`);
  await page.getByLabel("Preset").selectOption("cognifly");
  await settled(page);
  expect(await mass(page)).toBe(first);
  await setNumber(page, "rods.arm_rod_length_mm", "90");
  await expect(page.locator("[data-gauge=mass] b")).not.toHaveText(`${first} g`);
  const field = page.locator('[data-key="rods.arm_rod_length_mm"]');
  await expect(field).toHaveClass(/changed/);
  await expect(page.getByText("changed (1)")).toBeVisible();
  await page.getByLabel("Bought parts, materials, printer, sleeve").isVisible();
  await page.getByText("Bought parts, materials, printer, sleeve").click();
  const battery = page.locator('[id="c-bought.battery"]');
  await expect(battery.locator("option").first()).toContainText(/mm.*g/);
  await battery.selectOption("battery-2s-850");
  await settled(page);
  await expect(page.getByText("changed (2)", { exact: false })).toBeVisible();
  await shot(page, "1-changed");
  await field.getByRole("button", { name: /Reset/ }).click();
  await expect(field.locator("input[type=text]")).toBeFocused();
  await settled(page);
  await expect(field).not.toHaveClass(/changed/);
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("90");
  for (let steps = 0; steps < 2; steps++) {
    await page.getByRole("button", { name: "Undo" }).click();
    await settled(page);
  }
  expect(await mass(page)).toBe(first);
  await page.getByRole("button", { name: "Redo" }).click();
  await settled(page);
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("90");
  // A name that was taken is a step, too; its field is then that of the frame.
  const name = page.getByLabel("Name of the frame's file");
  const former = await name.inputValue();
  await name.fill("first");
  await name.press("Enter");
  await name.press("Control+z");
  await expect(name).toHaveValue(former);
  await expect(page).toHaveTitle(new RegExp(`^${former} `));
  // What no frame can be without is not offered, and an own part stays in its list.
  await expect(battery.locator('option[value="none"]')).toHaveCount(0);
  await expect(page.locator('[id="c-bought.camera"] option[value="none"]')).toHaveCount(1);
});

test("a value, a name and a file that is asked for while another value is computed lose nothing", async ({ page }) => {
  await start(page);
  const [arm, strut] = [
    await openField(page, "rods.arm_rod_length_mm"),
    await openField(page, "rods.strut_rod_length_mm"),
  ];
  const name = page.getByLabel("Name of the frame's file");
  await page.getByRole("tab", { name: "Files" }).click();
  for (const [field, value] of [
    [arm, "80"],
    [strut, "48"],
    [name, "late"],
  ] as const) {
    await field.fill(value);
    await field.press("Enter");
  }
  await expect(name).toHaveValue("late");
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: /^Frame file/ }).click();
  const file = await waiting;
  expect(file.suggestedFilename()).toBe("late.toml");
  const text = readFileSync(await file.path(), "utf8");
  expect(text).toContain("arm_rod_length_mm = 80");
  expect(text).toContain("strut_rod_length_mm = 48");
  await settled(page);
  await expect(name).toHaveValue("late");
  await expect(strut).toHaveValue("48");
  // Each is a step of its own, also those that waited together.
  const undo = page.getByRole("button", { name: "Undo" });
  const steps = [
    ["my-cognifly", "80", "48"],
    ["my-cognifly", "80", "50.03"],
    ["cognifly", "82", "50.03"],
  ] as const;
  for (const [called, armLength, strutLength] of steps) {
    await undo.click();
    await settled(page);
    await expect(name).toHaveValue(called);
    await page.getByRole("tab", { name: "Values" }).click();
    await expect(arm).toHaveValue(armLength);
    await expect(strut).toHaveValue(strutLength);
  }
  await expect(undo).toBeDisabled();
});

test("presets chosen one right after the other are steps of their own; quick changes of a value are one", async ({
  page,
}) => {
  await start(page);
  const first = await mass(page);
  // As if everything after this took no time.
  await page.evaluate(() => {
    const moment = performance.now();
    performance.now = () => moment;
  });
  const preset = page.getByLabel("Preset");
  const undo = page.getByRole("button", { name: "Undo" });
  for (const name of ["cognifly-mini", "cognifly"]) {
    await preset.selectOption(name);
    await settled(page);
  }
  await undo.click();
  await settled(page);
  await expect(preset).toHaveValue("cognifly-mini");
  await undo.click();
  await settled(page);
  expect(await mass(page)).toBe(first);
  await expect(undo).toBeDisabled();
  for (const length of ["90", "91", "92"]) await setNumber(page, "rods.arm_rod_length_mm", length);
  await undo.click();
  await settled(page);
  expect(await mass(page)).toBe(first);
  await expect(undo).toBeDisabled();
  // A value that is set and at once set back leaves no step.
  await setNumber(page, "rods.arm_rod_length_mm", "90");
  const strut = await (await openField(page, "rods.strut_rod_length_mm")).inputValue();
  for (const length of ["51", strut]) await setNumber(page, "rods.strut_rod_length_mm", length);
  await undo.click();
  await settled(page);
  expect(await mass(page)).toBe(first);
  await expect(undo).toBeDisabled();
});

test("parameters are found by words, and what differs is listed", async ({ page }) => {
  await start(page);
  await page.getByLabel("Search parameters").fill("hinge thickness");
  await expect(page.locator('[data-key="corner.corner_hinge_thickness_mm"]')).toBeVisible();
  await expect(page.locator('[data-key="rods.arm_rod_length_mm"]')).toHaveCount(0);
  await page.getByLabel("Search parameters").fill("no such thing");
  await expect(page.getByText("Nothing fits")).toBeVisible();
});

test("the frame file is edited as text, both ways, with the words of the command line", async ({ page }) => {
  await start(page);
  await setNumber(page, "rods.arm_rod_length_mm", "90");
  await page.getByRole("tab", { name: "Frame file" }).click();
  const text = page.locator("#toml");
  await expect(text).toHaveValue(/\[rods\]\narm_rod_length_mm = 90.0/);
  await text.fill('base = "cognifly"\n\n[rods]\n# shorter\narm_rod_length_mm = 85.0\nstrut_rod_lenght_mm = 50.0\n');
  await expect(page.locator("#toml-refusal")).toContainText("did you mean");
  await expect(page.locator("#toml-refusal")).toContainText("line 6");
  await shot(page, "1-refused-text");
  // The values are those of the text, as far as it states them.
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("85");
  await expect(page.locator(".left .last-good")).toHaveCount(0);
  await page.getByRole("tab", { name: "Frame file" }).click();
  await text.fill('base = "cognifly"\n\n[rods]\n# shorter\narm_rod_length_mm = 85.0\n');
  await expect(page.locator("#toml-refusal")).toBeEmpty();
  await settled(page);
  await setNumber(page, "rods.strut_rod_length_mm", "51");
  await page.getByRole("tab", { name: "Frame file" }).click();
  await expect(text).toHaveValue(/# shorter\narm_rod_length_mm = 85.0\nstrut_rod_length_mm = 51.0/);
});

test("what is typed with pauses is kept to the last letter", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Frame file" }).click();
  const text = page.locator("#toml");
  await text.fill('base = "cognifly"\nhub_joint.hub_joint_diameter_mm = 7');
  await settled(page);
  await text.press("Control+End");
  await text.press("Backspace");
  await text.pressSequentially("6", { delay: 30 });
  await page.waitForTimeout(400);
  await text.pressSequentially(".5", { delay: 30 });
  await page.waitForTimeout(400);
  await text.pressSequentially(" # chosen by hand, see the notes of the last flight", { delay: 30 });
  await settled(page);
  const whole = /_mm = 6\.5 # chosen by hand, see the notes of the last flight$/;
  await expect(text).toHaveValue(whole);
  await page.waitForTimeout(500);
  await settled(page);
  await expect(text).toHaveValue(whole);
  // What is undone takes the place of what was typed.
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(text).not.toHaveValue(whole);
});

test("what is being typed into a field stays when a result arrives, and is taken with Enter", async ({ page }) => {
  await start(page);
  const before = await page.locator("[data-gauge=mass] b").innerText();
  const arm = await openField(page, "rods.arm_rod_length_mm");
  const strut = page.locator('[id="p-rods.strut_rod_length_mm"]');
  await arm.fill("84");
  await arm.press("Enter");
  await strut.fill("51.2");
  await expect(page.locator("[data-gauge=mass] b")).not.toHaveText(before);
  await settled(page);
  await expect(strut).toHaveValue("51.2");
  await strut.press("Enter");
  await settled(page);
  await expect(page.getByText("changed (2)")).toBeVisible();
  // Escape gives up what is being typed.
  await strut.fill("60");
  await strut.press("Escape");
  await expect(strut).toHaveValue("51.2");
  await arm.focus();
  await expect(strut).toHaveValue("51.2");
  // What is no number is taken back when the field is left, with the reason.
  const field = page.locator('[data-key="rods.strut_rod_length_mm"]');
  for (const typed of ["0x50", "51 mm", "1.234,5", "x"]) {
    await strut.fill(typed);
    await arm.focus();
    await expect(strut).toHaveValue("51.2");
    await expect(field.locator(".fault")).toContainText(`“${typed}” is no number`);
  }
  // A letter that is typed is the field's to take back, a value that was taken is the frame's.
  await strut.focus();
  await strut.press("Control+z");
  await settled(page);
  await expect(page.getByText("changed (1)")).toBeVisible();
  await expect(strut).not.toHaveValue("51.2");
  await expect(field.locator(".fault")).toHaveCount(0);
  // A name that is none is taken back, too.
  const name = page.getByLabel("Name of the frame's file");
  await name.fill("Mein Rahmen");
  await name.press("Enter");
  await expect(page.locator(".notice")).toContainText("“Mein Rahmen” is no name of a file");
  await expect(name).toHaveValue("my-cognifly");
  await name.fill("mine");
  await name.press("Enter");
  await settled(page);
  await expect(page.locator(".notice")).toHaveCount(0);
  await expect(page).toHaveTitle("mine – flexframe studio");
});

test("a number that follows from another is the preset's where that was typed, and follows again after a reset", async ({
  page,
}) => {
  await start(page);
  await setNumber(page, "limits.envelope_width_mm", "250");
  const depth = page.locator('[data-key="limits.envelope_depth_mm"]');
  await expect(depth.locator("input[type=text]")).toHaveValue("250");
  await expect(depth.locator(".doc")).toContainText("follows from the envelope width unless stated");
  await setNumber(page, "limits.envelope_depth_mm", "210");
  await expect(depth.locator("input[type=text]")).toHaveValue("210");
  await expect(page.locator("[data-gauge=size]")).toContainText("of 250 × 210 × 120");
  await depth.getByRole("button", { name: "to what follows from the envelope width" }).click();
  await settled(page);
  await expect(depth.locator("input[type=text]")).toHaveValue("250");
  await page.getByText("Bought parts, materials, printer, sleeve").click();
  await page.locator('[id="c-bought.battery"]').selectOption("battery-2s-850");
  await settled(page);
  const height = await openField(page, "battery.battery_height_mm");
  await expect(height).toHaveValue("14");
  await setNumber(page, "battery.battery_height_mm", "16");
  await expect(height).toHaveValue("16");
  await page.getByRole("tab", { name: "Frame file" }).click();
  await expect(page.locator("#toml")).toHaveValue(/battery_height_mm = 16/);
});

test("a reset in a frame file without a base writes the preset's number", async ({ page }) => {
  await start(page);
  const preset = readFileSync("../../params/frames/cognifly.toml", "utf8");
  await page.getByRole("tab", { name: "Frame file" }).click();
  await page.locator("#toml").fill(preset.replace("arm_rod_length_mm = 82.0", "arm_rod_length_mm = 84.0"));
  await expect(page.locator("#toml-refusal")).toBeEmpty();
  const arm = await openField(page, "rods.arm_rod_length_mm");
  await expect(arm).toHaveValue("84");
  await settled(page);
  await page.locator('[data-key="rods.arm_rod_length_mm"]').getByRole("button", { name: /Reset/ }).click();
  await settled(page);
  await expect(arm).toHaveValue("82");
  await expect(page.locator(".refusal")).toHaveCount(0);
});

test("while the frame file is no TOML, no value can be set, and the line to mend is named", async ({ page }) => {
  await start(page);
  await page.getByRole("tab", { name: "Frame file" }).click();
  await page.locator("#toml").fill('base = "cognifly"\n[rods\n');
  await expect(page.locator("#toml-refusal")).toContainText("line 2");
  const arm = await openField(page, "rods.arm_rod_length_mm");
  await expect(page.getByText("Mend line 2 of the frame file first")).toBeVisible();
  await expect(arm).toBeDisabled();
  await expect(page.getByText("changed (0)")).toBeVisible();
  await page.getByRole("tab", { name: "Frame file" }).click();
  await page.locator("#toml").fill('base = "cognifly"\n[rods]\narm_rod_length_mm = 4000\n');
  await expect(page.locator("#toml-refusal")).toContainText("out of bounds");
  // What is TOML and refused is mended in its field.
  await setNumber(page, "rods.arm_rod_length_mm", "84");
  await expect(page.locator(".refusal")).toHaveCount(0);
});

test("an undo while changes are computed takes back the last of them", async ({ page }) => {
  await start(page);
  const fill = async (key: string, value: string) => {
    const field = await openField(page, key);
    await field.fill(value);
    await field.press("Enter");
  };
  await fill("rods.arm_rod_length_mm", "83");
  await settled(page);
  await fill("rods.strut_rod_length_mm", "52");
  await fill("rods.arm_rod_slack_mm", "2");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  const values = () =>
    Promise.all(
      ["arm_rod_length_mm", "strut_rod_length_mm", "arm_rod_slack_mm"].map(async (key) =>
        (await openField(page, `rods.${key}`)).inputValue(),
      ),
    );
  await expect.poll(values).toEqual(["83", "52", "1.5"]);
  await page.getByRole("button", { name: "Redo" }).click();
  await settled(page);
  await expect.poll(values).toEqual(["83", "52", "2"]);
});

test("a refusal stands beside its field, and the last good picture stays", async ({ page }) => {
  await start(page);
  const first = await mass(page);
  await setNumber(page, "rods.arm_rod_length_mm", "4000");
  const field = page.locator('[data-key="rods.arm_rod_length_mm"]');
  await expect(field.locator(".fault")).toContainText("arm_rod_length_mm");
  await expect(page.locator(".refusal")).toBeVisible();
  expect(await mass(page)).toBe(first);
  await shot(page, "1-refused-value");
  // The notice leaves the picture to see, and opens to the whole reason.
  const note = page.locator(".refusal");
  expect((await note.boundingBox())!.height).toBeLessThan(50);
  await expect(note.locator(".remedy")).toBeHidden();
  await note.getByRole("button", { name: "More" }).click();
  await expect(note.locator(".remedy")).toBeVisible();
  // What is known is of the last good frame, and says so.
  for (const panel of ["Compare", "Fold", "Drop", "Checks"]) {
    await page.getByRole("tab", { name: panel }).click();
    await expect(page.locator(".last-good")).toContainText("refused. What stands here is of the last good frame");
  }
  await expect(page.locator("[data-state]")).toContainText("Every checked limit of the last good frame holds.");
  await expect(page.locator("[data-state]")).toHaveAttribute("data-state", "some");
  // It stays in its field under another name, and after a reload.
  const name = page.getByLabel("Name of the frame's file");
  await name.fill("other");
  await name.press("Enter");
  await settled(page);
  const value = await openField(page, "rods.arm_rod_length_mm");
  await expect(value).toHaveValue("4000");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(value).toHaveValue("4000");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  await expect(page.locator(".refusal")).toHaveCount(0);
  await checked(page);
  await expect(page.locator(".last-good")).toHaveCount(0);
  await expect(page.locator("[data-state]")).toContainText("Every checked limit holds.");
  await page.getByRole("button", { name: "Redo" }).click();
  await settled(page);
  await page.reload();
  await expect(page.locator("[data-gauge=size]")).toBeVisible({ timeout: 60_000 });
  await settled(page);
  await expect(await openField(page, "rods.arm_rod_length_mm")).toHaveValue("4000");
  await expect(page.getByText("changed (1)")).toBeVisible();
  await field.getByRole("button", { name: /Reset/ }).click();
  await expect(page.locator(".refusal")).toHaveCount(0);
  await expect(value).toHaveValue("82");
});
