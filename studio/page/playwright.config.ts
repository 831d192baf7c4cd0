// The studio in Debian's Chromium, served by the program that is tested. FLEXFRAME names the program, CHROMIUM the browser,
// STUDIO_WORK a folder for results and screenshots.
import { resolve } from "node:path";
import { defineConfig } from "@playwright/test";

const program = resolve(process.env["FLEXFRAME"] ?? "../../target/release/flexframe");
const port = Number(process.env["STUDIO_PORT"] ?? 8431);

export default defineConfig({
  testDir: "tests",
  outputDir: resolve(process.env["STUDIO_WORK"] ?? "test-results"),
  retries: 1,
  // Ends what hangs; nothing is measured by it.
  timeout: 180_000,
  expect: { timeout: 20_000 },
  reporter: [["./tests/lines.ts"]],
  // What is measured runs first, alone; the stories wait for what they see, two at a time.
  projects: [
    { name: "measured", testMatch: /(figures|engine)\.spec\.ts/, workers: 1 },
    { name: "stories", testMatch: /story-.*\.spec\.ts/, workers: 2, dependencies: ["measured"] },
  ],
  use: {
    baseURL: `http://127.0.0.1:${port}/`,
    viewport: { width: 1400, height: 900 },
    launchOptions: {
      executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
      // Without a graphics card, and in a container, where Chromium's own sandbox cannot start.
      args: [
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--ignore-gpu-blocklist",
        "--disable-gpu-watchdog",
        "--disable-dev-shm-usage",
      ],
    },
  },
  webServer: {
    command: `"${program}" studio --folder ../dist --port ${port} --no-open`,
    url: `http://127.0.0.1:${port}/`,
    reuseExistingServer: false,
  },
});
