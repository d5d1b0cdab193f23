//! What can be measured at a point: its motion, and at a point of a beam the section's strains with the signs of the
//! model file.

use super::observer::Observer;
use super::{Marker, own_velocity};
use crate::math::Vec3;
use crate::math::elementary::atan2;
use crate::math::rotation::{quaternion_of, quaternion_of_triad, rotation_matrix, rotation_vector_near};
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::resultants::{SectionShape, SectionStrains};
use crate::mechanics::geometry::pose::{PLACE, Pose, angular_velocity};
use crate::mechanics::marker::configuration::Configuration;

/// The sides of a section, at which something may act.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Facing {
    /// Towards the start of the beam.
    Before,
    /// Towards the end of the beam.
    #[default]
    After,
}

/// A point that is watched.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// The point: a section, a body, a moving frame.
    pub marker: Marker,
    /// Position and axes as drawn.
    pub drawn: Pose,
    /// Of a point of a beam: the beam's number, and the fraction of its length, 0 to 1.
    pub on_beam: Option<(usize, f64)>,
    /// Who looks: none sees in global axes.
    pub observer: Option<Observer>,
    /// The side that section forces and strains belong to, at a point of a beam.
    pub facing: Facing,
    /// Of a point of a beam: the elements that it belongs to, two at an inner node.
    sections: Vec<Section>,
}

/// A position in an element, with what it is like undeformed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The element.
    pub element: usize,
    /// Position in it, 0 to 1.
    pub xi: f64,
    drawn: SectionShape,
}

impl Sensor {
    /// On `marker`, in the configuration `c` as drawn; `on_beam` is the beam and the fraction of its length where it is
    /// a point of one.
    pub fn new(beams: &[Beam], c: &Configuration, marker: Marker, on_beam: Option<(usize, f64)>) -> Self {
        let beam = on_beam.map(|(beam, _)| &beams[beam]);
        let sections = match (marker, beam) {
            (Marker::Section { element, xi, .. }, Some(_)) => vec![Section::new(c, element, xi)],
            (Marker::Node { node, .. }, Some(beam)) => {
                let ends = beam.elements_at(node).into_iter().zip([1.0, 0.0]);
                ends.filter_map(|(element, xi)| element.map(|element| Section::new(c, element, xi))).collect()
            }
            _ => Vec::new(),
        };
        Self { marker, drawn: marker.pose(c), on_beam, observer: None, facing: Facing::default(), sections }
    }

    /// An element that a point of a beam belongs to, with its position in it.
    pub fn in_element(&self) -> Option<(usize, f64)> {
        self.sections.first().map(|section| (section.element, section.xi))
    }

    /// The element, with the position in it, whose strains turn the section beyond its marker: of a point inside an
    /// element. What is tied to the section turns with the marker, as loads and springs do.
    fn relaxed(&self) -> Option<(usize, f64)> {
        match (self.marker, self.on_beam) {
            (Marker::Section { element, xi, .. }, Some(_)) => Some((element, xi)),
            _ => None,
        }
    }

    /// Velocity (m/s) and angular velocity (rad/s) in global axes.
    pub fn motion(&self, c: &Configuration, velocity: &[f64]) -> (Vec3, Vec3) {
        let range = self.marker.coordinates(c.mesh);
        let jacobian = self.marker.jacobian(c);
        // A moving frame has no coordinates; what has coordinates does not move without them.
        let [explicit, _] = self.marker.pose_t(c);
        let (mut linear, mut angular) = (explicit.place, angular_velocity(&self.marker.pose(c), &explicit));
        for (local, index) in range.enumerate() {
            linear += jacobian.place_q.column(local) * velocity[index];
            angular += jacobian.turn_q.column(local) * velocity[index];
        }
        if let Some((element, xi)) = self.relaxed() {
            angular += self.marker.pose(c).axis(0) * c.mesh.elements[element].relaxed_spin(&c.beams, xi, velocity);
        }
        (linear, angular)
    }

    /// Position as its observer sees it; without one from the origin of the state, m.
    pub fn seen_position(&self, c: &Configuration) -> Vec3 {
        let pose = self.marker.pose(c);
        self.observer.as_ref().map_or(pose.place, |observer| observer.see(c, &pose).place)
    }

    /// Displacement from the drawing as its observer sees it, m.
    pub fn seen_displacement(&self, c: &Configuration) -> Vec3 {
        self.seen_position(c) - self.seen_drawn().place
    }

    /// [`Self::motion`] as its observer sees it.
    pub fn seen_motion(&self, c: &Configuration, velocity: &[f64]) -> (Vec3, Vec3) {
        let motion = self.motion(c, velocity);
        match &self.observer {
            Some(observer) => observer.motion(c, velocity, &self.marker.pose(c).place, motion),
            None => motion,
        }
    }

    /// [`Self::acceleration`] as its observer sees it.
    pub fn seen_acceleration(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64]) -> Vec3 {
        let own = self.acceleration(c, velocity, acceleration);
        let Some(observer) = &self.observer else { return own };
        let of = [self.marker.pose(c).place, self.motion(c, velocity).0, own];
        observer.acceleration(c, velocity, acceleration, of)
    }

    /// Position and axes as drawn, as its observer saw them.
    fn seen_drawn(&self) -> Pose {
        self.observer.as_ref().map_or(self.drawn, |observer| observer.see_drawn(&self.drawn))
    }

    /// Rotation vector from the orientation as drawn, rad, the one nearest to `previous`, as its observer sees both.
    pub fn rotation(&self, c: &Configuration, previous: &Vec3) -> Vec3 {
        let mut pose = self.marker.pose(c);
        if let Some((element, xi)) = self.relaxed() {
            pose.axes *= rotation_matrix(&(Vec3::x() * c.mesh.elements[element].relaxed_turn(&c.beams, xi)));
        }
        let pose = self.observer.as_ref().map_or(pose, |observer| observer.see(c, &pose));
        rotation_vector_near(&(pose.axes * self.seen_drawn().axes.transpose()), previous)
    }

    /// Quaternion `w x y z` of the section as its observer sees it, continuous with the rotation vector `rotation`.
    pub fn quaternion(&self, rotation: &Vec3) -> [f64; 4] {
        let turned = quaternion_of(rotation) * quaternion_of_triad(&self.seen_drawn().axes);
        [turned.w, turned.i, turned.j, turned.k]
    }

    /// Angle of its x axis from the direction as drawn, rad, as its observer sees both; `rotation` is the rotation
    /// vector.
    pub fn tilt(&self, rotation: &Vec3) -> f64 {
        let drawn = self.seen_drawn().axis(0);
        let now = rotation_matrix(rotation) * drawn;
        // Small angles have no digits in their cosine.
        atan2(drawn.cross(&now).norm(), drawn.dot(&now))
    }

    /// The sections on both sides of a point of a beam: one where the beam ends or within an element, the side before
    /// first.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The elements that it belongs to, each with the position in it, 0 to 1.
    pub fn places(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.sections.iter().map(|section| (section.element, section.xi))
    }
}

impl Sensor {
    /// Acceleration in global axes, m/s², from the velocities of the coordinates and their second derivatives
    /// `acceleration`.
    pub fn acceleration(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64]) -> Vec3 {
        let [_, explicit] = self.marker.pose_t(c);
        let place_q = self.marker.jacobian(c).place_q;
        let own = self.marker.coordinates(c.mesh).enumerate();
        let sum = own.fold(explicit.place, |sum, (local, index)| sum + place_q.column(local) * acceleration[index]);
        // On the axis of a beam places are linear in the coordinates, and on a body all are: the directors have the
        // centripetal part.
        if self.marker.arm() == Vec3::zeros() {
            return sum;
        }
        let own = own_velocity(c, &self.marker, velocity);
        sum + self.marker.pose_q(c).convective(&self.marker, c, &own).column(PLACE)
    }
}

impl Section {
    /// At the position `xi` (0 to 1) of element `element`, in the configuration `c` as drawn.
    fn new(c: &Configuration, element: usize, xi: f64) -> Self {
        Self { element, xi, drawn: c.mesh.elements[element].section_shape(&c.beams, xi) }
    }

    /// Strains that the coordinates make, undeformed values taken off.
    pub fn strains(&self, c: &Configuration) -> SectionStrains {
        c.mesh.elements[self.element].section_strains(&c.beams, self.xi, &self.drawn)
    }
}
