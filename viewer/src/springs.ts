// Springs between two points: a short coil in the middle of a straight wire, so that many of them hide nothing. All springs are drawn in two calls.

import * as THREE from "three";
import type { Data } from "./data";
import type { Moment } from "./moment";

const COLOR = 0x2f9e63;
/** So many springs are drawn at full size; many would hide what they hold. */
const FULL_SIZED = 12;
/** Radius of a coil of full size, and of its wire: as shares of the mechanism's size and of the coil. */
const RADIUS = 0.018;
const WIRE = 0.12;
/** A coil is as long as so many of its radii, as drawn, or as this share of a short spring; it stretches with the spring. */
const COIL = 14;
const SHORT = 0.8;
/** Springs that are longer than so many times the mechanism have no coil. */
const LONGEST_COIL = 2;
const TURNS = 7;
const STEPS = 10 * TURNS;

const X = new THREE.Vector3(1, 0, 0);
const from = new THREE.Vector3();
const along = new THREE.Vector3();
const turn = new THREE.Quaternion();
const size = new THREE.Vector3();
const matrix = new THREE.Matrix4();

export class Springs {
  readonly group = new THREE.Group();
  private readonly coils: THREE.InstancedMesh;
  private readonly wires: THREE.BufferAttribute;
  private readonly length: number;
  /** The share of each spring that its coil takes. */
  private readonly shares: number[];

  /** `extent` is that of the mechanism, m. */
  constructor({ scene, tracks }: Data, private readonly extent: number) {
    const count = scene.springs.length;
    const radius = RADIUS * extent * Math.min(1, Math.sqrt(FULL_SIZED / Math.max(1, count)));
    this.length = COIL * radius;
    const [a, b] = ["spring.a", "spring.b"].map((name) => tracks.get(name)?.values ?? new Float32Array());
    this.shares = scene.springs.map((_, k) => {
      const drawn = Math.hypot(b[3 * k] - a[3 * k], b[3 * k + 1] - a[3 * k + 1], b[3 * k + 2] - a[3 * k + 2]);
      return Math.min(SHORT, this.length / (drawn || extent));
    });
    this.coils = new THREE.InstancedMesh(coil(radius, count > FULL_SIZED ? 3 : 6), new THREE.MeshStandardMaterial({ color: COLOR, roughness: 0.6 }), count);
    const wires = new THREE.BufferGeometry();
    this.wires = new THREE.BufferAttribute(new Float32Array(12 * count), 3);
    wires.setAttribute("position", this.wires);
    const lines = new THREE.LineSegments(wires, new THREE.LineBasicMaterial({ color: COLOR, transparent: true, opacity: 0.7 }));
    for (const part of [this.coils, lines]) part.frustumCulled = false;
    this.group.name = "springs";
    this.group.add(this.coils, lines);
  }

  update({ parts }: Moment): void {
    this.shares.forEach((whole, k) => {
      from.fromArray(parts["spring.a"], 3 * k);
      along.fromArray(parts["spring.b"], 3 * k).sub(from);
      const length = along.length();
      const share = length <= LONGEST_COIL * this.extent ? whole : 0;
      // Both ends of the wire, up to the coil.
      [0, (1 - share) / 2, (1 + share) / 2, 1].forEach((at, end) => this.wires.setXYZ(4 * k + end, from.x + at * along.x, from.y + at * along.y, from.z + at * along.z));
      from.addScaledVector(along, (1 - share) / 2);
      if (length > 0) turn.setFromUnitVectors(X, along.divideScalar(length));
      // A scale of nothing draws nothing.
      this.coils.setMatrixAt(k, matrix.compose(from, turn, size.set((share * length) / this.length, Math.sign(share), Math.sign(share))));
    });
    this.wires.needsUpdate = this.coils.instanceMatrix.needsUpdate = true;
  }
}

/** A coil along x as it is drawn, so that stretching changes its wire little; its ends come to its axis. `sides`: those of its wire. */
function coil(radius: number, sides: number): THREE.BufferGeometry {
  const points = Array.from({ length: STEPS + 1 }, (_, step) => {
    const share = step / STEPS;
    const angle = 2 * Math.PI * TURNS * share;
    const wide = radius * Math.min(1, 12 * share, 12 * (1 - share));
    return new THREE.Vector3(COIL * radius * share, wide * Math.cos(angle), wide * Math.sin(angle));
  });
  return new THREE.TubeGeometry(new THREE.CatmullRomCurve3(points), STEPS, WIRE * radius, sides);
}
