// A number as a slider with a field beside it. The field takes what is typed when it is left or Enter is pressed.
import { short } from "./words.ts";

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
  const take = (field: HTMLInputElement) => {
    const number = Number(field.value.replace(",", "."));
    if (field.value.trim() !== "" && Number.isFinite(number)) onInput(number);
    // What is no number changes nothing, and must not look as if it did.
    else field.value = short(value, 4);
  };
  const spoken = unit === "°" ? "degrees" : unit;
  return (
    <span class="slider">
      <input
        type="range"
        id={`${id}-range`}
        aria-label={`${name}, ${spoken}`}
        aria-describedby={describedBy}
        min={min}
        max={max}
        step={step}
        value={value ?? min}
        onInput={(event) => onInput(Number(event.currentTarget.value))}
      />
      <input
        type="text"
        inputMode="decimal"
        id={id}
        aria-label={`${name} in ${spoken || "numbers"}`}
        aria-describedby={describedBy}
        aria-invalid={invalid}
        value={short(value, 4)}
        onChange={(event) => take(event.currentTarget)}
      />
      <span class="unit" aria-hidden="true">
        {unit}
      </span>
    </span>
  );
}
