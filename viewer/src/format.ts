// The data of a page, as JSON: the words of docs/viewer/data.md. crates/view/src/format.rs is the same from the other side.

export const FORMAT = 1;

/** Numbers of one kind at all instants, quantized and packed. */
export interface Packed {
  components: number;
  things: number;
  ranges: [number, number][];
  data: string;
}

export type Profile =
  | { shape: "rectangle"; width: number; height: number }
  | { shape: "ellipse"; y: number; z: number }
  | { shape: "tube"; inner: number; outer: number };

export type Solid =
  | { shape: "box"; edges: [number, number, number] }
  | { shape: "cylinder"; axis: number; radius: number; length: number };

export interface BeamInfo {
  name: string;
  profile: Profile;
  /** How many times as large as the profile sections are, along y and z, at each station; without where all are alike. */
  sizes?: [number, number][];
  stress: boolean;
  stations: [number, number];
  fractions: number[];
  nodes: number[];
  drawn: { place: Packed; turn: Packed };
}

export interface Result {
  word: string;
  unit: string;
  meaning: string;
}

export interface SceneInfo {
  name: string;
  description: string;
  dynamic: boolean;
  gravity: [number, number, number];
  /** What all places are counted from, global, m. */
  origin: [number, number, number];
  size: number;
  beams: BeamInfo[];
  bodies: { name: string; mass: number; solid: Solid }[];
  frames: string[];
  joints: { name: string; kind: string; grounded: boolean; axis: boolean }[];
  springs: string[];
  loads: { name: string; line: boolean; arrows: [number, number] }[];
  points: string[];
  /** In their own axes, m; without where there are none. */
  surfaces?: { name: string; corners: [number, number, number][]; faces: number[][]; bottom?: true }[];
  /** Their points among those of the track `rope.place`; without where there are none. */
  ropes?: { name: string; radius: number; points: [number, number] }[];
  /** Without where the mechanism is dry. */
  water?: WaterInfo;
  results: Result[];
}

export interface WaterInfo {
  /** Height of still water above the origin, m. */
  surface: number;
  /** Time in which the waves grow, s. */
  ramp: number;
  /** Amplitude, angular frequency, wave number, direction x and y, phase at the global origin. */
  waves?: [number, number, number, number, number, number][];
  /** Its height at the origin, m, and its rise along x and y. */
  bottom?: { height: number; slope: [number, number] };
}

export interface ModeInfo {
  kind: "vibration" | "free" | "unstable";
  frequency: number;
  growth: number;
  moves: string;
  stations: { place: Packed; turn: Packed };
  bodies: { place: Packed; turn: Packed };
  /** Displacements of what else is drawn, by the name of its track. */
  places: Record<string, Packed>;
}

export interface ChartsInfo {
  count: number;
  times: string;
  columns: { name: string; unit: string; data: string }[];
  groups: { name: string; unit: string; columns: number[] }[];
}

/** A second run, which the page shows together with the first one. */
export interface SecondInfo {
  /** What the two runs are called. */
  names: [string, string];
  data: PageInfo;
}

export interface PageInfo {
  format: number;
  program: string;
  scene: SceneInfo;
  notes: string[];
  times: string;
  instants: number;
  tracks: Record<string, Packed>;
  charts: ChartsInfo;
  modes: ModeInfo[];
}
