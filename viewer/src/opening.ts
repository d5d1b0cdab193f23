// The instant at which a page opens: the state worth seeing.

import { values, type Quantity } from "./color";
import type { Data } from "./data";

/** An instant this near to the largest deformation, as a share of it, is as good: a mechanism at rest opens at its start. */
const NEAR = 0.01;

/**
 * Time of the state worth seeing, s: the end of equilibria, which are followed for the sake of the last one; of a motion the first instant at which the quantity of the colors is
 * largest, as the root mean square over all stations, because a peak at a single station deforms nothing.
 */
export function opening(data: Data, quantity?: Quantity): number {
  const { times, scene } = data;
  if (!scene.dynamic) return times[times.length - 1] ?? 0;
  if (!quantity) return times[0] ?? 0;
  // A value that is not known counts as none.
  const sizes = Array.from(times, (_, instant) => Math.sqrt(values(data, quantity, { first: instant, second: instant, share: 0 }).reduce((sum, value) => sum + (value * value || 0), 0)));
  const largest = sizes.reduce((most, size) => Math.max(most, size), 0);
  return times[sizes.findIndex((size) => size >= (1 - NEAR) * largest)] ?? 0;
}

/** The end of the page's address with which it plays at once. */
const PLAY = "#play";

/** Whether the page is to play as it opens; not for a reader who has asked for less motion. */
export function plays(): boolean {
  return location.hash === PLAY && !isStill();
}

/** Whether the reader has asked for less motion. */
export function isStill(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
