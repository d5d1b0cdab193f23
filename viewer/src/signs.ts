// Signs of what is no beam: bodies, joints, springs, frames, loads, measured points.

import * as THREE from "three";
import type { Data } from "./data";
import type { Moment } from "./moment";
import type { Solid } from "./format";
import { Springs } from "./springs";

const X = new THREE.Vector3(1, 0, 0);
const COLORS = { body: 0xd8892b, joint: 0x5b6473, ground: 0x8c6d46, force: 0xd63a3a, moment: 0x9a4fd0, reaction: 0x1f9e9e, point: 0x101418, surface: 0x7a8699 };
/** Opacity of a body. */
const THROUGH = 0.5;

/** Lets a thing be at place number `at` of `places`, turned as `turns` says. */
function put(thing: THREE.Object3D, at: number, places: Float32Array, turns?: Float32Array): void {
  thing.position.fromArray(places, 3 * at);
  if (turns) thing.quaternion.set(turns[4 * at + 1], turns[4 * at + 2], turns[4 * at + 3], turns[4 * at]);
}

function matt(color: number, opacity = 1): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ color, roughness: 0.6, transparent: opacity < 1, opacity });
}

/** Gives a thing its name in files. */
function titled<Thing extends THREE.Object3D>(thing: Thing, name: string): Thing {
  thing.name = name;
  return thing;
}

/** All signs; they know by themselves where they are. */
export class Signs {
  readonly bodies = new THREE.Group();
  readonly joints = new THREE.Group();
  readonly loads = new THREE.Group();
  readonly reactions = new THREE.Group();
  readonly points = new THREE.Group();
  private readonly coils: Springs;
  private readonly arms: THREE.LineSegments;
  private readonly frames: THREE.Object3D[];
  private readonly surfaces: THREE.Object3D[];
  private readonly forces: Arrow[][];
  private readonly largest: Record<"force" | "line" | "moment" | "lineMoment" | "reaction" | "reactionMoment", number>;

  /** `size` is the extent of the machine, m; `up` points against gravity. */
  constructor(private readonly data: Data, private readonly size: number, up: THREE.Vector3) {
    const { scene } = data;
    for (const { name, solid: shape } of scene.bodies) this.bodies.add(titled(solid(shape, size), name));
    for (const { name, kind, grounded } of scene.joints) this.joints.add(titled(jointSign(kind, grounded, 0.016 * size, up), name));
    this.coils = new Springs(data, size);
    this.frames = scene.frames.map(() => new THREE.AxesHelper(0.09 * size));
    for (const frame of this.frames) this.joints.add(frame);
    this.surfaces = (scene.surfaces ?? []).map(({ corners, faces }) => surfaceSign(corners, faces));
    // The bottom of the water is drawn as wide as the water.
    this.surfaces.forEach((surface, k) => (surface.visible = !scene.surfaces![k].bottom));
    for (const surface of this.surfaces) this.joints.add(surface);
    const arms = new THREE.BufferGeometry();
    arms.setAttribute("position", new THREE.BufferAttribute(new Float32Array(12 * scene.joints.length), 3));
    this.arms = new THREE.LineSegments(arms, new THREE.LineBasicMaterial({ color: 0x8a94a6 }));
    this.arms.frustumCulled = false;
    this.joints.add(this.arms);
    const dot = new THREE.SphereGeometry(0.006 * size, 12, 8);
    for (const _ of scene.points) this.points.add(new THREE.Mesh(dot, matt(COLORS.point)));
    const arrows = (count: number, color: number, heads: number, group: THREE.Group) =>
      Array.from({ length: count }, () => new Arrow(color, heads, 0.004 * size, group));
    const count = data.tracks.get("load.place")?.things ?? 0;
    const transmitted = data.tracks.has("joint.force") ? scene.joints.length : 0;
    this.forces = [
      arrows(count, COLORS.force, 1, this.loads),
      arrows(count, COLORS.moment, 2, this.loads),
      arrows(transmitted, COLORS.reaction, 1, this.reactions),
      arrows(transmitted, COLORS.moment, 2, this.reactions),
    ];
    this.reactions.visible = false;
    const lines = scene.loads.flatMap((load) => Array.from({ length: load.arrows[1] - load.arrows[0] }, () => load.line));
    const points = lines.map((line) => !line);
    this.largest = {
      force: largest(data, "load.force", points),
      line: largest(data, "load.force", lines),
      moment: largest(data, "load.moment", points),
      lineMoment: largest(data, "load.moment", lines),
      reaction: largest(data, "joint.force"),
      reactionMoment: largest(data, "joint.moment"),
    };
    this.isLine = lines;
  }

  private readonly isLine: boolean[];

  get springs(): THREE.Group {
    return this.coils.group;
  }

  update(moment: Moment): void {
    const { parts } = moment;
    this.coils.update(moment);
    this.bodies.children.forEach((body, k) => put(body, k, parts["body.place"], parts["body.turn"]));
    this.data.scene.joints.forEach((_, k) => put(this.joints.children[k], k, parts["joint.place"], parts["joint.turn"]));
    this.data.scene.joints.forEach((_, k) => upright(this.joints.children[k]));
    this.frames.forEach((frame, k) => put(frame, k, parts["frame.place"], parts["frame.turn"]));
    this.surfaces.forEach((surface, k) => put(surface, k, parts["surface.place"], parts["surface.turn"]));
    this.points.children.forEach((point, k) => put(point, k, parts["point.place"]));
    const ends = this.arms.geometry.attributes.position as THREE.BufferAttribute;
    this.data.scene.joints.forEach((_, k) => {
      for (const [side, from] of [parts["joint.a"], parts["joint.b"]].entries()) {
        for (let axis = 0; axis < 3; axis++) {
          ends.array[12 * k + 6 * side + axis] = from[3 * k + axis];
          ends.array[12 * k + 6 * side + 3 + axis] = parts["joint.place"][3 * k + axis];
        }
      }
    });
    ends.needsUpdate = true;
    const length = 0.2 * this.size;
    const [forces, moments, reactions, reactionMoments] = this.forces;
    forces.forEach((arrow, k) => arrow.set(parts["load.place"], parts["load.force"], k, length / (this.isLine[k] ? 2 * this.largest.line : this.largest.force)));
    moments.forEach((arrow, k) => arrow.set(parts["load.place"], parts["load.moment"], k, length / (this.isLine[k] ? 2 * this.largest.lineMoment : this.largest.moment)));
    reactions.forEach((arrow, k) => arrow.set(parts["joint.place"], parts["joint.force"], k, length / this.largest.reaction));
    reactionMoments.forEach((arrow, k) => arrow.set(parts["joint.place"], parts["joint.moment"], k, length / this.largest.reactionMoment));
  }
}

/** The largest vector of a track over the run, of the things that count; 1 where there is none. */
function largest(data: Data, name: string, counts?: boolean[]): number {
  const track = data.tracks.get(name);
  let most = 0;
  for (let at = 0; track && at < track.values.length; at += 3) {
    if (counts && !counts[(at / 3) % track.things]) continue;
    most = Math.max(most, Math.hypot(track.values[at], track.values[at + 1], track.values[at + 2]));
  }
  return most || 1;
}

function solid(shape: Solid, size: number): THREE.Mesh {
  // What is too small to be seen is drawn larger; nothing is infinitely thin.
  const extents = shape.shape === "box" ? shape.edges : [2 * shape.radius, shape.length];
  const factor = Math.max(1, (0.03 * size) / Math.max(...extents, 1e-12 * size));
  const least = 0.006 * size;
  const grown = (extent: number) => Math.max(least, factor * extent);
  let geometry: THREE.BufferGeometry;
  if (shape.shape === "box") geometry = new THREE.BoxGeometry(...(shape.edges.map(grown) as [number, number, number]));
  else {
    geometry = new THREE.CylinderGeometry(grown(shape.radius), grown(shape.radius), grown(shape.length), 48);
    // three.js draws it along y.
    if (shape.axis === 0) geometry.rotateZ(-Math.PI / 2);
    if (shape.axis === 2) geometry.rotateX(Math.PI / 2);
  }
  // A beam inside or behind is seen through it; the edges keep its shape.
  const material = matt(COLORS.body, THROUGH);
  material.depthWrite = false;
  const mesh = new THREE.Mesh(geometry, material);
  mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 30), new THREE.LineBasicMaterial({ color: 0x6b4310 })));
  return mesh;
}

/** A surface, seen from both sides and through. */
function surfaceSign(corners: number[][], faces: number[][]): THREE.Mesh {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners.flat(), 3));
  geometry.setIndex(faces.flatMap((face) => face.slice(2).flatMap((corner, k) => [face[0], face[k + 1], corner])));
  geometry.computeVertexNormals();
  const material = matt(COLORS.surface, 0.35);
  material.side = THREE.DoubleSide;
  material.depthWrite = false;
  const mesh = new THREE.Mesh(geometry, material);
  mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 30), new THREE.LineBasicMaterial({ color: COLORS.surface })));
  return mesh;
}

function jointSign(kind: string, grounded: boolean, size: number, up: THREE.Vector3): THREE.Group {
  const sign = new THREE.Group();
  const add = (geometry: THREE.BufferGeometry, color = COLORS.joint) => sign.add(new THREE.Mesh(geometry, matt(color)));
  const rod = (radius: number, length: number) => new THREE.CylinderGeometry(radius, radius, length, 20).rotateZ(Math.PI / 2);
  if (kind === "weld") add(new THREE.BoxGeometry(1.6 * size, 1.6 * size, 1.6 * size), grounded ? COLORS.ground : COLORS.joint);
  else if (kind === "revolute") add(rod(0.7 * size, 2.2 * size));
  else if (kind === "cylindrical") {
    add(rod(0.55 * size, 4 * size));
    add(rod(0.85 * size, 1.4 * size));
  } else if (kind === "prismatic") {
    add(new THREE.BoxGeometry(4 * size, 0.7 * size, 0.7 * size));
    add(new THREE.BoxGeometry(1.4 * size, 1.3 * size, 1.3 * size));
  } else if (kind === "universal") {
    add(rod(0.4 * size, 2.6 * size));
    add(new THREE.CylinderGeometry(0.4 * size, 0.4 * size, 2.6 * size, 20));
  } else if (kind === "inline") {
    add(rod(0.3 * size, 5 * size));
    add(new THREE.SphereGeometry(0.8 * size, 20, 14));
  } else if (kind === "inplane") {
    add(new THREE.BoxGeometry(0.15 * size, 4 * size, 4 * size));
    add(new THREE.SphereGeometry(0.6 * size, 20, 14));
  } else if (kind === "bushing") add(new THREE.TorusGeometry(0.9 * size, 0.4 * size, 12, 24));
  else add(new THREE.SphereGeometry(0.9 * size, 24, 16));
  if (grounded && kind !== "weld") {
    // A support: a cone that stands on a plate, below the joint whatever its axis is.
    const support = new THREE.Group();
    const cone = new THREE.Mesh(new THREE.ConeGeometry(1.5 * size, 2.4 * size, 4), matt(COLORS.ground, 0.85));
    cone.position.y = -1.2 * size;
    const plate = new THREE.Mesh(new THREE.BoxGeometry(3.6 * size, 0.3 * size, 3.6 * size), matt(COLORS.ground));
    plate.position.y = -2.5 * size;
    support.add(cone, plate);
    support.userData = { upright: new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), up) };
    sign.add(support);
  }
  return sign;
}

/** Turns the support of a joint back: it stands upright whatever the joint does. */
function upright(sign: THREE.Object3D): void {
  for (const part of sign.children) {
    if (part.userData.upright) part.quaternion.copy(sign.quaternion).invert().multiply(part.userData.upright);
  }
}

const to = new THREE.Vector3();

/** An arrow that begins at a point; a moment has two heads. */
class Arrow {
  private readonly shaft: THREE.Mesh;
  private readonly heads: THREE.Mesh[];
  private readonly whole = new THREE.Group();

  constructor(color: number, heads: number, private readonly radius: number, group: THREE.Group) {
    const material = matt(color);
    this.shaft = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, 1, 12).rotateZ(-Math.PI / 2).translate(0.5, 0, 0), material);
    const cone = new THREE.ConeGeometry(2.6 * radius, 7 * radius, 16).rotateZ(-Math.PI / 2).translate(-3.5 * radius, 0, 0);
    this.heads = Array.from({ length: heads }, () => new THREE.Mesh(cone, material));
    this.whole.add(this.shaft, ...this.heads);
    group.add(this.whole);
  }

  set(places: Float32Array, vectors: Float32Array, k: number, scale: number): void {
    to.fromArray(vectors, 3 * k);
    const length = scale * to.length();
    this.whole.visible = length > this.radius;
    if (!this.whole.visible) return;
    this.whole.position.fromArray(places, 3 * k);
    this.whole.quaternion.setFromUnitVectors(X, to.normalize());
    const head = Math.min(1, length / (8 * this.radius * this.heads.length));
    this.shaft.scale.set(Math.max(length - 6 * this.radius * head, 1e-9), 1, 1);
    this.heads.forEach((cone, number) => {
      cone.scale.setScalar(head);
      cone.position.x = length - 5 * this.radius * head * number;
    });
  }
}
