// Story 2: how the frame is shown, what was clicked, and distances.
import { effect, signal } from "@preact/signals";
import type { Vector3 } from "three";
import { catalogue, frame } from "../state/studio.ts";
import { showParameter } from "../state/focus.ts";
import { complain } from "../state/notice.ts";
import { owner } from "../state/player.ts";
import { label, short, size } from "../ui/words.ts";
import type { ColourBy } from "../view/colours.ts";
import {
  centre,
  colourBy,
  discs,
  envelope,
  explode,
  picked,
  plate,
  section,
  shownPictures,
  stage,
  viewer,
} from "../view/scene_state.ts";

const measuring = signal(false);
const points = signal<Vector3[]>([]);

let latest: Vector3 | null = null;
effect(() => {
  const at = picked.value;
  // A picked body in a new picture is picked at the same point: that is no click.
  if (!measuring.peek() || !at || at.at === latest || explode.peek() > 0) return;
  latest = at.at;
  const former = points.peek();
  points.value = former.length >= 2 ? [at.at] : [...former, at.at];
});
effect(() => viewer.value?.showDistance(points.value));
// Its points are those of a picture that is no more.
effect(() => {
  void shownPictures.value;
  void explode.value;
  points.value = [];
});

/** What draws comes with the picture, which the rest of the page does not wait for. */
function showBed(shown: boolean, number = 0): void {
  import("../view/bed.ts")
    .then((bed) => bed.showBed(shown, number))
    .catch((error: unknown) =>
      complain(`The bed cannot be shown: ${error instanceof Error ? error.message : String(error)}`),
    );
}

/** Where a section of the picture can be, mm. */
function sectionBounds(): [number, number] {
  void shownPictures.value;
  return (section.value && viewer.value?.boundsMm(section.value.axis)) || [0, 0];
}

/** A section across an axis, within the picture: the sides of a frame differ. */
function sectionAt(axis: "x" | "y" | "z", atMm: number): { axis: typeof axis; atMm: number } {
  const [low, high] = viewer.value?.boundsMm(axis) ?? [atMm, atMm];
  return { axis, atMm: Math.min(high, Math.max(low, atMm)) };
}

const OF_FRAME = "Of the assembled frame only";

export function Toolbar() {
  const [onBed, moving] = [stage.value === "bed", stage.value === "motion"];
  const assembled = !onBed && !moving && explode.value === 0;
  const bounds = sectionBounds();
  return (
    <div class="toolbar" role="group" aria-label="How the frame is shown">
      <label>
        Show{" "}
        <select
          aria-label="Show"
          value={moving ? "motion" : onBed ? "bed" : explode.value > 0 ? "exploded" : "assembled"}
          onChange={(event) => {
            const shown = event.currentTarget.value;
            if (shown === "motion") return;
            explode.value = shown === "exploded" ? 0.5 : 0;
            showBed(shown === "bed");
          }}
        >
          {moving && <option value="motion">{owner.value === "drop" ? "the drop" : "a step of the assembly"}</option>}
          <option value="assembled">assembled</option>
          <option value="exploded" disabled={moving}>
            exploded
          </option>
          <option value="bed">on the bed</option>
        </select>
      </label>
      {stage.value === "bed" && plate.value && plate.value.of.length > 1 && (
        <label>
          Plate{" "}
          <select
            aria-label="Plate"
            value={plate.value.at}
            onChange={(event) => showBed(true, Number(event.currentTarget.value))}
          >
            {plate.value.of.map((name, at) => (
              <option key={name} value={at}>
                {name}
              </option>
            ))}
          </select>
        </label>
      )}
      {explode.value > 0 && !onBed && !moving && (
        <input
          type="range"
          aria-label="How far apart"
          min="0.05"
          max="1.5"
          step="0.05"
          value={explode}
          onInput={(event) => (explode.value = Number(event.currentTarget.value))}
        />
      )}
      <label>
        Colour by{" "}
        <select
          aria-label="Colour by"
          disabled={onBed}
          value={colourBy}
          onChange={(event) => (colourBy.value = event.currentTarget.value as ColourBy)}
        >
          <option value="material">material</option>
          <option value="part">part</option>
          <option value="finding">finding</option>
        </select>
      </label>
      <Toggle of={envelope} words="Envelope" acts={!onBed && !moving} />
      <Toggle of={discs} words="Propeller discs" acts={!onBed} />
      <Toggle of={centre} words="Centre of mass" acts={!onBed && !moving} />
      <label>
        Section{" "}
        <select
          aria-label="Section"
          disabled={onBed}
          title={onBed ? OF_FRAME : undefined}
          value={section.value?.axis ?? ""}
          onChange={(event) => {
            const axis = event.currentTarget.value;
            section.value = axis === "" ? null : sectionAt(axis as "x", section.value?.atMm ?? 0);
          }}
        >
          <option value="">none</option>
          <option value="x">across (X)</option>
          <option value="y">along (Y)</option>
          <option value="z">level (Z)</option>
        </select>
      </label>
      {section.value && !onBed && (
        <label>
          <input
            type="range"
            aria-label="Where the section is, mm"
            min={bounds[0]}
            max={bounds[1]}
            step="1"
            value={section.value.atMm}
            onInput={(event) =>
              (section.value = { axis: section.value?.axis ?? "x", atMm: Number(event.currentTarget.value) })
            }
          />
          {section.value.atMm} mm
        </label>
      )}
      <button
        type="button"
        aria-pressed={measuring}
        disabled={!assembled}
        title={assembled ? undefined : OF_FRAME}
        onClick={() => {
          measuring.value = !measuring.value;
          points.value = [];
        }}
      >
        Distance
      </button>
      <button type="button" onClick={() => viewer.value?.fit()}>
        Fit
      </button>
      <PartOfFrame acts={!onBed && !moving} />
    </div>
  );
}

/** A body by its name, for those who do not point at it. */
function PartOfFrame({ acts }: { acts: boolean }) {
  void shownPictures.value;
  const names = viewer.value?.facts().map(({ name }) => name) ?? [];
  return (
    <label>
      Part{" "}
      <select
        aria-label="Part"
        disabled={!acts}
        title={acts ? undefined : OF_FRAME}
        value={picked.value?.body.facts.name ?? ""}
        onChange={(event) => (picked.value = viewer.value?.named(event.currentTarget.value) ?? null)}
      >
        <option value="">none</option>
        {names.sort().map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

/** `acts`: whether what is shown has what it switches. */
function Toggle({ of, words, acts }: { of: { value: boolean }; words: string; acts: boolean }) {
  return (
    <button
      type="button"
      aria-pressed={of.value}
      disabled={!acts}
      title={acts ? undefined : OF_FRAME}
      onClick={() => (of.value = !of.value)}
    >
      {words}
    </button>
  );
}

export function Selection() {
  const [a, b] = points.value;
  const body = picked.value?.body;
  const line = frame.value?.masses.lines.find(({ name }) => name === body?.facts.part);
  const drivers = catalogue.value?.parameters.filter(({ drives }) => body && drives.includes(body.facts.part)) ?? [];
  return (
    <div class="selection" aria-live="polite">
      {measuring.value && stage.value === "frame" && explode.value === 0 && (
        <p class="distance">
          {a && b
            ? `Distance ${short(1000 * a.distanceTo(b), 2)} mm`
            : a
              ? "Click the second point."
              : "Click two points of the frame."}
        </p>
      )}
      {body && !measuring.value && stage.value !== "bed" && (
        <div class="picked">
          <button type="button" class="close" aria-label="Close" onClick={() => (picked.value = null)}>
            ×
          </button>
          <h3>{body.facts.name}</h3>
          <p>
            {body.facts.part} · {body.facts.material} · {body.facts.quantity} of it
          </p>
          <p>
            {size(picked.value?.sizeMm)}
            {body.facts.mass_each_g !== null && ` · ${short(body.facts.mass_each_g, 2)} g each`}
            {line && ` (${line.basis})`}
          </p>
          {drivers.length > 0 && (
            <details>
              <summary>{drivers.length} parameters drive its shape</summary>
              <ul>
                {drivers.map(({ key }) => (
                  <li key={key}>
                    <button type="button" class="link" onClick={() => showParameter(key)}>
                      {label(key)}
                    </button>
                  </li>
                ))}
              </ul>
            </details>
          )}
        </div>
      )}
    </div>
  );
}
