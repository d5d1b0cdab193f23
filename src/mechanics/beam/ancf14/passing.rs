//! The inertia of material that passes through the mesh of an element that is paid out (MECHANICS 3.11).

use super::coordinates::{ELEMENT, ElementVector, SHAPE_PLACES, interpolate};
use super::paid_out::PaidOut;
use super::payout::Extent;
use crate::math::vectors::vec3;
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::configuration::{BeamConfiguration, Passage};
use crate::mechanics::beam::element::BeamElement;
use crate::mechanics::beam::line_load::LineLoad;
use crate::mechanics::beam::resultants::SectionShape;

impl PaidOut {
    /// `leftᵀ matrix right` of the coordinates of a line.
    pub(super) fn line_form(&self, left: &[f64], matrix: &[[f64; 4]; 4], right: &[f64]) -> f64 {
        let (left, right) = (self.drawn.own(left), self.drawn.own(right));
        let mut sum = 0.0;
        for (row, products) in SHAPE_PLACES.into_iter().zip(matrix) {
            for (column, product) in SHAPE_PLACES.into_iter().zip(products) {
                sum += product * (0..3).map(|axis| left[row + axis] * right[column + axis]).sum::<f64>();
            }
        }
        sum
    }

    /// Generalized force of the inertia of what passes through the mesh at the velocities `scale` times `velocity` of
    /// the system, beyond that of the mesh's own acceleration.
    pub(super) fn passing_inertia(&self, c: &BeamConfiguration, velocity: &[f64], scale: f64) -> ElementVector {
        let extent = self.extent(c.drives);
        let first = line_times(&self.transport.first, self.drawn.own(velocity));
        let by_q = line_times(&self.transport.by_q(&extent), self.drawn.own(c.q));
        first * (2.0 * extent.ratio * extent.rate * scale) + by_q
    }

    /// Adds the inertia of what passes through the mesh, beyond that of the mesh's own acceleration; over a step less
    /// `lambda' M v`, which the momentum of the mesh changes by as its mass grows.
    pub fn add_transport(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]) {
        let extent = self.extent(c.drives);
        let (velocity, scale) = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity, .. } => (*velocity, 1.0),
            Passage::Step(step) => (step.increment, 1.0 / step.duration),
        };
        self.drawn.add(&self.passing_inertia(c, velocity, scale), forces);
        if matches!(passage, Passage::Step(_)) {
            self.drawn.add_mass_times(-extent.ratio * extent.rate * scale, velocity, forces);
        }
    }

    /// Adds `scale` times the derivative of [`Self::add_transport`]; over a step twice that by the coordinates at its
    /// end.
    pub fn add_transport_tangent(&self, c: &BeamConfiguration, passage: &Passage, scale: f64, block: &mut [f64]) {
        let extent = self.extent(c.drives);
        let by_velocity = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity_by_q, .. } => *velocity_by_q,
            Passage::Step(step) => 2.0 / step.duration,
        };
        let (by_q, gyroscopic) = (self.transport.by_q(&extent), 2.0 * extent.ratio * extent.rate * by_velocity);
        for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
            for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
                let value = scale * (by_q[a][b] + gyroscopic * self.transport.first[a][b]);
                (0..3).for_each(|axis| block[(column + axis) * ELEMENT + row + axis] += value);
            }
        }
        if matches!(passage, Passage::Step(_)) {
            self.drawn.add_mass(-scale * extent.ratio * extent.rate * by_velocity, block);
        }
    }

    /// Kinetic energy that the velocity of the material has beyond that of the mesh, J.
    pub fn transport_energy(&self, c: &BeamConfiguration, velocity: &[f64]) -> f64 {
        let Extent { ratio, rate, .. } = self.extent(c.drives);
        let linear = self.line_form(velocity, &self.transport.first, c.q);
        let square = self.line_form(c.q, &self.transport.square, c.q);
        ratio * rate * (linear + 0.5 * rate * square)
    }

    /// Power of `load`, which acts per free length, by the motion of the material past the mesh, `c r'`, in which
    /// sections turn by `c` times their curvatures, W.
    pub fn passing_power(&self, c: &BeamConfiguration, load: &LineLoad) -> f64 {
        let (Extent { ratio, rate, .. }, own) = (self.extent(c.drives), self.drawn.own(c.q));
        let power = |(xi, share): (f64, f64)| {
            let slope = interpolate(&hermite::shape_x(xi, self.drawn.length), own);
            let speed = rate * (self.distance - xi * self.drawn.length);
            let axes = self.drawn.section_pose(c, xi).axes;
            let SectionShape { curvature: [about_y, about_z], torsion, .. } = self.drawn.section_shape(c, xi);
            let [force, moment] = load.on(ratio * share, &axes);
            speed * (force.dot(&slope) + moment.dot(&(axes * Vec3::new(torsion, about_y, about_z))))
        };
        self.drawn.load_points().into_iter().map(power).sum()
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m²/s) that the material has beyond those of
    /// the mesh.
    pub fn transport_momentum(&self, c: &BeamConfiguration) -> [Vec3; 2] {
        let (Extent { ratio, rate, .. }, own) = (self.extent(c.drives), self.drawn.own(c.q));
        let (mut linear, mut angular) = (Vec3::zeros(), Vec3::zeros());
        for (a, (row, products)) in SHAPE_PLACES.into_iter().zip(&self.transport.first).enumerate() {
            for (column, product) in SHAPE_PLACES.into_iter().zip(products) {
                let (place, moved) = (vec3(own, row), vec3(own, column) * (ratio * rate * product));
                angular += place.cross(&moved);
                // The shape functions of the positions add up to 1.
                linear += if a % 2 == 0 { moved } else { Vec3::zeros() };
            }
        }
        [linear, angular]
    }
}

/// `matrix`, that of a line, times the coordinates `own` of an element.
fn line_times(matrix: &[[f64; 4]; 4], own: &[f64]) -> ElementVector {
    matrix.iter().zip(SHAPE_PLACES).fold(ElementVector::zeros(), |mut sum, (products, row)| {
        sum.fixed_rows_mut::<3>(row).copy_from(&interpolate(products, own));
        sum
    })
}
