// The sliders of the page: what they span, and how numbers are typed.

import assert from "node:assert/strict";
import { test } from "node:test";
import { sliderRange, typed } from "../src/controls";

const of = (value: number, more: object = {}) => sliderRange({ name: "", unit: "", meaning: "", value, integer: false, ...more });

test("a slider spans the range of its number, or 0 to twice the value within the limits", () => {
  assert.deepEqual(of(2.1e11), [0, 4.2e11]);
  assert.deepEqual(of(-9.81), [-19.62, 0]);
  assert.deepEqual(of(0), [-1, 1]);
  assert.deepEqual(of(500, { min: 10, max: 2000 }), [10, 2000]);
  assert.deepEqual(of(0.3, { max: 0.5 }), [0, 0.5]);
  // The limits of a count, 1 to 100,000, are no range to choose from.
  assert.deepEqual(of(8, { integer: true, min: 1, max: 1e5 }), [1, 16]);
  assert.deepEqual(of(1, { integer: true, min: 1 }), [1, 5]);
  assert.deepEqual(of(0, { min: 0 }), [0, 1]);
});

test("numbers are typed as short as they are read back", () => {
  const numbers = [0, 0.005, 2.1e11, -9.81, 1e-8, 1 / 3, 7850, 123456.789];
  assert.deepEqual(numbers.map((value) => Number(typed(value))), numbers);
  assert.deepEqual([2.1e11, 1e-8, 0.005, 500].map(typed), ["2.1e11", "1e-8", "0.005", "500"]);
});
