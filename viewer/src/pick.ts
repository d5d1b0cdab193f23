// A point of a beam that was clicked on: where it is, and what the section bears there.

import * as THREE from "three";
import type { BeamInfo } from "./format";
import type { Data } from "./data";
import { mix, type Between } from "./moment";

/** A place between two stations of a beam. */
export interface Spot {
  beam: number;
  /** Number of the station before it, among those of all beams. */
  station: number;
  /** How far it is from there to the next one, 0 to 1. */
  share: number;
}

/** The fraction of its beam's length at which a spot is. */
export function fraction(beam: BeamInfo, spot: Spot): number {
  const local = spot.station - beam.stations[0];
  const [a, b] = [beam.fractions[local], beam.fractions[local + 1]];
  return a + spot.share * (b - a);
}

/** The spot of a beam nearest to a point, of its axis as a chain of straight pieces. A click near a station, by pixels, means it. */
export function nearest(beam: BeamInfo, number: number, places: ArrayLike<number>, point: ArrayLike<number>): Spot {
  let best: Spot = { beam: number, station: beam.stations[0], share: 0 };
  let least = Infinity;
  for (let station = beam.stations[0]; station + 1 < beam.stations[1]; station++) {
    const at = (k: number, axis: number) => places[3 * k + axis];
    const along = [0, 1, 2].map((axis) => at(station + 1, axis) - at(station, axis));
    const apart = [0, 1, 2].map((axis) => point[axis] - at(station, axis));
    const square = along.reduce((sum, part) => sum + part * part, 0);
    // The two stations of a corner are at one place.
    if (square === 0) continue;
    const share = Math.min(1, Math.max(0, along.reduce((sum, part, axis) => sum + part * apart[axis], 0) / square));
    const distance = apart.reduce((sum, part, axis) => sum + (part - share * along[axis]) ** 2, 0);
    if (distance < least) [least, best] = [distance, { beam: number, station, share }];
  }
  return best;
}

/** The spot at a fraction of a beam's length. */
export function spotAt(beam: BeamInfo, number: number, wanted: number): Spot {
  const last = beam.fractions.length - 2;
  let local = beam.fractions.findIndex((_, k) => k <= last && beam.fractions[k + 1] > wanted);
  if (local < 0) local = last;
  const [a, b] = [beam.fractions[local], beam.fractions[local + 1]];
  return { beam: number, station: beam.stations[0] + local, share: b > a ? (wanted - a) / (b - a) : 0 };
}

/** A number of a track at a spot, between the values of its two stations. */
export function valueAt(values: ArrayLike<number>, spot: Spot, components = 1, component = 0): number {
  const at = (station: number) => values[components * station + component];
  return at(spot.station) + spot.share * (at(spot.station + 1) - at(spot.station));
}

/** Place of a spot, m. */
export function placeAt(places: ArrayLike<number>, spot: Spot): THREE.Vector3 {
  return new THREE.Vector3(...([0, 1, 2].map((axis) => valueAt(places, spot, 3, axis)) as [number, number, number]));
}

/** All that is told of a spot at an instant: label, value, unit. */
export function told(data: Data, spot: Spot, at: Between): { word: string; value: number; unit: string; meaning: string }[] {
  const beam = data.scene.beams[spot.beam];
  return data.scene.results
    .filter((result) => result.word !== "stress" || beam.stress)
    .map((result) => ({ ...result, value: valueAt(mix(data.tracks.get(result.word), at), spot) }));
}

/** The beam and point under the pointer, if there is one; `x` and `y` run from -1 to 1. */
export function under(x: number, y: number, camera: THREE.Camera, meshes: THREE.Mesh[]): { beam: number; point: THREE.Vector3 } | undefined {
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(x, y), camera);
  const hit = ray.intersectObjects(meshes, false)[0];
  return hit && { beam: hit.object.userData.beam as number, point: hit.point };
}
