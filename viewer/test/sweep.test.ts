// A section swept along stations: every ring must lie in the plane of its section, around its station, with the outline's measures and normals that point outwards.

import assert from "node:assert/strict";
import { test } from "node:test";
import { axisOf, outline, sweep, triangles, vertices } from "../src/sweep";
import { turnBy } from "../src/moment";

/** Stations on a helix, each turned in its own way. */
function stations(count: number) {
  const places = new Float32Array(3 * count);
  const turns = new Float32Array(4 * count);
  for (let k = 0; k < count; k++) {
    places.set([k / count, Math.cos(k / 3), Math.sin(k / 3)], 3 * k);
    turns.set([1, 0, 0, 0], 4 * k);
    turnBy(turns, 4 * k, 0.3 * k, -0.2 * k, 0.1 * k);
  }
  return { places, turns };
}

const dot = (a: ArrayLike<number>, b: ArrayLike<number>) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

test("rings lie in the planes of their sections, with the measures of the outline", () => {
  const { places, turns } = stations(5);
  for (const profile of [
    { shape: "rectangle", width: 0.04, height: 0.01 }, { shape: "ellipse", y: 0.03, z: 0.02 }, { shape: "tube", inner: 0.01, outer: 0.02 },
  ] as const) {
    const shape = outline(profile);
    const around = shape.points.length;
    const positions = new Float32Array(3 * vertices(5, shape));
    const normals = new Float32Array(positions.length);
    sweep(shape, 2, places, turns, 0, 5, positions, normals);
    let [wide, high] = [0, 0];
    for (let station = 0; station < 5; station++) {
      const [x, y, z] = [0, 1, 2].map((axis) => axisOf(turns, 4 * station, axis));
      for (let point = 0; point < around; point++) {
        const at = 3 * (station * around + point);
        const arm = [0, 1, 2].map((axis) => positions[at + axis] - places[3 * station + axis]);
        const normal = normals.subarray(at, at + 3);
        assert.ok(Math.abs(dot(arm, x)) < 1e-6, "a vertex is outside the plane of its section");
        assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-6 && dot(normal, arm) > 0, "a normal points inwards");
        [wide, high] = [Math.max(wide, Math.abs(dot(arm, y))), Math.max(high, Math.abs(dot(arm, z)))];
      }
    }
    const expected = profile.shape === "rectangle" ? [0.02, 0.005] : profile.shape === "ellipse" ? [0.03, 0.02] : [0.02, 0.02];
    assert.ok(Math.abs(wide - 2 * expected[0]) < 1e-6 && Math.abs(high - 2 * expected[1]) < 1e-6, `${profile.shape}: ${wide}, ${high}`);
  }
});

test("the surface is closed, and its triangles look outwards", () => {
  const { places, turns } = stations(4);
  const shape = outline({ shape: "rectangle", width: 0.04, height: 0.01 });
  const positions = new Float32Array(3 * vertices(4, shape));
  const normals = new Float32Array(positions.length);
  sweep(shape, 1, places, turns, 0, 4, positions, normals);
  const indices = triangles(4, shape);
  // By the divergence theorem the sum of signed volumes is that of the solid: positive if all triangles look outwards.
  let volume = 0;
  const corner = (index: number) => positions.subarray(3 * index, 3 * index + 3);
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [corner(indices[at]), corner(indices[at + 1]), corner(indices[at + 2])];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  // Every edge, by place, is shared by an even number of triangles.
  const edges = new Map<string, number>();
  const key = (index: number) => [...corner(index)].map((part) => part.toFixed(5)).join();
  for (let at = 0; at < indices.length; at += 3) {
    for (const [a, b] of [[0, 1], [1, 2], [2, 0]]) {
      const ends = [key(indices[at + a]), key(indices[at + b])].sort();
      // A corner of a rectangle is there twice: triangles of a cap between both have no area.
      if (ends[0] === ends[1]) continue;
      const edge = ends.join(" ");
      edges.set(edge, (edges.get(edge) ?? 0) + 1);
    }
  }
  assert.ok([...edges.values()].every((count) => count % 2 === 0), "the surface has a hole");
  assert.ok(volume > 0, `${volume}`);
});

test("axes of a quaternion are those of its rotation", () => {
  const turn = new Float32Array([1, 0, 0, 0]);
  turnBy(turn, 0, 0, 0, Math.PI / 2);
  const near = (found: number[], expected: number[]) => found.forEach((part, k) => assert.ok(Math.abs(part - expected[k]) < 1e-6));
  near(axisOf(turn, 0, 0), [0, 1, 0]);
  near(axisOf(turn, 0, 1), [-1, 0, 0]);
  near(axisOf(turn, 0, 2), [0, 0, 1]);
});
