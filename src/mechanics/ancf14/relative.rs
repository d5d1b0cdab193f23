//! What strains of bending and torsion depend on: nine numbers, the element as its first node sees it (MECHANICS 8).
//!
//! In the frame `[t u v]` of the first node: the chord `r_1 − r_0`, the second slope `p_1` and the first stretch `|p_0|` (the first
//! slope lies along `t`); beside them the twist between the nodes, `θ_1 − θ_0 + β`, and `θ_0`. Strains are differentiated by these
//! nine; the way back to the 14 coordinates, turn of the frame and holonomy included, is here alone.

use super::coordinates::{ElementColumns, ElementVector, NODE, P, R, THETA};
use super::frame::NodeFrame;
use super::kinematics::Holonomy;
use crate::math::rotation::times_cross;
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};

/// Place of the chord, m.
const CHORD: usize = 0;
/// Place of the second slope, 1.
const SLOPE: usize = 3;
/// Place of the first stretch, 1.
const STRETCH: usize = 6;
/// Place of the twist between the nodes, rad.
pub const TWIST: usize = 7;
/// Place of the first node's angle `θ_0`, rad.
pub const ANGLE: usize = 8;
/// Nine and one that stays 0: processors take numbers in pairs.
pub const RELATIVE: usize = 10;

/// One number per number of the relative shape, and a 0.
pub type RelativeVector = [f64; RELATIVE];
/// One number per pair of numbers of the relative shape, by columns; all are symmetric, and the lower triangle counts.
pub type RelativeMatrix = [[f64; RELATIVE]; RELATIVE];

/// The shape of an element as its first node sees it.
#[derive(Clone, Debug)]
pub struct RelativeShape<'a> {
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

impl<'a> RelativeShape<'a> {
    /// At the element's coordinates `q` (14), with its nodes' frames there and the holonomy angle `previous` of the last accepted
    /// state, rad.
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

    /// `Σ_a weight_a X_a` of the nodes' places and slopes in the first node's frame; weights of the places are opposite.
    #[inline]
    pub fn interpolate(&self, weights: &[f64; 4]) -> Vec3 {
        let mut sum = self.chord_local * weights[2] + self.slope_local * weights[3];
        sum[0] += self.frames[0].stretch * weights[1];
        sum
    }

    /// `∂F/∂q`, 14×1, of what has the derivatives `by` by the relative shape.
    pub fn gradient(&self, by: &RelativeVector) -> ElementVector {
        let [first, second] = self.frames;
        let (by_chord, by_slope) = (block(by, CHORD), block(by, SLOPE));
        let (twist_p0, twist_p1) = self.holonomy.gradient(first, second);
        let moved = Vec3::new(by[STRETCH], 0.0, 0.0) + first.turn_force(&self.moment(&by_chord, &by_slope));
        let (by_chord, by_slope) = (first.in_space(&by_chord), first.in_space(&by_slope));
        let by_p0 = first.in_space(&moved) + twist_p0 * by[TWIST];
        let by_p1 = by_slope + twist_p1 * by[TWIST];
        let mut sum = ElementVector::zeros();
        for i in 0..3 {
            sum[R + i] = -by_chord[i];
            sum[P + i] = by_p0[i];
            sum[NODE + R + i] = by_chord[i];
            sum[NODE + P + i] = by_p1[i];
        }
        sum[THETA] = by[ANGLE] - by[TWIST];
        sum[NODE + THETA] = by[TWIST];
        sum
    }

    /// Sets `sum` to `scale ∂²F/∂q²`, 14×14 but for the rows and columns of `r_0` ([`super::coordinates::complete`]), of what has the derivatives `by` and
    /// the second derivatives `second` by the relative shape.
    ///
    /// All of it is done in the axes `[t u v]` of the first frame, in which `∂φ/∂p_0` and all that has to do with `t` are mostly zeros.
    pub fn set_hessian(&self, by: &RelativeVector, second: &RelativeMatrix, scale: f64, sum: &mut ElementColumns) {
        let [start, end] = self.frames;
        let (chord, slope) = (&self.chord_local, &self.slope_local);
        let (cc, sc) = (symmetric(second, CHORD), Mat3::from_fn(|i, j| second[CHORD + j][SLOPE + i]));
        let (cs, ss) = (sc.transpose(), symmetric(second, SLOPE));
        let (by_chord, by_slope, by_twist) = (block(by, CHORD), block(by, SLOPE), by[TWIST]);
        let row = |place: usize, column: usize| {
            Vec3::new(second[column][place], second[column + 1][place], second[column + 2][place])
        };
        let per_stretch = 1.0 / start.stretch;
        let k = start.k_local();
        // `[∂φ/∂p]ᵀ moment` and `turn ∂φ/∂p`: along `t` they are zero.
        let force =
            |moment: &Vec3| Vec3::new(0.0, moment[2] - k[0] * moment[0], -moment[1] - k[1] * moment[0]) * per_stretch;
        let by_slope_turn = |turn: &Mat3| {
            let (along, u, v) = (turn.column(0), turn.column(1), turn.column(2));
            [(v - along * k[0]) * per_stretch, (u + along * k[1]) * -per_stretch]
        };

        // By the turn of the first frame, which all the rest sees as the opposite turn of chord and slope.
        let [cu, cv] = by_slope_turn(&(times_cross(&cc, chord) + times_cross(&cs, slope) - by_chord.cross_matrix()));
        let [su, sv] = by_slope_turn(&(times_cross(&sc, chord) + times_cross(&ss, slope) - by_slope.cross_matrix()));
        let pu = force(&-(chord.cross(&cu) + slope.cross(&su)));
        let pv = force(&-(chord.cross(&cv) + slope.cross(&sv)));
        let frozen = self.moment(&by_chord, &by_slope);
        let frozen_force = force(&frozen);

        // By the first slope: it turns the frame and stretches.
        let (stretch_c, stretch_s) = (row(STRETCH, CHORD), row(STRETCH, SLOPE));
        let stretch_p = force(&self.moment(&stretch_c, &stretch_s));

        // By the twist between the nodes, in which the holonomy is.
        let holonomy = self.holonomy.local(start, end);
        let (b0, b1) = (&holonomy.p0, &holonomy.p1);
        let (twist_c, twist_s) = (row(TWIST, CHORD), row(TWIST, SLOPE));
        let mut twist_p = force(&self.moment(&twist_c, &twist_s));
        twist_p[0] = second[STRETCH][TWIST];
        let stiffness = second[TWIST][TWIST];
        let (all_p, all_s) = (twist_p + b0 * stiffness, twist_s + b1 * stiffness);
        let [h00_uu, h00_vu, h00_vv] = holonomy.p0_p0;
        let [h01_u, h01_v] = &holonomy.p0_p1;

        let cp = [stretch_c, cu + twist_c * b0[1], cv + twist_c * b0[2]];
        let cs = cs + twist_c * b1.transpose();
        let sp = [
            stretch_s + b1 * all_p[0],
            su + twist_s * b0[1] + b1 * all_p[1] + h01_u * by_twist,
            sv + twist_s * b0[2] + b1 * all_p[2] + h01_v * by_twist,
        ];
        let ss = ss + all_s * b1.transpose() + b1 * twist_s.transpose() + holonomy.p1_p1 * by_twist;
        // Of the symmetric `pp` the lower triangle; the moment's part is [`NodeFrame::moment_force_p`].
        let half = 0.5 * (k[0] * k[0] - k[1] * k[1]);
        let square = per_stretch * per_stretch;
        let round = by[STRETCH] * per_stretch;
        let pp = [
            second[STRETCH][STRETCH],
            stretch_p[1] - frozen_force[1] * per_stretch + b0[1] * (all_p[0] - by_twist * per_stretch),
            stretch_p[2] - frozen_force[2] * per_stretch + b0[2] * (all_p[0] - by_twist * per_stretch),
            pu[1] + round - k[0] * (frozen[0] * k[1] + frozen[1]) * square
                + (all_p[1] + twist_p[1]) * b0[1]
                + h00_uu * by_twist,
            pu[2]
                + (frozen[0] * (0.5 + half) - k[1] * frozen[1]) * square
                + all_p[2] * b0[1]
                + b0[2] * twist_p[1]
                + h00_vu * by_twist,
            pv[2]
                + round
                + k[1] * (frozen[0] * k[0] - frozen[2]) * square
                + (all_p[2] + twist_p[2]) * b0[2]
                + h00_vv * by_twist,
        ];

        // By the angle of the first node.
        let (angle_c, angle_s) = (row(ANGLE, CHORD), row(ANGLE, SLOPE));
        let mut angle_p = force(&self.moment(&angle_c, &angle_s));
        angle_p[0] = second[STRETCH][ANGLE];
        let mixed = second[TWIST][ANGLE];
        let first_angle = [angle_c - twist_c, angle_p + b0 * mixed - all_p, angle_s + b1 * mixed - all_s];

        let axes = [start.t, start.u, start.v];
        let scaled = axes.map(|axis| axis * scale);
        let lower = |block: &Mat3| [block[0], block[1], block[2], block[4], block[5], block[8]];
        for (place, block) in [(NODE + R, lower(&cc)), (P, pp), (NODE + P, lower(&ss))] {
            set_symmetric(sum, place, &scaled, &axes, &block);
        }
        let cs = [0, 1, 2].map(|column| cs.column(column).into_owned());
        for (row, column, block) in [(NODE + R, P, cp), (NODE + R, NODE + P, cs), (NODE + P, P, sp)] {
            set_both(sum, row, column, &scaled, &axes, &block);
        }
        for (theta, [by_c, by_p, by_s]) in [(THETA, first_angle), (NODE + THETA, [twist_c, all_p, all_s])] {
            for (place, block) in [(P, by_p), (NODE + R, by_c), (NODE + P, by_s)] {
                for i in 0..3 {
                    let value = scaled[0][i] * block[0] + scaled[1][i] * block[1] + scaled[2][i] * block[2];
                    sum[place + i][theta] = value;
                    sum[theta][place + i] = value;
                }
            }
        }
        sum[THETA][THETA] = (second[ANGLE][ANGLE] - 2.0 * mixed + stiffness) * scale;
        sum[THETA][NODE + THETA] = (mixed - stiffness) * scale;
        sum[NODE + THETA][THETA] = (mixed - stiffness) * scale;
        sum[NODE + THETA][NODE + THETA] = stiffness * scale;
    }

    /// Moment on the first node's frame of forces on the chord and on the second slope, by invariance (MECHANICS 8); all in its axes.
    #[inline]
    fn moment(&self, by_chord: &Vec3, by_slope: &Vec3) -> Vec3 {
        by_chord.cross(&self.chord_local) + by_slope.cross(&self.slope_local)
    }
}

/// By chord, second slope and first stretch, of what has the derivatives `by_p` and `by_w` by `r'` and `r''`, components in the first
/// node's frame; the weights are those of [`RelativeShape::interpolate`].
#[inline]
pub fn spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], by_p: &Vec3, by_w: &Vec3) -> RelativeVector {
    let of = |i: usize, a: usize| by_p[i] * shape_x[a] + by_w[i] * shape_xx[a];
    [of(0, 2), of(1, 2), of(2, 2), of(0, 3), of(1, 3), of(2, 3), of(0, 1), 0.0, 0.0, 0.0]
}

/// Adds to the lower triangle of `sum` what has the second derivatives `pp` by `r'`, of which the lower triangle counts, and `pw` by `r'`
/// and `r''`, none by `r''` twice.
#[inline]
pub fn add_spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], pp: &Mat3, pw: &Mat3, sum: &mut RelativeMatrix) {
    let between = |i: usize, a: usize, j: usize, b: usize| {
        let pp = if i > j { pp[(i, j)] } else { pp[(j, i)] };
        pp * (shape_x[a] * shape_x[b])
            + pw[(i, j)] * (shape_x[a] * shape_xx[b])
            + pw[(j, i)] * (shape_xx[a] * shape_x[b])
    };
    for j in 0..3 {
        for i in j..3 {
            for (a, place) in [(2, CHORD), (3, SLOPE)] {
                sum[place + j][place + i] += between(i, a, j, a);
            }
        }
        for i in 0..3 {
            sum[CHORD + j][SLOPE + i] += between(i, 3, j, 2);
        }
        for (b, column) in [(2, CHORD), (3, SLOPE)] {
            sum[column + j][STRETCH] += between(0, 1, j, b);
        }
    }
    sum[STRETCH][STRETCH] += between(0, 1, 0, 1);
}

/// The three numbers of `vector` from `place` on.
fn block(vector: &RelativeVector, place: usize) -> Vec3 {
    Vec3::new(vector[place], vector[place + 1], vector[place + 2])
}

/// The symmetric block on the diagonal of `matrix` from `place` on, of which the lower triangle counts.
#[inline]
fn symmetric(matrix: &RelativeMatrix, place: usize) -> Mat3 {
    let [xx, yx, zx] = [0, 1, 2].map(|i| matrix[place][place + i]);
    let [yy, zy, zz] = [(1, 1), (2, 1), (2, 2)].map(|(i, j)| matrix[place + j][place + i]);
    Mat3::new(xx, yx, zx, yx, yy, zy, zx, zy, zz)
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
