// Two runs in one scene: viewer/test/second.json is a second run as the Rust side writes it (crates/view/src/second.rs holds the same file); their common time axis, their common origin, the rows of
// their charts.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { known } from "../src/charts";
import { instants, shift } from "../src/comparison";
import { readSecond, type Data } from "../src/data";
import { bounds } from "../src/stage";

const info = JSON.parse(readFileSync("test/second.json", "utf8"));

/** A run with a cube of 1 m in the origin of its places. */
const first = (times: number[], second?: Data["second"]): Data =>
  ({ times: Float64Array.from(times), tracks: new Map(), drawn: { place: Float32Array.of(0, 0, 0, 1, 1, 1) }, scene: { origin: [0, 2, 3], size: 1, bodies: [] }, second }) as unknown as Data;

test("a second run is read as it was written", async () => {
  const { names, data } = await readSecond(info);
  assert.deepEqual(names, ["first.toml", "second.toml, steel.young = 1e11"]);
  assert.deepEqual([...data.times], [0.5, 2]);
  assert.deepEqual([...data.tracks.get("body.place")!.values], [0, 1, 2, 4, 5, 6]);
  assert.deepEqual([...data.charts.columns[0].values], [0, 4]);
  assert.deepEqual(data.notes, ["a note"]);
});

test("a second run of another format is refused", async () => {
  await assert.rejects(readSecond({ ...info, data: { ...info.data, format: 99 } }), /format 99/);
});

test("the time axis spans both runs", async () => {
  const second = await readSecond(info);
  assert.deepEqual([...instants(first([0, 1], second))], [0, 1, 2]);
  assert.deepEqual([...instants(first([1, 1.5], second))], [0.5, 1, 1.5, 2]);
  assert.deepEqual([...instants(first([0, 3], second))], [0, 3]);
  assert.deepEqual([...instants(first([0, 3]))], [0, 3]);
});

test("both runs are in sight, at their global positions", async () => {
  const second = await readSecond(info);
  assert.deepEqual(shift(first([0, 1], second)).toArray(), [1, 0, 0]);
  assert.deepEqual(shift(first([0, 1])).toArray(), [0, 0, 0]);
  const { min, max } = bounds(first([0, 1], second));
  // The cube of the second run is at most at (4, 5, 6), moved by (1, 0, 0); around it stays 0.7 of half of its diagonal.
  const around = 0.7 * (Math.sqrt(3) / 2);
  const expected = [0, 0, 0, 5 + around, 5 + around, 6 + around];
  [...min.toArray(), ...max.toArray()].forEach((value, place) => assert.ok(Math.abs(value - expected[place]) < 1e-6, `${place}: ${value}`));
});

test("the legend of a chart reads the nearest row of each run", () => {
  assert.equal(known([1, undefined, undefined, 4], 1), 0);
  assert.equal(known([1, undefined, undefined, 4], 2), 3);
  assert.equal(known([1, null, 3], 1), 1);
  assert.equal(known([undefined, undefined], 1), 1);
});
