// A number as a slider with a field beside it. The field takes what is typed when it is left or Enter is pressed.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { short } from "./words.ts";

const NUMBER = /^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?$/i;

/** What is typed as a number, with a point or a comma. */
function numberOf(typed: string): number | null {
  const plain = typed.trim();
  const number = NUMBER.test(plain) ? Number(plain.replace(",", ".")) : NaN;
  return Number.isFinite(number) ? number : null;
}

type Props = {
  id: string;
  name: string;
  unit: string;
  min: number;
  max: number;
  step?: number;
  value: number | null;
  describedBy?: string | undefined;
  invalid?: boolean;
  onInput: (value: number) => void;
};

/** A step of which the range has some hundred, and that is a round number. */
export function stepOf(min: number, max: number): number {
  return 10 ** Math.floor(Math.log10((max - min) / 100));
}

export function Slider({
  id,
  name,
  unit,
  min,
  max,
  step = stepOf(min, max),
  value,
  describedBy,
  invalid,
  onInput,
}: Props) {
  // What is being typed is not the value yet, and a result that arrives meanwhile does not take its place.
  const draft = useSignal<string | null>(null);
  const untaken = useSignal<string | null>(null);
  const take = (typed: string) => {
    // What is no number changes nothing, and must not look as if it did.
    draft.value = null;
    const number = numberOf(typed);
    untaken.value = number === null && typed.trim() !== "" ? typed.trim().slice(0, 40) : null;
    if (number !== null) onInput(number);
  };
  // What was typed has nothing to do with another value.
  useEffect(() => {
    untaken.value = null;
  }, [value]);
  const spoken = unit === "°" ? "degrees" : unit;
  const named = [name, spoken].filter(Boolean).join(", ");
  return (
    <>
      <span class="slider">
        <input
          type="range"
          id={`${id}-range`}
          aria-label={named}
          aria-describedby={describedBy}
          min={min}
          max={max}
          step={step}
          value={value ?? min}
          onInput={(event) => {
            untaken.value = null;
            onInput(Number(event.currentTarget.value));
          }}
        />
        <input
          type="text"
          inputMode="decimal"
          id={id}
          aria-label={`${name} in ${spoken || "numbers"}`}
          aria-describedby={describedBy}
          aria-invalid={invalid || untaken.value !== null}
          data-typed={draft.value !== null}
          value={draft.value ?? short(value, 4)}
          onInput={(event) => {
            draft.value = event.currentTarget.value;
            untaken.value = null;
          }}
          onChange={(event) => take(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key !== "Escape") return;
            draft.value = null;
            event.currentTarget.value = short(value, 4);
          }}
          onBlur={() => (draft.value = null)}
        />
        <span class="unit" aria-hidden="true">
          {unit}
        </span>
      </span>
      {untaken.value !== null && (
        <p class="fault" role="alert">
          “{untaken.value}” is no number, so nothing was changed. A number has digits and one point or comma: 1234.5
        </p>
      )}
    </>
  );
}
