// What is shown: an instant of the run or of a natural mode, colored, with what was clicked on. The page's controls change its settings.

import * as THREE from "three";
import { Beams } from "./beams";
import { Comparison, instants } from "./comparison";
import { QUANTITIES, range, values, type Quantity } from "./color";
import type { Data, Track } from "./data";
import { between, Moment, type Between } from "./moment";
import { isStill, opening, plays } from "./opening";
import { nearest, placeAt, under, type Spot } from "./pick";
import { Ropes } from "./ropes";
import { Signs } from "./signs";
import { Stage } from "./stage";
import { Timeline } from "./timeline";
import { Trails } from "./trails";
import { Water } from "./water";

/** A mode swings once in so many seconds of the clock. */
const PERIOD = 2;

export class Player {
  readonly stage: Stage;
  readonly beams: Beams;
  readonly signs: Signs;
  readonly ropes: Ropes;
  readonly water: Water;
  readonly trails: Trails;
  readonly comparison?: Comparison;
  readonly moment: Moment;
  /** The timeline of the run, and that of a mode. */
  readonly run: Timeline;
  readonly swing = new Timeline([0, PERIOD], PERIOD);
  quantity?: Quantity;
  /** What the colors span: the whole run, each instant, or up to a value. */
  ranging: "run" | "instant" | "fixed" = "run";
  private limit = 0;
  /** Number of the natural mode that is shown; none: the run. */
  mode?: number;
  amplitude = 1;
  magnification = 1;
  scale = 1;
  spot?: Spot;
  following = false;
  /** The range of the colors now. */
  range: [number, number] = [0, 0];
  private readonly ranges = new Map<string, [number, number]>();
  private readonly marker: THREE.Mesh;
  private listeners: (() => void)[] = [];
  private dirty = true;
  private last = 0;

  constructor(readonly data: Data, parent: HTMLElement) {
    this.run = new Timeline(instants(data), 8);
    this.stage = new Stage(data, parent);
    this.beams = new Beams(data, this.scale);
    this.signs = new Signs(data, this.stage.extent * 0.75, this.stage.up);
    this.ropes = new Ropes(data, this.stage.extent * 0.75);
    this.water = new Water(data.scene, this.stage.box);
    this.trails = new Trails(data);
    this.moment = new Moment(data);
    if (data.second) this.comparison = new Comparison(data, this.stage.extent * 0.75, this.stage.up, this.scale);
    this.marker = new THREE.Mesh(
      new THREE.SphereGeometry(1, 16, 12),
      new THREE.MeshBasicMaterial({ color: 0xff2d78, depthTest: false, transparent: true, opacity: 0.9 }),
    );
    this.marker.renderOrder = 2;
    this.marker.visible = false;
    this.stage.scene.add(this.marker, ...this.shown);
    for (const timeline of [this.run, this.swing]) timeline.onchange(() => this.refresh());
    this.stage.controls.addEventListener("change", () => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(parent);
    requestAnimationFrame((now) => this.tick(now));
  }

  /** All that belongs to the mechanism, of both runs. */
  get shown(): THREE.Object3D[] {
    const { beams, trails, ropes, water, signs, comparison } = this;
    const own = [beams.group, beams.ghosts, trails.group, ropes.group, water.group, signs.bodies, signs.joints, signs.springs, signs.loads, signs.reactions, signs.points];
    return comparison ? [...own, comparison.group] : own;
  }

  /** The state of a run that goes on while a reader drags the mechanism; it is shown instead of the recorded one. */
  private live?: { tracks: Map<string, Track>; time: number };

  /** Shows the present state of a run that goes on, until it is called without one. */
  showLive(live: { tracks: Map<string, Track>; time: number } | undefined): void {
    this.live = live;
    this.refresh();
  }

  get isLive(): boolean {
    return this.live !== undefined;
  }

  /** The data of what is shown. */
  get seen(): Data {
    return this.live ? { ...this.data, tracks: this.live.tracks } : this.data;
  }

  /** The time of what is shown, s. */
  get time(): number {
    return this.live?.time ?? this.timeline.time;
  }

  /** The timeline of what is shown. */
  get timeline(): Timeline {
    return this.mode === undefined ? this.run : this.swing;
  }

  /** The instant that is shown, as a place between two recorded ones. */
  at(): Between {
    if (this.live) return { first: 0, second: 0, share: 0 };
    return this.mode === undefined ? between(this.data.times, this.run.time) : { first: 0, second: 0, share: 0 };
  }

  onupdate(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Something has changed: everything is placed and colored anew with the next picture. */
  refresh(): void {
    this.dirty = true;
  }

  private redraw(): void {
    this.needsPicture = true;
  }

  private needsPicture = true;

  /** Ends it: its pictures and its memory. */
  dispose(): void {
    this.ended = true;
    this.stage.dispose();
  }

  private ended = false;

  private tick(now: number): void {
    if (this.ended) return;
    const passed = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    this.timeline.advance(passed);
    if (this.dirty) this.update();
    if (this.needsPicture) {
      this.beams.thin(this.stage.metersPerPixel());
      this.comparison?.thin(this.stage.metersPerPixel());
      this.stage.render();
      this.needsPicture = false;
      for (const listener of this.listeners) listener();
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  private update(): void {
    this.dirty = false;
    this.needsPicture = true;
    const at = this.at();
    const mode = this.mode === undefined || this.live ? undefined : this.data.modes[this.mode];
    if (mode) {
      // What is unstable or free moves there and back as well: to be seen, not to be timed.
      this.moment.setMode(mode, this.amplitude * this.unit() * Math.sin((2 * Math.PI * this.swing.time) / PERIOD));
    } else this.moment.set(at, this.magnification, this.live?.tracks);
    this.beams.update(this.moment.parts["station.place"], this.moment.parts["station.turn"]);
    this.signs.update(this.moment);
    this.ropes.update(this.moment);
    this.water.update(mode ? this.data.times[0] : this.time);
    this.compare(mode === undefined && !this.live);
    this.trails.update(mode || this.live ? -1 : at.second);
    this.paint(at, mode !== undefined);
    this.place();
  }

  /** Whether the second run is wanted; a mode and a run that goes on are not compared. */
  comparing = true;

  private compare(possible: boolean): void {
    if (!this.comparison) return;
    this.comparison.group.visible = possible && this.comparing;
    this.comparison.update(this.run.time, this.magnification);
  }

  /** The amount of a mode at which it is drawn with the amplitude 1. */
  private unit(): number {
    const mode = this.data.modes[this.mode!];
    const largest = (list: Float32Array) => {
      let most = 0;
      for (let at = 0; at < list.length; at += 3) most = Math.max(most, Math.hypot(list[at], list[at + 1], list[at + 2]));
      return most;
    };
    const moved = Math.max(largest(mode.stations.place.values), largest(mode.bodies.place.values));
    const turned = Math.max(largest(mode.stations.turn.values), largest(mode.bodies.turn.values));
    return Math.min((0.1 * this.stage.extent) / (moved || 1e-30), 0.8 / (turned || 1e-30));
  }

  private paint(at: Between, plain: boolean): void {
    if (!this.quantity || plain) {
      this.beams.paint();
      return;
    }
    const { quantity, limit } = this;
    const data = this.seen;
    if (this.ranging === "fixed") this.range = [quantity.signed ? -limit : 0, limit];
    else this.range = this.ranging === "instant" ? range(data, quantity, at) : this.wholeRange(quantity);
    this.beams.paint(values(data, quantity, at), this.range, quantity);
  }

  private wholeRange(quantity: Quantity): [number, number] {
    let known = this.ranges.get(quantity.word);
    if (!known) this.ranges.set(quantity.word, (known = range(this.data, quantity)));
    return known;
  }

  private place(): void {
    this.marker.visible = this.spot !== undefined;
    if (!this.spot) return;
    const place = placeAt(this.moment.parts["station.place"], this.spot);
    this.marker.position.copy(place);
    this.marker.scale.setScalar(0.008 * this.stage.extent);
    this.stage.follow(this.following ? place : undefined);
  }

  /** Colors by a quantity; without a word plainly. */
  colorBy(word: string): void {
    this.quantity = QUANTITIES.find((quantity) => quantity.word === word);
    this.refresh();
  }

  /** The largest value of the colors, where it is given. */
  limitRange(most: number): void {
    this.limit = Number.isFinite(most) ? Math.abs(most) : this.limit;
    this.refresh();
  }

  /** How many times as thick as they are sections are drawn. */
  thicken(scale: number): void {
    this.scale = scale;
    this.beams.setScale(scale);
    this.comparison?.setScale(scale);
    this.refresh();
  }

  /** Shows a natural mode, which swings at once; without a number the run, where it was left. */
  show(mode: number | undefined): void {
    this.run.playing = false;
    this.swing.playing = mode !== undefined;
    this.mode = mode;
    this.refresh();
  }

  /** Shows the state worth seeing; plays from the start where the address of the page asks for it. */
  open(): void {
    // The end of both runs, where they are equilibria.
    this.run.seek(this.data.scene.dynamic ? opening(this.data, this.quantity) : this.run.end);
    if (this.data.times.length < 2 && this.data.modes.length > 0) {
      this.show(0);
      if (isStill()) this.swing.hold(PERIOD / 4);
    } else if (plays()) this.run.play();
  }

  choose(spot: Spot | undefined): void {
    this.spot = spot;
    if (!spot) this.following = false;
    this.stage.follow(undefined);
    this.refresh();
  }

  /** Chooses what is under a point of the canvas, pixels; a thin beam also from a few pixels beside it. */
  pick(x: number, y: number): void {
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    for (const [dx, dy] of [[0, 0], [3, 0], [-3, 0], [0, 3], [0, -3], [6, 6], [-6, 6], [6, -6], [-6, -6]]) {
      const hit = under((2 * (x + dx)) / width - 1, 1 - (2 * (y + dy)) / height, this.stage.camera, this.beams.meshes);
      if (!hit) continue;
      const beam = this.data.scene.beams[hit.beam];
      this.choose(nearest(beam, hit.beam, this.moment.parts["station.place"], hit.point.toArray()));
      return;
    }
    this.choose(undefined);
  }

  setParallel(parallel: boolean): void {
    this.stage.setParallel(parallel);
    this.stage.controls.addEventListener("change", () => this.redraw());
    this.redraw();
  }

  /** Draws once more, because the camera or the size has changed. */
  look(): void {
    this.redraw();
  }
}
