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

const system = matchMedia("(prefers-color-scheme: dark)");
/** Whether the system is dark. */
export const isDark = signal(system.matches);
system.addEventListener("change", () => (isDark.value = system.matches));

effect(() => {
  if (theme.value === "system") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = theme.value;
  try {
    localStorage.setItem(KEY, theme.value);
  } catch {
    // Then it is chosen again next time.
  }
});
