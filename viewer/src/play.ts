// The run that a reader plays with: starts and ends it, shows its frames in the page, tells how fast it is.

import { h } from "./dom";
import { Drag, Frames } from "./drag";
import type { Request, Solver } from "./solver";
import { NARROW, type Page } from "./ui";

/** Keys that end it. */
const END = "Escape";
/** Milliseconds between two words on how fast it is: a screen reader speaks them. */
const PATIENCE = 1000;

export class Play {
  readonly button = h("button", { type: "button", class: "interact", "aria-pressed": "false", title: "Simulate while you drag the mechanism with the mouse or a finger (Escape ends)", onclick: () => this.toggle() }, "Interact");
  readonly status = h("p", { class: "interacting", role: "status", hidden: true });
  private drag?: Drag;
  private page?: Page;
  private state: "off" | "on" | "paused" = "off";
  private readonly keys: (event: KeyboardEvent) => void;

  /** `request` is the model of the run that is shown; `tell` shows a message of the solver; `changed` is called at begin and end. */
  constructor(private readonly solver: Solver, private readonly request: () => Request, private readonly tell: (error: string) => void, private readonly changed: (on: boolean) => void) {
    this.keys = (event) => {
      if (event.key !== END) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      this.end();
    };
  }

  get isOn(): boolean {
    return this.state !== "off";
  }

  /** Ends it, if it is on. */
  end(): void {
    if (this.isOn) this.solver.stop();
  }

  private toggle(): void {
    if (this.state === "paused") {
      this.tell("");
      this.state = "on";
      this.switch();
      this.solver.send({ kind: "resume" });
    } else if (this.isOn) this.end();
    else void this.start();
  }

  private async start(): Promise<void> {
    const { ancf14: page } = window as unknown as { ancf14?: Page };
    if (!page) return;
    const { player } = page;
    if (!page.data.scene.dynamic) return this.tell('There is nothing to drag: a static analysis has no motion. Set simulation.analysis to "dynamic".');
    this.tell("");
    this.state = "on";
    this.switch();
    this.changed(true);
    this.status.textContent = "Finding the initial state …";
    player.timeline.pause();
    const mode = page.app.querySelector<HTMLSelectElement>("[data-control=mode] select");
    if (mode) {
      mode.value = "";
      mode.dispatchEvent(new Event("change"));
    }
    const pace = player.run.speed;
    let frames: Frames | undefined;
    let told = -Infinity;
    addEventListener("keydown", this.keys, true);
    const outcome = await this.solver.interact(this.request(), pace, {
      begun: (info) => {
        this.page = page;
        // There the picture is below the controls.
        if (innerWidth < NARROW) player.stage.canvas.scrollIntoView();
        frames = new Frames(info, page.data.tracks);
        this.drag = new Drag(page, info, frames, {
          grab: (grip, place) => this.solver.send({ kind: "grab", grip, place }),
          pull: (place) => this.solver.send({ kind: "pull", place }),
          release: () => this.solver.send({ kind: "release" }),
        });
      },
      frame: (numbers, rate) => {
        if (!frames) return;
        frames.take(numbers);
        player.showLive(frames);
        this.drag?.update();
        if (this.state === "paused" || performance.now() - told < PATIENCE) return;
        told = performance.now();
        const late = rate < 0.95 * pace ? `; the solver is slower than the chosen speed, ${pace} ×` : "";
        this.status.textContent = `t = ${frames.time.toFixed(2)} s, ${Number(rate.toPrecision(2))} × real time${late}. Drag a beam or a body; Escape ends.`;
      },
      paused: (error) => {
        this.drag?.release();
        this.state = "paused";
        this.switch();
        this.tell(error);
        this.status.textContent = "Paused: the solver could not go on. The mechanism is where it was before the step, and nothing holds it.";
      },
    }).catch((reason) => ({ error: `The page cannot show the run: ${reason instanceof Error ? reason.message : String(reason)}.` }));
    removeEventListener("keydown", this.keys, true);
    this.drag?.dispose();
    this.drag = undefined;
    // Another page may have taken its place.
    if (this.page === (window as unknown as { ancf14?: Page }).ancf14) player.showLive(undefined);
    this.state = "off";
    this.switch();
    this.changed(false);
    if (outcome.error) this.tell(outcome.error);
  }

  private switch(): void {
    this.button.textContent = { off: "Interact", on: "End interaction", paused: "Continue" }[this.state];
    this.button.setAttribute("aria-pressed", String(this.isOn));
    this.status.hidden = !this.isOn;
  }
}
