//! What strains of bending and torsion depend on: nine numbers, the element as its first node sees it (MECHANICS 8).
//!
//! In the frame `[t u v]` of the first node: the chord `r_1 − r_0`, the second slope `p_1` and the first stretch
//! `|p_0|` (the first slope lies along `t`); beside them the twist between the nodes, `θ_1 − θ_0 + β`, and `θ_0`.
//! Strains are differentiated by these nine; the way back to the 14 coordinates, turn of the frame and holonomy
//! included, is here alone.

use super::Holonomy;
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::ancf14::coordinates::{ElementColumns, ElementVector, NODE, P, R, THETA};
use crate::mechanics::beam::ancf14::frame::NodeFrame;

/// Position of the chord, m.
const CHORD: usize = 0;
/// Position of the second slope, 1.
const SLOPE: usize = 3;
/// Position of the first stretch, 1.
const STRETCH: usize = 6;
/// Position of the twist between the nodes, rad.
pub const TWIST: usize = 7;
/// Place of the first node's angle `θ_0`, rad.
pub const ANGLE: usize = 8;
/// Nine and one that stays 0: processors take numbers in pairs.
pub const COROTATED: usize = 10;

/// One number per number of the corotated shape, and a 0.
pub type CorotatedVector = [f64; COROTATED];
/// One number per pair of numbers of the corotated shape, by columns; all are symmetric, and the lower triangle counts.
pub type CorotatedMatrix = [[f64; COROTATED]; COROTATED];

/// The shape of an element as its first node sees it.
#[derive(Clone, Debug)]
pub struct CorotatedShape<'a> {
    /// Frames of the two nodes.
    pub frames: [&'a NodeFrame; 2],
    /// Holonomy between them.
    pub holonomy: Holonomy,
    /// Twist between the nodes, rad.
    pub twist: f64,
    /// Chord and second slope in the first node's frame, m and 1.
    chord_local: Vec3,
    slope_local: Vec3,
}

/// A small change of a corotated shape.
#[derive(Clone, Copy, Debug)]
pub struct CorotatedChange {
    /// Of chord and second slope in the first node's frame, m and 1.
    chord: Vec3,
    slope: Vec3,
    /// Of the first stretch, 1.
    stretch: f64,
    /// Of the twist between the nodes, rad.
    pub twist: f64,
    /// Of the first node's angle, rad.
    pub angle: f64,
}

/// What the derivatives of a corotated shape by the coordinates change by with a small change of these; all in the axes
/// of the first frame.
#[derive(Clone, Copy, Debug)]
pub struct WayBackChange {
    /// Turn of the first frame, rad.
    turn: Vec3,
    /// Changes of chord and second slope as that frame sees them, m and 1.
    chord: Vec3,
    slope: Vec3,
    /// Change of the first stretch, 1.
    stretch: f64,
    /// Changes of `k` along `u` and `v`, 1.
    k: [f64; 2],
    /// Changes of the derivatives of the holonomy angle with respect to the slopes, rad.
    twist_p0: Vec3,
    twist_p1: Vec3,
}

impl CorotatedChange {
    /// As [`CorotatedShape::interpolate`].
    #[inline]
    pub fn interpolate(&self, weights: &[f64; 4]) -> Vec3 {
        let mut sum = self.chord * weights[2] + self.slope * weights[3];
        sum[0] += self.stretch * weights[1];
        sum
    }
}

impl<'a> CorotatedShape<'a> {
    /// At the element's coordinates `q` (14), with its nodes' frames there and the holonomy angle `previous` of the
    /// last accepted state, rad.
    #[inline]
    pub fn new(q: &[f64], frames: [&'a NodeFrame; 2], previous: f64) -> Self {
        let [first, second] = frames;
        let holonomy = Holonomy::new(first, second, previous);
        Self {
            frames,
            twist: q[NODE + THETA] - q[THETA] + holonomy.angle,
            holonomy,
            chord_local: first.components(&(vec3(q, NODE + R) - vec3(q, R))),
            slope_local: first.components(&vec3(q, NODE + P)),
        }
    }

    /// `Σ_a weight_a X_a` of the nodes' places and slopes in the first node's frame; weights of the places are
    /// opposite.
    #[inline]
    pub fn interpolate(&self, weights: &[f64; 4]) -> Vec3 {
        let mut sum = self.chord_local * weights[2] + self.slope_local * weights[3];
        sum[0] += self.frames[0].stretch * weights[1];
        sum
    }

    /// What it changes by with small changes `change` (14) of the coordinates.
    #[inline]
    pub fn along(&self, change: &[f64]) -> CorotatedChange {
        let [first, second] = self.frames;
        let (p0, p1) = (vec3(change, P), vec3(change, NODE + P));
        let moved = first.components(&p0);
        let turn = first.turn_along(&moved);
        let chord = first.components(&(vec3(change, NODE + R) - vec3(change, R)));
        let (twist_p0, twist_p1) = self.holonomy.gradient(first, second);
        CorotatedChange {
            chord: chord + self.chord_local.cross(&turn),
            slope: first.components(&p1) + self.slope_local.cross(&turn),
            stretch: moved[0],
            twist: change[NODE + THETA] - change[THETA] + twist_p0.dot(&p0) + twist_p1.dot(&p1),
            angle: change[THETA],
        }
    }

    /// `∂F/∂q`, 14×1, of what has the derivatives `by` by the corotated shape.
    pub fn gradient(&self, by: &CorotatedVector) -> ElementVector {
        let [first, second] = self.frames;
        let (by_chord, by_slope) = (block(by, CHORD), block(by, SLOPE));
        let (twist_p0, twist_p1) = self.holonomy.gradient(first, second);
        let moved = Vec3::new(by[STRETCH], 0.0, 0.0) + first.turn_force(&self.moment(&by_chord, &by_slope));
        let (by_chord, by_slope) = (first.in_space(&by_chord), first.in_space(&by_slope));
        let by_p0 = first.in_space(&moved) + twist_p0 * by[TWIST];
        let by_p1 = by_slope + twist_p1 * by[TWIST];
        let mut sum = by_coordinates(&by_chord, &by_p0, &by_p1);
        sum[THETA] = by[ANGLE] - by[TWIST];
        sum[NODE + THETA] = by[TWIST];
        sum
    }

    /// What [`Self::gradient`] of the same derivatives `by` changes by with a small change of the coordinates, 14×1:
    /// `Ṡᵀ by` (MECHANICS 3.8).
    pub fn gradient_change(&self, by: &CorotatedVector, change: &WayBackChange) -> ElementVector {
        let [first, _] = self.frames;
        let WayBackChange { turn, chord, slope, stretch, k, twist_p0, twist_p1 } = change;
        let (by_chord, by_slope, by_twist) = (block(by, CHORD), block(by, SLOPE), by[TWIST]);
        let moment = self.moment(&by_chord, &by_slope);
        let moment_change = by_chord.cross(chord) + by_slope.cross(slope);
        let force = first.turn_force(&moment);
        let of_k = Vec3::new(0.0, -k[0] * moment[0], -k[1] * moment[0]);
        let force_change = first.turn_force(&moment_change) + (of_k - force * *stretch) / first.stretch;
        let moved = Vec3::new(by[STRETCH], 0.0, 0.0) + force;
        let by_chord = first.in_space(&turn.cross(&by_chord));
        let by_p0 = first.in_space(&(force_change + turn.cross(&moved) + twist_p0 * by_twist));
        let by_p1 = first.in_space(&(turn.cross(&by_slope) + twist_p1 * by_twist));
        by_coordinates(&by_chord, &by_p0, &by_p1)
    }

    /// What the derivatives of the shape with respect to the coordinates change by with small changes `change` (14) of
    /// the coordinates; these change the shape by `own`.
    pub fn way_back_change(&self, change: &[f64], own: &CorotatedChange) -> WayBackChange {
        let [first, second] = self.frames;
        let holonomy = self.holonomy.local(first, second);
        let (p0, p1) = (first.components(&vec3(change, P)), first.components(&vec3(change, NODE + P)));
        let per_stretch = 1.0 / first.stretch;
        let turn = first.turn_along(&p0);
        let [b_u, b_v] = [holonomy.p0[1], holonomy.p0[2]];
        let [uu, vu, vv] = holonomy.p0_p0;
        let twist_p0 = Vec3::new(
            -(b_u * p0[1] + b_v * p0[2]) * per_stretch,
            uu * p0[1] + vu * p0[2] - b_u * p0[0] * per_stretch + holonomy.p0_p1[0].dot(&p1),
            vu * p0[1] + vv * p0[2] - b_v * p0[0] * per_stretch + holonomy.p0_p1[1].dot(&p1),
        );
        let lower = &holonomy.p1_p1;
        let p1_p1 = Mat3::from_fn(|i, j| if i < j { lower[(j, i)] } else { lower[(i, j)] });
        WayBackChange {
            turn,
            chord: own.chord,
            slope: own.slope,
            stretch: own.stretch,
            k: first.k_local_along(&p0, &turn),
            twist_p0,
            twist_p1: holonomy.p0_p1[0] * p0[1] + holonomy.p0_p1[1] * p0[2] + p1_p1 * p1,
        }
    }

    /// Sets `sum` to `scale ∂²F/∂q²`, 14×14 but for the rows and columns of `r_0`
    /// ([`crate::mechanics::beam::ancf14::coordinates::complete`]), of what has the derivatives `by` and the second
    /// derivatives `second` by the corotated shape; fills in the upper triangle of `second`.
    ///
    /// All of it is done in the axes `[t u v]` of the first frame, in which `∂φ/∂p_0` and all that has to do with `t`
    /// are mostly zeros.
    pub fn set_hessian(
        &self,
        by: &CorotatedVector,
        second: &mut CorotatedMatrix,
        scale: f64,
        sum: &mut ElementColumns,
    ) {
        mirror(second);
        let [start, end] = self.frames;
        let (by_chord, by_slope, by_twist) = (block(by, CHORD), block(by, SLOPE), by[TWIST]);
        let per_stretch = 1.0 / start.stretch;
        let [k_u, k_v] = start.k_local();
        let holonomy = self.holonomy.local(start, end);
        let (b0, b1) = (&holonomy.p0, &holonomy.p1);

        // By the first slope: along `t` it stretches; along `u` and `v` it turns the frame, which all the rest sees as
        // the opposite turn of chord and slope, and it changes the holonomy.
        let turns = [Vec3::new(-k_u, 0.0, 1.0) * per_stretch, Vec3::new(-k_v, -1.0, 0.0) * per_stretch]; // columns of ∂φ/∂p
        let along = &second[STRETCH];
        let (shape_u, u) = self.by_turn(&turns[0], b0[1], second, [&by_chord, &by_slope]);
        let (shape_v, v) = self.by_turn(&turns[1], b0[2], second, [&by_chord, &by_slope]);
        let dot = |a: &CorotatedVector, b: &CorotatedVector| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let moment = self.moment(&by_chord, &by_slope);
        let force_u = (moment[2] - k_u * moment[0]) * per_stretch;
        let force_v = (-moment[1] - k_v * moment[0]) * per_stretch;
        let half = 0.5 * (k_u * k_u - k_v * k_v);
        let square = per_stretch * per_stretch;
        let round = by[STRETCH] * per_stretch;
        // The lower triangle; the part of the moment is that of [`NodeFrame::moment_force_p`].
        let pp = [
            along[STRETCH],
            u[STRETCH] - (force_u + b0[1] * by_twist) * per_stretch,
            v[STRETCH] - (force_v + b0[2] * by_twist) * per_stretch,
            dot(&shape_u, &u) + round - k_u * (moment[0] * k_v + moment[1]) * square + holonomy.p0_p0[0] * by_twist,
            dot(&shape_v, &u) + (moment[0] * (0.5 + half) - k_v * moment[1]) * square + holonomy.p0_p0[1] * by_twist,
            dot(&shape_v, &v) + round + k_v * (moment[0] * k_u - moment[2]) * square + holonomy.p0_p0[2] * by_twist,
        ];
        let cp = [block(along, CHORD), block(&u, CHORD), block(&v, CHORD)];
        let sp = [
            block(along, SLOPE) + b1 * along[TWIST],
            block(&u, SLOPE) + b1 * u[TWIST] + holonomy.p0_p1[0] * by_twist,
            block(&v, SLOPE) + b1 * v[TWIST] + holonomy.p0_p1[1] * by_twist,
        ];

        // By the second slope, which changes the holonomy too.
        let (twist, angle) = (&second[TWIST], &second[ANGLE]);
        let (twist_c, twist_s) = (block(twist, CHORD), block(twist, SLOPE) + b1 * twist[TWIST]);
        let (angle_c, angle_s) = (block(angle, CHORD), block(angle, SLOPE) + b1 * angle[TWIST]);
        let column = |j: usize| block(&second[SLOPE + j], CHORD) + twist_c * b1[j];
        let cs = [column(0), column(1), column(2)];
        let entry = |i: usize, j: usize| {
            second[SLOPE + j][SLOPE + i]
                + twist_s[i] * b1[j]
                + b1[i] * twist[SLOPE + j]
                + holonomy.p1_p1[(i, j)] * by_twist
        };
        let ss = [entry(0, 0), entry(1, 0), entry(2, 0), entry(1, 1), entry(2, 1), entry(2, 2)];
        let lower = |j: usize, i: usize| second[CHORD + j][CHORD + i];
        let cc = [lower(0, 0), lower(0, 1), lower(0, 2), lower(1, 1), lower(1, 2), lower(2, 2)];

        let axes = [start.t, start.u, start.v];
        let scaled = axes.map(|axis| axis * scale);
        for (place, block) in [(NODE + R, cc), (P, pp), (NODE + P, ss)] {
            set_symmetric(sum, place, &scaled, &axes, &block);
        }
        for (row, column, block) in [(NODE + R, P, cp), (NODE + R, NODE + P, cs), (NODE + P, P, sp)] {
            set_both(sum, row, column, &scaled, &axes, &block);
        }
        let twist_p = Vec3::new(along[TWIST], u[TWIST], v[TWIST]);
        let angle_p = Vec3::new(along[ANGLE], u[ANGLE], v[ANGLE]);
        for (theta, [by_c, by_p, by_s]) in [
            (THETA, [angle_c - twist_c, angle_p - twist_p, angle_s - twist_s]),
            (NODE + THETA, [twist_c, twist_p, twist_s]),
        ] {
            for (place, block) in [(P, by_p), (NODE + R, by_c), (NODE + P, by_s)] {
                for i in 0..3 {
                    let value = scaled[0][i] * block[0] + scaled[1][i] * block[1] + scaled[2][i] * block[2];
                    sum[place + i][theta] = value;
                    sum[theta][place + i] = value;
                }
            }
        }
        let (mixed, stiffness) = (angle[TWIST], twist[TWIST]);
        sum[THETA][THETA] = (angle[ANGLE] - 2.0 * mixed + stiffness) * scale;
        sum[THETA][NODE + THETA] = (mixed - stiffness) * scale;
        sum[NODE + THETA][THETA] = (mixed - stiffness) * scale;
        sum[NODE + THETA][NODE + THETA] = stiffness * scale;
    }

    /// What the corotated shape changes by with a first slope that makes the frame turn by `turn` and the holonomy
    /// change by `twist`; and what the derivatives `by`, in the axes of the frame, change by with it.
    #[inline]
    fn by_turn(
        &self,
        turn: &Vec3,
        twist: f64,
        second: &CorotatedMatrix,
        [by_chord, by_slope]: [&Vec3; 2],
    ) -> (CorotatedVector, CorotatedVector) {
        let (chord, slope) = (self.chord_local.cross(turn), self.slope_local.cross(turn));
        let shape = [chord[0], chord[1], chord[2], slope[0], slope[1], slope[2], 0.0, twist, 0.0, 0.0];
        let (of_chord, of_slope) = (turn.cross(by_chord), turn.cross(by_slope));
        let mut change =
            [of_chord[0], of_chord[1], of_chord[2], of_slope[0], of_slope[1], of_slope[2], 0.0, 0.0, 0.0, 0.0];
        for (column, moved) in [0, 1, 2, 3, 4, 5, TWIST].map(|place| (&second[place], shape[place])) {
            for row in 0..COROTATED {
                change[row] += column[row] * moved;
            }
        }
        (shape, change)
    }

    /// Moment on the first node's frame of forces on the chord and on the second slope, by invariance (MECHANICS 8);
    /// all in its axes.
    #[inline]
    fn moment(&self, by_chord: &Vec3, by_slope: &Vec3) -> Vec3 {
        by_chord.cross(&self.chord_local) + by_slope.cross(&self.slope_local)
    }
}

/// By chord, second slope and first stretch, of what has the derivatives `by_p` and `by_w` by `r'` and `r''`,
/// components in the first node's frame; the weights are those of [`CorotatedShape::interpolate`].
#[inline]
pub fn spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], by_p: &Vec3, by_w: &Vec3) -> CorotatedVector {
    let of = |i: usize, a: usize| by_p[i] * shape_x[a] + by_w[i] * shape_xx[a];
    [of(0, 2), of(1, 2), of(2, 2), of(0, 3), of(1, 3), of(2, 3), of(0, 1), 0.0, 0.0, 0.0]
}

/// Adds to the lower triangle of `sum` what has the second derivatives `pp` by `r'`, of which the lower triangle
/// counts, and `pw` by `r'` and `r''`, none by `r''` twice.
#[inline]
pub fn add_spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], pp: &Mat3, pw: &Mat3, sum: &mut CorotatedMatrix) {
    let (square, both) = (|a: usize| shape_x[a] * shape_x[a], |a: usize| shape_x[a] * shape_xx[a]);
    for j in 0..3 {
        for i in j..3 {
            let (twice, once) = (pp[(i, j)], pw[(i, j)] + pw[(j, i)]);
            for (a, place) in [(2, CHORD), (3, SLOPE)] {
                sum[place + j][place + i] += twice * square(a) + once * both(a);
            }
        }
    }
    let between = |i: usize, a: usize, j: usize, b: usize| {
        let pp = if i > j { pp[(i, j)] } else { pp[(j, i)] };
        pp * (shape_x[a] * shape_x[b])
            + pw[(i, j)] * (shape_x[a] * shape_xx[b])
            + pw[(j, i)] * (shape_xx[a] * shape_x[b])
    };
    for j in 0..3 {
        for i in 0..3 {
            sum[CHORD + j][SLOPE + i] += between(i, 3, j, 2);
        }
        for (b, column) in [(2, CHORD), (3, SLOPE)] {
            sum[column + j][STRETCH] += between(0, 1, j, b);
        }
    }
    sum[STRETCH][STRETCH] += pp[(0, 0)] * square(1) + 2.0 * pw[(0, 0)] * both(1);
}

/// The derivatives with respect to the coordinates, 14×1, of what has these with respect to the chord and to both
/// slopes; 0 with respect to the angles.
#[inline]
fn by_coordinates(by_chord: &Vec3, by_p0: &Vec3, by_p1: &Vec3) -> ElementVector {
    let mut sum = ElementVector::zeros();
    for i in 0..3 {
        sum[R + i] = -by_chord[i];
        sum[P + i] = by_p0[i];
        sum[NODE + R + i] = by_chord[i];
        sum[NODE + P + i] = by_p1[i];
    }
    sum
}

/// The three numbers of `vector` from `place` on.
fn block(vector: &CorotatedVector, place: usize) -> Vec3 {
    Vec3::new(vector[place], vector[place + 1], vector[place + 2])
}

/// Fills in the upper triangle of a symmetric matrix; a column at a time, whose positions the compiler knows.
#[inline]
fn mirror(matrix: &mut CorotatedMatrix) {
    mirror_column::<0>(matrix);
    mirror_column::<1>(matrix);
    mirror_column::<2>(matrix);
    mirror_column::<3>(matrix);
    mirror_column::<4>(matrix);
    mirror_column::<5>(matrix);
    mirror_column::<6>(matrix);
    mirror_column::<7>(matrix);
}

#[inline]
#[expect(clippy::needless_range_loop, reason = "of iterators over columns the compiler does not know the places")]
fn mirror_column<const COLUMN: usize>(matrix: &mut CorotatedMatrix) {
    for row in COLUMN + 1..=ANGLE {
        matrix[row][COLUMN] = matrix[COLUMN][row];
    }
}

/// Sets the block of `sum` at `row` and `column` to `left block rightᵀ`, and its mirror image too; columns all.
#[inline]
fn set_both(
    sum: &mut ElementColumns,
    row: usize,
    column: usize,
    left: &[Vec3; 3],
    right: &[Vec3; 3],
    block: &[Vec3; 3],
) {
    let [t, u, v] = block.map(|of| left[0] * of[0] + left[1] * of[1] + left[2] * of[2]);
    for j in 0..3 {
        let turned = t * right[0][j] + u * right[1][j] + v * right[2][j];
        for i in 0..3 {
            sum[column + j][row + i] = turned[i];
            sum[row + i][column + j] = turned[i];
        }
    }
}

/// The same of a symmetric block on the diagonal, from `place` on, of which `[xx, yx, zx, yy, zy, zz]` is given.
#[inline]
fn set_symmetric(sum: &mut ElementColumns, place: usize, left: &[Vec3; 3], right: &[Vec3; 3], block: &[f64; 6]) {
    let [xx, yx, zx, yy, zy, zz] = *block;
    let [t, u, v] =
        [[xx, yx, zx], [yx, yy, zy], [zx, zy, zz]].map(|of| left[0] * of[0] + left[1] * of[1] + left[2] * of[2]);
    for j in 0..3 {
        for i in j..3 {
            let turned = t[i] * right[0][j] + u[i] * right[1][j] + v[i] * right[2][j];
            sum[place + j][place + i] = turned;
            sum[place + i][place + j] = turned;
        }
    }
}
