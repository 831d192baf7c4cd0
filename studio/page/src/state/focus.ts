// Which panels are open, and how one leads to a field of another.
import { signal } from "@preact/signals";
import { catalogue } from "./studio.ts";

export const left = signal<"values" | "text">("values");
export const right = signal<"checks" | "compare" | "fold" | "drop" | "diagnose" | "files">("checks");
/** On a narrow screen one of the three columns is shown. */
export const column = signal<"left" | "middle" | "right">("middle");

/** What is searched for among the values, and whether only those that differ from the preset are listed. */
export const search = signal("");
export const changedOnly = signal(false);

/** The group of the values that are chosen from a list. */
export const CHOICES = "choices";
/** The groups of values that are open. What is closed is not drawn. */
export const openGroups = signal<ReadonlySet<string>>(new Set(["rods"]));

export function openGroup(group: string, open: boolean): void {
  if (openGroups.value.has(group) === open) return;
  const next = new Set(openGroups.value);
  if (open) next.add(group);
  else next.delete(group);
  openGroups.value = next;
}

/** The field that a value is typed into or chosen in, if it is drawn. */
export function fieldOf(key: string): HTMLElement | null {
  return document.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"] :is(input[type="text"], select)`);
}

/** Shows the picture. Where it takes the place of what was pressed, on a narrow screen, the focus goes with it. */
export function showPicture(): void {
  column.value = "middle";
  requestAnimationFrame(() => {
    const held = document.activeElement?.checkVisibility({ visibilityProperty: true });
    if (!held || document.activeElement === document.body)
      document.querySelector<HTMLElement>(".picture canvas")?.focus();
  });
}

/** Opens the text of the frame file at a line, which is selected. */
export function showLine(line: number): void {
  left.value = "text";
  column.value = "left";
  requestAnimationFrame(() => {
    const area = document.querySelector<HTMLTextAreaElement>("#toml");
    const lines = area?.value.split("\n") ?? [];
    const start = lines.slice(0, line - 1).reduce((sum, { length }) => sum + length + 1, 0);
    area?.focus();
    area?.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
  });
}

/** Opens the field of a value, even where a search left it out, and puts the focus there. */
export function showParameter(key: string): void {
  left.value = "values";
  column.value = "left";
  const chosen = catalogue.value?.choices.some((choice) => choice.key === key);
  openGroup(chosen ? CHOICES : (key.split(".")[0] ?? ""), true);
  requestAnimationFrame(() => {
    if (!fieldOf(key)) {
      search.value = "";
      changedOnly.value = false;
    }
    requestAnimationFrame(() => focusField(key));
  });
}

function focusField(key: string): void {
  const field = fieldOf(key);
  field?.closest("[data-key]")?.scrollIntoView({ block: "center" });
  field?.focus();
}
