// Light or dark: as the system has it, unless somebody chose.
import { effect, signal } from "@preact/signals";

const KEY = "flexframe-studio-theme";
export type Theme = "system" | "light" | "dark";

function chosen(): Theme {
  try {
    const kept = localStorage.getItem(KEY);
    return kept === "light" || kept === "dark" ? kept : "system";
  } catch {
    return "system";
  }
}

export const theme = signal<Theme>(chosen());

effect(() => {
  if (theme.value === "system") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = theme.value;
  try {
    localStorage.setItem(KEY, theme.value);
  } catch {
    // Then it is chosen again next time.
  }
});
