// Mass against its budget and size against the envelope, beside the picture.
import { computed } from "@preact/signals";
import { frame } from "../state/studio.ts";
import { short } from "../ui/words.ts";
import { shownPictures, viewer } from "../view/scene_state.ts";

const GROUPS: [string, string][] = [
  ["printed", "printed"],
  ["rod", "rods"],
  ["bought", "bought"],
  ["extra", "extra"],
];

const SIDES = ["width", "depth", "height"];
/** How far a length may be off as it is measured, mm: what is over its limit by no more keeps it, as the rule says. */
const MEASURING_MM = 0.005;

const size = computed(() => {
  void shownPictures.value;
  return viewer.value?.sizeMm() ?? null;
});

export function Gauges() {
  const of = frame.value;
  if (!of) return null;
  const budget = of.values["limits.mass_budget_g"] ?? 0;
  const total = of.masses.total_g;
  const groups = GROUPS.map(([kind, words]) => ({
    words,
    kind,
    mass: of.masses.lines.filter((line) => line.kind === kind).reduce((sum, line) => sum + line.total_g, 0),
  })).filter(({ mass }) => mass > 0);
  const width = of.values["limits.envelope_width_mm"] ?? 0;
  const limits = [width, of.values["limits.envelope_depth_mm"] ?? width, of.values["limits.envelope_height_mm"] ?? 0];
  const full = Math.max(budget, total);
  const sides = (size.value ?? []).map((side, at) => {
    const isOver = side > (limits[at] ?? 0) + MEASURING_MM;
    // What is over its limit shows it.
    return { share: side / (limits[at] || 1), isOver, words: short(side, isOver ? 2 : 1) };
  });
  return (
    <section class="gauges" aria-label="Mass and size">
      <figure class={total > budget ? "over" : ""} data-gauge="mass">
        <figcaption>
          <b>{short(total, 1)} g</b> of {short(budget, 1)} g
        </figcaption>
        <svg
          viewBox="0 0 200 12"
          preserveAspectRatio="none"
          role="img"
          aria-label={groups.map(({ words, mass }) => `${words} ${short(mass, 1)} g`).join(", ")}
        >
          {groups.map(({ kind, mass }, at) => {
            const before = groups.slice(0, at).reduce((sum, other) => sum + other.mass, 0);
            return (
              <rect
                key={kind}
                class={`kind-${kind}`}
                x={(200 * before) / full}
                y="0"
                width={(200 * mass) / full}
                height="12"
              />
            );
          })}
          <rect class="limit" x={(200 * budget) / full - 1} y="0" width="2" height="12" />
        </svg>
        <p class="legend">
          {groups.map(({ words, kind, mass }) => (
            <span key={kind}>
              <i class={`key kind-${kind}`} />
              {words} {short(mass, 1)} g
            </span>
          ))}
        </p>
      </figure>
      {size.value && (
        <figure class={sides.some(({ isOver }) => isOver) ? "over" : ""} data-gauge="size">
          <figcaption>
            <b>{sides.map(({ words }) => words).join(" × ")} mm</b> of{" "}
            {limits.map((side) => short(side, 2)).join(" × ")}
          </figcaption>
          <svg
            viewBox="0 0 200 12"
            preserveAspectRatio="none"
            role="img"
            aria-label={sides
              .map(({ words }, at) => `${SIDES[at]} ${words} mm of ${short(limits[at], 2)} mm`)
              .join(", ")}
          >
            {sides.map(({ share, isOver }, at) => (
              <rect
                key={at}
                class={isOver ? "bad" : "good"}
                x="0"
                y={at * 4}
                width={Math.min(200, 190 * share)}
                height="3"
              />
            ))}
            <rect class="limit" x="189" y="0" width="2" height="12" />
          </svg>
        </figure>
      )}
    </section>
  );
}
