// Which frame: the preset, the name of its file, undo and redo.
import { useEffect } from "preact/hooks";
import { canRedo, canUndo, doc, notice, presets, redo, take, undo } from "../state/studio.ts";
import { ofPreset } from "../state/doc.ts";
import type { Theme } from "../state/theme.ts";
import { theme } from "../state/theme.ts";
import { plainName } from "../state/link.ts";

export function Header() {
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      const typing =
        event.target instanceof HTMLTextAreaElement ||
        (event.target instanceof HTMLInputElement && event.target.type !== "range");
      if (typing || !(event.ctrlKey || event.metaKey)) return;
      const name = event.key.toLowerCase();
      if (name === "z" && !event.shiftKey) undo();
      else if (name === "y" || (name === "z" && event.shiftKey)) redo();
      else return;
      event.preventDefault();
    };
    document.addEventListener("keydown", key);
    return () => document.removeEventListener("keydown", key);
  }, []);
  const rename = (name: string) => {
    if (plainName(name)) take({ ...doc.value, name });
    else notice.value = "A name has letters, digits, “-”, “_” and “.”, and does not begin with “.”.";
  };
  return (
    <header class="header">
      <h1>flexframe studio</h1>
      <label>
        Preset{" "}
        <select
          aria-label="Preset"
          value={doc.value.preset}
          onChange={(event) => take(ofPreset(event.currentTarget.value))}
        >
          {presets.value?.frames.map(({ name }) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </label>
      <label class="name">
        Name{" "}
        <input
          type="text"
          aria-label="Name of the frame's file"
          value={doc.value.name}
          onChange={(event) => rename(event.currentTarget.value)}
        />
      </label>
      <button type="button" disabled={!canUndo.value} onClick={undo} title="Ctrl+Z">
        Undo
      </button>
      <button type="button" disabled={!canRedo.value} onClick={redo} title="Ctrl+Y">
        Redo
      </button>
      <select
        aria-label="Colours of the page"
        value={theme}
        onChange={(event) => (theme.value = event.currentTarget.value as Theme)}
      >
        <option value="system">as the system</option>
        <option value="light">light</option>
        <option value="dark">dark</option>
      </select>
    </header>
  );
}
