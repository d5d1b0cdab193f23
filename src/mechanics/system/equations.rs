//! The equations of a system: forces, tangent, mass and constraints, summed over its parts in file order.

use crate::math::blocks::{Block, Blocks};
use crate::mechanics::beam::configuration::Purpose;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::constraint::joint::{Joint, JointGradient, MOST_CONDITIONS};
use crate::mechanics::force::load::{Load, Site};
use crate::mechanics::geometry::marker_jacobian::MarkerMatrix;
use crate::mechanics::input::excitation::{Excitation, Wrench};
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::system::System;
use crate::mechanics::system::tangent_layout::TangentLayout;
use nalgebra::SMatrix;

impl System {
    /// Appends the blocks of the tangent in the order of `TangentLayout`.
    pub fn push_tangent_blocks(&self, blocks: &mut Blocks) {
        let mut push = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
            blocks.push(Block { row: rows.start, column: columns.start, rows: rows.len(), columns: columns.len() });
        };
        for element in &self.mesh.elements {
            push(element.coordinates(), element.coordinates());
        }
        for body in &self.bodies {
            let range = body.start..body.start + BODY;
            push(range.clone(), range);
        }
        for load in &self.loads {
            if let Site::Point(marker) = &load.site {
                let range = marker.coordinates(&self.mesh);
                push(range.clone(), range);
            }
        }
        let springs = self.springs.iter().map(|spring| spring.coordinate);
        for coordinate in springs.chain(self.actuators.iter().map(|actuator| actuator.coordinate)) {
            let sides = self.sides(coordinate);
            for number in 0..4 {
                push(sides[number / 2].coordinates(&self.mesh), sides[number % 2].coordinates(&self.mesh));
            }
        }
        for (body, element) in self.contact_pairs() {
            let (body, element) = (body..body + BODY, self.mesh.elements[element].coordinates());
            push(element.clone(), body.clone());
            push(body, element);
        }
        self.push_beam_contact_blocks(blocks);
        self.push_rope_blocks(blocks);
        self.push_reading_blocks(blocks);
    }

    /// The two sides of a relative coordinate.
    pub fn sides(&self, coordinate: usize) -> [&Marker; 2] {
        [&self.relative_coordinates[coordinate].a, &self.relative_coordinates[coordinate].b]
    }

    /// `∂U/∂q − F`: internal minus external forces, as `passage` says.
    pub fn forces(&self, c: &Configuration, passage: &Passage, excitation: &Excitation, forces: &mut [f64]) {
        self.add_external(c, passage, excitation, forces);
        let of_beams = passage.of_beams();
        for element in &self.mesh.elements {
            element.add_gradient(&c.beams, &of_beams, forces);
        }
        self.add_rotary_forces(c, passage, forces);
        self.add_mass_damping(c, passage, forces);
        if let Passage::Instant { velocity, strain_rates, .. } = passage {
            self.add_material_damping(c, velocity, *strain_rates, forces);
        }
        self.add_springs(c, passage, forces);
        self.add_contact_forces(c, passage, forces);
        self.add_foundation_forces(c, passage, 1.0, forces);
        self.add_rope_forces(c, passage, 1.0, forces);
        self.add_fluid(c, passage, excitation, 1.0, forces);
    }

    /// [`Self::forces`], and sets the first blocks of `tangent` to `scale` times their derivative by `q` (over a step:
    /// twice the derivative by the coordinates at its end). The part of material damping at an instant is exact if
    /// `passage` asks for it.
    pub fn forces_and_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        self.add_external(c, passage, excitation, forces);
        let layout = TangentLayout::of(self);
        self.add_beams_and_set_tangent(c, passage, scale, forces, tangent);
        self.add_rotary_forces(c, passage, forces);
        self.add_rotary_tangent(c, passage, scale, tangent);
        self.add_mass_damping(c, passage, forces);
        self.add_mass_damping_tangent(c, passage, scale, tangent);
        if let Passage::Instant { velocity, velocity_by_q, purpose: Purpose::Derivatives, .. } = passage {
            self.add_material_damping_and_tangent(c, velocity, [scale, scale * velocity_by_q], forces, tangent);
        }
        for number in 0..self.bodies.len() {
            tangent.block_mut(layout.body(number)).fill(0.0);
        }
        self.set_load_tangent(c, excitation, scale, tangent);
        self.add_springs(c, passage, forces);
        self.set_spring_tangent(c, passage, scale, tangent);
        self.set_effort_tangent(c, passage, excitation, scale, tangent);
        self.add_contacts_and_set_tangent(c, passage, scale, forces, tangent);
        self.add_beam_contacts_and_set_tangent(c, passage, scale, forces, tangent);
        self.add_foundations_and_tangent(c, passage, scale, forces, tangent);
        self.add_ropes_and_set_tangent(c, passage, scale, forces, tangent);
        self.add_fluid_and_tangent(c, passage, excitation, scale, forces, tangent);
    }

    // Each on its own: as parts of one function the matrices of beams, loads and springs would stand on the stack
    // side by side.

    #[inline(never)]
    fn add_beams_and_set_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        let (layout, of_beams) = (TangentLayout::of(self), passage.of_beams());
        for (number, element) in self.mesh.elements.iter().enumerate() {
            let block = tangent.block_mut(layout.element(number));
            match passage {
                Passage::Instant { velocity, velocity_by_q, purpose: Purpose::Iteration, .. }
                    if element.is_damped() =>
                {
                    let motion = (*velocity, *velocity_by_q);
                    element.add_damped_gradient_and_set_hessian(&c.beams, motion, scale, forces, block);
                }
                _ => element.add_gradient_and_set_hessian(&c.beams, &of_beams, scale, forces, block),
            }
        }
    }

    #[inline(never)]
    fn set_load_tangent(&self, c: &Configuration, excitation: &Excitation, scale: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        let mut points = layout.load_points();
        for (load, (wrench, station)) in self.loads.iter().zip(excitation.loads()) {
            let is_constant = load.is_constant(wrench);
            match &load.site {
                Site::Point(marker) => {
                    let block = tangent.block_mut(points.next().expect("a load on a marker has a block"));
                    if is_constant {
                        block.fill(0.0);
                    } else {
                        let count = marker.coordinates(&self.mesh).len();
                        copy_corner(block, count, &load.point_force_q(marker, c, wrench), -scale);
                    }
                }
                Site::Line(elements) if !is_constant => {
                    let line = load.along(wrench);
                    for number in elements.clone() {
                        let block = tangent.block_mut(layout.element(number));
                        self.mesh.elements[number].add_line_stiffness(&c.beams, &line, -scale, block);
                    }
                }
                Site::Moving(track) if !is_constant => {
                    let marker = track.marker(station);
                    let Marker::Section { element, .. } = marker else { unreachable!("tracks are made of sections") };
                    self.add_moving_load_tangent(
                        load,
                        (&marker, wrench),
                        c,
                        -scale,
                        tangent.block_mut(layout.element(element)),
                    );
                }
                Site::Line(_) | Site::Moving(_) => {}
            }
        }
    }

    #[inline(never)]
    fn add_moving_load_tangent(
        &self,
        load: &Load,
        (marker, wrench): (&Marker, &Wrench),
        c: &Configuration,
        factor: f64,
        block: &mut [f64],
    ) {
        let count = marker.coordinates(&self.mesh).len();
        add_corner(block, count, &load.point_force_q(marker, c, wrench), factor);
    }

    #[inline(never)]
    fn set_spring_tangent(&self, c: &Configuration, passage: &Passage, scale: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        for (number, spring) in self.springs.iter().enumerate() {
            let blocks = layout.spring(number);
            // Every coordinate of a joint has a spring, most of them do nothing.
            if spring.is_idle() {
                blocks.for_each(|block| tangent.block_mut(block).fill(0.0));
                continue;
            }
            let counts = self.sides(spring.coordinate).map(|marker| marker.coordinates(&self.mesh).len());
            let mut parts = [MarkerMatrix::zeros(); 4];
            spring.set_hessian(&self.relative_coordinates[spring.coordinate], c, passage, &mut parts);
            for (pair, (block, part)) in blocks.zip(&parts).enumerate() {
                copy_corner(tangent.block_mut(block), counts[pair / 2], part, scale);
            }
        }
    }

    #[inline(never)]
    pub(super) fn add_springs(&self, c: &Configuration, passage: &Passage, forces: &mut [f64]) {
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let parts = spring.gradient(&self.relative_coordinates[spring.coordinate], c, passage);
            for (marker, part) in self.sides(spring.coordinate).into_iter().zip(&parts) {
                let range = marker.coordinates(&self.mesh);
                add(forces, range.start, &part.as_slice()[..range.len()]);
            }
        }
    }

    /// Sets `forces` to minus the external forces.
    pub(super) fn add_external(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        forces: &mut [f64],
    ) {
        forces.fill(0.0);
        for element in &self.mesh.elements {
            element.add_weight(&excitation.gravity, -element.extent(c.beams.drives), forces);
        }
        for body in &self.bodies {
            add(forces, body.start, (excitation.gravity * -body.mass).as_slice());
        }
        for (load, given) in self.loads.iter().zip(excitation.loads()) {
            load.each_force(c, given, |range, own| {
                forces[range].iter_mut().zip(own).for_each(|(sum, own)| *sum -= own);
            });
        }
        self.subtract_efforts(c, passage, excitation, forces);
    }

    /// Constraint conditions `g(q)`, zero when the joints hold; m or 1.
    pub fn constraint_conditions(&self, c: &Configuration, g: &mut [f64]) {
        self.set_conditions(g, |joint, own| joint.phi(c, own));
    }

    /// Sets `conditions` by what `set` gives for each joint; those that share them add to them.
    fn set_conditions(&self, conditions: &mut [f64], set: impl Fn(&Joint, &mut [f64])) {
        for (joint, rows) in self.joints_with_rows() {
            if joint.shares_conditions() {
                let mut own = [0.0; MOST_CONDITIONS];
                set(joint, &mut own[..rows.len()]);
                conditions[rows].iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            } else {
                set(joint, &mut conditions[rows]);
            }
        }
    }

    /// `∂g/∂t` at fixed coordinates, of drives and moving frames; m/s or 1/s.
    pub fn constraint_rates(&self, c: &Configuration, g_t: &mut [f64]) {
        self.set_conditions(g_t, |joint, own| joint.phi_t(c, own));
    }

    /// `g''` without the part of the accelerations; m/s² or 1/s².
    pub fn constraint_accelerations(&self, c: &Configuration, velocity: &[f64], g_tt: &mut [f64]) {
        self.set_conditions(g_tt, |joint, own| joint.phi_tt(c, velocity, own));
    }

    /// `∂g/∂q`, a pair of blocks a joint.
    pub fn constraint_gradients(&self, c: &Configuration, gradients: &mut Vec<JointGradient>) {
        gradients.resize(self.joints.len(), JointGradient::default());
        for (joint, gradient) in self.joints.iter().zip(gradients) {
            joint.phi_q(c, gradient);
        }
    }

    /// `rates += ∂g/∂q · velocity`.
    pub fn add_constraint_rates(&self, gradients: &[JointGradient], velocity: &[f64], rates: &mut [f64]) {
        for ((joint, rows), gradient) in self.joints_with_rows().zip(gradients) {
            self.add_joint_rates(joint, gradient, velocity, &mut rates[rows]);
        }
    }

    /// [`Self::add_constraint_rates`] of one joint, into its own `rates`.
    pub(super) fn add_joint_rates(&self, joint: &Joint, gradient: &JointGradient, velocity: &[f64], rates: &mut [f64]) {
        for (marker, block) in [(&joint.a, &gradient.a), (&joint.b, &gradient.b)] {
            let velocity = &velocity[marker.coordinates(&self.mesh)];
            for (velocity, column) in velocity.iter().zip(columns(block)) {
                rates.iter_mut().zip(column).for_each(|(rate, value)| *rate += value * velocity);
            }
        }
    }

    /// `forces += factor · (∂g/∂q)ᵀ multipliers`.
    pub fn add_constraint_forces(
        &self,
        gradients: &[JointGradient],
        multipliers: &[f64],
        factor: f64,
        forces: &mut [f64],
    ) {
        for ((joint, rows), gradient) in self.joints_with_rows().zip(gradients) {
            let own = &multipliers[rows];
            for (marker, block) in [(&joint.a, &gradient.a), (&joint.b, &gradient.b)] {
                let forces = &mut forces[marker.coordinates(&self.mesh)];
                for (force, column) in forces.iter_mut().zip(columns(block)) {
                    own.iter().zip(column).for_each(|(multiplier, value)| *force += factor * value * multiplier);
                }
            }
        }
    }
}

/// The columns of a matrix.
fn columns<const ROWS: usize, const COLUMNS: usize>(
    matrix: &SMatrix<f64, ROWS, COLUMNS>,
) -> std::slice::ChunksExact<'_, f64> {
    matrix.as_slice().chunks_exact(ROWS)
}

/// `target[start..] += values`.
pub(super) fn add(target: &mut [f64], start: usize, values: &[f64]) {
    for (target, value) in target[start..start + values.len()].iter_mut().zip(values) {
        *target += value;
    }
}

/// Adds `factor` times the upper left corner of `matrix` to a column-major block of `rows` rows.
pub(super) fn add_corner<const ROWS: usize, const COLUMNS: usize>(
    block: &mut [f64],
    rows: usize,
    matrix: &SMatrix<f64, ROWS, COLUMNS>,
    factor: f64,
) {
    for (target, source) in block.chunks_exact_mut(rows.max(1)).zip(columns(matrix)) {
        target.iter_mut().zip(source).for_each(|(target, value)| *target += factor * value);
    }
}

/// Fills a column-major block of `rows` rows with `factor` times the upper left corner of `matrix`.
pub fn copy_corner<const ROWS: usize, const COLUMNS: usize>(
    block: &mut [f64],
    rows: usize,
    matrix: &SMatrix<f64, ROWS, COLUMNS>,
    factor: f64,
) {
    for (target, source) in block.chunks_exact_mut(rows.max(1)).zip(columns(matrix)) {
        target.iter_mut().zip(source).for_each(|(target, value)| *target = factor * value);
    }
}

/// Fills a column-major block of `rows` rows with `factor` times the transpose of the upper left corner of `matrix`.
pub fn copy_transposed<const ROWS: usize, const COLUMNS: usize>(
    block: &mut [f64],
    rows: usize,
    matrix: &SMatrix<f64, ROWS, COLUMNS>,
    factor: f64,
) {
    for (number, target) in block.chunks_exact_mut(rows.max(1)).enumerate() {
        let row = columns(matrix).map(|column| column[number]);
        target.iter_mut().zip(row).for_each(|(target, value)| *target = factor * value);
    }
}
