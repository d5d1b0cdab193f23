// The packed numbers: viewer/test/packed.json has texts that the Rust side writes (crates/view/src/block.rs holds the same file), with the numbers that they stand for.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { doubles, read, track } from "../src/data";
import type { PageInfo } from "../src/format";

const packed = JSON.parse(readFileSync("test/packed.json", "utf8"));

test("tracks are read as they were written, to half a step of their range", async () => {
  const found = await track(packed.track);
  assert.equal(found.values.length, packed.values.length);
  packed.values.forEach((value: number, place: number) => {
    const [low, high] = found.ranges[place % found.components];
    const step = (high - low) / 65535;
    assert.ok(Math.abs(found.values[place] - value) <= 0.5001 * step + 1e-7 * Math.abs(value), `${place}: ${found.values[place]}, ${value}`);
  });
});

test("doubles are read to the last bit", async () => {
  const found = await doubles(packed.doubles);
  assert.deepEqual([...found], packed.numbers);
});

test("data of another format are refused", async () => {
  await assert.rejects(read({ format: 99 } as PageInfo), /format 99/);
});
