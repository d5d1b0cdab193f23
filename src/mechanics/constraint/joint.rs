//! Joints: lists of primitive conditions `phi = 0` between two markers (MECHANICS 6). A kind of joint is a file with
//! its list.
//!
//! The rigidity of bodies and the drives are lists of conditions too: whatever holds the system together is a
//! [`Joint`].

use super::gear::GearSide;
use super::primitive::{MOST_ROWS, Primitive};
use super::slide::Slide;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::mechanics::geometry::marker_jacobian::{MARKER, MarkerMatrix};
use crate::mechanics::geometry::pose::{Pose, VECTORS};
use crate::mechanics::geometry::pose_pair::{PairHessian, PairVector};
use crate::mechanics::input::switch::Hold;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::own_velocity;
use crate::mechanics::marker::pose_gradient::{PoseGradient, of_side, pull_back};
use crate::mechanics::marker::relative_coordinate::Measure;
use nalgebra::SMatrix;

/// Most conditions a joint has.
pub const MOST_CONDITIONS: usize = 6;

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// What it is, and its name in the model file: `joint hinge`.
    pub name: String,
    /// One side.
    pub a: Marker,
    /// The other side.
    pub b: Marker,
    /// The conditions.
    pub primitives: &'static [Primitive],
    /// The drive that prescribes the measure of its only primitive, if one does.
    pub drive: Option<usize>,
    /// How its only primitive enters the condition of a gear, if it does.
    pub gear: Option<GearSide>,
    /// The element that it holds b to, if b slides along a beam.
    pub slide: Option<Slide>,
    /// What engages and releases it; none: it always holds.
    pub holding: Option<Holding>,
}

/// Where side a holds b now.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settled {
    /// Side a where the joint has engaged anew or where b has slid to; none: as drawn.
    carried: Option<Marker>,
    /// The curvature vector of a beam at b, which slides along it, 1/m.
    bend: Vec3,
}

/// How a switch works on a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Holding {
    /// The switch, by its number.
    pub switch: usize,
    /// What it holds.
    pub held: Held,
}

/// What holds where it stands when a switch engages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// The pose of side b relative to side a.
    Pose,
    /// The measure of the only primitive: this relative coordinate.
    Coordinate(usize),
}

/// Gradient of a joint's conditions by the coordinates of its two sides, rows in order, 6×24 each, of which only the
/// rows of conditions and the columns of coordinates are set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointGradient {
    /// Whether the joint is released: its conditions are none, and its gradient is 0.
    pub is_released: bool,
    /// By the coordinates of side a.
    pub a: SMatrix<f64, MOST_CONDITIONS, MARKER>,
    /// By the coordinates of side b.
    pub b: SMatrix<f64, MOST_CONDITIONS, MARKER>,
}

impl JointGradient {
    /// Sets it from how the poses of both sides move and the gradients of all rows by their vectors.
    fn set(&mut self, sides: &[PoseGradient; 2], rows_x: &[PairVector]) {
        for (side, target) in [&mut self.a, &mut self.b].into_iter().enumerate() {
            let columns = &mut target.data.0;
            for (phi_x, row) in rows_x.iter().zip(0..MOST_CONDITIONS) {
                sides[side].pull_back(&of_side(phi_x, side), |column, value| columns[column][row] = value);
            }
        }
    }
}

/// The gradient of `lambda·phi` from those of all rows.
fn weighted(rows_x: &[PairVector], lambda: &[f64]) -> PairVector {
    let mut sum = PairVector::zeros();
    rows_x.iter().zip(lambda).for_each(|(row, lambda)| sum += row * *lambda);
    sum
}

impl Joint {
    /// Number of conditions.
    pub fn rows(&self) -> usize {
        self.primitives.iter().map(|primitive| primitive.rows()).sum()
    }

    /// What its switch does; none: it has no switch.
    fn hold<'c>(&self, c: &'c Configuration) -> Option<&'c Hold> {
        self.holding.map(|holding| &c.prescribed.holds[holding.switch])
    }

    /// Whether it is released.
    pub fn is_released(&self, c: &Configuration) -> bool {
        self.hold(c).is_some_and(|hold| !hold.is_engaged)
    }

    /// Side a where the joint has engaged anew: at the pose that side b had then; none: as drawn.
    fn carried(&self, c: &Configuration) -> Option<Marker> {
        match (self.holding, self.hold(c)) {
            (Some(Holding { held: Held::Pose, .. }), Some(hold)) if hold.pose != Pose::default() => {
                Some(self.a.carried(&hold.pose.place, &hold.pose.axes))
            }
            _ => None,
        }
    }

    /// Where it holds; none: it imposes nothing, since it is released, or b slides on another element.
    pub fn settle(&self, c: &Configuration) -> Option<Settled> {
        if self.is_released(c) {
            return None;
        }
        let Some(slide) = &self.slide else {
            return Some(Settled { carried: self.carried(c), bend: Vec3::zeros() });
        };
        let nearest = slide.nearest(c, &self.b.pose(c).place);
        let is_here = nearest.element == slide.element;
        is_here.then(|| Settled { carried: Some(nearest.marker()), bend: nearest.bend })
    }

    /// Both sides as they hold each other, with what [`Self::settle`] gives.
    pub fn sides<'j>(&'j self, settled: &'j Settled) -> [&'j Marker; 2] {
        [settled.carried.as_ref().unwrap_or(&self.a), &self.b]
    }

    /// Whether its part is added to the conditions of the joint before it: it is the second side of a gear, or holds to
    /// another element of the beam that b slides along.
    pub fn shares_conditions(&self) -> bool {
        self.is_second_side() || self.slide.as_ref().is_some_and(|slide| !slide.is_first())
    }

    /// Whether it is the second side of a gear.
    pub fn is_second_side(&self) -> bool {
        self.gear.as_ref().is_some_and(|side| side.is_second)
    }

    /// What its drive prescribes, with its rate and acceleration, from where it engaged; of a lock where it engaged;
    /// else 0.
    pub fn prescribed(&self, c: &Configuration) -> Jet {
        let mut jet = self.drive.map_or(Jet::constant(0.0), |drive| c.prescribed.drives[drive]);
        if let Some(Holding { held: Held::Coordinate(_), .. }) = self.holding {
            jet.value += self.hold(c).map_or(0.0, |hold| hold.value);
        }
        jet
    }

    /// The conditions, zero when they hold; m or 1.
    pub fn phi(&self, c: &Configuration, phi: &mut [f64]) {
        let Some(settled) = self.settle(c) else {
            phi.fill(0.0);
            return;
        };
        let [a, b] = self.sides(&settled).map(|side| side.pose(c));
        if let Some(part) = self.gear_part(c, &a, &b) {
            phi[0] = part.value;
            return;
        }
        let prescribed = self.prescribed(c).value;
        let mut row = 0;
        for primitive in self.primitives {
            primitive.phi(&a, &b, prescribed, &mut phi[row..row + primitive.rows()]);
            row += primitive.rows();
        }
    }

    /// What its only primitive adds to the condition of a gear, with derivatives by the measure; none: it is no side of
    /// one.
    fn gear_part(&self, c: &Configuration, a: &Pose, b: &Pose) -> Option<Jet> {
        match (&self.gear, self.primitives) {
            (Some(side), [Primitive::Measured(measure)]) => Some(side.part(measure.value(a, b, side.previous(c)))),
            _ => None,
        }
    }

    /// Sets `gradients`, which are zero, to those of all rows by the vectors of both poses, in order, and returns
    /// those; `part` is [`Self::gear_part`].
    fn rows_x<'g>(
        &self,
        a: &Pose,
        b: &Pose,
        part: Option<Jet>,
        gradients: &'g mut [PairVector; MOST_CONDITIONS],
    ) -> &'g [PairVector] {
        let mut row = 0;
        for primitive in self.primitives {
            for local in 0..primitive.rows() {
                primitive.set_phi_x(a, b, local, &mut gradients[row]);
                if let Some(part) = part {
                    gradients[row] *= part.first;
                }
                row += 1;
            }
        }
        &gradients[..row]
    }

    /// Sets `gradient` to `∂phi/∂q` of both sides.
    pub fn phi_q(&self, c: &Configuration, gradient: &mut JointGradient) {
        let Some(settled) = self.settle(c) else {
            *gradient = JointGradient { is_released: self.slide.is_none(), ..JointGradient::default() };
            return;
        };
        gradient.is_released = false;
        let [a, b] = self.sides(&settled);
        let poses = [a.pose(c), b.pose(c)];
        let mut rows_x = [PairVector::zeros(); MOST_CONDITIONS];
        let rows_x = self.rows_x(&poses[0], &poses[1], self.gear_part(c, &poses[0], &poses[1]), &mut rows_x);
        gradient.set(&[a.pose_q(c), b.pose_q(c)], rows_x);
    }

    /// Second derivative of `lambda·phi` by the vectors of both poses; `part` is [`Self::gear_part`], `bend` that of
    /// [`Settled`].
    fn stiffness_x(&self, [a, b]: [&Pose; 2], bend: &Vec3, part: Option<Jet>, lambda: &[f64]) -> PairHessian {
        let mut hessian = PairHessian::default();
        let mut row = 0;
        for primitive in self.primitives {
            debug_assert!(primitive.rows() <= MOST_ROWS);
            let own = &lambda[row..row + primitive.rows()];
            match (part, *primitive) {
                (Some(part), Primitive::Measured(measure)) => {
                    measure.add_hessian(a, b, part.first * own[0], &mut hessian);
                    measure.add_square(a, b, part.second * own[0], &mut hessian);
                }
                _ => primitive.add_phi_xx(a, b, own, &mut hessian),
            }
            row += primitive.rows();
        }
        if self.slide.is_some() {
            // As b slides, the axes turn with the curve (MECHANICS 6).
            let bent: f64 = lambda.iter().zip(1..).map(|(lambda, axis)| lambda * bend.dot(&a.axis(axis))).sum();
            Measure::Distance(0).add_square(a, b, -bent, &mut hessian);
        }
        hessian
    }

    /// Sets `blocks` to `∂²(lambda·phi)/∂q²`: `aa, ab, ba, bb`, 24×24 each, of which only the rows and columns of the
    /// markers' own coordinates are set. On the way `gradient` is set as by [`Self::phi_q`].
    pub fn phi_q_and_qq(
        &self,
        c: &Configuration,
        lambda: &[f64],
        gradient: &mut JointGradient,
        blocks: &mut [MarkerMatrix; 4],
    ) {
        let Some(settled) = self.settle(c) else {
            *gradient = JointGradient { is_released: self.slide.is_none(), ..JointGradient::default() };
            blocks.iter_mut().for_each(|block| block.fill(0.0));
            return;
        };
        gradient.is_released = false;
        let own = self.sides(&settled);
        let [a, b] = own.map(|side| side.pose(c));
        let part = self.gear_part(c, &a, &b);
        let mut rows_x = [PairVector::zeros(); MOST_CONDITIONS];
        let rows_x = self.rows_x(&a, &b, part, &mut rows_x);
        // They are large: `map` would copy them.
        let sides = [own[0].pose_q(c), own[1].pose_q(c)];
        gradient.set(&sides, rows_x);
        let (force, stiffness) = (weighted(rows_x, lambda), self.stiffness_x([&a, &b], &settled.bend, part, lambda));
        pull_back(c, own, &sides, &force, &stiffness, blocks);
    }

    /// `phi''` at an instant without the part of the accelerations, `v·phi_qq·v + 2 phi_qt·v + phi_tt`, row after row.
    pub fn phi_tt(&self, c: &Configuration, velocity: &[f64], phi_tt: &mut [f64]) {
        let Some(settled) = self.settle(c) else {
            phi_tt.fill(0.0);
            return;
        };
        let sides = self.sides(&settled);
        let [a, b] = sides.map(|side| side.pose(c));
        let (mut rate, mut acceleration) = (PairVector::zeros(), PairVector::zeros());
        for (side, marker) in sides.into_iter().enumerate() {
            let (own, pose_q) = (own_velocity(c, marker, velocity), marker.pose_q(c));
            let [first, second] = marker.pose_t(c).map(|pose| pose.vectors());
            let start = VECTORS * side;
            rate.fixed_columns_mut::<VECTORS>(start).copy_from(&(pose_q.times(&own) + first));
            let convective = pose_q.convective(marker, c, &own);
            acceleration.fixed_columns_mut::<VECTORS>(start).copy_from(&(convective + second));
        }
        let part = self.gear_part(c, &a, &b);
        let mut rows_x = [PairVector::zeros(); MOST_CONDITIONS];
        let rows_x = self.rows_x(&a, &b, part, &mut rows_x);
        for (row, phi_tt) in phi_tt.iter_mut().enumerate() {
            let mut unit = [0.0; MOST_CONDITIONS];
            unit[row] = 1.0;
            let stiffness = self.stiffness_x([&a, &b], &settled.bend, part, &unit[..rows_x.len()]);
            *phi_tt = stiffness.times(&rate).dot(&rate) + rows_x[row].dot(&acceleration) - self.prescribed(c).second;
        }
    }

    /// `∂phi/∂t` at fixed coordinates, row after row.
    pub fn phi_t(&self, c: &Configuration, phi_t: &mut [f64]) {
        let Some(settled) = self.settle(c) else {
            phi_t.fill(0.0);
            return;
        };
        if ![self.a, self.b].iter().any(|side| matches!(side, Marker::Frame { .. })) {
            phi_t.fill(0.0 - self.prescribed(c).first);
            return;
        }
        let sides = self.sides(&settled);
        let moving = sides.map(|marker| marker.pose_t(c)[0].vectors());
        let [a, b] = sides.map(|side| side.pose(c));
        let mut rows_x = [PairVector::zeros(); MOST_CONDITIONS];
        let rows_x = self.rows_x(&a, &b, self.gear_part(c, &a, &b), &mut rows_x);
        for (phi_t, gradient) in phi_t.iter_mut().zip(rows_x) {
            let by_frames: f64 = (0..2).map(|side| of_side(gradient, side).dot(&moving[side])).sum();
            *phi_t = by_frames - self.prescribed(c).first;
        }
    }

    /// `∂(lambda·phi)/∂X` by the vectors of both poses: minus the forces of the joint on them.
    pub fn phi_x(&self, c: &Configuration, lambda: &[f64]) -> PairVector {
        let Some(settled) = self.settle(c) else { return PairVector::zeros() };
        let [a, b] = self.sides(&settled).map(|side| side.pose(c));
        let mut rows_x = [PairVector::zeros(); MOST_CONDITIONS];
        weighted(self.rows_x(&a, &b, self.gear_part(c, &a, &b), &mut rows_x), lambda)
    }

    /// Whether the sides are as meant, not half-turn relatives of it (MECHANICS 6).
    pub fn is_upright(&self, c: &Configuration) -> bool {
        let Some(settled) = self.settle(c) else { return true };
        let [a, b] = self.sides(&settled).map(|side| side.pose(c));
        self.primitives.iter().all(|primitive| primitive.is_upright(&a, &b))
    }
}
