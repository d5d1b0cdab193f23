// The model in the page: its parameters, its text, and the solver that simulates it anew.

import { Controls } from "./controls";
import { h, tick } from "./dom";
import type { PageInfo } from "./format";
import { Play } from "./play";
import { Solver, type Outcome, type Request } from "./solver";

/** From this width on the model is open from the start. */
const WIDE = 1100;

export class Live {
  readonly element: HTMLElement;
  private readonly solver: Solver;
  private readonly controls = new Controls(() => this.changed());
  private readonly text: HTMLTextAreaElement;
  private readonly source: HTMLDetailsElement;
  private readonly start = h("button", { type: "button", class: "run", onclick: () => void this.run() }, "Run again");
  private readonly stop = h("button", { type: "button", class: "stop", hidden: true, onclick: () => this.solver.stop() }, "Stop");
  private readonly progress = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the run" });
  private readonly told = h("div", { class: "told", role: "status" });
  private readonly command = h("code");
  private readonly commandBox: HTMLElement;
  private readonly play: Play;
  /** What the run that is shown was asked for with. */
  private shown: Request;
  private automatic = false;
  private running = false;
  private waiting = false;
  /** The text of the model whose controls are shown. */
  private described = "";

  /** `show` shows the data of a run. */
  constructor(private readonly model: Request, packed: string, private readonly show: (data: PageInfo) => Promise<void>) {
    this.solver = new Solver(packed);
    this.shown = model;
    this.play = new Play(this.solver, () => this.shown, (error) => this.tell(error), () => this.switch());
    this.text = h("textarea", {
      spellcheck: "false", rows: 18, wrap: "off", "aria-label": "Text of the model file",
      onchange: () => this.changed(),
    });
    this.text.value = model.text;
    this.source = h("details", { class: "source" }, h("summary", {}, "Model file"), this.text);
    this.commandBox = h("p", { class: "command" }, "On the command line: ", this.command);
    const details = h("details", { class: "live" },
      h("summary", {}, "Model"),
      h("div", { class: "run-bar" }, this.start, this.stop, this.play.button, tick("Run at each change", false, (on) => ((this.automatic = on), on && this.controls.changes.length > 0 && void this.run())), this.progress),
      this.play.status, this.told, this.controls.element, this.source, this.commandBox);
    details.open = innerWidth >= WIDE;
    this.element = h("aside", { class: "model", "aria-label": "Model" }, details);
    this.tellCommand();
    void this.open();
  }

  /** What the page asks the solver for now. */
  private request(): Request {
    const changes = this.controls.changes;
    const overrides: [string, string][] = [];
    const set = new Map(changes);
    for (const [key, value] of this.model.overrides) {
      // Each key once. Of a vector that was given as a whole, all components follow if one is changed.
      const parts = this.controls.values.filter(([name]) => name === key || name.startsWith(`${key}[`) || key.endsWith(`.${name}`));
      if (parts.some(([name]) => set.has(name))) parts.forEach(([name, text]) => set.set(name, text));
      else overrides.push([key, value]);
    }
    return { ...this.model, text: this.text.value, overrides: [...overrides, ...set] };
  }

  /** Shows what can be set in the model as it is written. */
  private async describe(): Promise<string> {
    this.described = this.text.value;
    const { description, error } = await this.solver.describe({ ...this.model, text: this.text.value });
    if (description) this.controls.show(description.controls);
    this.tellCommand();
    return error ?? "";
  }

  private async open(): Promise<void> {
    try {
      this.tell(await this.describe());
    } catch (reason) {
      this.tell(`This browser cannot run the solver: ${reason instanceof Error ? reason.message : String(reason)}. Open the page in a browser of 2023 or later.`);
      this.start.disabled = true;
    }
  }

  private changed(): void {
    this.tellCommand();
    if (this.automatic) void this.run();
  }

  /** Simulates; a change in the meantime simulates once more. */
  async run(): Promise<void> {
    this.play.end();
    if (this.running) {
      this.waiting = true;
      this.solver.stop();
      return;
    }
    this.running = true;
    this.waiting = false;
    this.switch();
    this.tell("");
    const end = await this.simulate(this.request()).catch((reason): Outcome => ({ error: `The page cannot show the run: ${reason instanceof Error ? reason.message : String(reason)}.` }));
    this.running = false;
    this.switch();
    if (this.waiting) await this.run();
    else this.tell(end.ended ? "The run was stopped before it had a result." : (end.error ?? ""), end.warnings);
  }

  /** Simulates and shows the run, unless another one waits already. */
  private async simulate(request: Request): Promise<Outcome> {
    const outcome = await this.solver.run(request, (share) => (this.progress.value = share));
    // Another text has other numbers to set.
    if (request.text !== this.described && !outcome.error) outcome.error = await this.describe();
    if (outcome.data && !this.waiting) {
      await this.show(outcome.data);
      this.shown = request;
    }
    return outcome;
  }

  private switch(): void {
    this.start.disabled = this.running && !this.automatic;
    this.play.button.disabled = this.running;
    this.stop.hidden = this.progress.hidden = !this.running;
    this.progress.value = 0;
  }

  /** Shows what the solver says; a line of the model file can be gone to. */
  private tell(error: string, warnings: string[] = []): void {
    this.controls.mark(error);
    const line = Number(/^ *--> .*?:(\d+):\d+/m.exec(error)?.[1] ?? NaN);
    const go = h("button", { type: "button", onclick: () => this.goTo(line) }, `Go to line ${line}`);
    this.told.replaceChildren(
      ...(error ? [h("pre", { class: "error", role: "alert" }, error), ...(line ? [go] : [])] : []),
      ...warnings.map((warning) => h("p", { class: "warning" }, `Warning: ${warning}`)));
  }

  private goTo(line: number): void {
    this.source.open = true;
    const lines = this.text.value.split("\n");
    const begin = lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
    this.text.focus();
    this.text.setSelectionRange(begin, begin + (lines[line - 1]?.length ?? 0));
    this.text.scrollTop = (this.text.scrollHeight / lines.length) * (line - 4);
  }

  private tellCommand(): void {
    const { file, overrides, modes } = this.request();
    // What a shell might read in another way is quoted.
    const word = (text: string) => (/^[\w.,:+/=-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
    const set = overrides.map(([key, value]) => ` --set ${word(`${key}=${value}`)}`).join("");
    this.command.textContent = `ancf14 view ${word(file)}${set}${modes === null ? "" : ` --modes=${modes}`}`;
    this.commandBox.hidden = this.text.value !== this.model.text;
  }
}
