// Drags a point of the mechanism with the pointer, while the solver simulates: takes hold of the nearest grip of what is under the pointer, and tells the solver where the pointer is.

import * as THREE from "three";
import type { Track } from "./data";
import { under } from "./pick";
import type { Player } from "./player";
import type { SessionInfo } from "./solver";
import type { Page } from "./ui";

/** What the solver is told: grips and places, counted from the scene's origin. */
export interface Hand {
  grab(grip: number, place: number[]): void;
  pull(place: number[]): void;
  release(): void;
}

/** What a frame of the solver consists of: the time, the places of the grips, and the tracks one after another (crates/live/src/session.rs). */
export class Frames {
  time = 0;
  /** Places of the grips, three numbers each. */
  grips: Float32Array = new Float32Array();
  readonly tracks = new Map<string, Track>();

  constructor(private readonly info: SessionInfo, recorded: Map<string, Track>) {
    // The model with grips has more loads and outputs than the page; they come last.
    for (const [name, track] of recorded) this.tracks.set(name, { ...track, values: new Float32Array(track.components * track.things) });
  }

  take(numbers: Float32Array): void {
    this.time = numbers[0];
    let at = 1 + 3 * this.info.grips.length;
    this.grips = numbers.subarray(1, at);
    for (const [name, components, things] of this.info.tracks) {
      const own = this.tracks.get(name);
      if (own) own.values.set(numbers.subarray(at, at + own.values.length));
      at += components * things;
    }
  }
}

export class Drag {
  private readonly player: Player;
  private readonly ending = new AbortController();
  private readonly line: THREE.Line;
  private readonly ends = new THREE.BufferAttribute(new Float32Array(6), 3);
  private readonly knob: THREE.Mesh;
  /** The grip that is held. */
  private held?: number;
  private pointer?: number;
  private readonly plane = new THREE.Plane();
  private readonly target = new THREE.Vector3();

  constructor(page: Page, private readonly info: SessionInfo, private readonly frames: Frames, private readonly hand: Hand) {
    const player = (this.player = page.player);
    const color = 0xff2d78;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.ends);
    this.line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color, depthTest: false }));
    this.line.frustumCulled = false;
    this.knob = new THREE.Mesh(new THREE.SphereGeometry(0.008 * player.stage.extent, 16, 12), new THREE.MeshBasicMaterial({ color, depthTest: false }));
    for (const part of [this.line, this.knob]) {
      part.renderOrder = 3;
      part.visible = false;
      player.stage.scene.add(part);
    }
    player.stage.compile();
    const { canvas } = player.stage;
    const { signal } = this.ending;
    // Before the camera takes the pointer.
    canvas.parentElement!.addEventListener("pointerdown", (event) => this.down(event), { signal, capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event), { signal });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const) canvas.addEventListener(name, (event) => event.pointerId === this.pointer && this.release(), { signal });
  }

  /** Draws the spring to where the point is now. */
  update(): void {
    if (this.held === undefined) return;
    this.ends.array.set(this.frames.grips.subarray(3 * this.held, 3 * this.held + 3), 0);
    this.ends.array.set(this.target.toArray(), 3);
    this.ends.needsUpdate = true;
    this.knob.position.fromArray(this.frames.grips, 3 * this.held);
  }

  release(): void {
    if (this.held === undefined) return;
    this.held = undefined;
    this.pointer = undefined;
    this.player.stage.controls.enabled = true;
    this.line.visible = this.knob.visible = false;
    this.hand.release();
  }

  dispose(): void {
    this.release();
    this.ending.abort();
    this.player.stage.scene.remove(this.line, this.knob);
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || this.held !== undefined) return;
    const hit = this.hit(event);
    if (!hit) return;
    const places = this.frames.grips;
    const place = new THREE.Vector3();
    const candidates = this.info.grips.map((grip, number) => ({ grip, number })).filter(({ grip }) => (hit.beam === undefined ? grip.body === hit.body : grip.beam === hit.beam));
    const distance = (number: number) => place.fromArray(places, 3 * number).distanceTo(hit.point);
    const nearest = candidates.reduce<number | undefined>((best, { number }) => (best === undefined || distance(number) < distance(best) ? number : best), undefined);
    if (nearest === undefined) return;
    this.held = nearest;
    this.pointer = event.pointerId;
    const { stage } = this.player;
    stage.controls.enabled = false;
    stage.canvas.setPointerCapture(event.pointerId);
    // The pointer moves in the plane of the picture that goes through the point.
    this.plane.setFromNormalAndCoplanarPoint(stage.camera.getWorldDirection(new THREE.Vector3()), place.fromArray(places, 3 * nearest).clone());
    this.aim(event);
    this.line.visible = this.knob.visible = true;
    this.update();
    this.hand.grab(nearest, this.target.toArray());
  }

  private move(event: PointerEvent): void {
    if (event.pointerId !== this.pointer) return;
    this.aim(event);
    this.hand.pull(this.target.toArray());
  }

  private aim(event: PointerEvent): void {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(this.normalized(event), this.player.stage.camera);
    ray.ray.intersectPlane(this.plane, this.target);
  }

  private normalized({ clientX, clientY }: { clientX: number; clientY: number }): THREE.Vector2 {
    const box = this.player.stage.canvas.getBoundingClientRect();
    return new THREE.Vector2((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
  }

  /** The beam or body under the pointer; a thin beam also from a few pixels away. */
  private hit({ clientX, clientY }: PointerEvent): { point: THREE.Vector3; beam?: number; body?: number } | undefined {
    const { stage, beams, signs } = this.player;
    for (const [dx, dy] of [[0, 0], [4, 0], [-4, 0], [0, 4], [0, -4], [8, 8], [-8, 8], [8, -8], [-8, -8]]) {
      const at = this.normalized({ clientX: clientX + dx, clientY: clientY + dy });
      const hit = under(at.x, at.y, stage.camera, beams.meshes);
      if (hit) return hit;
      const ray = new THREE.Raycaster();
      ray.setFromCamera(at, stage.camera);
      const solid = ray.intersectObjects(signs.bodies.children, false)[0];
      if (solid) return { point: solid.point, body: signs.bodies.children.indexOf(solid.object) };
    }
    return undefined;
  }
}
