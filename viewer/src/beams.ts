// Beams in the scene: swept surfaces, their colors, the drawing as a ghost.

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { color, type Quantity } from "./color";
import type { Data } from "./data";
import { outline, sweep, thinnest, triangles, vertices, type Outline } from "./sweep";

interface Skin {
  mesh: THREE.Mesh;
  axis: Axis;
  ghost: THREE.Mesh;
  shape: Outline;
  sizes?: [number, number][];
  stations: [number, number];
}

const PLAIN = 0x3b7dd8;

/** The axis of a beam as a line of a width in pixels: pieces from station to station. */
class Axis {
  readonly line: LineSegments2;
  private readonly places: THREE.InterleavedBuffer;
  private readonly colors: THREE.InterleavedBuffer;

  constructor(private readonly count: number, material: LineMaterial) {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(6 * (count - 1)));
    geometry.setColors(new Float32Array(6 * (count - 1)));
    this.places = (geometry.attributes.instanceStart as THREE.InterleavedBufferAttribute).data;
    this.colors = (geometry.attributes.instanceColorStart as THREE.InterleavedBufferAttribute).data;
    this.line = new LineSegments2(geometry, material);
  }

  place(places: Float32Array, first: number): void {
    for (let piece = 0; piece + 1 < this.count; piece++) {
      this.places.array.set(places.subarray(3 * (first + piece), 3 * (first + piece) + 6), 6 * piece);
    }
    this.places.needsUpdate = true;
  }

  /** Colors a station: the end of one piece and the beginning of the next. */
  color(station: number, ...rgb: [number, number, number]): void {
    if (station > 0) this.colors.array.set(rgb, 6 * station - 3);
    if (station + 1 < this.count) this.colors.array.set(rgb, 6 * station);
  }

  finish(): void {
    this.colors.needsUpdate = true;
  }
}

export class Beams {
  readonly group = new THREE.Group();
  readonly ghosts = new THREE.Group();
  private readonly skins: Skin[];
  private readonly material: THREE.MeshStandardMaterial;
  private readonly plain: THREE.Color;
  private readonly faint = new THREE.MeshBasicMaterial({ color: 0x8a94a6, transparent: true, opacity: 0.22, depthWrite: false, side: THREE.DoubleSide });
  /** So wide, in pixels, that a rope far away is still seen. */
  private readonly hair = new LineMaterial({ vertexColors: true, linewidth: 2.4 });

  /** `look` has the color without a quantity, and how else beams are drawn. */
  constructor(private readonly data: Data, private scale: number, look: THREE.MeshStandardMaterialParameters = {}) {
    const { color = PLAIN, ...others } = look;
    this.plain = new THREE.Color(color);
    this.material = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.55, metalness: 0.1, side: THREE.DoubleSide, ...others });
    this.skins = data.scene.beams.map((beam, number) => {
      const shape = outline(beam.profile);
      const count = beam.stations[1] - beam.stations[0];
      const body = () => {
        const geometry = new THREE.BufferGeometry();
        for (const name of ["position", "normal", "color"]) {
          geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * vertices(count, shape)), 3));
        }
        geometry.setIndex(triangles(count, shape));
        return geometry;
      };
      const mesh = new THREE.Mesh(body(), this.material);
      mesh.userData = { beam: number };
      mesh.name = beam.name;
      const axis = new Axis(count, this.hair);
      const ghost = new THREE.Mesh(body(), this.faint);
      for (const part of [mesh, axis.line, ghost]) part.frustumCulled = false;
      this.group.add(mesh, axis.line);
      this.ghosts.add(ghost);
      return { mesh, axis, ghost, shape, sizes: beam.sizes, stations: beam.stations };
    });
    this.ghosts.visible = false;
    this.setScale(scale);
    this.paint();
  }

  get meshes(): THREE.Mesh[] {
    return this.skins.map((skin) => skin.mesh);
  }

  /** How many times as thick as they are sections are drawn. */
  setScale(scale: number): void {
    this.scale = scale;
    for (const skin of this.skins) this.place(skin, skin.ghost, this.data.drawn.place, this.data.drawn.turn);
  }

  /** Draws the axes of those beams that are thinner than a few pixels, which have `meters` each. */
  thin(meters: number): void {
    this.skins.forEach(({ axis }, beam) => (axis.line.visible = this.scale * thinnest(this.data.scene.beams[beam].profile) < 3.5 * meters));
  }

  /** Where the stations are now. */
  update(places: Float32Array, turns: Float32Array): void {
    for (const skin of this.skins) {
      this.place(skin, skin.mesh, places, turns);
      skin.axis.place(places, skin.stations[0]);
    }
  }

  private place(skin: Skin, mesh: THREE.Mesh, places: Float32Array, turns: Float32Array): void {
    const { position, normal } = mesh.geometry.attributes as Record<string, THREE.BufferAttribute>;
    sweep(skin.shape, this.scale, places, turns, ...skin.stations, position.array as Float32Array, normal.array as Float32Array, skin.sizes);
    position.needsUpdate = normal.needsUpdate = true;
    // Rays look at it first.
    mesh.geometry.boundingSphere = null;
  }

  /** Colors by the values at all stations; plain without. */
  paint(values?: Float32Array, range: [number, number] = [0, 0], quantity?: Quantity): void {
    const shade = new THREE.Color();
    for (const { mesh, axis, shape, stations } of this.skins) {
      const colors = mesh.geometry.attributes.color as THREE.BufferAttribute;
      const around = shape.points.length;
      const count = stations[1] - stations[0];
      const at = (station: number) => {
        if (!values || !quantity) return shade.copy(this.plain);
        const [r, g, b] = color(values[stations[0] + station], range, quantity.signed);
        return shade.setRGB(r, g, b, THREE.SRGBColorSpace);
      };
      for (let ring = 0; ring < count + 2; ring++) {
        const station = ring < count ? ring : ring === count ? 0 : count - 1;
        const { r, g, b } = at(station);
        for (let point = 0; point < around; point++) colors.setXYZ(ring * around + point, r, g, b);
        if (ring < count) axis.color(ring, r, g, b);
      }
      colors.needsUpdate = true;
      axis.finish();
    }
  }
}
