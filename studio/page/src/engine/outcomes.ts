// The shapes of what is simulated, measured and diagnosed, as far as the page reads them.

export type Bend = {
  body: string;
  hinge: string;
  from_deg: number;
  to_deg: number;
  load: { strain_percent: number } | null;
};
export type Step = {
  number: number;
  title: string;
  text: string;
  caution: string | null;
  tool: string;
  minutes: number;
  repeats: number;
  bends: Bend[];
  joins: { body: string; onto: string; left_out_mm: number }[];
};
export type Fold = { minutes: number; step_shown_s: number; steps: Step[] };

export type DropAnswer = {
  model: string;
  body: { mass_kg: number; gap_mm: number; from: string };
  heights: {
    height_m: number;
    /** None where the run diverges. */
    peak_sensor_g: number | null;
    peak_proper_g: number | null;
    contact_time_ms: number | null;
    max_displacement_mm: number | null;
    energy: {
      input_j: number;
      stored_j: number;
      dissipated_j: number;
      kinetic_j: number;
      collision_j: number;
      air_j: number;
    } | null;
    t_s: number[];
    accel_g: number[];
    x_mm: number[];
    ground_n: number[];
  }[];
  outside: { warning: string }[];
};

export type Moment = { t_ms: number; down_mm: number; up_m_s: number; proper_g: number; ground_n: number };
export type Energies = {
  kinetic_mj: number;
  stored_mj: number;
  relaxed_mj: number;
  friction_mj: number;
  gravity_mj: number;
};
export type ImpactAnswer = {
  heights: {
    height_m: number;
    peak_sensor_g: number;
    peak_proper_g: number;
    travel_mm: number;
    contact_ms: number | null;
    /** Whether the lowest body reaches the ground, and when. */
    touches: { touches: boolean; at_ms: number | null; speed_m_s: number | null; gap_mm: number };
    energy_lowest: Energies;
    moments: Moment[];
    sensor_g: number[];
  }[];
};

export type Measured = {
  heights: {
    height_m: number;
    drops: number;
    clean: number;
    frame: string | null;
    clean_peak_axial_g: { median: number } | null;
  }[];
  drops: {
    trial: string;
    height_m: number;
    frame: string | null;
    source: string;
    peak_axial_g?: number | null;
    restitution?: number | null;
    flags: { flag: string; reason: string }[];
  }[];
  notes: string[];
};

export type Estimate = { value: number; unit: string; ci95: [number, number] };
export type Diagnosed = {
  verdict: "named" | "ambiguous" | "none_suffices" | "nothing_missing";
  reasons: string[];
  /** The model, its body, and its own parameters as they were refitted. */
  base: { model: string; body: { mass_kg: number; gap_mm: number; from: string }; after: Record<string, Estimate> };
  effects: { id: string; parameters: Record<string, Estimate> }[];
  held_out_heights_m: number[];
  gap: {
    before: number;
    after: number;
    floor: number;
    held_out_before: number;
    held_out_after: number;
    held_out_floor: number;
    unit: string;
  };
  ranking: { id: string; score: number; left_out_g: number | null; reason_rejected: string | null }[];
  where: {
    cells: { height_m: number; phase: string; residual_g?: number; apart_g?: number; error_g: number }[];
    worst: Worst | null;
  };
  next_experiment: { what: string; between: string[] } | null;
  left_out: { trial: string; reason: string }[];
};
type Worst = { height_m: number; t_ms: number; measured_g: number; model_g: number; phase: string };
