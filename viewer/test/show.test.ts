// Instants between two recorded ones, colors, ranges, places on beams, the course of time.

import assert from "node:assert/strict";
import { test } from "node:test";
import { color, plainText, quantityText, QUANTITIES, range, values } from "../src/color";
import type { Data, Track } from "../src/data";
import type { BeamInfo } from "../src/format";
import { between, mix } from "../src/moment";
import { fraction, nearest, placeAt, spotAt, valueAt } from "../src/pick";
import { niceLength } from "../src/stage";
import { niceSpeed, Timeline } from "../src/timeline";

const track = (components: number, things: number, list: number[]): Track => ({ components, things, ranges: [], values: Float32Array.from(list) });

/** Two beams, the second without a stress; two instants. */
const data = {
  times: Float64Array.of(0, 1),
  stations: 4,
  scene: { beams: [{ stress: true, stations: [0, 2] }, { stress: false, stations: [2, 4] }] },
  tracks: new Map([
    ["stress", track(1, 4, [1, 2, 0, 0, 5, 6, 0, 0])],
    ["moment_y", track(1, 4, [3, 0, 0, 0, 0, 0, 0, 0])],
    ["moment_z", track(1, 4, [4, 0, 0, 0, 0, 0, 0, -12])],
    ["torque", track(1, 4, [-8, 0, 0, 0, 2, 0, 0, 0])],
  ]),
} as unknown as Data;

const quantity = (word: string) => QUANTITIES.find((own) => own.word === word)!;
const FIRST = { first: 0, second: 0, share: 0 };

test("time lies between recorded instants", () => {
  const times = Float64Array.of(0, 1, 3);
  assert.deepEqual(between(times, 2), { first: 1, second: 2, share: 0.5 });
  assert.deepEqual(between(times, -1), { first: 0, second: 0, share: 0 });
  assert.deepEqual(between(times, 9), { first: 2, second: 2, share: 0 });
  assert.deepEqual([...mix(track(1, 2, [0, 10, 4, 20]), { first: 0, second: 1, share: 0.25 })], [1, 12.5]);
  const turn = mix(track(4, 1, [1, 0, 0, 0, 0, 1, 0, 0]), { first: 0, second: 1, share: 0.5 });
  assert.ok(Math.abs(Math.hypot(...turn) - 1) < 1e-6);
});

test("quantities of two components are their length; what is unknown has no value", () => {
  assert.equal(values(data, quantity("bending_moment"), FIRST)[0], 5);
  const stress = values(data, quantity("stress"), FIRST);
  assert.deepEqual([...stress.subarray(0, 2)], [1, 2]);
  assert.ok(Number.isNaN(stress[2]) && Number.isNaN(stress[3]));
});

test("ranges are of an instant or of the run, those of two signs symmetric", () => {
  assert.deepEqual(range(data, quantity("stress")), [0, 6]);
  assert.deepEqual(range(data, quantity("stress"), FIRST), [0, 2]);
  assert.deepEqual(range(data, quantity("torque")), [-8, 8]);
  assert.deepEqual(range(data, quantity("bending_moment")), [0, 12]);
});

test("colors go from end to end, neutral at zero, gray where nothing is known", () => {
  const gray = color(0, [-1, 1], true);
  assert.ok(Math.abs(gray[0] - gray[2]) < 1e-9);
  const [cold, warm] = [color(-1, [-1, 1], true), color(1, [-1, 1], true)];
  assert.ok(cold[2] > cold[0] && warm[0] > warm[2]);
  assert.deepEqual(color(9, [0, 1], false), color(1, [0, 1], false));
  assert.deepEqual(color(0, [0, 0], false), color(0, [0, 1], false));
  assert.notDeepEqual(color(NaN, [0, 1], false), color(0, [0, 1], false));
});

test("numbers are told with a prefix and four digits", () => {
  assert.equal(quantityText(2.0404e9, "Pa"), "2.04 GPa");
  assert.equal(quantityText(-0.043842, "m"), "−43.84 mm");
  assert.equal(quantityText(0.25, ""), "0.25");
  assert.equal(quantityText(0.25, "1/m"), "0.25 1/m");
  assert.equal(quantityText(12, "m/s2"), "12 m/s²");
  assert.equal(quantityText(0, "N.m"), "0 N·m");
  assert.equal(quantityText(NaN, "Pa"), "unknown");
  assert.equal(plainText(-1.23456e-7), "−1.235e-7");
});

test("a click means the nearest point of the axis; its fraction is that of the length", () => {
  const beam = { stations: [1, 4], fractions: [0, 0.5, 1] } as BeamInfo;
  const places = [9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 2, 0];
  const spot = nearest(beam, 0, places, [1.2, 0.5, 0.1]);
  assert.deepEqual(spot, { beam: 0, station: 2, share: 0.25 });
  assert.equal(fraction(beam, spot), 0.625);
  assert.deepEqual(spotAt(beam, 0, 0.625), spot);
  assert.deepEqual(spotAt(beam, 0, 1), { beam: 0, station: 2, share: 1 });
  assert.deepEqual(placeAt(places, spot).toArray(), [1, 0.5, 0]);
  assert.equal(valueAt([0, 0, 8, 4], spot), 7);
});

test("time passes, loops, stops, and goes by instants", () => {
  const timeline = new Timeline([0, 1, 2, 4], 4);
  assert.equal(timeline.speed, 1);
  timeline.toggle();
  timeline.advance(3);
  assert.equal(timeline.time, 3);
  timeline.advance(2);
  assert.equal(timeline.time, 1);
  timeline.step(1);
  assert.equal(timeline.time, 2);
  assert.equal(timeline.playing, false);
  timeline.looping = false;
  timeline.toggle();
  timeline.advance(100);
  assert.deepEqual([timeline.time, timeline.playing], [4, false]);
  timeline.seek(-5);
  assert.equal(timeline.time, 0);
  timeline.looping = timeline.once = true;
  timeline.toggle();
  timeline.advance(100);
  assert.deepEqual([timeline.time, timeline.playing], [4, false]);
  const instant = new Timeline([0], 8);
  instant.toggle();
  assert.equal(instant.playing, false);
});

test("speeds and lengths are round", () => {
  assert.deepEqual([0.06, 1.2, 13, NaN].map(niceSpeed), [0.05, 1, 10, 1]);
  assert.deepEqual([0.13, 0.2, 7, 99].map(niceLength), [0.1, 0.2, 5, 50]);
});
