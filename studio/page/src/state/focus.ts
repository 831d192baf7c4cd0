// Which panels are open, and how one leads to a field of another.
import { signal } from "@preact/signals";

export const left = signal<"values" | "text">("values");
export const right = signal<"checks" | "compare" | "fold" | "drop" | "diagnose" | "files">("checks");
/** On a narrow screen one of the three columns is shown. */
export const column = signal<"left" | "middle" | "right">("middle");

/** Opens the field of a parameter and puts the focus there. */
export function showParameter(key: string): void {
  left.value = "values";
  column.value = "left";
  requestAnimationFrame(() => {
    const field = document.querySelector(`[data-key="${CSS.escape(key)}"]`);
    const group = field?.closest("details");
    if (group) group.open = true;
    field?.scrollIntoView({ block: "center" });
    field?.querySelector<HTMLElement>("input[type=text], select")?.focus();
  });
}
