// Which frame: the preset, the name of its file, undo and redo.
import { effect, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { canRedo, canUndo, doc, fileName, presets, redo, rename, take, undo } from "../state/studio.ts";
import { complain } from "../state/notice.ts";
import { ofPreset } from "../state/doc.ts";
import type { Theme } from "../state/theme.ts";
import { theme } from "../state/theme.ts";
import { plainName } from "../state/link.ts";

/** Whether a field has typed text that its own undo takes back; what was taken of a field is a step of the frame's. */
function isTyping(field: EventTarget | null): boolean {
  if (field instanceof HTMLTextAreaElement) return true;
  const isText = field instanceof HTMLInputElement && ["text", "search"].includes(field.type);
  return isText && field.dataset["typed"] !== "false";
}

/** What a preset's file says of it. */
function described(text: string): string | undefined {
  return /^description\s*=\s*"([^"\\]*)"/m.exec(text)?.[1];
}

// Tabs of the browser are told apart by their frames.
effect(() => {
  document.title = `${doc.value.name} – flexframe studio`;
});

export function Header() {
  // What is being typed is not the name yet.
  const draft = useSignal<string | null>(null);
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || isTyping(event.target)) return;
      const name = event.key.toLowerCase();
      if (name === "z" && !event.shiftKey) undo();
      else if (name === "y" || (name === "z" && event.shiftKey)) redo();
      else return;
      event.preventDefault();
    };
    document.addEventListener("keydown", key);
    return () => document.removeEventListener("keydown", key);
  }, []);
  const takeName = (field: HTMLInputElement) => {
    const name = field.value;
    draft.value = null;
    if (plainName(name)) return rename(name);
    // The name stays, and the field shows it.
    field.value = fileName.value;
    complain(
      `“${name.slice(0, 80)}” is no name of a file: it has letters, digits, “-”, “_” and “.”, 100 at the most, and does not begin with “.”.`,
    );
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
          {presets.value?.frames.map(({ name, text }) => (
            <option key={name} value={name}>
              {[name, described(text)].filter(Boolean).join(" – ")}
            </option>
          ))}
        </select>
      </label>
      <label class="name">
        Name{" "}
        <input
          type="text"
          aria-label="Name of the frame's file"
          data-typed={draft.value !== null && draft.value !== fileName.value}
          value={draft.value ?? fileName.value}
          onInput={(event) => (draft.value = event.currentTarget.value)}
          onChange={(event) => takeName(event.currentTarget)}
          onKeyDown={(event) => {
            if (event.key !== "Escape") return;
            draft.value = null;
            event.currentTarget.value = fileName.value;
          }}
          onBlur={() => (draft.value = null)}
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
        <option value="system">system</option>
        <option value="light">light</option>
        <option value="dark">dark</option>
      </select>
    </header>
  );
}
