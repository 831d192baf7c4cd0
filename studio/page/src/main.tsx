// Starts the page.
import { render } from "preact";
import { App } from "./app.tsx";
import { begin, notice } from "./state/studio.ts";
import "./style.css";

const root = document.getElementById("studio");
if (root) {
  root.replaceChildren();
  render(<App />, root);
  begin().catch((error: unknown) => {
    notice.value = `The engine cannot be started: ${error instanceof Error ? error.message : String(error)}`;
  });
}
