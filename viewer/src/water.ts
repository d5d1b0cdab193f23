// The water: its surface with the waves of the run, and its bottom.

import * as THREE from "three";
import type { SceneInfo, WaterInfo } from "./format";

const WATER = 0x3f8fc4;
const GROUND = 0xb59b6a;
/** The surface has at most so many cells along each side, and so many cosines in a picture. */
const MOST_CELLS = 64;
const MOST_COSINES = 500_000;
/** It reaches beyond the machine by this share of its size. */
const MARGIN = 0.15;

/** The share of the waves at a time: they grow over the ramp. */
function share(time: number, ramp: number): number {
  if (time >= ramp) return 1;
  const s = Math.max(0, time / ramp);
  return s * s * s * (6 * s * s - 15 * s + 10);
}

/** The height of the surface above still water at a global point and a time, m. */
export function elevation({ waves, ramp }: WaterInfo, x: number, y: number, time: number): number {
  let sum = 0;
  for (const [amplitude, frequency, number, alongX, alongY, phase] of waves ?? []) sum += amplitude * Math.cos(number * (x * alongX + y * alongY) - frequency * time + phase);
  return sum * share(time, ramp);
}

/** Cells along a side of the surface: as many as so many waves allow in each picture. */
export function cells(waves: number): number {
  return waves === 0 ? 1 : Math.max(8, Math.min(MOST_CELLS, Math.floor(Math.sqrt(MOST_COSINES / waves)) - 1));
}

export class Water {
  readonly group = new THREE.Group();
  private readonly surface?: THREE.Mesh;
  private readonly scene: SceneInfo;

  /** `box` holds all that is ever seen. */
  constructor(scene: SceneInfo, box: THREE.Box3) {
    this.scene = scene;
    const { water } = scene;
    if (!water) return;
    const size = box.getSize(new THREE.Vector3());
    const margin = MARGIN * size.length();
    const middle = box.getCenter(new THREE.Vector3());
    const [wide, long] = [size.x + 2 * margin, size.y + 2 * margin];
    const count = cells(water.waves?.length ?? 0);
    const plane = (geometry: THREE.PlaneGeometry, color: number, opacity: number) => {
      const material = new THREE.MeshStandardMaterial({ color, roughness: 0.35, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false });
      const mesh = new THREE.Mesh(geometry.translate(middle.x, middle.y, 0), material);
      this.group.add(mesh);
      return mesh;
    };
    this.surface = plane(new THREE.PlaneGeometry(wide, long, count, count), WATER, 0.3);
    this.surface.renderOrder = 1;
    this.surface.frustumCulled = false;
    if (water.bottom) {
      const { height, slope } = water.bottom;
      const ground = plane(new THREE.PlaneGeometry(wide, long, 1, 1), GROUND, 0.55);
      const places = ground.geometry.attributes.position as THREE.BufferAttribute;
      for (let at = 0; at < places.count; at++) places.setZ(at, height + slope[0] * places.getX(at) + slope[1] * places.getY(at));
      ground.geometry.computeVertexNormals();
    }
    this.update(0);
  }

  /** Shows the surface at a time, s. */
  update(time: number): void {
    const { water, origin } = this.scene;
    if (!this.surface || !water) return;
    const places = this.surface.geometry.attributes.position as THREE.BufferAttribute;
    for (let at = 0; at < places.count; at++) places.setZ(at, water.surface + elevation(water, places.getX(at) + origin[0], places.getY(at) + origin[1], time));
    places.needsUpdate = true;
    this.surface.geometry.computeVertexNormals();
  }
}
