// The stage: renderer, light, camera with its views, ground grid, axes in the corner, scale bar.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { shift } from "./comparison";
import type { Data } from "./data";
import type { BeamInfo, Solid } from "./format";

/** So many places of each kind tell where something is. */
const MOST_PLACES = 2000;
/** The camera goes back by this factor, and the picture down by this share of its height, so many times at most; so many pixels stay free around what covers a corner. What goes back leaves
 * more room below than the picture goes down. */
const BACK = 1.05;
const DOWN = 0.02;
const MOST_STEPS = 6;
const GAP = 16;

/** Where a camera is. */
export interface Pose {
  position: [number, number, number];
  target: [number, number, number];
  zoom: number;
  half: number;
}

/** Springs that are longer than so many times the mechanism lead out of the picture. */
const FAR_SPRING = 2;

export type View = "iso" | "front" | "side" | "top";

/** Against gravity; z of a model without gravity. */
export function upOf(gravity: [number, number, number]): THREE.Vector3 {
  const up = new THREE.Vector3(...gravity).negate();
  return up.lengthSq() > 0 ? up.normalize() : new THREE.Vector3(0, 0, 1);
}

/** What holds everything at all instants. */
export function bounds(data: Data): THREE.Box3 {
  const box = new THREE.Box3();
  const point = new THREE.Vector3();
  const take = (list: ArrayLike<number>) => {
    for (let at = 0; at + 2 < list.length; at += 3) box.expandByPoint(point.set(list[at], list[at + 1], list[at + 2]));
  };
  for (const name of ["station.place", "body.place", "joint.place", "frame.place", "rope.place"]) take(data.tracks.get(name)?.values ?? []);
  take(data.drawn.place);
  const bodies = data.tracks.get("body.place");
  data.scene.bodies.forEach(({ solid }, body) => {
    for (let at = 3 * body; bodies && at < bodies.values.length; at += 3 * bodies.things) {
      point.fromArray(bodies.values, at);
      box.expandByPoint(point.clone().addScalar(0.7 * radius(solid))).expandByPoint(point.subScalar(0.7 * radius(solid)));
    }
  });
  for (const name of ["spring.a", "spring.b"]) takeNear(box, data.tracks.get(name)?.values ?? []);
  if (box.isEmpty()) box.expandByPoint(point.set(0, 0, 0));
  if (data.second) box.union(bounds(data.second.data).translate(shift(data)));
  const size = box.getSize(new THREE.Vector3()).length();
  if (size === 0) box.expandByScalar(data.scene.size / 2);
  return box;
}

/** Includes the ends of springs, but not those that are so far away that the mechanism could not be seen beside them. */
function takeNear(box: THREE.Box3, ends: ArrayLike<number>): void {
  const near = box.isEmpty() ? undefined : box.clone().expandByScalar(FAR_SPRING * box.getSize(new THREE.Vector3()).length());
  const point = new THREE.Vector3();
  for (let at = 0; at + 2 < ends.length; at += 3) {
    point.set(ends[at], ends[at + 1], ends[at + 2]);
    if (!near || near.containsPoint(point)) box.expandByPoint(point);
  }
}

/** Half of the largest extent of a solid, m. */
const radius = (solid: Solid) => (solid.shape === "box" ? Math.hypot(...solid.edges) / 2 : Math.hypot(solid.radius, solid.length / 2));

/** Half of the largest extent of a beam's sections, m. */
function thickness({ profile, sizes }: BeamInfo): number {
  const half = profile.shape === "rectangle" ? Math.hypot(profile.width, profile.height) / 2 : profile.shape === "ellipse" ? Math.max(profile.y, profile.z) : profile.outer;
  return half * Math.max(1, ...(sizes ?? []).flat());
}

/** A place where something is at some instant, and how far it reaches, m. */
interface Place {
  at: THREE.Vector3;
  radius: number;
}

/** Some of the places of stations, bodies and joints over the run. */
function places(data: Data): Place[] {
  const { beams, bodies } = data.scene;
  const found: Place[] = [];
  for (const [name, radii] of [["station.place", beams.map(thickness)], ["body.place", bodies.map(({ solid }) => radius(solid))], ["joint.place", []]] as const) {
    const values = data.tracks.get(name)?.values ?? [];
    const every = 3 * Math.ceil(values.length / 3 / MOST_PLACES);
    const largest = Math.max(0, ...radii);
    for (let at = 0; at + 2 < values.length; at += every) found.push({ at: new THREE.Vector3(values[at], values[at + 1], values[at + 2]), radius: largest });
  }
  if (data.second) {
    const moved = shift(data);
    found.push(...places(data.second.data).map(({ at, radius }) => ({ at: at.add(moved), radius })));
  }
  return found;
}

/** The largest of 1, 2, 5 times a power of ten that is not above `length`. */
export function niceLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * ([5, 2, 1].find((digit) => digit * power <= length * 1.0001) ?? 1);
}

export class Stage {
  readonly scene = new THREE.Scene();
  readonly canvas: HTMLCanvasElement;
  readonly up: THREE.Vector3;
  readonly box: THREE.Box3;
  /** Diagonal of what is seen over the whole run, m. */
  readonly extent: number;
  readonly grid: THREE.Group;
  readonly cell: number;
  camera: THREE.PerspectiveCamera | THREE.OrthographicCamera;
  controls: OrbitControls;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly light = new THREE.DirectionalLight(0xffffff, 2.1);
  private readonly gizmo = new THREE.Scene();
  private readonly gizmoCamera = new THREE.OrthographicCamera(-1.5, 1.5, 1.5, -1.5, 0.1, 10);
  private following?: THREE.Vector3;
  /** Places where something is in the course of the run, and what on the screen covers a corner of the picture. */
  private readonly places: Place[];
  covered: () => DOMRect | undefined = () => undefined;
  /** Pixels on the left that controls cover: the picture is centerd in what is left. */
  private inset = 0;
  /** How far the picture is moved down, as a share of its height. */
  private down = 0;

  constructor(data: Data, private readonly parent: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${data.scene.name}: the mechanism in three dimensions`);
    this.canvas.tabIndex = 0;
    parent.append(this.canvas);
    this.up = upOf(data.scene.gravity);
    this.box = bounds(data);
    this.places = places(data);
    this.extent = this.box.getSize(new THREE.Vector3()).length();
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xa8b0c0, 2.2), this.light, this.light.target);
    this.cell = niceLength(this.extent / 8);
    this.grid = this.makeGrid();
    this.scene.add(this.grid);
    this.camera = this.perspective();
    this.controls = this.makeControls();
    this.makeGizmo(data.scene.gravity);
    this.resizing.observe(parent);
    this.resize();
    this.view("iso");
  }

  private readonly resizing = new ResizeObserver(() => this.resize());

  /** Gives the memory of the graphics card back. */
  dispose(): void {
    this.resizing.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Where the camera is and what it looks at. */
  get pose(): Pose {
    const { camera, controls } = this;
    return { position: camera.position.toArray(), target: controls.target.toArray(), zoom: camera.zoom, half: camera.userData.half };
  }

  set pose({ position, target, zoom, half }: Pose) {
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    this.camera.zoom = zoom;
    if (this.isParallel) this.camera.userData.half = half;
    this.shape();
    this.controls.update();
  }

  private perspective(): THREE.PerspectiveCamera {
    const camera = new THREE.PerspectiveCamera(32, 1, this.extent / 500, this.extent * 60);
    camera.up.copy(this.up);
    return camera;
  }

  private makeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = false;
    controls.zoomToCursor = true;
    controls.minDistance = this.extent / 200;
    controls.maxDistance = this.extent * 20;
    return controls;
  }

  private makeGrid(): THREE.Group {
    const group = new THREE.Group();
    const middle = this.box.getCenter(new THREE.Vector3());
    const lowest = Math.min(...[0, 1, 2, 3, 4, 5, 6, 7].map((k) => {
      const corner = new THREE.Vector3(k & 1 ? this.box.max.x : this.box.min.x, k & 2 ? this.box.max.y : this.box.min.y, k & 4 ? this.box.max.z : this.box.min.z);
      return corner.dot(this.up);
    }));
    const count = 2 * Math.ceil((0.85 * this.extent) / this.cell / 2 + 1);
    const grid = new THREE.GridHelper(count * this.cell, count, 0x8a94a6, 0x8a94a6);
    const material = grid.material as THREE.LineBasicMaterial;
    material.transparent = true;
    material.opacity = 0.28;
    material.depthWrite = false;
    group.add(grid);
    group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.up);
    // Lines of the grid lie at round numbers.
    const snapped = new THREE.Vector3(...middle.toArray().map((part) => Math.round(part / this.cell) * this.cell));
    group.position.copy(snapped).addScaledVector(this.up, lowest - 0.02 * this.extent - snapped.dot(this.up));
    return group;
  }

  private makeGizmo(gravity: [number, number, number]): void {
    const axes: [string, THREE.Vector3, number][] = [
      ["x", new THREE.Vector3(1, 0, 0), 0xd63a3a],
      ["y", new THREE.Vector3(0, 1, 0), 0x2f9e44],
      ["z", new THREE.Vector3(0, 0, 1), 0x3b6fe0],
    ];
    const g = new THREE.Vector3(...gravity);
    if (g.lengthSq() > 0) axes.push(["g", g.normalize(), 0x808894]);
    for (const [letter, direction, color] of axes) {
      const arrow = new THREE.ArrowHelper(direction, new THREE.Vector3(), 0.95, color, 0.28, 0.17);
      const label = letterSprite(letter, color);
      label.position.copy(direction).multiplyScalar(1.22);
      this.gizmo.add(arrow, label);
    }
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.parent;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height);
    this.shape();
  }

  private get aspect(): number {
    return this.parent.clientWidth / Math.max(1, this.parent.clientHeight);
  }

  /** Leaves so many pixels on the left to the controls. */
  leave(inset: number): void {
    this.inset = inset;
    this.shape();
    this.fit();
  }

  private shape(): void {
    if (this.camera instanceof THREE.PerspectiveCamera) this.camera.aspect = this.aspect;
    else {
      const half = this.camera.userData.half as number;
      this.camera.top = half;
      this.camera.bottom = -half;
      this.camera.left = -half * this.aspect;
      this.camera.right = half * this.aspect;
    }
    const { clientWidth, clientHeight } = this.parent;
    this.camera.setViewOffset(clientWidth, clientHeight, -this.inset / 2, -this.down * clientHeight, clientWidth, clientHeight);
    this.camera.updateProjectionMatrix();
  }

  get isParallel(): boolean {
    return this.camera instanceof THREE.OrthographicCamera;
  }

  /** Perspective or parallel, with the same things in sight. */
  setParallel(parallel: boolean): void {
    if (parallel === this.isParallel) return;
    const { target } = this.controls;
    const from = this.camera.position.clone();
    const tangent = Math.tan(THREE.MathUtils.degToRad(16));
    if (parallel) {
      const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -this.extent * 40, this.extent * 60);
      camera.userData.half = from.distanceTo(target) * tangent;
      this.camera = camera;
    } else {
      const { zoom, userData } = this.camera as THREE.OrthographicCamera;
      from.sub(target).setLength(userData.half / zoom / tangent).add(target);
      this.camera = this.perspective();
    }
    this.camera.up.copy(this.up);
    this.camera.position.copy(from);
    this.controls.dispose();
    this.controls = this.makeControls();
    this.controls.target.copy(target);
    this.shape();
    this.controls.update();
  }

  /** Looks from a standard direction at all that is ever seen. */
  view(view: View): void {
    const up = this.up;
    // Two horizontal directions: y and x of a model whose z is up.
    const side = Math.abs(up.z) > 0.5 ? new THREE.Vector3(1, 0, 0) : Math.abs(up.y) > 0.5 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    side.addScaledVector(up, -side.dot(up)).normalize();
    const front = new THREE.Vector3().crossVectors(side, up);
    const direction = {
      iso: () => front.clone().addScaledVector(side, 0.55).addScaledVector(up, 0.5),
      front: () => front,
      side: () => side,
      // A little off the vertical, so that x points to the right.
      top: () => up.clone().addScaledVector(front, 1e-3),
    }[view]();
    this.fit(direction.clone().normalize());
  }

  /** Puts all that is ever seen into sight, from the present direction or another one. */
  fit(direction?: THREE.Vector3): void {
    const target = this.box.getCenter(new THREE.Vector3());
    const from = direction ?? this.camera.position.clone().sub(this.controls.target).normalize();
    // The half-width and half-height of what is seen along that direction.
    const right = new THREE.Vector3().crossVectors(this.up, from).normalize();
    const above = new THREE.Vector3().crossVectors(from, right);
    let [wide, high, deep] = [0, 0, 0];
    const corner = new THREE.Vector3();
    for (let k = 0; k < 8; k++) {
      corner.set(k & 1 ? this.box.max.x : this.box.min.x, k & 2 ? this.box.max.y : this.box.min.y, k & 4 ? this.box.max.z : this.box.min.z).sub(target);
      wide = Math.max(wide, Math.abs(corner.dot(right)));
      high = Math.max(high, Math.abs(corner.dot(above)));
      deep = Math.max(deep, Math.abs(corner.dot(from)));
    }
    const margin = 0.04 * this.extent;
    const half = Math.max(high + margin, (wide + margin) / this.aspect / (1 - this.inset / Math.max(this.parent.clientWidth, 2 * this.inset))) * 1.04;
    this.controls.target.copy(target);
    const look = (step: number) => {
      const larger = half * BACK ** step;
      this.down = DOWN * step;
      this.camera.position.copy(target).addScaledVector(from, larger / Math.tan(THREE.MathUtils.degToRad(16)) + 0.6 * deep);
      if (this.camera instanceof THREE.OrthographicCamera) {
        this.camera.userData.half = larger;
        this.camera.zoom = 1;
      }
      this.shape();
      this.controls.update();
      return !this.isCovered();
    };
    // From farther away and lower, until nothing is behind what covers a corner, if that helps.
    const steps = Array.from({ length: MOST_STEPS + 1 }, (_, step) => step);
    if (!steps.some(look)) look(0);
  }

  /** Whether something that is ever seen is behind what covers a corner. */
  private isCovered(): boolean {
    const cover = this.covered();
    if (!cover) return false;
    this.camera.updateMatrixWorld();
    const { left, top } = this.canvas.getBoundingClientRect();
    const scale = 1 / this.metersPerPixel();
    return this.places.some(({ at, radius }) => {
      const { x, y } = this.project(at);
      const gap = GAP + radius * scale;
      return x + left > cover.left - gap && x + left < cover.right + gap && y + top > cover.top - gap && y + top < cover.bottom + gap;
    });
  }

  /** Moves with a point, from where it is now on; stops without. */
  follow(point?: THREE.Vector3): void {
    if (point && this.following) {
      const moved = point.clone().sub(this.following);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
    }
    this.following = point?.clone();
  }

  /** Meters that a pixel is wide at the middle of the view. */
  metersPerPixel(): number {
    const height = Math.max(1, this.parent.clientHeight);
    if (this.camera instanceof THREE.OrthographicCamera) return (2 * this.camera.userData.half) / this.camera.zoom / height;
    return (2 * Math.tan(THREE.MathUtils.degToRad(16)) * this.camera.position.distanceTo(this.controls.target)) / height;
  }

  /** Where a point is on the canvas, pixels. */
  project(point: THREE.Vector3): { x: number; y: number; visible: boolean } {
    const seen = point.clone().project(this.camera);
    const { clientWidth, clientHeight } = this.parent;
    return { x: (0.5 + seen.x / 2) * clientWidth, y: (0.5 - seen.y / 2) * clientHeight, visible: seen.z > -1 && seen.z < 1 };
  }

  render(): void {
    const { clientWidth: width, clientHeight: height } = this.parent;
    if (width === 0 || height === 0) return;
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    this.light.position.copy(this.controls.target).addScaledVector(back, this.extent).addScaledVector(this.up, 0.9 * this.extent);
    this.light.target.position.copy(this.controls.target);
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.autoClear = true;
    this.renderer.render(this.scene, this.camera);
    const side = Math.min(96, width / 4);
    this.gizmoCamera.up.copy(this.camera.up);
    this.gizmoCamera.position.copy(back).multiplyScalar(4);
    this.gizmoCamera.lookAt(0, 0, 0);
    this.renderer.autoClear = false;
    this.renderer.clearDepth();
    this.renderer.setViewport(width - side - 4, 4, side, side);
    this.renderer.render(this.gizmo, this.gizmoCamera);
  }

  /** Makes everything ready to be drawn, also what is not visible yet: its first picture would take the time of several. */
  compile(): void {
    this.renderer.compile(this.scene, this.camera);
  }

  /** The picture as it is, on a background. */
  png(background: string): string {
    this.renderer.setClearColor(new THREE.Color(background), 1);
    this.render();
    const url = this.canvas.toDataURL("image/png");
    this.renderer.setClearColor(0x000000, 0);
    this.render();
    return url;
  }
}

function letterSprite(letter: string, color: number): THREE.Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const paper = canvas.getContext("2d")!;
  paper.font = "bold 46px sans-serif";
  paper.textAlign = "center";
  paper.textBaseline = "middle";
  paper.fillStyle = `#${color.toString(16).padStart(6, "0")}`;
  paper.fillText(letter, 32, 32);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, depthTest: false }));
  sprite.scale.setScalar(0.5);
  return sprite;
}
