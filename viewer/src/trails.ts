// The ways of measured points: lines from the start to the present instant.

import * as THREE from "three";
import type { Data } from "./data";

const COLORS = [0xd55e00, 0x009e73, 0xcc79a7, 0x0072b2, 0x8a7a00, 0x56b4e9];

export class Trails {
  readonly group = new THREE.Group();
  private readonly lines: THREE.Line[];

  constructor(data: Data) {
    const track = data.tracks.get("point.place");
    const instants = data.times.length;
    this.lines = data.scene.points.map((_, point) => {
      const places = new Float32Array(3 * instants);
      for (let instant = 0; track && instant < instants; instant++) {
        const at = 3 * (instant * track.things + point);
        places.set(track.values.subarray(at, at + 3), 3 * instant);
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: COLORS[point % COLORS.length] }));
      line.frustumCulled = false;
      this.group.add(line);
      return line;
    });
    this.group.visible = false;
  }

  /** Shows the way up to this instant; -1: none. */
  update(instant: number): void {
    for (const line of this.lines) line.geometry.setDrawRange(0, instant + 1);
  }
}
