// The vertical axis of a chart: what it spans, and its numbers. Round-off is not shown as a curve.

import type uPlot from "uplot";
import { plainText } from "./color";

/** What changes by less than this share of its size is constant but for round-off; what is smaller than this share of the largest value beside it is zero. */
const ROUND_OFF = 1e-9;
/** The share of the span that stays free above and below the curves. */
const MARGIN = 0.1;

/** The largest size among the values of all curves of a chart. */
export function size(curves: ArrayLike<number>[]): number {
  let most = 0;
  for (const values of curves) for (let at = 0; at < values.length; at++) if (Math.abs(values[at]) > most) most = Math.abs(values[at]);
  return most;
}

/** What the axis of curves from `low` to `high` spans: a margin more, not beyond 0, and from 0 on where they are constant; of zero from -1 to 1. uPlot's own rule rounds to ten digits. */
export function span(low: number | null, high: number | null): uPlot.Range.MinMax {
  if (low === null || high === null) return [low, high];
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (largest === 0) return [-1, 1];
  if (high - low <= ROUND_OFF * largest) return low > 0 ? [0, 2 * low] : [2 * low, 0];
  const margin = MARGIN * (high - low);
  return [low >= 0 ? Math.max(0, low - margin) : low - margin, high <= 0 ? Math.min(0, high + margin) : high + margin];
}

/** A value beside others of which the largest is `largest`. */
export function told(value: number, largest: number): string {
  return plainText(Math.abs(value) < ROUND_OFF * largest ? 0 : value);
}

/** A number of an axis: as many digits as tell neighbours apart. */
export function axisText(value: number, splits: number[]): string {
  const step = Math.abs(splits[1] - splits[0]) || 1;
  const most = Math.max(...splits.map(Math.abs));
  if (value === 0) return "0";
  if (most >= 1e5 || most < 1e-3) return value.toExponential(Math.max(0, Math.min(3, Math.floor(Math.log10(most)) - Math.floor(Math.log10(step)))));
  let digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) > 1e-6) digits++;
  return value.toFixed(digits);
}
