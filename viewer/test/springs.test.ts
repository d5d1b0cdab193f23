// Springs of the picture: each is a straight wire from its one end to the other, with a coil of bounded length in its middle. Coils as long as their springs hide what many springs hold.

import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import type { Data } from "../src/data";
import type { Moment } from "../src/moment";
import { Springs } from "../src/springs";

/** Springs along x from the origin, of these lengths as drawn, in a mechanism of 1 m. */
const springs = (...lengths: number[]) => {
  const ends = (at: (length: number) => number) => ({ components: 3, things: lengths.length, ranges: [], values: Float32Array.from(lengths.flatMap((length) => [at(length), 0, 0])) });
  return new Springs({ scene: { springs: lengths.map(String) }, tracks: new Map([["spring.a", ends(() => 0)], ["spring.b", ends((length) => length)]]) } as unknown as Data, 1);
};
const moment = (...lengths: number[]) =>
  ({ parts: { "spring.a": new Float32Array(3 * lengths.length), "spring.b": Float32Array.from(lengths.flatMap((length) => [length, 0, 0])) } }) as unknown as Moment;
const parts = ({ group }: Springs) => group.children as [THREE.InstancedMesh, THREE.LineSegments];
/** From where to where the coil of spring `k` reaches along x, m. */
const coil = (own: Springs, k: number) => {
  const [coils] = parts(own);
  const matrix = new THREE.Matrix4();
  coils.getMatrixAt(k, matrix);
  coils.geometry.computeBoundingBox();
  const { min, max } = coils.geometry.boundingBox!.clone().applyMatrix4(matrix);
  return [min.x, max.x];
};
const wire = (own: Springs, k: number) => [...(parts(own)[1].geometry.attributes.position.array as Float32Array).subarray(12 * k, 12 * k + 12)].filter((_, at) => at % 3 === 0);

test("a long spring is a wire with a short coil in its middle", () => {
  const own = springs(1.5);
  own.update(moment(1.5));
  const [from, to] = coil(own, 0);
  // The wire of the coil has facets.
  assert.ok(to - from < 0.3 && Math.abs(from + to - 1.5) < 1e-3, `${from} to ${to}`);
  const [begin, before, after, end] = wire(own, 0);
  assert.deepEqual([begin, end], [0, 1.5]);
  // The wire of the coil is thicker than none: 0.12 of its radius of 18 mm on each side.
  assert.ok(Math.abs(before - from) < 3e-3 && Math.abs(after - to) < 3e-3, `${before} to ${after}`);
});

test("a coil stretches with its spring", () => {
  const own = springs(1);
  own.update(moment(1));
  const [from, to] = coil(own, 0);
  own.update(moment(1.2));
  const [begin, end] = coil(own, 0);
  assert.ok(Math.abs((end - begin) / (to - from) - 1.2) < 1e-6);
});

test("a spring that leads far away has no coil", () => {
  const own = springs(9);
  own.update(moment(9));
  const matrix = new THREE.Matrix4();
  parts(own)[0].getMatrixAt(0, matrix);
  assert.equal(matrix.determinant(), 0);
  assert.deepEqual(wire(own, 0), [0, 4.5, 4.5, 9]);
});

test("many springs are two things to draw, with smaller and coarser coils", () => {
  const own = springs(...Array.from({ length: 60 }, () => 1));
  assert.equal(own.group.children.length, 2);
  own.update(moment(...Array.from({ length: 60 }, () => 1)));
  const [from, to] = coil(own, 59);
  assert.ok(to - from < 0.13, `${from} to ${to}`);
  const count = (springs: Springs) => parts(springs)[0].geometry.index!.count;
  assert.ok(count(own) <= count(springs(1)) / 2);
});
