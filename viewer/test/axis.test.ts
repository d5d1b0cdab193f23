// The vertical axis of a chart. An axis that fits whatever there is shows round-off as a curve with labels of 1e-14.

import assert from "node:assert/strict";
import { test } from "node:test";
import { size, span, told } from "../src/axis";

test("zero is a line in the middle of an axis", () => {
  assert.deepEqual(span(0, 0), [-1, 1]);
});

test("a constant but for round-off is a line, and a small change is a curve", () => {
  const [low, high] = span(0.7, 0.7 + 1e-11) as [number, number];
  assert.ok(high - low > 0.1, `${low} to ${high}`);
  const [from, to] = span(0.7, 0.7 + 1e-7) as [number, number];
  // Ends are rounded to 1e-15.
  assert.ok(from <= 0.7 + 1e-12 && to >= 0.7 + 1e-7 && to - from < 3e-7, `${from} to ${to}`);
});

test("an axis without values spans nothing", () => {
  assert.deepEqual(span(null, null), [null, null]);
});

test("a value that is round-off of the others reads 0", () => {
  const largest = size([[0, -2e-4], [3e-14, 0]]);
  assert.equal(largest, 2e-4);
  assert.equal(told(3e-14, largest), "0");
  assert.equal(told(3e-12, largest), "3.000e−12");
});
