//! Forces and moments on markers: at one point, or spread over a beam; in global directions or turning with the section.

use crate::math::Vec3;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::axis_vector;
use crate::mechanics::input::excitation::{HostWrench, Wrench};
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;

/// What a load's components refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Global axes: a dead load.
    Global,
    /// Axes of the section, x along the tangent: the load turns with it.
    Follower,
}

/// Where a load has its components from.
#[derive(Clone, Debug)]
pub enum LoadGuide {
    /// They are functions of time.
    Signals {
        /// Force, N, or N/m along a beam.
        force: [Signal; 3],
        /// Moment, N m, or N along a beam.
        moment: [Signal; 3],
    },
    /// A host gives them.
    Host,
}

/// A load on one or more markers.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name in the model file.
    pub name: String,
    /// Where it acts, each marker with its share: 1 at a point, quadrature weights (m) along a beam.
    pub points: Vec<(Marker, f64)>,
    /// Where its components come from.
    pub guide: LoadGuide,
    /// Axes of the components.
    pub direction: Direction,
}

impl Load {
    /// Its components at `time`, s; `target` is what a host gives.
    pub fn at(&self, time: f64, target: &HostWrench) -> Wrench {
        match &self.guide {
            LoadGuide::Signals { force, moment } => {
                let value = |signals: &[Signal; 3]| Vec3::from_fn(|i, _| signals[i].at(time));
                Wrench { force: value(force), moment: value(moment) }
            }
            LoadGuide::Host => target.at(time),
        }
    }

    /// The functions of time that its components are; none where a host gives them.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let components = match &self.guide {
            LoadGuide::Signals { force, moment } => Some(force.iter().chain(moment)),
            LoadGuide::Host => None,
        };
        components.into_iter().flatten()
    }

    /// The share of point `number` in the components `wrench`, in space: N, N m.
    fn in_space(&self, c: &Configuration, number: usize, wrench: &Wrench) -> (Vec3, Vec3) {
        let (marker, share) = &self.points[number];
        let (force, moment) = (wrench.force * *share, wrench.moment * *share);
        match self.direction {
            Direction::Global => (force, moment),
            Direction::Follower => {
                let axes = marker.pose(c).axes;
                (axes * force, axes * moment)
            }
        }
    }

    /// Generalized force of point `number` under the components `wrench`, 24×1, in the marker's coordinates.
    pub fn force(&self, c: &Configuration, number: usize, wrench: &Wrench) -> MarkerVector {
        let (force, moment) = self.in_space(c, number, wrench);
        let jacobian = self.points[number].0.jacobian(c);
        jacobian.place_q.tr_mul(&force) + jacobian.turn_q.tr_mul(&moment)
    }

    /// Whether its force may depend on the coordinates.
    pub fn may_turn(&self) -> bool {
        let has_moment = match &self.guide {
            LoadGuide::Signals { moment, .. } => moment.iter().any(|own| !matches!(own, Signal::Constant(0.0))),
            LoadGuide::Host => true,
        };
        self.direction == Direction::Follower
            || has_moment
            || self.points.iter().any(|(marker, _)| marker.arm() != Vec3::zeros())
    }

    /// Whether [`Self::force_q`] of point `number` under the components `wrench` is zero: that of a dead force without an arm.
    pub fn is_constant(&self, number: usize, wrench: &Wrench) -> bool {
        self.direction == Direction::Global
            && wrench.moment == Vec3::zeros()
            && self.points[number].0.arm() == Vec3::zeros()
    }

    /// `∂(generalized force)/∂q` of point `number` under the components `wrench`, 24×24.
    pub fn force_q(&self, c: &Configuration, number: usize, wrench: &Wrench) -> MarkerMatrix {
        let marker = &self.points[number].0;
        let (force, moment) = self.in_space(c, number, wrench);
        let sum = marker.wrench_stiffness(c, &force, &moment);
        match self.direction {
            Direction::Global => sum,
            Direction::Follower => {
                let (jacobian, pose_q) = (marker.jacobian(c), marker.pose_q(c));
                let turned = |local: &Vec3| -> ByCoordinates {
                    let mut sum = ByCoordinates::zeros();
                    for number in 0..pose_q.count() {
                        sum.set_column(number, &(pose_q.column(number).fixed_columns::<3>(axis_vector(0)) * local));
                    }
                    sum
                };
                let share = self.points[number].1;
                sum + jacobian.place_q.tr_mul(&turned(&(wrench.force * share)))
                    + jacobian.turn_q.tr_mul(&turned(&(wrench.moment * share)))
            }
        }
    }
}
