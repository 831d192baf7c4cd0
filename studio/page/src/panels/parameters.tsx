// Story 1: every number and choice of the frame, by group, with unit, bounds, meaning, and what differs from the preset.
import { computed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import type { Choice, Parameter } from "../engine/answers.ts";
import type { Setting } from "../state/link.ts";
import { changedOnly, CHOICES, fieldOf, openGroup, openGroups, search } from "../state/focus.ts";
import { ownParts } from "../state/doc.ts";
import { baseOf, catalogue, changedKeys, doc, followsFrom, refused, set, valueOf } from "../state/studio.ts";
import { Slider } from "../ui/slider.tsx";
import { label, short, size } from "../ui/words.ts";
import { lit } from "../view/scene_state.ts";

const fits = computed(() => {
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  return (key: string, ...texts: string[]) => {
    if (changedOnly.value && !changedKeys.value.has(key)) return false;
    const all = `${key} ${texts.join(" ")}`.toLowerCase().replaceAll("_", " ");
    return words.every((word) => all.includes(word.replaceAll("_", " ")));
  };
});

export function Parameters() {
  const known = catalogue.value;
  if (!known) return null;
  const parameters = known.parameters.filter((p) => fits.value(p.key, p.doc, p.about, p.drives.join(" ")));
  const choices = known.choices.filter((c) => fits.value(c.key, c.of.map(({ name }) => name).join(" ")));
  const tables = [...new Set(parameters.map(({ table }) => table))];
  const open = search.value !== "" || changedOnly.value;
  return (
    <div class="parameters">
      <div class="finder">
        <input
          type="search"
          aria-label="Search parameters"
          placeholder="Search"
          value={search}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
        <label>
          <input
            type="checkbox"
            checked={changedOnly}
            onChange={(event) => (changedOnly.value = event.currentTarget.checked)}
          />
          changed ({changedKeys.value.size})
        </label>
      </div>
      <Unreadable />
      <fieldset class="plain" disabled={refused.value?.editable === false}>
        {choices.length > 0 && (
          <Group
            id={CHOICES}
            title="Bought parts, materials, printer, sleeve"
            changed={choices.filter(({ key }) => changedKeys.value.has(key)).length}
            found={open}
          >
            {() => choices.map((choice) => <ChoiceField key={choice.key} choice={choice} />)}
          </Group>
        )}
        {tables.map((table) => {
          const own = parameters.filter((p) => p.table === table);
          const changed = own.filter(({ key }) => changedKeys.value.has(key)).length;
          return (
            <Group key={table} id={table} title={label(table)} changed={changed} found={open}>
              {() => (
                <>
                  <p class="about">{own[0]?.about}</p>
                  {own.map((p) => (
                    <NumberField key={p.key} parameter={p} />
                  ))}
                </>
              )}
            </Group>
          );
        })}
      </fieldset>
      {tables.length === 0 && choices.length === 0 && <p class="empty">Nothing fits “{search}”.</p>}
    </div>
  );
}

/** Why no value can be set. */
function Unreadable() {
  if (refused.value?.editable !== false) return null;
  const line = refused.value.refusal.place?.line;
  return (
    <p class="caution" role="status">
      Mend {line === undefined ? "the" : `line ${line} of the`} frame file first: while it is no TOML, values cannot be
      set in it.
    </p>
  );
}

type GroupProps = { id: string; title: string; changed?: number; found: boolean; children: () => ComponentChildren };

/** A group that opens; its fields are drawn when it is open, or when a search found them. */
function Group({ id, title, changed = 0, found, children }: GroupProps) {
  const open = found || openGroups.value.has(id);
  return (
    <details
      open={open}
      data-table={id === CHOICES ? undefined : id}
      onToggle={(event) => {
        if (!found) openGroup(id, event.currentTarget.open);
      }}
    >
      <summary>
        <h3>{title}</h3>
        {changed > 0 && <span class="badge">{changed} changed</span>}
      </summary>
      {open && children()}
    </details>
  );
}

function NumberField({ parameter: p }: { parameter: Parameter }) {
  const id = `p-${p.key}`;
  const value = valueOf(p.key);
  const fault = refused.value?.key === p.key ? refused.value.refusal : null;
  const from = followsFrom(p.key);
  const light = () => (lit.value = new Set(p.drives));
  const dark = () => (lit.value = new Set());
  return (
    <div
      class={`field ${changedKeys.value.has(p.key) ? "changed" : ""}`}
      data-key={p.key}
      onFocusIn={light}
      onFocusOut={dark}
      onPointerEnter={light}
      onPointerLeave={dark}
    >
      <div class="head">
        <label for={id}>{label(p.key)}</label>
        <Reset keyOf={p.key} unit={p.unit} />
      </div>
      <Slider
        id={id}
        name={label(p.key)}
        unit={p.unit}
        min={p.min}
        max={p.max}
        value={typeof value === "number" ? value : null}
        describedBy={`${id}-doc`}
        invalid={fault !== null}
        onInput={(number) => set({ [p.key]: number })}
      />
      {fault && (
        <p class="fault" role="alert">
          {fault.message}
          {fault.remedy && <span class="remedy">{fault.remedy}</span>}
        </p>
      )}
      <p class="doc" id={`${id}-doc`}>
        {p.doc} <span class="bounds">{`${short(p.min)} to ${short(p.max)}${p.unit ? ` ${p.unit}` : ""}`}</span>
        {from !== null && <span class="bounds"> follows from the {from} unless stated</span>}
      </p>
    </div>
  );
}

function Reset({ keyOf, unit }: { keyOf: string; unit: string }) {
  if (!changedKeys.value.has(keyOf)) return null;
  const former = baseOf(keyOf);
  const from = followsFrom(keyOf);
  const number = typeof former === "number" ? `${short(former)}${unit ? ` ${unit}` : ""}` : former;
  const goal = from === null ? number : `what follows from the ${from}`;
  return (
    <button
      type="button"
      class="reset"
      title={from === null ? `Back to ${number}, the preset's` : `Back to ${goal}`}
      aria-label={`Reset ${label(keyOf)} to ${goal}`}
      onClick={() => {
        set({ [keyOf]: null });
        // The button goes with the change: what it was of has the focus.
        fieldOf(keyOf)?.focus();
      }}
    >
      ↺ {from === null ? number : `follows the ${from}`}
    </button>
  );
}

const NONE = { name: "none" };

function ChoiceField({ choice }: { choice: Choice }) {
  const id = `c-${choice.key}`;
  const value = valueOf(choice.key) as Setting | null;
  const own = ownParts(doc.value.text).filter(
    ({ name, kind }) => kind === choice.kind && !choice.of.some((of) => of.name === name),
  );
  const options = [...choice.of, ...own.map(({ name }) => ({ name })), ...(choice.optional ? [NONE] : [])];
  const known = options.some(({ name }) => name === value);
  const fault = refused.value?.key === choice.key ? refused.value.refusal : null;
  return (
    <div class={`field ${changedKeys.value.has(choice.key) ? "changed" : ""}`} data-key={choice.key}>
      <div class="head">
        <label for={id}>
          {label(choice.key)}
          {choice.quantity !== undefined && choice.quantity > 1 ? ` × ${choice.quantity}` : ""}
        </label>
        <Reset keyOf={choice.key} unit="" />
      </div>
      <select id={id} value={value ?? ""} onChange={(event) => set({ [choice.key]: event.currentTarget.value })}>
        {!known && value !== null && <option value={value}>{value} (of the frame file)</option>}
        {options.map((option) => (
          <option key={option.name} value={option.name}>
            {described(option)}
            {own.some(({ name }) => name === option.name) && " (of the frame file)"}
          </option>
        ))}
      </select>
      {fault && (
        <p class="fault" role="alert">
          {fault.message}
          {fault.remedy && <span class="remedy">{fault.remedy}</span>}
        </p>
      )}
    </div>
  );
}

function described(option: Choice["of"][number]): string {
  const facts = [
    option.title,
    option.size_mm && size(option.size_mm),
    option.mass_g !== undefined && `${short(option.mass_g, 2)} g`,
    option.density_g_cm3 !== undefined && `${short(option.density_g_cm3)} g/cm³`,
  ].filter(Boolean);
  return facts.length > 0 ? `${option.name} – ${facts.join(", ")}` : option.name;
}
