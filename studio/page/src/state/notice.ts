// What the page says in one line above everything: what went wrong, or what was done.
import { signal } from "@preact/signals";

export const notice = signal<{ words: string; good: boolean } | null>(null);

export function complain(words: string): void {
  notice.value = { words, good: false };
}

export function tell(words: string): void {
  notice.value = { words, good: true };
}

/** Something new begins: what was said before is not of it. */
export function quiet(): void {
  notice.value = null;
}
