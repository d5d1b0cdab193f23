// Charts of all outputs, linked to the timeline: a click goes to that instant, the pointer reads values.

import uPlot from "uplot";
import { axisText, size, span, told } from "./axis";
import { plainText } from "./color";
import type { Data } from "./data";
import { h } from "./dom";
import type { Timeline } from "./timeline";

const STROKES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a7a00", "#56a0d3", "#7a4fc0", "#444c58"];
/** The same colors, bright enough on a dark background. */
const BRIGHT = ["#4aa8e8", "#f0803c", "#2fc796", "#e49ac4", "#c9ba4a", "#8ccdf5", "#ab86ea", "#b4bdca"];
/** Lines of a second run. */
const DASH = [6, 4];
/** A chart of the stations of a beam has so many curves at most. */
const MOST_CURVES = 8;
const HEIGHT = 168;
const AXES = new Map([["[1]", "x"], ["[2]", "y"], ["[3]", "z"]]);

interface Chart {
  host: HTMLElement;
  plot?: uPlot;
  now: HTMLElement;
}

export class Charts {
  readonly element = h("div", { class: "charts" });
  private readonly charts: Chart[] = [];
  private readonly sync = uPlot.sync("time");

  constructor(private readonly data: Data, private readonly timeline: Timeline) {
    const seen = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        if (entry.isIntersecting) this.open(this.charts.find((chart) => chart.host === entry.target)!);
      }
    }, { rootMargin: "300px" });
    for (const group of data.charts.groups) {
      const host = h("section", { class: "chart", "data-chart": group.name, style: `min-height: ${HEIGHT + 56}px` });
      this.charts.push({ host, now: h("div", { class: "now" }) });
      this.element.append(host);
      seen.observe(host);
    }
    new ResizeObserver(() => this.resize()).observe(this.element);
    timeline.onchange(() => this.mark());
  }

  /** Draws all charts anew, in the colors of the page. */
  restyle(): void {
    for (const chart of this.charts) {
      if (!chart.plot) continue;
      chart.plot.destroy();
      chart.plot = undefined;
      this.open(chart);
    }
  }

  /** Ends all charts, which listen to the window. */
  dispose(): void {
    for (const chart of this.charts) chart.plot?.destroy();
    this.charts.length = 0;
  }

  private width(): number {
    return Math.max(200, this.element.clientWidth - 12);
  }

  private open(chart: Chart): void {
    if (chart.plot || this.element.clientWidth === 0) return;
    const { groups, columns, times } = this.data.charts;
    const group = groups[this.charts.indexOf(chart)];
    const { second } = this.data;
    const every = Math.ceil((group.columns.length * (second ? 2 : 1)) / MOST_CURVES);
    const shown = group.columns.filter((_, k) => k % every === 0 || k === group.columns.length - 1);
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink-soft").trim();
    const line = style.getPropertyValue("--line").trim();
    const strokes = style.colorScheme === "dark" ? BRIGHT : STROKES;
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, font: "11px system-ui, sans-serif" };
    const title = `${group.name}${group.unit ? ` (${group.unit})` : ""}`;
    // `along.position.2` has the columns `along.position[1,2]`, ...: what differs is enough.
    const common = group.name.replace(/\.\d+$/, "");
    const end = (name: string) => (name.startsWith(common) ? name.slice(common.length).replace(/^\./, "") : name) || "value";
    // A vector has the components x, y and z; four numbers are a quaternion.
    const isVector = group.columns.length === 3;
    const isAlong = group.columns.length > 4;
    const label = (name: string) => (isVector && AXES.get(end(name))) || end(name).replace(/^\[(\d+)(,\d+)?\]$/, (whole, station) => (isAlong ? `station ${station}` : whole));
    const largest = size(shown.map((column) => columns[column].values));
    const text = (value: number | null) => (value === null ? "–" : told(value, largest));
    const same = (column: number) => second?.data.charts.columns.find(({ name, unit }) => name === columns[column].name && unit === columns[column].unit);
    const others = shown.flatMap((column, k) => {
      const own = same(column);
      return own ? [{ ...own, label: `${label(own.name)} 2nd`, stroke: strokes[k % strokes.length] }] : [];
    });
    const curve = (label: string, stroke: string, count: number) =>
      ({ label, stroke, width: 1.6, points: { show: count < 3 }, value: (_: uPlot, value: number | null | undefined) => text(value ?? null) });
    const own = [times, ...shown.map((column) => columns[column].values)] as unknown as uPlot.AlignedData;
    // Where one run has no row at an instant of the other, its line goes on to its next one.
    const rows = second && others.length > 0 ? uPlot.join([own, [second.data.charts.times, ...others.map(({ values }) => values)] as unknown as uPlot.AlignedData]) : own;
    chart.plot = new uPlot(
      {
        width: this.width(),
        height: HEIGHT,
        title,
        cursor: { sync: { key: this.sync.key, setSeries: false }, drag: { x: true, y: false }, points: { size: 6 } },
        scales: { x: { time: false }, y: { range: (_, low, high) => span(low, high) } },
        axes: [
          { ...axis, size: 26 },
          { ...axis, size: 58, values: (_, splits) => splits.map((value) => (largest === 0 && value !== 0 ? "" : axisText(value, splits))) },
        ],
        series: [
          { label: "t", value: (_, value) => (value === null ? "–" : plainText(value)) },
          ...shown.map((column, k) => curve(label(columns[column].name), strokes[k % strokes.length], times.length)),
          ...others.map(({ label, stroke, values }) => ({ ...curve(label, stroke, values.length), dash: DASH })),
        ],
        // uPlot empties the legend as the pointer leaves; `setCursor` comes after that.
        hooks: { ready: [() => queueMicrotask(() => this.markOne(chart))], setScale: [() => this.markOne(chart)], setCursor: [() => this.markOne(chart)] },
      },
      rows,
      chart.host,
    );
    chart.plot.over.append(chart.now);
    this.listen(chart.plot);
  }

  /** A click goes to the instant; a drag, which zooms, does not. */
  private listen(plot: uPlot): void {
    let pressed = 0;
    plot.over.addEventListener("pointerdown", (event) => (pressed = event.clientX));
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - pressed) > 4) return;
      const left = event.clientX - plot.over.getBoundingClientRect().left;
      this.timeline.playing = false;
      this.timeline.seek(plot.posToVal(left, "x"));
    });
  }

  private resize(): void {
    for (const chart of this.charts) chart.plot?.setSize({ width: this.width(), height: HEIGHT });
    this.mark();
  }

  /** Moves the line of the present instant in all charts. */
  private mark(): void {
    for (const chart of this.charts) this.markOne(chart);
  }

  private markOne({ plot, now }: Chart): void {
    if (!plot) return;
    const left = plot.valToPos(this.timeline.time, "x");
    now.style.transform = `translateX(${left}px)`;
    // The legend tells the values of the pointer, or else of the present instant.
    if ((plot.cursor.left ?? -1) < 0) plot.setLegend({ idxs: plot.data.map((values) => known(values, plot.posToIdx(left))) }, false);
    now.hidden = !(left >= 0 && left <= plot.over.clientWidth);
  }
}

/** The place nearest to `index` at which a run has a row. */
export function known(values: ArrayLike<number | null | undefined>, index: number): number {
  for (let away = 0; away < values.length; away++) {
    for (const place of [index - away, index + away]) if (values[place] !== undefined) return place;
  }
  return index;
}
