// A row of tabs: arrow keys go from one to the next, Home and End to the first and the last.
import type { Signal } from "@preact/signals";

/** `panel`: the id of what the tabs show. */
type Props<T extends string> = { name: string; panel: string; tabs: { id: T; words: string }[]; at: Signal<T> };

export function Tabs<T extends string>({ name, panel, tabs, at }: Props<T>) {
  const goTo = (place: number) => {
    const next = tabs.at(place % tabs.length);
    if (!next) return;
    at.value = next.id;
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  const press = (event: KeyboardEvent) => {
    // These are the browser's.
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const now = tabs.findIndex(({ id }) => id === at.value);
    const place = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: -1 }[event.key];
    if (place === undefined) return;
    event.preventDefault();
    goTo(place);
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
          aria-controls={panel}
          tabIndex={at.value === id ? 0 : -1}
          onClick={() => (at.value = id)}
          onKeyDown={press}
        >
          {words}
        </button>
      ))}
    </div>
  );
}
