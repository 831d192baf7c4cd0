// A list of the impact models that come with the engine.
import type { Signal } from "@preact/signals";
import { presets } from "../state/studio.ts";

/** `own`: one more choice, with its value and its words. */
export function ModelSelect({ label, model, own }: { label: string; model: Signal<string>; own?: [string, string] }) {
  return (
    <label>
      Model{" "}
      <select aria-label={label} value={model} onChange={(event) => (model.value = event.currentTarget.value)}>
        {presets.value?.models.map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
        {own && <option value={own[0]}>{own[1]}</option>}
      </select>
    </label>
  );
}
