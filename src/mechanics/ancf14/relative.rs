//! What strains of bending and torsion depend on: nine numbers, the element as its first node sees it (MECHANICS 8).
//!
//! In the frame `[t u v]` of the first node: the chord `r_1 − r_0`, the second slope `p_1` and the first stretch `|p_0|` (the first
//! slope lies along `t`); beside them the twist between the nodes, `θ_1 − θ_0 + β`, and `θ_0`. Strains are differentiated by these
//! nine; the way back to the 14 coordinates, turn of the frame and holonomy included, is here alone.

use super::coordinates::{ElementMatrix, ElementVector, NODE, P, R, THETA};
use super::frame::NodeFrame;
use super::kinematics::Holonomy;
use crate::math::rotation::{cross_times, times_cross};
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use nalgebra::{SMatrix, SVector};

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
const RELATIVE: usize = 10;

/// One number per number of the relative shape, and a 0.
pub type RelativeVector = SVector<f64, RELATIVE>;
/// One number per pair of numbers of the relative shape; of symmetric ones the lower triangle counts.
pub type RelativeMatrix = SMatrix<f64, RELATIVE, RELATIVE>;

/// The shape of an element as its first node sees it.
#[derive(Clone, Debug)]
pub struct RelativeShape<'a> {
    /// Frames of the two nodes.
    pub frames: [&'a NodeFrame; 2],
    /// Holonomy between them.
    pub holonomy: Holonomy,
    /// Twist between the nodes, rad.
    pub twist: f64,
    /// Chord and second slope in space, m and 1.
    chord: Vec3,
    slope: Vec3,
    /// The same in the first node's frame.
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
        let (chord, slope) = (vec3(q, NODE + R) - vec3(q, R), vec3(q, NODE + P));
        Self {
            frames,
            twist: q[NODE + THETA] - q[THETA] + holonomy.angle,
            holonomy,
            chord,
            slope,
            chord_local: first.components(&chord),
            slope_local: first.components(&slope),
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
        let (by_chord, by_slope) = (first.in_space(&block(by, CHORD)), first.in_space(&block(by, SLOPE)));
        let (twist_p0, twist_p1) = self.holonomy.gradient(first, second);
        let by_p0 =
            first.moment_force(&self.moment(&by_chord, &by_slope)).0 + first.t * by[STRETCH] + twist_p0 * by[TWIST];
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

    /// Sets `sum` to `∂²F/∂q²`, 14×14, of what has the derivatives `by` and the second derivatives `second` by the relative shape.
    pub fn set_hessian(&self, by: &RelativeVector, second: &RelativeMatrix, sum: &mut ElementMatrix) {
        let [start, end] = self.frames;
        let t = start.t;
        let axes = Mat3::from_columns(&[start.t, start.u, start.v]);
        let in_space = |row: usize, column: usize| {
            let half = axes * second.fixed_view::<3, 3>(row, column);
            let (along, u, v) = (half.column(0), half.column(1), half.column(2));
            let turned = |i: usize| along * start.t[i] + u * start.u[i] + v * start.v[i];
            Mat3::from_columns(&[turned(0), turned(1), turned(2)])
        };
        let row = |row: usize, column: usize| {
            start.in_space(&Vec3::new(second[(row, column)], second[(row, column + 1)], second[(row, column + 2)]))
        };
        let (cc, sc, ss) = (in_space(CHORD, CHORD), in_space(SLOPE, CHORD), in_space(SLOPE, SLOPE));
        let cs = sc.transpose();
        let (by_chord, by_slope) = (start.in_space(&block(by, CHORD)), start.in_space(&block(by, SLOPE)));

        // By the turn of the first frame, which all the rest sees as the opposite turn of chord and slope.
        let c_turn = times_cross(&cc, &self.chord) + times_cross(&cs, &self.slope) - by_chord.cross_matrix();
        let s_turn = times_cross(&sc, &self.chord) + times_cross(&ss, &self.slope) - by_slope.cross_matrix();
        let turn_turn = -(cross_times(&self.chord, &c_turn) + cross_times(&self.slope, &s_turn));
        let turn_p = start.turn_p();
        let scalar = |place: usize| {
            let (by_c, by_s) = (row(place, CHORD), row(place, SLOPE));
            let by_p = turn_p.tr_mul(&self.moment(&by_c, &by_s));
            (by_c, by_p, by_s)
        };

        // By the first slope: it turns the frame and stretches.
        let (stretch_c, stretch_p, stretch_s) = scalar(STRETCH);
        let mut cp = c_turn * turn_p + stretch_c * t.transpose();
        let mut sp = s_turn * turn_p + stretch_s * t.transpose();
        let mut pp = turn_p.tr_mul(&(turn_turn * turn_p))
            + start.moment_force_p(&self.moment(&by_chord, &by_slope)).0
            + start.t_p() * by[STRETCH]
            + stretch_p * t.transpose()
            + t * (stretch_p + t * second[(STRETCH, STRETCH)]).transpose();

        // By the twist between the nodes, in which the holonomy is.
        let (b0, b1) = self.holonomy.gradient(start, end);
        let [h00, h01, h11] = self.holonomy.hessian(start, end);
        let (twist_c, mut twist_p, twist_s) = scalar(TWIST);
        twist_p += t * second[(TWIST, STRETCH)];
        let stiffness = second[(TWIST, TWIST)];
        let (all_p, all_s) = (twist_p + b0 * stiffness, twist_s + b1 * stiffness);
        cp += twist_c * b0.transpose();
        sp += twist_s * b0.transpose() + b1 * all_p.transpose() + h01.transpose() * by[TWIST];
        pp += all_p * b0.transpose() + b0 * twist_p.transpose() + h00 * by[TWIST];
        let cs = cs + twist_c * b1.transpose();
        let ss = ss + all_s * b1.transpose() + b1 * twist_s.transpose() + h11 * by[TWIST];

        // By the angle of the first node.
        let (angle_c, mut angle_p, angle_s) = scalar(ANGLE);
        let mixed = second[(ANGLE, TWIST)];
        angle_p += t * second[(ANGLE, STRETCH)] + b0 * mixed - all_p;
        let first_angle = [angle_c - twist_c, angle_p, angle_s + b1 * mixed - all_s];

        set(sum, NODE + R, NODE + R, &cc);
        set(sum, R, R, &cc);
        set(sum, P, P, &pp);
        set(sum, NODE + P, NODE + P, &ss);
        for (row, column, block) in [
            (R, NODE + R, -cc),
            (NODE + R, P, cp),
            (R, P, -cp),
            (NODE + R, NODE + P, cs),
            (R, NODE + P, -cs),
            (NODE + P, P, sp),
        ] {
            set(sum, row, column, &block);
            set(sum, column, row, &block.transpose());
        }
        for (theta, [by_c, by_p, by_s]) in [(THETA, first_angle), (NODE + THETA, [twist_c, all_p, all_s])] {
            for (place, block) in [(R, -by_c), (P, by_p), (NODE + R, by_c), (NODE + P, by_s)] {
                for i in 0..3 {
                    sum[(theta, place + i)] = block[i];
                    sum[(place + i, theta)] = block[i];
                }
            }
        }
        sum[(THETA, THETA)] = second[(ANGLE, ANGLE)] - 2.0 * mixed + stiffness;
        sum[(THETA, NODE + THETA)] = mixed - stiffness;
        sum[(NODE + THETA, THETA)] = mixed - stiffness;
        sum[(NODE + THETA, NODE + THETA)] = stiffness;
    }

    /// Moment on the first node's frame of forces on the chord and on the second slope, by invariance (MECHANICS 8).
    fn moment(&self, by_chord: &Vec3, by_slope: &Vec3) -> Vec3 {
        by_chord.cross(&self.chord) + by_slope.cross(&self.slope)
    }
}

/// By the relative shape, of what has the derivatives `by_p` and `by_w` by `r'` and `r''`, components in the first node's frame; the
/// weights are those of [`RelativeShape::interpolate`].
#[inline]
pub fn spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], by_p: &Vec3, by_w: &Vec3) -> RelativeVector {
    let mut sum = RelativeVector::zeros();
    for i in 0..3 {
        sum[CHORD + i] = by_p[i] * shape_x[2] + by_w[i] * shape_xx[2];
        sum[SLOPE + i] = by_p[i] * shape_x[3] + by_w[i] * shape_xx[3];
    }
    sum[STRETCH] = by_p[0] * shape_x[1] + by_w[0] * shape_xx[1];
    sum
}

/// Adds to `sum` what has the second derivatives `pp` by `r'` and `pw` by `r'` and `r''`, none by `r''` twice.
pub fn add_spread(shape_x: &[f64; 4], shape_xx: &[f64; 4], pp: &Mat3, pw: &Mat3, sum: &mut RelativeMatrix) {
    let wp = pw.transpose();
    let between = |a: usize, b: usize| {
        pp * (shape_x[a] * shape_x[b]) + pw * (shape_x[a] * shape_xx[b]) + wp * (shape_xx[a] * shape_x[b])
    };
    for (a, b, row, column) in [(2, 2, CHORD, CHORD), (3, 2, SLOPE, CHORD), (3, 3, SLOPE, SLOPE)] {
        let mut view = sum.fixed_view_mut::<3, 3>(row, column);
        view += between(a, b);
    }
    let [along_p, along_w, by_along_p] = [pp.column(0), wp.column(0), pw.column(0)];
    for (b, column) in [(2, CHORD), (3, SLOPE)] {
        let row = along_p * (shape_x[1] * shape_x[b])
            + along_w * (shape_x[1] * shape_xx[b])
            + by_along_p * (shape_xx[1] * shape_x[b]);
        for i in 0..3 {
            sum[(STRETCH, column + i)] += row[i];
        }
    }
    sum[(STRETCH, STRETCH)] += pp[0] * (shape_x[1] * shape_x[1]) + 2.0 * pw[0] * (shape_x[1] * shape_xx[1]);
}

/// The three numbers of `vector` from `place` on.
fn block(vector: &RelativeVector, place: usize) -> Vec3 {
    vector.fixed_rows::<3>(place).into_owned()
}

fn set(sum: &mut ElementMatrix, row: usize, column: usize, block: &Mat3) {
    sum.fixed_view_mut::<3, 3>(row, column).copy_from(block);
}
