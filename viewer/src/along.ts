// A quantity along a beam: now, and the smallest and largest value over the run.

import uPlot from "uplot";
import { quantityText, values, type Quantity } from "./color";
import type { Data } from "./data";
import { h } from "./dom";
import type { Between } from "./moment";

const HEIGHT = 168;

/** Smallest and largest value of each station over the run. */
export function envelope(data: Data, quantity: Quantity): { low: Float32Array; high: Float32Array } {
  const low = new Float32Array(data.stations).fill(Infinity);
  const high = new Float32Array(data.stations).fill(-Infinity);
  data.times.forEach((_, instant) => {
    values(data, quantity, { first: instant, second: instant, share: 0 }).forEach((value, station) => {
      if (value < low[station]) low[station] = value;
      if (value > high[station]) high[station] = value;
    });
  });
  return { low, high };
}

export class Along {
  readonly element = h("section", { class: "chart along", hidden: true });
  private plot?: uPlot;
  private shown = "";
  private extremes?: ReturnType<typeof envelope>;

  constructor(private readonly data: Data) {}

  /** Shows `quantity` along beam number `beam` at an instant of `seen`; hides itself without one. */
  update(beam: number | undefined, quantity: Quantity | undefined, at: Between, seen: Data): void {
    const wanted = beam === undefined || !quantity ? "" : `${beam} ${quantity.word} ${this.element.parentElement?.clientWidth}`;
    this.element.hidden = wanted === "";
    if (beam === undefined || !quantity) return;
    const { stations, fractions, name } = this.data.scene.beams[beam];
    const own = (list: Float32Array) => Array.from(list.subarray(...stations), (value) => (Number.isFinite(value) ? value : null));
    if (wanted !== this.shown) {
      this.shown = wanted;
      this.extremes = envelope(this.data, quantity);
      this.plot?.destroy();
      this.plot = this.chart(`${name}: ${quantity.label} along the beam`, quantity);
    }
    const { low, high } = this.extremes!;
    this.plot!.setData([fractions, own(low), own(high), own(values(seen, quantity, at))]);
  }

  dispose(): void {
    this.plot?.destroy();
  }

  private chart(title: string, quantity: Quantity): uPlot {
    const style = getComputedStyle(document.documentElement);
    const [ink, line, accent] = ["--ink-soft", "--line", "--accent"].map((name) => style.getPropertyValue(name).trim());
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, font: "11px system-ui, sans-serif" };
    const value = (_: uPlot, number: number | null) => (number === null ? "–" : quantityText(number, quantity.unit));
    return new uPlot(
      {
        width: Math.max(200, (this.element.parentElement?.clientWidth ?? 320) - 12),
        height: HEIGHT,
        title,
        scales: { x: { time: false } },
        axes: [{ ...axis, size: 26 }, { ...axis, size: 62, values: (_, splits) => splits.map((split) => quantityText(split, quantity.unit, 3)) }],
        series: [
          { label: "fraction", value: (_, number) => (number === null ? "–" : number.toFixed(3)) },
          { label: "min", stroke: "#8a94a6", width: 1, value },
          { label: "max", stroke: "#8a94a6", width: 1, dash: [5, 4], value },
          { label: "now", stroke: accent, width: 2, value },
        ],
      },
      [[], [], [], []],
      this.element,
    );
  }
}
