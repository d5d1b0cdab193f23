// A second run in the same scene and on the same time axis: its beams, bodies and springs as a tinted ghost of the first run.

import * as THREE from "three";
import { Beams } from "./beams";
import type { Data } from "./data";
import { between, Moment } from "./moment";
import { placeAt, spotAt, told } from "./pick";
import { Signs } from "./signs";

/** The tint; `--second` of style.css is the same. */
const TINT = 0xd0389a;

/** How a ghost is drawn: pushed back a little, so that it does not flicker where both runs are at the same place. */
const GHOST: THREE.MeshStandardMaterialParameters = { transparent: true, opacity: 0.5, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 };

/** What the place of a thing in the second run is added to, m: each run counts places from an origin of its own. */
export function shift({ scene, second }: Data): THREE.Vector3 {
  return second ? new THREE.Vector3(...second.data.scene.origin).sub(new THREE.Vector3(...scene.origin)) : new THREE.Vector3();
}

/** The instants of both runs' time axis: those of the first run, and those of the second one before its begin and after its end. */
export function instants({ times, second }: Data): Float64Array {
  if (!second) return times;
  const [begin, end] = [times[0], times[times.length - 1]];
  const own = second.data.times;
  return Float64Array.of(...own.filter((time) => time < begin), ...times, ...own.filter((time) => time > end));
}

export class Comparison {
  readonly group = new THREE.Group();
  private readonly data: Data;
  private readonly beams: Beams;
  private readonly signs: Signs;
  private readonly moment: Moment;
  private time = 0;

  /** `data` has a second run; `size` is the extent of the mechanism, m, and `scale` says how many times as thick as they are sections are drawn. */
  constructor(data: Data, size: number, up: THREE.Vector3, scale: number) {
    this.data = data.second!.data;
    this.beams = new Beams(this.data, scale, { color: TINT, ...GHOST });
    this.signs = new Signs(this.data, size, up);
    this.moment = new Moment(this.data);
    const ghost = new THREE.MeshStandardMaterial({ color: TINT, roughness: 0.6, ...GHOST });
    for (const group of [this.signs.bodies, this.signs.springs]) {
      group.traverse((part) => {
        if (part instanceof THREE.Mesh) part.material = ghost;
      });
    }
    this.group.add(this.beams.group, this.signs.bodies, this.signs.springs);
    this.group.position.copy(shift(data));
  }

  setScale(scale: number): void {
    this.beams.setScale(scale);
  }

  /** See `Beams.thin`. */
  thin(meters: number): void {
    this.beams.thin(meters);
  }

  /** Takes an instant; before its begin and after its end the second run stands still. */
  update(time: number, magnification: number): void {
    this.time = time;
    this.moment.set(between(this.data.times, time), magnification);
    this.beams.update(this.moment.parts["station.place"], this.moment.parts["station.turn"]);
    this.signs.update(this.moment);
  }

  /** Global position, m, and results of the second run at a fraction of the beam with this name; none if it has no such beam. */
  told(name: string, fraction: number): { place: number[]; results: Map<string, number> } | undefined {
    const { scene, times } = this.data;
    const number = scene.beams.findIndex((beam) => beam.name === name);
    if (number < 0) return undefined;
    const spot = spotAt(scene.beams[number], number, fraction);
    const place = placeAt(this.moment.parts["station.place"], spot).toArray().map((part, axis) => part + scene.origin[axis]);
    return { place, results: new Map(told(this.data, spot, between(times, this.time)).map(({ word, value }) => [word, value])) };
  }
}
