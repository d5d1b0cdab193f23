// Ropes over sheaves: their spans and arcs as thin rods from point to point.

import * as THREE from "three";
import type { Data } from "./data";
import type { Moment } from "./moment";

const COLOR = 0x6d5a3c;
/** A rope is drawn at least this thick, as a share of the machine's size. */
const THINNEST = 0.0025;

const X = new THREE.Vector3(1, 0, 0);
const from = new THREE.Vector3();
const to = new THREE.Vector3();
const turn = new THREE.Quaternion();
const size = new THREE.Vector3();
const matrix = new THREE.Matrix4();

export class Ropes {
  readonly group = new THREE.Group();
  private readonly pieces: THREE.InstancedMesh;

  /** `extent` is that of the machine, m. */
  constructor(private readonly data: Data, private readonly extent: number) {
    const count = this.ropes.reduce((sum, { points }) => sum + points[1] - points[0] - 1, 0);
    const rod = new THREE.CylinderGeometry(1, 1, 1, 8, 1, true).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
    this.pieces = new THREE.InstancedMesh(rod, new THREE.MeshStandardMaterial({ color: COLOR, roughness: 0.8 }), count);
    this.pieces.frustumCulled = false;
    this.group.name = "ropes";
    this.group.add(this.pieces);
  }

  private get ropes() {
    return this.data.scene.ropes ?? [];
  }

  update({ parts }: Moment): void {
    const places = parts["rope.place"];
    let piece = 0;
    for (const { radius, points } of this.ropes) {
      const thick = Math.max(radius, THINNEST * this.extent);
      for (let point = points[0]; point + 1 < points[1]; point++) {
        from.fromArray(places, 3 * point);
        to.fromArray(places, 3 * point + 3).sub(from);
        const length = to.length();
        if (length > 0) turn.setFromUnitVectors(X, to.divideScalar(length));
        this.pieces.setMatrixAt(piece++, matrix.compose(from, turn, size.set(length, thick, thick)));
      }
    }
    this.pieces.instanceMatrix.needsUpdate = true;
  }
}
