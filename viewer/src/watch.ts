// The page of `ancf14 view --watch`: asks the program that serves it for news of the model, and shows each new run in place of the one before. A mistake is told above the picture, which stays.

import { button, h, unshown } from "./dom";
import type { PageInfo } from "./format";

/** Milliseconds between two questions. */
const PACE = 400;

/** What the program answers: crates/cli/src/watch/news.rs. */
interface News {
  /** Number of the run that is there to be shown; 0: none yet. */
  run: number;
  /** The share of the present run that is done; null: it has ended. */
  share: number | null;
  /** What is wrong with the model, as on the terminal; empty: nothing. */
  error: string;
  warnings: string[];
}

export class Watch {
  private readonly told = h("div", { class: "told", role: "status" });
  private readonly progress = h("progress", { max: 1, hidden: true, "aria-label": "Progress of the run" });
  readonly element = h("aside", { class: "watch", "aria-label": "News of the model" }, this.progress, this.told);
  private shown = 0;
  private last = "";
  private failure = "";

  /** `show` shows the data of a run. */
  constructor(private readonly show: (data: PageInfo) => Promise<void>) {
    void this.watch();
  }

  private async watch(): Promise<void> {
    for (;;) {
      try {
        await this.look();
      } catch (reason) {
        this.progress.hidden = true;
        this.tell(reason instanceof Error ? reason.message : String(reason), []);
      }
      await new Promise((go) => setTimeout(go, PACE));
    }
  }

  private async look(): Promise<void> {
    const { run, share, error, warnings } = await ask<News>("news");
    this.progress.hidden = share === null;
    this.progress.value = share ?? 0;
    if (run !== this.shown) {
      const data = await ask<PageInfo>("data");
      // A run that cannot be shown is not asked for again.
      this.shown = run;
      this.failure = await this.show(data).then(() => "", unshown);
    }
    this.tell(error || this.failure, warnings);
  }

  private tell(error: string, warnings: string[]): void {
    // An element that is replaced loses what is selected in it.
    const words = JSON.stringify([error, warnings]);
    if (words === this.last) return;
    this.last = words;
    // Whoever has read it can put it away; what is new is shown again.
    const hide = button("×", "Hide", () => this.told.replaceChildren());
    this.told.replaceChildren(
      ...(error || warnings.length > 0 ? [hide] : []),
      ...(error ? [h("pre", { class: "error", role: "alert" }, error)] : []),
      ...warnings.map((warning) => h("p", { class: "warning" }, `Warning: ${warning}`)));
  }
}

async function ask<T>(what: string): Promise<T> {
  const answer = await fetch(what, { cache: "no-store" }).catch(() => undefined);
  if (!answer?.ok) throw new Error("The program does not answer: it has ended. Start ancf14 view --watch again, and open the address that it prints.");
  return answer.json();
}
