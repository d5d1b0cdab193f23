// The page around the picture: header, controls, timeline, charts, what was clicked on.

import { Along } from "./along";
import { Charts } from "./charts";
import { gradient, QUANTITIES, quantityText } from "./color";
import type { Data } from "./data";
import { button, choice, h, save, slider, tick } from "./dom";
import { glb } from "./glb";
import { Labels } from "./labels";
import { PickPanel } from "./panel";
import { Player } from "./player";
import { niceLength, type View } from "./stage";
import { list, listenToKeys } from "./keys";
import { Video } from "./video";

/** Below this width charts go under the picture, and controls lie over it. */
export const NARROW = 820;
/** From this width on controls are open from the start. */
const WIDE = 1100;

export class Page {
  readonly player: Player;
  private readonly charts: Charts;
  private readonly along: Along;
  private readonly panel: PickPanel;
  private readonly labels: Labels;
  private readonly viewport = h("div", { class: "viewport" });
  readonly side = h("aside", { class: "side", "aria-label": "Charts" });
  private readonly scrub: HTMLInputElement;
  private readonly clock = h("output", { class: "clock", "aria-live": "off" });
  private readonly play: HTMLButtonElement;
  private readonly speed = h("output", { class: "speed", title: "Seconds of the run in a second" });
  private readonly legend = h("div", { class: "legend", hidden: true });
  private readonly scaleBar = h("div", { class: "scale-bar" });
  private readonly scaleNote = h("div", { class: "scale-note" });
  private readonly video = new Video(this);

  constructor(readonly data: Data, readonly app: HTMLElement) {
    const charts = this.side;
    const stage = h("main", { class: "stage" }, this.viewport);
    const body = h("div", { class: "body" }, stage, charts);
    app.append(this.header(), body);
    this.player = new Player(data, this.viewport);
    const { player } = this;
    // A single instant: nothing moves.
    const still = player.run.times.length < 2 && data.modes.length === 0;
    // Lines in water, and ropes that run over something, are looked at for their tension.
    const usual = data.scene.water || data.scene.surfaces?.length ? "axial_force" : "bending_moment";
    player.colorBy(data.scene.beams.some((beam) => beam.stress) ? "stress" : data.scene.beams.length > 0 ? usual : "");
    // As drawn, beams bear nothing.
    if (still && player.range[0] === player.range[1]) player.colorBy("");
    this.charts = new Charts(data, player.run);
    this.along = new Along(data);
    this.panel = new PickPanel(player);
    this.labels = new Labels(player, this.viewport);
    this.charts.element.hidden = player.run.times.length < 2;
    charts.append(this.panel.element, this.along.element, this.charts.element);
    stage.append(this.legend, this.controls(), this.scaleBar, this.scaleNote, this.video.status);
    if (data.second) stage.append(this.runs(data.second.names));
    this.scrub = h("input", {
      type: "range", class: "scrub", min: 0, max: 1000, step: "any", "aria-label": "Time",
      oninput: () => {
        const { timeline } = player;
        timeline.playing = false;
        timeline.seek(timeline.start + (this.scrub.valueAsNumber / 1000) * timeline.duration);
      },
    });
    this.play = button("▶", "Play", () => player.timeline.toggle(), "Space");
    this.play.classList.add("play");
    const timeline = this.timeline();
    if (!still) app.append(timeline);
    this.pointer();
    listenToKeys(this, this.listening.signal);
    player.onupdate(() => this.update());
    player.open();
    this.legend.hidden = !player.quantity;
    this.describe();
    player.stage.covered = () => (this.legend.hidden ? undefined : this.legend.getBoundingClientRect());
    player.stage.fit();
  }

  private readonly listening = new AbortController();

  /** Ends the page: another one takes its place. */
  dispose(): void {
    this.listening.abort();
    this.video.stop();
    this.charts.dispose();
    this.along.dispose();
    this.player.dispose();
  }

  private header(): HTMLElement {
    const { scene, notes } = this.data;
    const { second } = this.data;
    const others = second ? second.data.notes.map((note) => `${second.names[1]}: ${note}`) : [];
    const notice = [...notes, ...others].map((note) => h("p", { class: "note" }, note));
    const title = h("div", { class: "title" }, h("h1", {}, scene.name), h("p", { class: "description" }, scene.description));
    const model = button("glTF", "Save the mechanism of this instant as glTF, for other programs", () => this.saveModel(), "M");
    model.dataset.control = "gltf";
    const tools = h(
      "div", { class: "tools" },
      button("PNG", "Save the picture as PNG", () => save(this.player.stage.png(this.background), this.data.scene.name, "png")),
      model,
      this.video.format && this.video.button,
      button("◐", "Light or dark", () => this.switchTheme()),
      button("?", "Keys", () => this.help(), "?"),
    );
    return h("header", {}, title, tools, ...notice, this.keys);
  }

  private readonly keys = h("dialog", { class: "help", "aria-label": "Keys" });

  /** Opens the list of all keys, or closes it. */
  help(): void {
    if (this.keys.open) return this.keys.close();
    this.keys.replaceChildren(
      h("h2", {}, "Keys"),
      list(this),
      h("p", {}, "Drag turns, with the right button or two fingers moves, the wheel zooms. A click on a beam reads its section, a click into a chart goes to that instant. With the solver in the page, Interact lets you drag the mechanism while it is simulated; Esc ends it."),
      h("form", { method: "dialog" }, h("button", {}, "Close")),
    );
    this.keys.showModal();
  }

  /** Whether the browser can record a video. */
  get records(): boolean {
    return this.video.format !== undefined;
  }

  /** Saves what is seen at this instant as a file of glTF. */
  private saveModel(): void {
    const { player, data } = this;
    const bytes = glb(player.shown, player.stage.up, `${data.scene.name}, ${this.clock.textContent}`, data.program);
    const url = URL.createObjectURL(new Blob([bytes], { type: "model/gltf-binary" }));
    save(url, data.scene.name, "glb");
    // A browser may begin to read it only when the reader has said where to put it.
    setTimeout(() => URL.revokeObjectURL(url), 60000);
  }

  /** Tells the two runs apart, by the color in the picture and the lines in the charts. */
  private runs(names: [string, string]): HTMLElement {
    const row = (kind: string, name: string) => h("div", { class: kind }, h("span", { class: "stroke" }), h("span", { class: "name" }, name));
    return h("div", { class: "runs", role: "note", "aria-label": "Runs" }, row("first", names[0]), row("second", names[1]));
  }

  private controls(): HTMLElement {
    const { player, data } = this;
    const { signs, beams, trails, stage } = player;
    // Of a section whose outline is not known there is no stress.
    const known = QUANTITIES.filter(({ word, from }) => from.every((name) => data.tracks.has(name)) && (word !== "stress" || data.scene.beams.some(({ stress }) => stress)));
    const options: [string, string][] = [["", "nothing"], ...known.map(({ word, label }): [string, string] => [word, label])];
    const color = choice("Color by", options, player.quantity?.word ?? "", (word) => {
      player.colorBy(word);
      this.describe();
      if (player.ranging === "fixed") {
        const list = ranges.querySelector("select")!;
        list.value = "run";
        list.dispatchEvent(new Event("change"));
      }
    });
    color.dataset.control = "color";
    const modes: [string, string][] = [["", "simulation"], ...data.modes.map((mode, k): [string, string] => [String(k), `mode ${k + 1}: ${pace(mode)}`])];
    const show = (group: { visible: boolean }) => (on: boolean) => {
      group.visible = on;
      player.refresh();
    };
    const views = (["iso", "front", "side", "top"] as View[]).map((view, k) => button({ iso: "3D", front: "Front", side: "Side", top: "Top" }[view], `View: ${view === "iso" ? "oblique" : view}`, () => this.view(view), String(k + 1)));
    const mode = choice("Show", modes, "", (value) => {
      player.show(value === "" ? undefined : Number(value));
      amplitude.hidden = value === "";
      this.describe();
    });
    mode.dataset.control = "mode";
    // A peak of a moment would leave everything else in one color: the range can be set by hand.
    const most = h("input", { type: "number", step: "any", min: 0, "aria-label": "Largest value of the colors", onchange: () => player.limitRange(most.valueAsNumber) });
    const largest = h("label", { class: "choice", hidden: true }, h("span", {}, "up to"), most);
    const ranges = choice("Range", [["run", "of the whole run"], ["instant", "of each instant"], ["fixed", "up to a value"]], "run", (kind) => {
      largest.hidden = kind !== "fixed";
      most.value = String(Number(player.range[1].toPrecision(3)));
      player.ranging = kind as typeof player.ranging;
      player.limitRange(most.valueAsNumber);
    });
    ranges.dataset.control = "range";
    const amplitude = slider("Amplitude", [0, 4, 0.1], 1, (value) => `× ${value}`, (value) => {
      player.amplitude = value;
      player.refresh();
    });
    amplitude.hidden = true;
    const rows: (Node | undefined)[] = [
      data.modes.length > 0 ? mode : undefined,
      data.modes.length > 0 ? amplitude : undefined,
      data.scene.beams.length > 0 ? color : undefined,
      data.scene.beams.length > 0 ? ranges : undefined,
      data.scene.beams.length > 0 ? largest : undefined,
      h("div", { class: "ticks" },
        tick("As drawn", false, show(beams.ghosts)), tick("Names", false, (on) => this.labels.show(on)),
        data.scene.points.length > 0 ? tick("Trails", false, show(trails.group)) : undefined,
        player.comparison ? tick("Second run", true, (on) => {
          player.comparing = on;
          player.refresh();
        }) : undefined,
        data.scene.bodies.length > 0 ? tick("Bodies", true, show(signs.bodies)) : undefined,
        tick("Joints", true, show(signs.joints)),
        data.scene.springs.length > 0 ? tick("Springs", true, show(signs.springs)) : undefined,
        data.scene.ropes ? tick("Ropes", true, show(player.ropes.group)) : undefined,
        data.scene.water ? tick("Water", true, show(player.water.group)) : undefined,
        data.scene.loads.length > 0 ? tick("Loads", true, show(signs.loads)) : undefined,
        data.tracks.has("joint.force") ? tick("Reactions", false, show(signs.reactions)) : undefined,
        data.scene.points.length > 0 ? tick("Outputs", true, show(signs.points)) : undefined,
        tick("Grid", true, show(stage.grid)),
        tick("Parallel", false, (on) => player.setParallel(on))),
      data.scene.beams.length > 0 ? slider("Thickness", [0, 8, 1], thicknessPlace(player.scale), (place) => `× ${THICKNESS[place]}`, (place) => {
        player.thicken(THICKNESS[place]);
        this.describe();
      }) : undefined,
      data.scene.beams.length > 0 ? slider("Displacement", [0, 8, 1], 0, (place) => `× ${THICKNESS[place]}`, (place) => {
        player.magnification = THICKNESS[place];
        player.refresh();
      }) : undefined,
      h("div", { class: "views" }, ...views, button("Fit", "Fit into the picture", () => this.view(), "F")),
    ];
    const details = h("details", { class: "controls" }, h("summary", {}, "Display"), ...rows.filter((row) => row !== undefined));
    details.open = this.app.clientWidth >= WIDE;
    const leave = () => {
      stage.leave(details.open && innerWidth >= NARROW ? 272 : 0);
      player.look();
    };
    details.addEventListener("toggle", leave);
    return details;
  }

  private timeline(): HTMLElement {
    const { player } = this;
    const now = () => player.timeline;
    const loop = button("⟳", "Loop", () => {
      now().looping = !now().looping;
      loop.setAttribute("aria-pressed", String(now().looping));
    }, "L");
    loop.dataset.control = "loop";
    loop.setAttribute("aria-pressed", "true");
    return h(
      "footer", { class: "timeline" },
      h("div", { class: "buttons" },
        button("|‹", "To the start", () => now().seek(now().start), "Home"), button("‹", "One instant back", () => now().step(-1), "←"), this.play,
        button("›", "One instant on", () => now().step(1), "→"), loop),
      this.scrub,
      this.clock,
      h("div", { class: "buttons" }, button("−", "Slower", () => now().slower(), "−"), this.speed, button("+", "Faster", () => now().faster(), "+")),
    );
  }

  view(view?: View): void {
    if (view) this.player.stage.view(view);
    else this.player.stage.fit();
    this.player.look();
  }

  /** A click that is no drag picks. */
  private pointer(): void {
    const { canvas } = this.player.stage;
    let pressed = { x: 0, y: 0 };
    canvas.addEventListener("pointerdown", ({ clientX: x, clientY: y }) => (pressed = { x, y }));
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4) return;
      const box = canvas.getBoundingClientRect();
      this.player.pick(event.clientX - box.left, event.clientY - box.top);
    });
  }

  /** Brings everything around the picture to the instant that is shown. */
  private update(): void {
    const { player } = this;
    const { timeline } = player;
    if (timeline.duration > 0 && !player.isLive) this.scrub.value = String((1000 * (timeline.time - timeline.start)) / timeline.duration);
    const isMode = player.mode !== undefined;
    const digits = Math.max(0, 2 - Math.floor(Math.log10(timeline.duration || 1)));
    this.clock.textContent = isMode ? pace(this.data.modes[player.mode!]) : `t = ${player.time.toFixed(digits)} s`;
    this.scrub.setAttribute("aria-valuetext", this.clock.textContent);
    this.play.textContent = timeline.playing ? "⏸" : "▶";
    this.play.setAttribute("aria-label", timeline.playing ? "Pause" : "Play");
    this.speed.textContent = isMode ? "" : `${timeline.speed} ×`;
    if (player.quantity && !isMode) {
      const [low, high] = player.range;
      const middle = (low + high) / 2;
      this.legend.querySelectorAll("span").forEach((label, k) => (label.textContent = quantityText([high, middle, low][k], player.quantity!.unit, 3)));
    }
    this.legend.hidden = !player.quantity || isMode;
    const meters = niceLength(110 * player.stage.metersPerPixel());
    this.scaleBar.style.width = `${meters / player.stage.metersPerPixel()}px`;
    this.scaleBar.textContent = quantityText(meters, "m");
    // Of a single instant there is nothing to chart.
    this.side.hidden = this.data.times.length < 2 && !player.spot;
    this.panel.update();
    this.along.update(player.spot?.beam, isMode ? undefined : player.quantity, player.at(), player.seen);
    this.labels.update();
    this.video.update();
  }

  /** Legend and remarks, which do not change from instant to instant. */
  private describe(): void {
    const { quantity, scale, stage } = this.player;
    if (quantity) {
      const bar = h("div", { class: "bar" });
      bar.style.background = gradient(quantity.signed);
      this.legend.replaceChildren(h("div", { class: "name" }, quantity.label), h("div", { class: "scale" }, bar, h("div", { class: "ends" }, h("span"), h("span"), h("span"))));
    }
    const thick = this.data.scene.beams.length > 0 && scale !== 1 ? `sections drawn ${scale} times as thick · ` : "";
    this.scaleNote.textContent = `${thick}grid ${quantityText(stage.cell, "m")}`;
    this.player.refresh();
  }

  switchTheme(): void {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    this.charts.restyle();
    this.player.look();
  }

  /** The color behind the picture. */
  get background(): string {
    return getComputedStyle(document.documentElement).getPropertyValue("--stage").trim();
  }
}

/** How a mode goes on, in a few words. */
export function pace(mode: { kind: string; frequency: number; growth: number }): string {
  if (mode.kind === "vibration") return `${Number(mode.frequency.toPrecision(5))} Hz`;
  return mode.kind === "free" ? "free" : `unstable, grows with rate ${Number(mode.growth.toPrecision(4))} 1/s`;
}

const THICKNESS = [1, 2, 5, 10, 20, 50, 100, 200, 500];

function thicknessPlace(scale: number): number {
  return Math.max(0, THICKNESS.indexOf(scale));
}
