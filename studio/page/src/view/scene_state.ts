// What the picture shows, as signals, and the one viewer of the page.
import { computed, effect, signal } from "@preact/signals";
import { findings, frame, picture } from "../state/studio.ts";
import { touched } from "../state/places.ts";
import type { Standing } from "../state/standing.ts";
import { standing } from "../state/standing.ts";
import type { ColourBy } from "./colours.ts";
import type { Look, Picked, Viewer } from "./viewer.ts";

export const viewer = signal<Viewer | null>(null);
export const colourBy = signal<ColourBy>("material");
export const explode = signal(0);
export const discs = signal(false);
export const envelope = signal(false);
export const centre = signal(false);
export const section = signal<Look["section"]>(null);
export const ghost = signal(false);
export const picked = signal<Picked | null>(null);
/** Parts of the parameter or the finding that is looked at. */
export const lit = signal<Set<string>>(new Set());
/** Bodies that the shown step of the assembly bends or puts on. */
export const handled = signal<ReadonlySet<string>>(new Set());
/** What the picture shows instead of the assembled frame. */
export const stage = signal<"frame" | "bed" | "motion">("frame");
/** Whether the bed is being laid. */
export const laying = signal(false);
/** The plates of the bed by name, and which is shown. */
export const plate = signal<{ of: string[]; at: number } | null>(null);

/** The worst that the checks found of each body or part. */
const standings = computed(() => {
  const worst = new Map<string, Standing>();
  if (colourBy.value !== "finding") return worst;
  const facts = frame.value ? (viewer.value?.facts() ?? []) : [];
  for (const finding of findings.value?.of ?? []) {
    for (const name of touched(finding.subject, facts)) {
      const now = standing(finding);
      if (now === "violated" || (now === "warns" && worst.get(name) !== "violated")) worst.set(name, now);
      else if (!worst.has(name)) worst.set(name, "holds");
    }
  }
  return worst;
});

export const look = computed<Look>(() => {
  const values = frame.value?.values ?? {};
  const width = values["limits.envelope_width_mm"] ?? 0;
  const depth = values["limits.envelope_depth_mm"] ?? width;
  const height = values["limits.envelope_height_mm"] ?? 0;
  const own = picked.value ? [picked.value.body.facts.name] : [];
  return {
    colourBy: colourBy.value,
    explode: explode.value,
    discs: discs.value,
    envelopeMm: envelope.value ? [width, depth, height] : null,
    centreMm: centre.value ? (frame.value?.masses.centre_of_mass_mm ?? null) : null,
    section: section.value,
    lit: new Set([...lit.value, ...own, ...handled.value]),
    standings: standings.value,
    ghost: ghost.value,
  };
});

/** Joins a viewer to the state. */
export function join(made: Viewer): void {
  viewer.value = made;
  made.onPick = (at) => (picked.value = at);
  effect(() => {
    const bytes = picture.value;
    // The viewer takes the buffer apart: it gets a copy of what others may still read.
    if (!bytes) return;
    void made.show(bytes.slice()).then(() => {
      shownPictures.value += 1;
      // What was picked is another mesh now, or none.
      if (picked.value) picked.value = made.again(picked.value);
    });
  });
  effect(() => {
    void shownPictures.value;
    made.apply(look.value);
  });
}

/** How many pictures were shown: what is measured of the picture follows from it. */
export const shownPictures = signal(0);
