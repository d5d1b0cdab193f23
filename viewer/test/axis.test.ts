// The vertical axis of a chart. An axis that fits whatever there is shows round-off as a curve with labels of 1e-14.

import assert from "node:assert/strict";
import { test } from "node:test";
import { size, span, told } from "../src/axis";

test("zero is a line in the middle of an axis", () => {
  assert.deepEqual(span(0, 0), [-1, 1]);
});

test("a constant but for round-off is a line in the middle of an axis from 0", () => {
  assert.deepEqual(span(0.7, 0.7 + 1e-10), [0, 1.4]);
  assert.deepEqual(span(-3 - 1e-12, -3), [2 * (-3 - 1e-12), 0]);
});

test("a small change is a curve, and axes end at 0 where curves do not cross it", () => {
  const [from, to] = span(0.7, 0.7 + 1e-8) as [number, number];
  // Differences of 1e-8 have seven digits.
  assert.ok(Math.abs((0.7 - from) / 1e-9 - 1) < 1e-6 && Math.abs((to - 0.7) / 1.1e-8 - 1) < 1e-6, `${from} to ${to}`);
  assert.deepEqual([span(0, 10), span(-10, 0), span(-10, 10)], [[0, 11], [-11, 0], [-12, 12]]);
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
