// The surface of the water: the waves that the page is told, at the point and time that it shows.

import assert from "node:assert/strict";
import { test } from "node:test";
import { cells, elevation } from "../src/water";

/** A wave of 2 m that travels along (0.6, 0.8), with its crest at the global origin at the start. */
const water = { surface: 0, ramp: 0, waves: [[2, 0.8, 0.07, 0.6, 0.8, 0]] as [number, number, number, number, number, number][] };

test("a crest travels along the direction of its wave at frequency over number", () => {
  const way = 0.8 / 0.07 * 5;
  assert.ok(Math.abs(elevation(water, 0, 0, 0) - 2) < 1e-12);
  assert.ok(Math.abs(elevation(water, 0.6 * way, 0.8 * way, 5) - 2) < 1e-12);
  // Across its direction nothing changes.
  assert.ok(Math.abs(elevation(water, -0.8 * 33, 0.6 * 33, 0) - 2) < 1e-12);
  assert.ok(Math.abs(elevation(water, 0, 0, Math.PI / 0.8) + 2) < 1e-12);
});

test("waves grow over the ramp", () => {
  const growing = { ...water, ramp: 10 };
  assert.equal(elevation(growing, 0, 0, 0), 0);
  // Half the share at half the ramp, all of it behind.
  assert.ok(Math.abs(elevation(growing, 0, 0, 5) - 0.5 * elevation(water, 0, 0, 5)) < 1e-12);
  assert.equal(elevation(growing, 0, 0, 12), elevation(water, 0, 0, 12));
});

test("many waves make a coarser surface, still water a flat one", () => {
  assert.equal(cells(0), 1);
  assert.equal(cells(1), 64);
  assert.ok(cells(400) >= 8 && 400 * (cells(400) + 1) ** 2 <= 500_000);
});
