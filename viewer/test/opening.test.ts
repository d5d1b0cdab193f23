// The instant at which a page opens: a page that opens at the start shows a straight beam without color, which is the state nobody asks for.

import assert from "node:assert/strict";
import { test } from "node:test";
import { QUANTITIES } from "../src/color";
import type { Data } from "../src/data";
import { opening } from "../src/opening";

const torque = QUANTITIES.find(({ word }) => word === "torque")!;

/** A beam with two stations; `values` has those of each instant, a second apart. */
const run = (dynamic: boolean, values: number[][]): Data => ({
  times: Float64Array.from(values, (_, instant) => instant),
  scene: { dynamic, beams: [{ stress: true, stations: [0, 2] }] },
  tracks: new Map([["torque", { components: 1, things: 2, ranges: [], values: Float32Array.from(values.flat()) }]]),
}) as unknown as Data;

test("a motion opens at its largest deformation, of either sign, and not at a peak of one station", () => {
  assert.equal(opening(run(true, [[0, 0], [2, 1], [-4, -4], [0, 5]]), torque), 2);
});

test("a mechanism at rest opens at its start, whatever its round-off is", () => {
  assert.equal(opening(run(true, [[7, 0], [7.0001, 0], [7.0002, 0]]), torque), 0);
  assert.equal(opening(run(true, [[0, 0], [0, 0]]), torque), 0);
});

test("values that are not known do not count", () => {
  assert.equal(opening(run(true, [[0, NaN], [NaN, 1], [0, NaN]]), torque), 1);
});

test("equilibria open at the last one, and what has no color at its start", () => {
  assert.equal(opening(run(false, [[0, 0], [9, 9], [1, 1]]), torque), 2);
  assert.equal(opening(run(true, [[0, 0], [9, 9], [1, 1]])), 0);
});
