// Everything as it is at one instant, also between two recorded ones: what the scene draws.

import type { Data, Mode, Track } from "./data";

/** An instant as a place between two recorded ones. */
export interface Between {
  first: number;
  second: number;
  share: number;
}

/** Where `time` lies among the recorded instants. */
export function between(times: Float64Array, time: number): Between {
  let low = 0;
  let high = times.length - 1;
  if (time <= times[low]) return { first: low, second: low, share: 0 };
  if (time >= times[high]) return { first: high, second: high, share: 0 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return { first: low, second: high, share: (time - times[low]) / (times[high] - times[low]) };
}

/** The numbers of a track at an instant; those of two are mixed linearly, quaternions made as long as they must be. */
export function mix(track: Track | undefined, at: Between, out?: Float32Array): Float32Array {
  if (!track) return out ?? new Float32Array();
  const width = track.components * track.things;
  const result = out && out.length === width ? out : new Float32Array(width);
  const [a, b] = [at.first * width, at.second * width];
  for (let place = 0; place < width; place++) {
    const begin = track.values[a + place];
    result[place] = begin + at.share * (track.values[b + place] - begin);
  }
  if (track.components === 4) normalize(result);
  return result;
}

function normalize(turns: Float32Array): void {
  for (let at = 0; at < turns.length; at += 4) {
    const length = Math.hypot(turns[at], turns[at + 1], turns[at + 2], turns[at + 3]) || 1;
    for (let part = 0; part < 4; part++) turns[at + part] /= length;
  }
}

/** The names of what a moment has of the tracks. */
const NAMES = [
  "station.place", "station.turn", "body.place", "body.turn", "frame.place", "frame.turn", "joint.place", "joint.turn",
  "joint.a", "joint.b", "joint.force", "joint.moment", "spring.a", "spring.b", "load.place", "load.force", "load.moment", "point.place", "surface.place", "surface.turn", "rope.place",
] as const;

export type MomentName = (typeof NAMES)[number];

/** Numbers of all things at one instant, in buffers that are used again. */
export class Moment {
  readonly parts: Record<MomentName, Float32Array>;

  constructor(private readonly data: Data) {
    this.parts = Object.fromEntries(NAMES.map((name) => [name, new Float32Array()])) as Record<MomentName, Float32Array>;
  }

  /** Takes the instant, with displacements of beams and bodies from the drawing magnified. */
  set(at: Between, magnification: number, tracks = this.data.tracks): void {
    for (const name of NAMES) this.parts[name] = mix(tracks.get(name), at, this.parts[name]);
    if (magnification !== 1) magnify(this.parts["station.place"], this.data.drawn.place, magnification);
  }

  /** Takes the first instant, with the stations and bodies moved by `amount` of a natural mode. */
  setMode(mode: Mode, amount: number): void {
    this.set({ first: 0, second: 0, share: 0 }, 1);
    swing(this.parts["station.place"], this.parts["station.turn"], mode.stations, amount);
    swing(this.parts["body.place"], this.parts["body.turn"], mode.bodies, amount);
    for (const [name, track] of mode.places) {
      const places = this.parts[name as MomentName];
      for (let at = 0; at < places.length; at++) places[at] += amount * track.values[at];
    }
  }
}

/** Moves places away from those as drawn. */
function magnify(places: Float32Array, drawn: Float32Array, factor: number): void {
  for (let at = 0; at < places.length; at++) places[at] = drawn[at] + factor * (places[at] - drawn[at]);
}

function swing(places: Float32Array, turns: Float32Array, motion: { place: Track; turn: Track }, amount: number): void {
  for (let at = 0; at < places.length; at++) places[at] += amount * motion.place.values[at];
  for (let thing = 0; thing * 4 < turns.length; thing++) {
    const [x, y, z] = [0, 1, 2].map((axis) => amount * motion.turn.values[3 * thing + axis]);
    turnBy(turns, 4 * thing, x, y, z);
  }
}

/** Turns the quaternion `w x y z` at `at` by the rotation vector `x y z`, in space. */
export function turnBy(turns: Float32Array, at: number, x: number, y: number, z: number): void {
  const angle = Math.hypot(x, y, z);
  if (angle === 0) return;
  const factor = Math.sin(angle / 2) / angle;
  const [a, b, c, d] = [Math.cos(angle / 2), factor * x, factor * y, factor * z];
  const [w, i, j, k] = [turns[at], turns[at + 1], turns[at + 2], turns[at + 3]];
  turns[at] = a * w - b * i - c * j - d * k;
  turns[at + 1] = a * i + b * w + c * k - d * j;
  turns[at + 2] = a * j - b * k + c * w + d * i;
  turns[at + 3] = a * k + b * j - c * i + d * w;
}
