// Story 5: the frame dropped, by a model or by its own mechanics; curves, peak, energies, and the motion slowed down.
import { computed, effect, signal } from "@preact/signals";
import type { DropAnswer, Energies, ImpactAnswer } from "../engine/outcomes.ts";
import type { Doc } from "../state/doc.ts";
import { identity } from "../state/doc.ts";
import { right, showPicture } from "../state/focus.ts";
import { hideMotion, owner, play, playing, seconds, showMotion } from "../state/player.ts";
import { checker, current, shownDoc } from "../state/studio.ts";
import { Work } from "../state/work.ts";
import type { Curve } from "../ui/plot.tsx";
import { Plot } from "../ui/plot.tsx";
import { ModelSelect } from "../ui/model_select.tsx";
import { MotionTime } from "../ui/motion_time.tsx";
import { Progress } from "../ui/progress.tsx";
import { Slider } from "../ui/slider.tsx";
import { short } from "../ui/words.ts";
import { before, other, pinned } from "./compare.tsx";

const OWN = "frame";
const height = signal(1);
const model = signal("paper-corrected");
const both = signal(false);

type Dropped = {
  name: string;
  peakG: number | null;
  contactMs: number | null;
  travelMm: number | null;
  /** The gap that is used up, mm, where a rigid body hits the ground: what follows is not computed. */
  hitMm: number | null;
  accel: [number, number][];
  /** The ground's force over the way down, from first touch until the frame leaves the ground. */
  force: [number, number][];
  energies: [string, number][];
  warnings: string[];
  motion: Uint8Array<ArrayBuffer> | null;
};
const work = new Work<Dropped[]>();
let timer: ReturnType<typeof setTimeout> | undefined;
let last = "";

effect(() => {
  const [of, open] = [shownDoc.value, right.value === "drop"];
  const against = both.value ? before.value : null;
  const how = { height_m: height.value, model: model.value };
  const asked = of && JSON.stringify([identity(of), against && identity(against), how]);
  clearTimeout(timer);
  if (!open) hideMotion("drop");
  else if (of && asked !== last) {
    timer = setTimeout(() => {
      last = asked ?? "";
      hideMotion("drop");
      void work
        .run((onStage, latest) => dropBoth(of, against, how, onStage, latest))
        .then((isLatest) => {
          if (!isLatest) return;
          // The motion of what was dropped before, where somebody had it shown meanwhile.
          hideMotion("drop");
          // What failed is tried again when the panel is opened again.
          if (work.failure.peek() !== null) last = "";
        });
    }, 250);
  }
});

type OnStage = Parameters<Parameters<typeof work.run>[0]>[0];
type How = { height_m: number; model: string };

async function dropBoth(
  of: Doc,
  against: Doc | null,
  how: How,
  onStage: OnStage,
  latest: () => boolean,
): Promise<Dropped[]> {
  const first = await dropOne((await current.opened(of)).handle, of.name, true, how, onStage);
  // Nobody waits for the other one where something newer is asked for.
  if (!against || !latest()) return [first];
  return [first, await dropOne((await other.opened(against)).handle, `${against.name} (before)`, false, how, onStage)];
}

async function dropOne(
  handle: number,
  name: string,
  motion: boolean,
  { height_m, model }: How,
  onStage: OnStage,
): Promise<Dropped> {
  if (model === OWN) {
    const { answer, files } = await checker.ask<ImpactAnswer>({ do: "impact", handle, height_m, motion }, {}, onStage);
    return ofImpact(name, answer, files[0]?.bytes ?? null);
  }
  const { answer } = await checker.ask<DropAnswer>(
    { do: "drop", model, handle, heights_m: [height_m], trace: true },
    {},
    onStage,
  );
  return ofDrop(name, answer);
}

function ofDrop(name: string, answer: DropAnswer): Dropped {
  const of = answer.heights[0]!;
  const energy = of.energy;
  const energies: [string, number][] = energy
    ? [
        ["stored", energy.stored_j],
        ["dissipated", energy.dissipated_j],
        ["still moving", energy.kinetic_j],
        ["left to a rigid hit", energy.collision_j],
        ["air", energy.air_j],
      ]
    : [];
  return {
    name,
    peakG: of.peak_sensor_g,
    contactMs: of.contact_time_ms,
    travelMm: of.max_displacement_mm,
    hitMm: energy && energy.collision_j > 0 ? answer.body.gap_mm : null,
    accel: of.t_s.map((t, at) => [1000 * t, of.accel_g[at]!]),
    // A model whose ground pulls goes on after that.
    force: of.x_mm
      .map((x, at): [number, number] => [x, of.ground_n[at]!])
      .filter((_, at) => 1000 * of.t_s[at]! <= (of.contact_time_ms ?? Infinity)),
    energies,
    warnings: answer.outside.map(({ warning }) => warning),
    motion: null,
  };
}

const WORDS: Record<keyof Energies, string> = {
  stored_mj: "stored",
  relaxed_mj: "relaxed",
  friction_mj: "friction",
  kinetic_mj: "still moving",
  gravity_mj: "height",
};

/** The impact goes on as if the ground were not below the lowest body. */
function hits({ touches, at_ms, speed_m_s, gap_mm }: ImpactAnswer["heights"][number]["touches"]): string[] {
  if (!touches) return [];
  return [
    `The lowest body, ${short(gap_mm, 1)} mm above the ground, reaches it after ${short(at_ms, 1)} ms at ${short(speed_m_s, 2)} m/s. The peak does not include that impact.`,
  ];
}

function ofImpact(name: string, answer: ImpactAnswer, motion: Uint8Array<ArrayBuffer> | null): Dropped {
  const of = answer.heights[0]!;
  return {
    name,
    peakG: of.peak_sensor_g,
    contactMs: of.contact_ms,
    travelMm: of.travel_mm,
    hitMm: null,
    accel: of.moments.map(({ t_ms }, at) => [t_ms, of.sensor_g[at]!]),
    force: of.moments
      .filter(({ t_ms }) => t_ms <= (of.contact_ms ?? Infinity))
      .map(({ down_mm, ground_n }) => [down_mm, ground_n]),
    energies: (Object.keys(WORDS) as (keyof Energies)[]).map((key) => [WORDS[key], of.energy_lowest[key] / 1000]),
    warnings: hits(of.touches),
    motion,
  };
}

const accelerations = computed<Curve[]>(() =>
  (work.result.value ?? []).map(({ name, accel }, at) => ({ name, points: accel, dashed: at > 0 })),
);
/** The points that lie farther than all before them. */
function rising(points: [number, number][]): [number, number][] {
  let farthest = -Infinity;
  return points.filter(([x]) => x > farthest && ((farthest = x), true));
}

// A curve over the way is not single-valued: loading and unloading are curves of their own.
const forces = computed<Curve[]>(() =>
  (work.result.value ?? []).flatMap(({ name, force }, colour) => {
    const lowest = force.reduce((best, [x], at) => (x > force[best]![0] ? at : best), 0);
    return [
      { name: `${name}, in`, points: rising(force.slice(0, lowest + 1)), colour },
      { name: `${name}, out`, points: rising(force.slice(lowest).reverse()), colour, dashed: true },
    ];
  }),
);

export function Drop() {
  // After a failure, what was dropped before is of another height, model or frame.
  const results = work.failure.value === null ? (work.result.value ?? []) : [];
  const motion = results[0]?.motion;
  return (
    <div class="drop">
      <ModelSelect label="Model of the drop" model={model} own={[OWN, "the frame's own mechanics"]} />
      <div class="field">
        <label for="drop-height">Height</label>
        <Slider
          id="drop-height"
          name="Height"
          unit="m"
          min={0.1}
          max={3}
          step={0.05}
          value={height.value}
          onInput={(value) => (height.value = value)}
        />
      </div>
      <label>
        <input type="checkbox" checked={both} onChange={(event) => (both.value = event.currentTarget.checked)} /> with{" "}
        {pinned.value ? pinned.value.name : `the preset ${before.value.preset}`} beside it
      </label>
      <Progress of={work} words="Dropping" />
      <div class={work.running.value ? "old" : ""}>
        <div class="row" role="status">
          {results.map(({ name, peakG, contactMs, travelMm, hitMm }) => (
            <p key={name} class={`peak ${hitMm === null ? "" : "invalid"}`} data-peak={peakG}>
              <b>{short(peakG, 1)} g</b>
              <span>
                {name}
                <br />
                {travelMm !== null && `${short(travelMm, 1)} mm down, `}
                {contactMs !== null && `${short(contactMs, 1)} ms`}
                {hitMm !== null && (
                  <em>
                    Not valid: the battery hits the ground at {short(hitMm, 1)} mm. The model does not compute this hit.
                  </em>
                )}
              </span>
            </p>
          ))}
        </div>
        {results.flatMap(({ name, warnings }) =>
          warnings.map((warning) => (
            <p key={`${name} ${warning}`} class="caution">
              {results.length > 1 && `${name}: `}
              {warning}
            </p>
          )),
        )}
        {results.length > 0 && (
          <Plot title="Acceleration behind the sensor" x="t, ms" y="a, g" curves={accelerations.value} />
        )}
        {results.length > 0 && (
          <Plot title="Force of the ground over the way down" x="x, mm" y="F, N" curves={forces.value} />
        )}
        {results.map(({ name, energies }) => (
          <EnergyBar key={name} name={name} energies={energies} />
        ))}
        {motion && (
          <div class="row">
            <button
              type="button"
              disabled={work.running}
              onClick={async () => {
                showPicture();
                if (owner.value !== "drop") await showMotion("drop", motion, { slower: 5 });
                play();
              }}
            >
              {playing.value ? "Stop" : "Slow motion, 1 : 500"}
            </button>
            {owner.value === "drop" && (
              <>
                <MotionTime label="Time of the impact" />
                <span>{short(seconds.value * 10, 1)} ms</span>
                <button type="button" onClick={() => hideMotion("drop")}>
                  Close
                </button>
              </>
            )}
          </div>
        )}
      </div>
    </div>
  );
}

const SHADES = ["#3f7fd1", "#e8862e", "#2f9e62", "#b3547a", "#8a8f2b"];

function EnergyBar({ name, energies }: { name: string; energies: [string, number][] }) {
  const shown = energies.filter(([, joule]) => joule > 1e-6);
  const all = shown.reduce((sum, [, joule]) => sum + joule, 0);
  if (all <= 0) return null;
  return (
    <figure class="energy">
      <figcaption>Energy at the lowest point: {name}</figcaption>
      <svg
        viewBox="0 0 200 12"
        preserveAspectRatio="none"
        role="img"
        aria-label={shown.map(([words, joule]) => `${words} ${short(joule, 2)} J`).join(", ")}
      >
        {shown.map(([words, joule], at) => {
          const before = shown.slice(0, at).reduce((sum, [, other]) => sum + other, 0);
          return (
            <rect
              key={words}
              x={(200 * before) / all}
              width={(200 * joule) / all}
              height="12"
              fill={SHADES[at % SHADES.length]}
            />
          );
        })}
      </svg>
      <p class="legend">
        {shown.map(([words, joule], at) => (
          <span key={words}>
            <svg class="key" viewBox="0 0 1 1">
              <rect width="1" height="1" fill={SHADES[at % SHADES.length]} />
            </svg>
            {words} {short(joule, 2)} J
          </span>
        ))}
      </p>
    </figure>
  );
}
