//! Work and power of what acts from outside: gravity, loads, drives, moving frames, dampers. What the energy of the system may change by.

use crate::math::Vec3;
use crate::mechanics::constraint::joint::{Joint, JointGradient, MOST_CONDITIONS};
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::state::energy_balance::{Energies, LIFT_ROUND_OFF};
use crate::mechanics::system::System;
use crate::mechanics::system::step_starts::StepStarts;

impl System {
    /// Kinetic energy with the velocities `velocity`, and elastic energy at `c`, J.
    pub fn energies(&self, c: &Configuration, velocity: &[f64]) -> Energies {
        Energies { kinetic: self.kinetic_energy(velocity), elastic: self.elastic_energy(c) }
    }

    /// Energy that is round-off of the weight, J.
    pub fn energy_noise(&self) -> f64 {
        LIFT_ROUND_OFF * self.mass * self.gravity.norm() * self.size
    }

    /// Mass of everything, kg: the work of a unit acceleration along x.
    pub fn whole_mass(&self) -> f64 {
        let unit = Vec3::x();
        let mut forces = vec![0.0; self.coordinates()];
        self.mesh.elements.iter().for_each(|element| element.add_weight(&unit, 1.0, &mut forces));
        let nodes: f64 = self.mesh.nodes.iter().map(|node| forces[node.coordinates().start]).sum();
        self.bodies.iter().fold(nodes, |sum, body| sum + body.mass)
    }

    /// [`System::forces`] over a step, and `strain_rates` set to the rates over it. Returns the elastic energy at its end, J, and the work of what acts
    /// from outside but for constraints, J, as the step takes its forces.
    pub fn finish_step(
        &self,
        c: &Configuration,
        step: &TimeStep,
        excitation: &Excitation,
        forces: &mut [f64],
        strain_rates: &mut [f64],
    ) -> [f64; 2] {
        self.add_external(c, excitation, forces);
        let (mut work, mut elastic) = (-dot(forces, step.increment), 0.0);
        let of_beams = step.of_beams();
        for element in &self.mesh.elements {
            let [energy, taken] = element.finish_step(&c.beams, &of_beams, forces, strain_rates);
            elastic += energy;
            work -= taken;
        }
        let passage = Passage::Step(*step);
        self.add_springs(c, &passage, forces);
        for spring in &self.springs {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            elastic += spring.energy(coordinate, step.end);
            strain_rates[self.mesh.relative_rate_index(spring.coordinate)] = spring.step_rate(coordinate, step);
            work += spring.step_work(coordinate, c, step);
        }
        [elastic, work]
    }

    /// Sets what a step from `c` with the velocities `velocity` starts with: `starts` of elements, and `strain_rates` to the rates there of all strains, and of the
    /// relative coordinates of springs.
    pub fn begin_step(&self, c: &Configuration, velocity: &[f64], starts: &mut StepStarts, strain_rates: &mut [f64]) {
        starts.list.resize_with(self.mesh.branches, Default::default);
        self.mesh
            .elements
            .iter()
            .for_each(|element| element.begin_step(&c.beams, velocity, &mut starts.list, strain_rates));
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let rate = self.relative_coordinates[spring.coordinate].rate(c, velocity);
            strain_rates[self.mesh.relative_rate_index(spring.coordinate)] = rate;
        }
    }

    /// Power at the instant `c` with the velocities `velocity`, W: of what acts from outside but for constraints and dampers, and of dampers, which take it;
    /// `forces` is scratch memory.
    pub fn power(&self, c: &Configuration, velocity: &[f64], excitation: &Excitation, forces: &mut [f64]) -> [f64; 2] {
        self.add_external(c, excitation, forces);
        let external = -dot(forces, velocity);
        let viscous = if self.has_material_damping() {
            forces.fill(0.0);
            self.add_material_damping(c, velocity, None, forces);
            dot(forces, velocity)
        } else {
            0.0
        };
        let springs =
            self.springs.iter().map(|spring| spring.power(&self.relative_coordinates[spring.coordinate], c, velocity));
        springs.fold([external, viscous], |[given, taken], own| [given + own[0], taken + own[1]])
    }

    /// Work of drives and of joints to moving frames while the coordinates change by `change`, J; their power for velocities, W. All other
    /// constraints do none.
    pub fn driven_work(&self, gradients: &[JointGradient], multipliers: &[f64], change: &[f64]) -> f64 {
        let mut work = 0.0;
        let mut joints = self.joints_with_rows().zip(gradients).peekable();
        while let Some(((joint, rows), gradient)) = joints.next() {
            let second = joints.next_if(|((next, _), _)| next.shares_condition());
            if is_driven(joint) || second.as_ref().is_some_and(|((joint, _), _)| is_driven(joint)) {
                let mut rates = [0.0; MOST_CONDITIONS];
                let rates = &mut rates[..joint.rows()];
                self.add_joint_rates(joint, gradient, change, rates);
                if let Some(((joint, _), gradient)) = second {
                    self.add_joint_rates(joint, gradient, change, rates);
                }
                work -= dot(&multipliers[rows], rates);
            }
        }
        work
    }
}

/// Whether a joint puts energy into the system: a drive's, or one to a moving frame.
fn is_driven(joint: &Joint) -> bool {
    joint.drive.is_some() || [joint.a, joint.b].iter().any(|side| matches!(side, Marker::Frame { .. }))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
