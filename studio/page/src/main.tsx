// Starts the page.
import { render } from "preact";
import { App } from "./app.tsx";
import { effect } from "@preact/signals";
import { begin, notice, picture } from "./state/studio.ts";
import "./style.css";

const root = document.getElementById("studio");
if (root) {
  root.replaceChildren();
  render(<App />, root);
  begin().catch((error: unknown) => {
    notice.value = `The engine cannot be started: ${error instanceof Error ? error.message : String(error)}`;
  });
}

// The page is kept for when there is no network, once the first picture does not have to wait for that.
const stop = effect(() => {
  if (!picture.value || !import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  void navigator.serviceWorker.register("./sw.js").catch(() => undefined);
  queueMicrotask(() => stop());
});
