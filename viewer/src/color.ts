// What beams are colored by: quantities, ranges, and the colors themselves.

import type { Data } from "./data";
import { mix, type Between } from "./moment";

/** A quantity to color by. */
export interface Quantity {
  word: string;
  label: string;
  unit: string;
  /** Whether it has two signs: the colors then have a neutral middle at 0. */
  signed: boolean;
  /** The tracks whose length (root of the sum of squares) it is; a single one is taken as it is. */
  from: string[];
}

export const QUANTITIES: Quantity[] = [
  { word: "stress", label: "Stress (von Mises)", unit: "Pa", signed: false, from: ["stress"] },
  { word: "axial_force", label: "Axial force", unit: "N", signed: true, from: ["axial_force"] },
  { word: "shear_force", label: "Shear force", unit: "N", signed: false, from: ["shear_y", "shear_z"] },
  { word: "bending_moment", label: "Bending moment", unit: "N.m", signed: false, from: ["moment_y", "moment_z"] },
  { word: "moment_y", label: "Moment about y", unit: "N.m", signed: true, from: ["moment_y"] },
  { word: "moment_z", label: "Moment about z", unit: "N.m", signed: true, from: ["moment_z"] },
  { word: "torque", label: "Torque", unit: "N.m", signed: true, from: ["torque"] },
  { word: "curvature", label: "Curvature", unit: "1/m", signed: false, from: ["curvature_y", "curvature_z"] },
  { word: "torsion", label: "Twist rate", unit: "rad/m", signed: true, from: ["torsion"] },
  { word: "axial_strain", label: "Axial strain", unit: "", signed: true, from: ["axial_strain"] },
  { word: "speed", label: "Speed", unit: "m/s", signed: false, from: ["speed"] },
];

/** The values of a quantity at all stations at an instant; without a value where the beam has none. */
export function values(data: Data, quantity: Quantity, at: Between): Float32Array {
  const parts = quantity.from.map((name) => mix(data.tracks.get(name), at));
  const result = parts[0].slice();
  if (parts.length > 1) result.forEach((value, place) => (result[place] = Math.hypot(value, parts[1][place])));
  blank(data, quantity, result);
  return result;
}

/** Not-a-number at the stations of beams without an outline, which have no stress. */
function blank(data: Data, quantity: Quantity, values: Float32Array): void {
  if (quantity.word !== "stress") return;
  for (const beam of data.scene.beams) if (!beam.stress) values.fill(NaN, ...beam.stations);
}

/** Smallest and largest value of a quantity at an instant, or over the run. */
export function range(data: Data, quantity: Quantity, at?: Between): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  const take = (list: Float32Array) => {
    for (const value of list) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  };
  if (at) take(values(data, quantity, at));
  else data.times.forEach((_, instant) => take(values(data, quantity, { first: instant, second: instant, share: 0 })));
  if (!(low <= high)) return [0, 0];
  return quantity.signed ? symmetric(low, high) : [Math.min(0, low), high];
}

/** A range about 0: the neutral color then means nothing acts. */
function symmetric(low: number, high: number): [number, number] {
  const most = Math.max(Math.abs(low), Math.abs(high));
  return [-most, most];
}

export type Rgb = [number, number, number];

// Turbo would shout; viridis for sizes, blue to red through gray for signs: both can be told apart without seeing all colors.
const SEQUENTIAL: Rgb[] = [[72, 58, 140], [60, 82, 148], [50, 105, 145], [39, 127, 142], [31, 161, 135], [74, 193, 109], [160, 218, 57], [253, 231, 37]];
const DIVERGING: Rgb[] = [[33, 72, 160], [67, 118, 200], [128, 170, 226], [186, 204, 224], [206, 206, 206], [236, 190, 170], [226, 130, 104], [200, 68, 60], [150, 18, 40]];

/** The color of a value in a range, each part from 0 to 1; gray where there is no value. */
export function color(value: number, [low, high]: [number, number], signed: boolean): Rgb {
  if (Number.isNaN(value)) return [0.55, 0.57, 0.6];
  const scale = signed ? DIVERGING : SEQUENTIAL;
  const share = high > low ? Math.min(1, Math.max(0, (value - low) / (high - low))) : signed ? 0.5 : 0;
  const place = share * (scale.length - 1);
  const index = Math.min(scale.length - 2, Math.floor(place));
  const [a, b] = [scale[index], scale[index + 1]];
  return [0, 1, 2].map((part) => (a[part] + (place - index) * (b[part] - a[part])) / 255) as Rgb;
}

/** The scale as a CSS gradient from bottom to top. */
export function gradient(signed: boolean): string {
  const scale = signed ? DIVERGING : SEQUENTIAL;
  return `linear-gradient(to top, ${scale.map((parts) => `rgb(${parts.join(" ")})`).join(", ")})`;
}

const PREFIXES: [number, string][] = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"]];

/** A number with unit, with four digits and a prefix where that is shorter. */
export function quantityText(value: number, unit: string, digits = 4): string {
  if (Number.isNaN(value)) return "unknown";
  const shown = unit.replace(".", "·").replace(/(\D)([23])/g, (_, letter, power) => letter + (power === "2" ? "²" : "³"));
  if (value === 0) return `0 ${shown}`.trim();
  const size = Math.abs(value);
  const takesPrefix = unit !== "" && !unit.startsWith("1/") && !unit.startsWith("kg");
  const [factor, prefix] = (takesPrefix && PREFIXES.find(([least]) => size >= least * 0.9995)) || [1, ""];
  const scaled = value / factor;
  const plain = Math.abs(scaled) >= 1e-3 && Math.abs(scaled) < 1e5;
  const text = plain ? String(Number(scaled.toPrecision(digits))) : scaled.toExponential(digits - 1);
  return `${text.replace("-", "−")} ${prefix}${shown}`.trim();
}

/** A number as it is, without a prefix: beside an axis that is labelled with the unit. */
export function plainText(value: number, digits = 4): string {
  const plain = value === 0 || (Math.abs(value) >= 1e-3 && Math.abs(value) < 1e5);
  return (plain ? String(Number(value.toPrecision(digits))) : value.toExponential(digits - 1)).replace("-", "−");
}
