//! Forces and moments on markers: at one point, or spread over a beam; in global directions or turning with the
//! section.

use crate::math::Vec3;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::beam::line_load::LineLoad;
use crate::mechanics::beam::mesh::Mesh;
use crate::mechanics::force::track::Track;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::axis_vector;
use crate::mechanics::input::excitation::{HostWrench, Wrench};
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use std::ops::Range;

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

/// Where a load acts.
#[derive(Clone, Debug)]
pub enum Site {
    /// On a marker.
    Point(Marker),
    /// Along elements, by their numbers.
    Line(Range<usize>),
    /// A point that moves along a beam.
    Moving(Box<Track>),
}

/// A load.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name in the model file.
    pub name: String,
    /// Where it acts.
    pub site: Site,
    /// Where its components come from.
    pub guide: LoadGuide,
    /// Axes of the components.
    pub direction: Direction,
}

impl Load {
    /// Its components at `time`, s; `target` is what a host gives. They are 0 where it has left its beam.
    pub fn at(&self, time: f64, target: &HostWrench) -> Wrench {
        if let Site::Moving(track) = &self.site
            && !track.at(time).1
        {
            return Wrench::default();
        }
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

    /// The elements that it acts on or may come to; of a load on a marker none.
    pub fn elements(&self) -> Range<usize> {
        match &self.site {
            Site::Point(_) => 0..0,
            Site::Line(elements) => elements.clone(),
            Site::Moving(track) => track.elements(),
        }
    }

    /// The station of a load that moves along a beam, a function of time, and its presence there.
    pub fn track_signals(&self) -> impl Iterator<Item = &Signal> {
        let signals = match &self.site {
            Site::Moving(track) => Some([&track.station, &track.presence]),
            Site::Point(_) | Site::Line(_) => None,
        };
        signals.into_iter().flatten()
    }

    /// Where it is on its beam at `time` (s), a fraction of its length; 0 of a load that does not move.
    pub fn station(&self, time: f64) -> f64 {
        if let Site::Moving(track) = &self.site { track.at(time).0 } else { 0.0 }
    }

    /// The marker that it acts on at `time`, s; none: it acts along elements.
    pub fn marker(&self, time: f64) -> Option<Marker> {
        match &self.site {
            Site::Point(marker) => Some(*marker),
            Site::Moving(track) => Some(track.marker(track.at(time).0)),
            Site::Line(_) => None,
        }
    }

    /// The markers that it acts on: along elements their load points; of a moving load one of each element that it may
    /// come to.
    pub fn markers(&self, mesh: &Mesh) -> Vec<Marker> {
        match &self.site {
            Site::Point(marker) => vec![*marker],
            Site::Moving(track) => track.markers(mesh),
            Site::Line(elements) => {
                let points = |number: usize| mesh.elements[number].load_points().map(|(xi, _)| (number, xi));
                elements.clone().flat_map(points).map(|(number, xi)| Marker::section(number, xi)).collect()
            }
        }
    }

    /// Calls `take` with the coordinates of each part that it acts on and with the generalized force there under the
    /// components `wrench`, at the fraction `station` of its beam if it moves along one.
    pub fn each_force(
        &self,
        c: &Configuration,
        (wrench, station): (&Wrench, f64),
        mut take: impl FnMut(Range<usize>, &[f64]),
    ) {
        let mut at_point = |marker: &Marker| {
            let range = marker.coordinates(c.mesh);
            let force = self.point_force(marker, c, wrench);
            take(range.clone(), &force.as_slice()[..range.len()]);
        };
        match &self.site {
            Site::Point(marker) => at_point(marker),
            Site::Moving(track) => at_point(&track.marker(station)),
            Site::Line(elements) => {
                let load = self.along(wrench);
                for element in &c.mesh.elements[elements.clone()] {
                    let range = element.coordinates();
                    take(range.clone(), &element.line_force(&c.beams, &load)[..range.len()]);
                }
            }
        }
    }

    /// Power of the components `wrench` by the velocity of material past the mesh of beams that are paid out, W: what
    /// the forces of [`Self::each_force`] do not do at coordinates that stand still.
    pub fn passing_power(&self, c: &Configuration, wrench: &Wrench) -> f64 {
        let Site::Line(elements) = &self.site else { return 0.0 };
        let (load, paid_out) =
            (self.along(wrench), c.mesh.elements[elements.clone()].iter().filter_map(AnyElement::paid_out));
        paid_out.map(|element| element.passing_power(&c.beams, &load)).sum()
    }

    /// The components `wrench` as an element sees them.
    pub fn along(&self, wrench: &Wrench) -> LineLoad {
        let Wrench { force, moment } = *wrench;
        LineLoad { force, moment, follows: self.direction == Direction::Follower }
    }

    /// The components `wrench` at a marker, in space: N, N m.
    pub fn in_space(&self, marker: &Marker, c: &Configuration, wrench: &Wrench) -> [Vec3; 2] {
        match self.direction {
            Direction::Global => [wrench.force, wrench.moment],
            Direction::Follower => {
                let axes = marker.pose(c).axes;
                [axes * wrench.force, axes * wrench.moment]
            }
        }
    }

    /// Generalized force at a marker under the components `wrench`, 24×1, in the marker's coordinates.
    pub fn point_force(&self, marker: &Marker, c: &Configuration, wrench: &Wrench) -> MarkerVector {
        let [force, moment] = self.in_space(marker, c, wrench);
        let jacobian = marker.jacobian(c);
        jacobian.place_q.tr_mul(&force) + jacobian.turn_q.tr_mul(&moment)
    }

    /// Whether its force may depend on the coordinates.
    pub fn may_turn(&self) -> bool {
        let has_moment = match &self.guide {
            LoadGuide::Signals { moment, .. } => moment.iter().any(|own| !matches!(own, Signal::Constant(0.0))),
            LoadGuide::Host => true,
        };
        self.direction == Direction::Follower || has_moment || self.has_arm()
    }

    /// Whether its force under the components `wrench` depends on no coordinate: that of a dead force without an arm.
    pub fn is_constant(&self, wrench: &Wrench) -> bool {
        self.direction == Direction::Global && wrench.moment == Vec3::zeros() && !self.has_arm()
    }

    fn has_arm(&self) -> bool {
        matches!(&self.site, Site::Point(marker) if marker.arm() != Vec3::zeros())
    }

    /// Derivative of [`Self::point_force`] with respect to the marker's coordinates, 24×24.
    pub fn point_force_q(&self, marker: &Marker, c: &Configuration, wrench: &Wrench) -> MarkerMatrix {
        let [force, moment] = self.in_space(marker, c, wrench);
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
                sum + jacobian.place_q.tr_mul(&turned(&wrench.force)) + jacobian.turn_q.tr_mul(&turned(&wrench.moment))
            }
        }
    }
}
