// The shapes of the engine's answers, as far as the page reads them.

export type Presets = { frames: { name: string; text: string }[]; models: string[]; printers: string[] };

export type Parameter = {
  key: string;
  table: string;
  about: string;
  name: string;
  unit: string;
  min: number;
  max: number;
  doc: string;
  drives: string[];
  follows: string | null;
};

export type Option = {
  name: string;
  title?: string;
  size_mm?: number[];
  mass_g?: number;
  density_g_cm3?: number;
  source?: string;
};
/** Of a bought part: its kind, and whether a frame can be without it. */
export type Choice = { key: string; quantity?: number; kind?: string; optional?: boolean; of: Option[] };
export type Rule = { id: string; title: string; sentence: string };
export type Catalogue = { parameters: Parameter[]; choices: Choice[]; rules: Rule[] };

export type Read = {
  name: string;
  description: string;
  values: Record<string, number | null>;
  choices: Record<string, string>;
  stated: string[];
};

/** A frame file with values set in it, and the numbers and words that it states then, good or not. */
export type Edited = { text: string; stated: Record<string, number | string> };

export type MassLine = {
  name: string;
  kind: string;
  material: string;
  quantity: number;
  each_g: number;
  total_g: number;
  basis: string;
};
export type Masses = {
  lines: MassLine[];
  total_g: number;
  estimated_g: number;
  centre_of_mass_mm: [number, number, number];
};
export type Opened = Read & { handle: number; masses: Masses; made: [string, string, number][] };

export type Spot = { file: string; line: number; column: number; key?: string };
export type Finding = {
  rule: string;
  subject: string;
  verdict: "holds" | "violated" | "note";
  value: number;
  limit: number;
  margin: number;
  unit: string;
  message: string;
  levers: string[];
  places: Spot[];
};
export type Checked = { frames: { frame: string; violations: number; findings: Finding[] }[] };

export type Changed = {
  name: string;
  unit: string;
  reported: [string, string];
  values: [number | null, number | null];
  trend: "better" | "worse" | "neither";
};
export type Difference = {
  names: [string, string];
  parameters: Changed[];
  masses: Changed[];
  volumes: Changed[];
  measures: Changed[];
  not_compared: string[];
  broken: string[];
  mended: string[];
  peak: string;
};

export type Beds = {
  printer: { name: string; round: boolean; size_mm: [number, number]; height_mm: number };
  plates: { name: string; material: string; items: { part: string; at_mm: number[]; turn: number[] }[] }[];
};
