// A row of tabs: arrow keys go from one to the next.
import type { Signal } from "@preact/signals";

type Props<T extends string> = { name: string; tabs: { id: T; words: string }[]; at: Signal<T> };

export function Tabs<T extends string>({ name, tabs, at }: Props<T>) {
  const go = (by: number) => {
    const next = tabs[(tabs.findIndex(({ id }) => id === at.value) + by + tabs.length) % tabs.length];
    if (!next) return;
    at.value = next.id;
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={name}>
      {tabs.map(({ id, words }) => (
        <button
          key={id}
          id={`tab-${id}`}
          type="button"
          role="tab"
          aria-selected={at.value === id}
          tabIndex={at.value === id ? 0 : -1}
          onClick={() => (at.value = id)}
          onKeyDown={(event) => {
            if (event.key === "ArrowRight") go(1);
            else if (event.key === "ArrowLeft") go(-1);
          }}
        >
          {words}
        </button>
      ))}
    </div>
  );
}
