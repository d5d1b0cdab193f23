// A section swept along the stations of a beam: vertices and normals of its surface.

import type { Profile } from "./format";

/** The outline of a section: points (y, z) with their normals, in order; a corner is there twice. */
export interface Outline {
  points: [number, number][];
  normals: [number, number][];
}

const ROUND = 20;

/** The outer outline of a section, m. */
export function outline(profile: Profile): Outline {
  if (profile.shape === "rectangle") {
    const [y, z] = [profile.width / 2, profile.height / 2];
    return {
      points: [[y, -z], [y, z], [y, z], [-y, z], [-y, z], [-y, -z], [-y, -z], [y, -z]],
      normals: [[1, 0], [1, 0], [0, 1], [0, 1], [-1, 0], [-1, 0], [0, -1], [0, -1]],
    };
  }
  const [a, b] = profile.shape === "ellipse" ? [profile.y, profile.z] : [profile.outer, profile.outer];
  const angles = Array.from({ length: ROUND }, (_, k) => (2 * Math.PI * k) / ROUND);
  return {
    points: angles.map((angle) => [a * Math.cos(angle), b * Math.sin(angle)]),
    normals: angles.map((angle) => {
      const [y, z] = [b * Math.cos(angle), a * Math.sin(angle)];
      const length = Math.hypot(y, z) || 1;
      return [y / length, z / length];
    }),
  };
}

/** The smallest extent of a section, m. */
export function thinnest(profile: Profile): number {
  if (profile.shape === "rectangle") return Math.min(profile.width, profile.height);
  return 2 * (profile.shape === "ellipse" ? Math.min(profile.y, profile.z) : profile.outer);
}

/** Axis `axis` of the quaternion `w x y z` at `at`. */
export function axisOf(turns: ArrayLike<number>, at: number, axis: number): [number, number, number] {
  const [w, x, y, z] = [turns[at], turns[at + 1], turns[at + 2], turns[at + 3]];
  if (axis === 0) return [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
  if (axis === 1) return [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)];
  return [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
}

/** The indices of the triangles between rings of `around` points, and the caps at both ends, which have vertices of their own behind the rings. */
export function triangles(stations: number, shape: Outline): number[] {
  const around = shape.points.length;
  const isRound = around === ROUND;
  const indices: number[] = [];
  for (let station = 0; station + 1 < stations; station++) {
    for (let point = 0; point < around; point++) {
      // A rectangle has each edge as two points of its own.
      if (!isRound && point % 2 === 1) continue;
      const next = (point + 1) % around;
      const [a, b] = [station * around + point, station * around + next];
      const [c, d] = [a + around, b + around];
      indices.push(a, b, c, b, d, c);
    }
  }
  for (const [cap, turned] of [[stations * around, true], [(stations + 1) * around, false]] as const) {
    for (let point = 1; point + 1 < around; point++) {
      indices.push(cap, cap + (turned ? point + 1 : point), cap + (turned ? point : point + 1));
    }
  }
  return indices;
}

/** Number of vertices of a swept beam. */
export function vertices(stations: number, shape: Outline): number {
  return (stations + 2) * shape.points.length;
}

/**
 * Writes the vertices of a beam with the stations from `begin` to before `end` into `positions` and `normals`; its section is `scale` times as thick as it is, and
 * at each station `sizes` times (along y and z) as large as `shape`.
 */
export function sweep(
  shape: Outline, scale: number, places: ArrayLike<number>, turns: ArrayLike<number>, begin: number, end: number,
  positions: Float32Array, normals: Float32Array, sizes?: [number, number][],
): void {
  let at = 0;
  const ring = (station: number, normal?: [number, number, number]) => {
    const [y, z] = [axisOf(turns, 4 * station, 1), axisOf(turns, 4 * station, 2)];
    for (let point = 0; point < shape.points.length; point++, at += 3) {
      const [growY, growZ] = sizes?.[station - begin] ?? [1, 1];
      const [u, v] = [growY * shape.points[point][0], growZ * shape.points[point][1]];
      const [nu, nv] = shape.normals[point];
      for (let axis = 0; axis < 3; axis++) {
        positions[at + axis] = places[3 * station + axis] + scale * (u * y[axis] + v * z[axis]);
        normals[at + axis] = normal ? normal[axis] : nu * y[axis] + nv * z[axis];
      }
    }
  };
  for (let station = begin; station < end; station++) ring(station);
  const first = axisOf(turns, 4 * begin, 0);
  ring(begin, [-first[0], -first[1], -first[2]]);
  ring(end - 1, axisOf(turns, 4 * (end - 1), 0));
}
