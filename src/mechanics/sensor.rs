//! What can be measured at a point: its motion, and at a point of a beam the section's strains with the signs of the model file.

use super::configuration::Configuration;
use super::marker::Marker;
use super::pose::{Pose, angular_velocity};
use super::resultants::{self, SectionForces};
use super::state::State;
use super::system::{System, evaluation};
use crate::math::quadrature::{LOBATTO_POINTS, collocation, lagrange};
use crate::math::rotation::{quaternion_of, quaternion_of_triad, rotation_matrix, rotation_vector_near};
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::coordinates::interpolate;
use crate::mechanics::beam::kinematics::{CurvePoint, Kinematics};
use crate::mechanics::beam::quadratic_twist::{self, Twist};
use crate::mechanics::beam::strain::Strain;

/// A point that is watched.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// The point: a section, a body, a moving frame.
    pub marker: Marker,
    /// Place and axes as drawn.
    pub drawn: Pose,
    /// Of a point of a beam: the beam's number, and the fraction of its length, 0 to 1.
    pub on_beam: Option<(usize, f64)>,
    /// Of a point of a beam: the elements that it belongs to, two at an inner node.
    sections: Vec<Section>,
}

/// A place in an element, with what it is like undeformed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Section {
    element: usize,
    xi: f64,
    /// `J0 = |r0'|`, 1.
    reference_stretch: f64,
    /// `gamma_10`, `gamma_20`, 1/m.
    reference: [f64; 2],
}

/// Strains of a section, undeformed values taken off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionStrains {
    /// Axial strain `|r'|/J0 − 1`, 1.
    pub axial: f64,
    /// Curvature about y and about z, 1/m.
    pub curvature: [f64; 2],
    /// Torsion, rad/m.
    pub torsion: f64,
}

impl Sensor {
    /// On `marker`, in the configuration `c` as drawn; `on_beam` is the beam and the fraction of its length where it is a point of one.
    pub fn new(system: &System, c: &Configuration, marker: Marker, on_beam: Option<(usize, f64)>) -> Self {
        let beam = on_beam.map(|(beam, _)| &system.beams[beam]);
        let sections = match (marker, beam) {
            (Marker::Section { element, xi }, Some(_)) => vec![Section::new(c, element, xi)],
            (Marker::Node { node, .. }, Some(beam)) => {
                let ends = beam.elements_at(node).into_iter().zip([1.0, 0.0]);
                ends.filter_map(|(element, xi)| element.map(|element| Section::new(c, element, xi))).collect()
            }
            _ => Vec::new(),
        };
        Self { marker, drawn: marker.pose(c), on_beam, sections }
    }

    /// Velocity (m/s) and angular velocity (rad/s) in global axes.
    pub fn motion(&self, c: &Configuration, velocity: &[f64]) -> (Vec3, Vec3) {
        let range = self.marker.coordinates(c.elements);
        let motion = self.marker.motion(c);
        // A moving frame has no coordinates; what has coordinates does not move without them.
        let [explicit, _] = self.marker.pose_t(c);
        let (mut linear, mut angular) = (explicit.place, angular_velocity(&self.marker.pose(c), &explicit));
        for (local, index) in range.enumerate() {
            linear += motion.place_q.column(local) * velocity[index];
            angular += motion.turn_q.column(local) * velocity[index];
        }
        if let Some((number, xi)) = self.relaxed_section(c) {
            let (bubble_q, range) = (evaluation(c, number, None).bubble_q(), self.marker.coordinates(c.elements));
            let rate: f64 = bubble_q.iter().zip(&velocity[range]).map(|(by_q, velocity)| by_q * velocity).sum();
            angular += self.marker.pose(c).axis(0) * (quadratic_twist::shape(xi) * rate);
        }
        (linear, angular)
    }

    /// Rotation vector from the orientation as drawn, rad, the one nearest to `previous`.
    pub fn rotation(&self, c: &Configuration, previous: &Vec3) -> Vec3 {
        let mut axes = self.marker.pose(c).axes;
        if let Some((number, xi)) = self.relaxed_section(c) {
            axes *= rotation_matrix(&(Vec3::x() * (bubble(c, number) * quadratic_twist::shape(xi))));
        }
        rotation_vector_near(&(axes * self.drawn.axes.transpose()), previous)
    }

    /// Quaternion `w x y z` of the section, continuous with the rotation vector `rotation`.
    pub fn quaternion(&self, rotation: &Vec3) -> [f64; 4] {
        let turned = quaternion_of(rotation) * quaternion_of_triad(&self.drawn.axes);
        [turned.w, turned.i, turned.j, turned.k]
    }

    /// The element and the place in it of a section that the quadratic twist turns: markers have the linear one.
    fn relaxed_section(&self, c: &Configuration) -> Option<(usize, f64)> {
        match self.marker {
            Marker::Section { element, xi } if c.elements[element].stiffness.twist == Twist::Quadratic => {
                Some((element, xi))
            }
            _ => None,
        }
    }

    /// Material twist from the beam's start to here (off the beams 0), undeformed value taken off, rad: the sum of `l tau` (MECHANICS, trap 16).
    pub fn twist(&self, system: &System, c: &Configuration) -> f64 {
        let (Some((beam, _)), Some(section)) = (self.on_beam, self.sections.first()) else { return 0.0 };
        let twist = |number: usize| c.kinematics(number).twist - c.elements[number].reference_twist;
        let before = system.beams[beam].first_element..section.element;
        let inside =
            section.xi * twist(section.element) + bubble(c, section.element) * quadratic_twist::shape(section.xi);
        before.map(twist).sum::<f64>() + inside
    }

    /// Strains of the section; at an inner node the mean of its two elements'.
    pub fn strains(&self, c: &Configuration) -> SectionStrains {
        let mut sum = SectionStrains::default();
        for section in &self.sections {
            let own = section.strains(c);
            let share = 1.0 / self.sections.len() as f64;
            sum.axial += share * own.axial;
            sum.torsion += share * own.torsion;
            for (sum, own) in sum.curvature.iter_mut().zip(own.curvature) {
                *sum += share * own;
            }
        }
        sum
    }
}

impl Sensor {
    /// Acceleration in global axes, m/s², from the second derivatives `acceleration` of the coordinates.
    pub fn acceleration(&self, c: &Configuration, acceleration: &[f64]) -> Vec3 {
        // Places that are watched are linear in the coordinates: on the beam's axis, at the centre of mass.
        let [_, explicit] = self.marker.pose_t(c);
        let place_q = self.marker.motion(c).place_q;
        let own = self.marker.coordinates(c.elements).enumerate();
        own.fold(explicit.place, |sum, (local, index)| sum + place_q.column(local) * acceleration[index])
    }

    /// Force and moments of the section; at an inner node the mean of its two elements'.
    pub fn section_forces(&self, c: &Configuration) -> SectionForces {
        let mut sum = SectionForces::default();
        for section in &self.sections {
            let own = resultants::section_forces(&c.elements[section.element].stiffness, &section.strains(c));
            let share = 1.0 / self.sections.len() as f64;
            sum.axial += share * own.axial;
            for (sum, own) in sum.moment.iter_mut().zip(own.moment) {
                *sum += share * own;
            }
        }
        sum
    }

    /// Largest von Mises stress over the section's outline, Pa; at an inner node of the mean strains. NaN without an outline.
    pub fn stress(&self, system: &System, c: &Configuration) -> f64 {
        let (Some((beam, _)), Some(section)) = (self.on_beam, self.sections.first()) else { return f64::NAN };
        let beam = &system.beams[beam];
        let stiffness = &c.elements[section.element].stiffness;
        let strains = self.strains(c);
        resultants::largest_stress(&beam.outline, beam.young, stiffness, &strains).unwrap_or(f64::NAN)
    }
}

impl Section {
    /// At the place `xi` (0 to 1) of element `element`, in the configuration `c` as drawn.
    fn new(c: &Configuration, element: usize, xi: f64) -> Self {
        let drawn = Self { element, xi, reference_stretch: 1.0, reference: [0.0; 2] };
        let (stretch, gammas) = drawn.gammas(c, &c.kinematics(element), 0.0);
        // What the same interpolation finds as drawn: without loads all strains are 0 exactly.
        Self { reference_stretch: stretch, reference: gammas.map(|gamma| gamma / stretch), ..drawn }
    }

    /// Strains: axial the quadratic through the axial points, curvature about y `−gamma2`, about z `gamma1`.
    fn strains(&self, c: &Configuration) -> SectionStrains {
        let element = &c.elements[self.element];
        let evaluation = evaluation(c, self.element, None);
        let of_energy: f64 = lagrange(&LOBATTO_POINTS, self.xi)
            .iter()
            .zip(evaluation.axial_strains())
            .map(|(weight, e)| weight * e)
            .sum();
        let axial = match element.stiffness.strain {
            Strain::Small => of_energy,
            // Green's strain as an elongation.
            Strain::Large | Strain::LargeTruncated => (1.0 + 2.0 * of_energy).max(0.0).sqrt() - 1.0,
        };
        let (_, gammas) = self.gammas(c, &evaluation.kinematics, evaluation.bubble);
        let [about_z, about_y] = [0, 1].map(|i| gammas[i] / self.reference_stretch - self.reference[i]);
        SectionStrains {
            axial,
            curvature: [-about_y, about_z],
            torsion: (evaluation.kinematics.twist - element.reference_twist
                + evaluation.bubble * quadratic_twist::shape_xi(self.xi))
                / (element.length * self.reference_stretch),
        }
    }

    /// `|r'|`, and the curvatures `(gamma1, gamma2)` of the section by its element's length (2.14), 1/m; `bubble` is the
    /// internal coordinate of the quadratic twist, rad.
    fn gammas(&self, c: &Configuration, kinematics: &Kinematics, bubble: f64) -> (f64, [f64; 2]) {
        let element = &c.elements[self.element];
        let q = c.element_q(element);
        let shape_x = hermite::shape_x(self.xi, element.length);
        let shape_xx = hermite::shape_xx(self.xi, element.length);
        let point = CurvePoint::new(&kinematics.base.axes, interpolate(&shape_x, q), interpolate(&shape_xx, q));
        let inner = collocation(self.xi).map(|a| a * element.length);
        let alpha = kinematics.alpha_at(q, self.xi, &inner) + bubble * quadratic_twist::shape(self.xi);
        let (sin, cos) = alpha.sin_cos();
        let [kappa1, kappa2, _] = point.scalars.map(|scalar| scalar.value);
        (point.stretch, [cos * kappa1 + sin * kappa2, cos * kappa2 - sin * kappa1])
    }
}

/// Internal coordinate of the quadratic twist of element `number`, rad; 0 for linear twist.
fn bubble(c: &Configuration, number: usize) -> f64 {
    match c.elements[number].stiffness.twist {
        Twist::Linear => 0.0,
        Twist::Quadratic => evaluation(c, number, None).bubble,
    }
}

/// A state with the frames of its nodes: what sensors read.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    frames: Vec<crate::mechanics::beam::frame::NodeFrame>,
}

impl Snapshot {
    /// Computes the frames of `state` and returns its configuration.
    pub fn of<'a>(&'a mut self, system: &'a System, state: &'a State) -> Configuration<'a> {
        system.frames(&state.q, &state.triads, &mut self.frames);
        system.configuration(&state.q, &self.frames, state, &state.prescribed)
    }
}
