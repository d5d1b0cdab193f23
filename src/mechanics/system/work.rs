//! Work and power of what acts from outside: gravity, loads, drives, moving frames, dampers. What the energy of the
//! system may change by.

use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::mechanics::beam::node::Node;
use crate::mechanics::constraint::joint::{Joint, JointGradient, MOST_CONDITIONS};
use crate::mechanics::force::actuator;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::state::energy_balance::{Energies, LIFT_ROUND_OFF};
use crate::mechanics::system::System;
use crate::mechanics::system::step_starts::StepStarts;

/// What a step does to the energies.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepEnergy {
    /// Elastic energy at its end, J.
    pub elastic: f64,
    /// Work of what acts from outside but for constraints, J.
    pub work: f64,
    /// The part of it that moving frames do through springs, J.
    pub by_frames: f64,
    /// The part of it that heat does through beams, J.
    pub by_heat: f64,
    /// The part of it that winches and drums of ropes give, but for the velocity of what they pay out, J.
    pub by_winches: f64,
    /// The part of it that dampers take, J.
    pub dissipated: f64,
    /// The part of it that fluids do, J.
    pub by_fluids: f64,
}

impl System {
    /// Kinetic energy with the velocities `velocity`, and elastic energy at `c`, J.
    pub fn energies(&self, c: &Configuration, velocity: &[f64]) -> Energies {
        Energies { kinetic: self.kinetic_energy(c, velocity), elastic: self.elastic_energy(c) }
    }

    /// Kinetic, elastic and gravity energy at `c` with the velocities `velocity`, J.
    pub fn whole_energy(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        let Energies { kinetic, elastic } = self.energies(c, velocity);
        kinetic + elastic + self.gravity_energy(c)
    }

    /// Energy that is round-off of the weight, J.
    pub fn energy_noise(&self) -> f64 {
        LIFT_ROUND_OFF * self.mass * self.gravity.norm() * self.size
    }

    /// Sets the mass of everything and of each beam: the work of a unit acceleration along x.
    pub fn set_masses(&mut self) {
        let unit = Vec3::x();
        let mut forces = vec![0.0; self.coordinates()];
        self.mesh.elements.iter().for_each(|element| element.add_weight(&unit, 1.0, &mut forces));
        let of_nodes = |nodes: &[Node]| nodes.iter().map(|node| forces[node.coordinates().start]).sum::<f64>();
        self.beam_masses = self.beams.iter().map(|beam| of_nodes(&self.mesh.nodes[beam.node_range()])).collect();
        self.mass = self.bodies.iter().fold(of_nodes(&self.mesh.nodes), |sum, body| sum + body.mass);
    }

    /// [`System::forces`] over a step, and `strain_rates` set to the rates over it. Returns what the step does to the
    /// energies, as it takes its forces.
    pub fn finish_step(
        &self,
        c: &Configuration,
        step: &TimeStep,
        excitation: &Excitation,
        forces: &mut [f64],
        strain_rates: &mut [f64],
    ) -> StepEnergy {
        let passage = Passage::Step(*step);
        self.add_external(c, &passage, excitation, forces);
        let mut found = StepEnergy { work: -dot(forces, step.increment), ..StepEnergy::default() };
        let of_beams = step.of_beams();
        // Not part of the work: the energies of that account have no weight in them, and what loads do to material that
        // passes, the winch takes.
        found.by_winches = self.lifted_by_winches(c, step, &excitation.gravity)
            - step.duration * self.passing_power_of_loads(c, excitation);
        for element in &self.mesh.elements {
            let [energy, taken, given] = element.finish_step(&c.beams, &of_beams, forces, strain_rates);
            found.elastic += energy;
            found.work += given - taken;
            *(if element.paid_out().is_some() { &mut found.by_winches } else { &mut found.by_heat }) += given;
            found.dissipated += taken;
        }
        self.add_rotary_forces(c, &passage, forces);
        self.add_mass_damping(c, &passage, forces);
        let taken = self.taken_by_mass_damping(c, step.increment, step.duration);
        found.work -= taken;
        found.dissipated += taken;
        self.add_springs(c, &passage, forces);
        for spring in &self.springs {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            found.elastic += spring.energy(coordinate, step.end);
            strain_rates[self.mesh.relative_rate_index(spring.coordinate)] = spring.step_rate(coordinate, step);
            let [given, taken] = spring.step_work(coordinate, c, step);
            found.work += given - taken;
            found.by_frames += given;
            found.dissipated += taken;
        }
        let contacts = self.finish_contacts(c, step, forces);
        found.elastic += contacts.elastic;
        found.work += contacts.by_frames - contacts.dissipated;
        found.by_frames += contacts.by_frames;
        found.dissipated += contacts.dissipated;
        let [elastic, taken] = self.finish_foundations(c, step, forces);
        found.elastic += elastic;
        found.work -= taken;
        found.dissipated += taken;
        let ropes = self.finish_ropes(c, step, forces);
        found.elastic += ropes.elastic;
        found.work += ropes.by_frames + ropes.by_drums - ropes.dissipated;
        found.by_winches += ropes.by_drums;
        found.by_frames += ropes.by_frames;
        found.dissipated += ropes.dissipated;
        if self.is_in_fluid() {
            found.by_fluids = self.add_fluid_with_work(c, &passage, excitation, step.increment, forces);
            found.work += found.by_fluids;
        }
        found
    }

    /// Work of loads and of actuators as the system passes through `c` while the coordinates change by `change`, J;
    /// their power for velocities, W.
    pub fn loads_and_actuators(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        change: &[f64],
    ) -> [f64; 2] {
        let duration = if let Passage::Step(step) = passage { step.duration } else { 1.0 };
        let (mut of_loads, mut of_actuators) = (duration * self.passing_power_of_loads(c, excitation), 0.0);
        for (load, given) in self.loads.iter().zip(excitation.loads()) {
            load.each_force(c, given, |range, own| of_loads += dot(own, &change[range]));
        }
        for (actuator, effort) in self.efforts(c, passage, excitation) {
            let parts = actuator::force(&self.relative_coordinates[actuator.coordinate], c, effort);
            for (marker, part) in self.sides(actuator.coordinate).into_iter().zip(&parts) {
                of_actuators += dot(part.as_slice(), &change[marker.coordinates(&self.mesh)]);
            }
        }
        [of_loads, of_actuators]
    }

    /// Power of moving frames through springs at the instant `c`, W.
    pub fn power_of_frames(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        let power = |spring: &Spring| spring.power(&self.relative_coordinates[spring.coordinate], c, velocity)[0];
        self.springs.iter().map(power).sum()
    }

    /// Sets what a step from `c` with the velocities `velocity` starts with: `starts` of elements, and `strain_rates`
    /// to the rates there of all strains, and of the relative coordinates of springs; none: they are known. `middle`
    /// has the values of the drives in the middle of the step.
    pub fn begin_step(
        &self,
        c: &Configuration,
        middle: &[Jet],
        velocity: &[f64],
        starts: &mut StepStarts,
        mut strain_rates: Option<&mut [f64]>,
    ) {
        starts.list.resize_with(self.mesh.branches, Default::default);
        for element in &self.mesh.elements {
            element.begin_step(&c.beams, middle, velocity, &mut starts.list, strain_rates.as_deref_mut());
        }
        let Some(strain_rates) = strain_rates else { return };
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let rate = self.relative_coordinates[spring.coordinate].rate(c, velocity);
            strain_rates[self.mesh.relative_rate_index(spring.coordinate)] = rate;
        }
    }

    /// [`Self::energies`] at the instant `c` with the velocities `velocity`, J, and power there, W: of what acts from
    /// outside but for constraints and dampers, and of dampers, which take it; `forces` is scratch memory.
    pub fn energies_and_power(
        &self,
        c: &Configuration,
        velocity: &[f64],
        excitation: &Excitation,
        forces: &mut [f64],
    ) -> (Energies, [f64; 2]) {
        self.add_external(c, &Passage::with_velocity(velocity), excitation, forces);
        let external = -dot(forces, velocity);
        let of_beams = self.mesh.elements.iter().map(|element| element.energy_and_viscous_power(&c.beams, velocity));
        let [beams, viscous] = of_beams.fold([0.0; 2], |[energy, power], own| [energy + own[0], power + own[1]]);
        let springs =
            self.springs.iter().map(|spring| spring.power(&self.relative_coordinates[spring.coordinate], c, velocity));
        let power = springs
            .fold([external, viscous + self.power_of_mass_damping(c, velocity)], |[given, taken], own| {
                [given + own[0], taken + own[1]]
            });
        let elastic = self.with_stored_energy(beams, c);
        (Energies { kinetic: self.kinetic_energy(c, velocity), elastic }, power)
    }

    /// Work of drives and of joints to moving frames while the coordinates change by `change`, J; their power for
    /// velocities, W. All other constraints do none.
    pub fn driven_work(&self, gradients: &[JointGradient], multipliers: &[f64], change: &[f64]) -> f64 {
        let mut work = 0.0;
        let mut joints = self.joints_with_rows().zip(gradients).peekable();
        while let Some(((joint, rows), gradient)) = joints.next() {
            let mut is_work = is_driven(joint);
            let mut rates = [0.0; MOST_CONDITIONS];
            let rates = &mut rates[..joint.rows()];
            let shares = |((next, _), _): &((&Joint, _), _)| next.shares_conditions();
            if is_work || joints.peek().is_some_and(shares) {
                self.add_joint_rates(joint, gradient, change, rates);
            }
            while let Some(((joint, _), gradient)) = joints.next_if(shares) {
                self.add_joint_rates(joint, gradient, change, rates);
                is_work |= is_driven(joint);
            }
            if is_work {
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
