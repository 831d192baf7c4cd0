// Draws the page; a module of its own, because the engine need not wait for it.
import { render } from "preact";
import { App } from "./app.tsx";

export function show(root: HTMLElement): void {
  root.replaceChildren();
  render(<App />, root);
}
