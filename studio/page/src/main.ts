// Starts the engine, then the page: the first model is being made while the page is read and drawn.
import { effect } from "@preact/signals";
import { complain } from "./state/notice.ts";
import { begin, picture } from "./state/studio.ts";
import "./style.css";

// Asked for first, so that it does not wait behind the engine.
const page = import("./page.tsx");

begin().catch((error: unknown) => {
  complain(`The engine cannot be started: ${error instanceof Error ? error.message : String(error)}`);
});

// The page is kept for when there is no network, once the first picture does not have to wait for that.
const stop = effect(() => {
  if (!picture.value || !import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  void navigator.serviceWorker.register("./sw.js").catch(() => undefined);
  queueMicrotask(() => stop());
});

const root = document.getElementById("studio");
if (root) {
  await page.then(
    ({ show }) => show(root),
    (error: unknown) => {
      root.textContent = `The page cannot be loaded: ${error instanceof Error ? error.message : String(error)}. Load it again.`;
    },
  );
}
