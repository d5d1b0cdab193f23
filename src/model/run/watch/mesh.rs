//! Whether a mesh is too coarse for what the system does: the energy that its elements leave out, and section forces
//! and moments that are off where they are read.

use crate::error::decimal;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::output::fiber_strain::{self, FiberStrain};
use crate::mechanics::output::mesh_error::{Deformation, MeshError};
use crate::mechanics::state::State;
use crate::mechanics::state::energy_balance::Energies;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::quantity::Quantity;
use crate::model::run::scale::Beams;
use crate::model::variables::Table;
use serde::{Deserialize, Serialize};

/// Energy that a mesh may leave out in dynamics, of the largest energy: under loads displacements are off by as much,
/// and 1 % is called right.
const LEFT_OUT: f64 = 0.01;
/// The same in equilibrium, where no passing wave adds to it: energies are off by up to twice the share of
/// displacements.
const LEFT_OUT_AT_REST: f64 = 0.005;
/// By how much section forces and moments may be off where they are read, of their largest value: they converge more
/// slowly than displacements.
const OFF: f64 = 0.05;
/// The same for axial forces in equilibrium: the estimate from means is of a higher order than the force that is read,
/// and no wave adds to the difference.
const AXIAL_OFF_AT_REST: f64 = 0.02;
/// Energy left out, and error of a section's force, that the mesh that is recommended should have.
const WANTED: [f64; 2] = [1e-3, 0.01];
/// Largest refinement that is recommended at a time: an estimate from a mesh that resolves nothing says little about a
/// much finer one.
const LARGEST_REFINEMENT: f64 = 8.0;

/// A force or moment is compared with this share of the largest one of its system at least: what is far smaller does
/// not matter.
const SMALL: f64 = 0.1;
/// The same for a moment, of the largest axial force times the size of the system, below which it is the round-off of
/// that force.
const ROUND_OFF: f64 = 1e-6;

/// In dynamics one communication point of so many is looked at, which makes the look cheap beside the steps,
const STRIDE: u64 = 4;
/// and so many must show it: a sudden load bends the nearest element first, until the wave is as long as some.
const SIGHTINGS: u32 = 3;
/// Looks after which a mesh that may be too coarse is judged, if the run does not end before: what elements leave out
/// of the little energy at a start does not matter once the mechanism has more.
const LASTING: u32 = 200;

/// What has been seen of the mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshWatch {
    is_static: bool,
    points: u64,
    largest_energy: f64,
    largest_moment: f64,
    largest_force: f64,
    energy: Sightings,
    energy_warned: bool,
    /// The most that elements have left out beyond the bound; none, or judged already.
    suspect: Option<Suspect>,
    /// Looks since the first error that is still to be judged.
    looks: u32,
    /// Of all quantities that are read at points, in the order of the table.
    readings: Vec<Reading>,
    reading_warned: bool,
    fibers_warned: bool,
    /// What quantities of beams amount to.
    pub beams: Beams,
    /// Strain energy of the last state that was looked at, J; not saved with the others.
    #[serde(skip)]
    pub strain_energy: f64,
    /// The largest energy that the elements left out so far, J, and the deformation that most of it was of; not saved
    /// with the others.
    #[serde(skip)]
    pub most_left_out: (f64, Option<Deformation>),
}

/// How often something was seen while its scale was about the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Sightings {
    /// The scale at the first of them.
    scale: f64,
    count: u32,
}

/// Energy that elements have left out, and is still to be judged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Suspect {
    /// J.
    energy: f64,
    time: f64,
    /// The element that leaves out most, and what of.
    element: usize,
    deformation: Deformation,
}

/// What was read of a quantity, at all of its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Reading {
    largest: f64,
    off: Sightings,
    /// The largest error beyond the bound that is still to be judged, N or N m; 0: there is none.
    worst: f64,
    /// Where it was, and when.
    sensor: usize,
    time: f64,
}

/// A force or moment at a section, N or N m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Section {
    /// The axial force, or the largest component of the moment, whichever is read: what is small compared with the
    /// others does little.
    size: f64,
    /// By how much what is read is off.
    off: f64,
}

impl Sightings {
    /// Whether `error` has been beyond `bound` of `scale` often enough. What was seen when the scale was half as large
    /// does not count: it was the beginning.
    fn add(&mut self, error: f64, scale: f64, bound: f64, enough: u32) -> bool {
        if scale > 2.0 * self.scale {
            *self = Self { scale, count: 0 };
        }
        if error > bound * scale {
            self.count = self.count.saturating_add(1);
        }
        self.count >= enough
    }
}

impl Section {
    /// What `quantity` is read from at `sensor`; none where it is no force or moment of a section of ANCF14.
    fn new(quantity: Quantity, system: &System, c: &Configuration, sensor: &Sensor) -> Option<Self> {
        let components = match quantity {
            Quantity::SectionForce | Quantity::AxialStrain => 0..0,
            Quantity::Torsion => 0..1,
            Quantity::Curvature => 1..3,
            Quantity::SectionMoment | Quantity::Stress => 0..3,
            _ => return None,
        };
        let (read, smooth) = (sensor.section_forces(c), system.smooth_forces(c, sensor)?);
        if components.is_empty() {
            // Beside a jump of the axial force there is a warning of its own.
            let beam = &system.beams[sensor.on_beam?.0];
            if sensor.places().any(|(element, _)| system.is_beside_jump(beam, element - beam.first_element)) {
                return None;
            }
            return Some(Self { size: read.axial.abs(), off: (read.axial - smooth.axial).abs() });
        }
        let largest = |sizes: &[f64]| sizes.iter().fold(0.0, |largest, size| size.abs().max(largest));
        let off: [f64; 3] = std::array::from_fn(|k| read.moment[k] - smooth.moment[k]);
        Some(Self { size: largest(&read.moment), off: largest(&off[components]) })
    }
}

impl MeshWatch {
    /// Of a run of this analysis.
    pub fn new(analysis: Analysis) -> Self {
        Self { is_static: analysis == Analysis::Static, ..Self::default() }
    }

    /// Looks at a new state and returns what the user should know of its mesh by now.
    pub fn look(&mut self, system: &System, state: &State, table: &Table, frames: &mut FrameCache) -> Vec<String> {
        let point = self.points;
        self.points = point.wrapping_add(1);
        let is_skipped = !self.is_static && !point.is_multiple_of(STRIDE);
        let has_warned = self.energy_warned && self.reading_warned;
        // An equilibrium is looked at all the same: its energy is asked for.
        if is_skipped || system.beams.is_empty() || (has_warned && self.fibers_warned && !self.is_static) {
            return Vec::new();
        }
        let c = frames.of(system, state);
        let error = system.mesh_error(&c);
        self.strain_energy = error.energy;
        let Energies { kinetic, elastic } = state.balance.last.unwrap_or(Energies { kinetic: 0.0, elastic: 0.0 });
        self.largest_energy = self.largest_energy.max(kinetic + elastic.max(error.energy));
        if error.left_out > self.most_left_out.0 {
            self.most_left_out = (error.left_out, error.worst.as_ref().map(|worst| worst.deformation));
        }
        self.beams.of_unit_strain = error.of_unit_strain;
        self.beams.relieved.include(&error.relieved);
        self.largest_moment = self.largest_moment.max(error.largest_moment);
        self.largest_force = self.largest_force.max(error.largest_force);
        let fibers = self.fibers(system, state, &error.fibers);
        if has_warned || error.energy <= error.round_off {
            return fibers.into_iter().collect();
        }
        self.see_energy(state, &error);
        self.see_readings(system, state, table, &c);
        if self.suspect.is_some() || self.readings.iter().any(|reading| reading.worst > 0.0) {
            self.looks += 1;
        }
        let judged = if self.looks >= LASTING { self.judge(system, table) } else { Vec::new() };
        judged.into_iter().chain(fibers).collect()
    }

    /// Judges what has been seen by what the run has come to, and returns what the user should know of its mesh.
    pub fn judge(&mut self, system: &System, table: &Table) -> Vec<String> {
        self.looks = 0;
        let energy = self.judge_energy(system);
        energy.into_iter().chain(self.judge_readings(system, table)).collect()
    }

    /// How often something must be seen.
    fn enough(&self) -> u32 {
        if self.is_static { 1 } else { SIGHTINGS }
    }

    /// Warns of fibers that strain so far that the law of large strain departs from the rigidities of the section.
    fn fibers(&mut self, system: &System, state: &State, fibers: &FiberStrain) -> Option<String> {
        if self.fibers_warned || fibers.largest() < fiber_strain::NOTABLE {
            return None;
        }
        self.fibers_warned = true;
        let [bending, axial] = fibers.departure().map(|share| 100.0 * share);
        Some(format!(
            "fibers of beam {} strain by about {:.0} % at t = {} s: the law of strain = \"large\", Green's strain times Young's modulus, makes bending moments differ by about {bending:.1} % from EI \
             times the curvature, 1.25 times the square of the bending strain, and axial forces by about {axial:.1} % from EA times the elongation; if these should stay in proportion, take strain = \"small\" \
             for the beam, or a section of shape = \"rigidities\"",
            system.beam_of(fibers.element).0.name,
            100.0 * fibers.largest(),
            decimal(state.instant()),
        ))
    }

    /// The share of [`Self::most_energy`] that the elements may leave out.
    fn bound_of_energy(&self) -> f64 {
        if self.is_static { LEFT_OUT_AT_REST } else { LEFT_OUT }
    }

    /// The largest energy so far, J, or what beams have relieved that have none.
    fn most_energy(&self) -> f64 {
        self.largest_energy.max(self.beams.relieved.of("J"))
    }

    /// Keeps energy that the elements leave out.
    fn see_energy(&mut self, state: &State, error: &MeshError) {
        let (enough, bound, most) = (self.enough(), self.bound_of_energy(), self.most_energy());
        let Some(worst) = error.worst.as_ref().filter(|_| !self.energy_warned) else { return };
        let is_beyond = self.energy.add(error.left_out, most, bound, enough);
        if is_beyond && self.suspect.is_none_or(|suspect| suspect.energy < error.left_out) {
            let (element, deformation) = (worst.element, worst.deformation);
            self.suspect = Some(Suspect { energy: error.left_out, time: state.instant(), element, deformation });
        }
    }

    /// Warns of energy that the elements leave out.
    fn judge_energy(&mut self, system: &System) -> Option<String> {
        let Suspect { energy, time, element, deformation } = self.suspect.take()?;
        let share = energy / self.most_energy();
        self.energy_warned = share > self.bound_of_energy();
        if !self.energy_warned {
            return None;
        }
        let (beam, number) = system.beam_of(element);
        let [begin, end] = System::ends_of(beam, number);
        let (word, order, remedy) = match deformation {
            Deformation::Bending => ("bending", 4, ""),
            Deformation::Torsion => ("torsion", 2, ", or twist = \"quadratic\""),
            Deformation::Stretching => ("stretching", 4, ""),
        };
        Some(format!(
            "the mesh is too coarse: at t = {} s its elements miss about {:.1} % of the largest energy, most of it {word} of beam {} between {begin:.2} and \
             {end:.2} of its length; results are off by up to about as much, and by far more where the mechanism buckles; take elements = {} or more for this \
             beam{remedy}",
            decimal(time),
            100.0 * share,
            beam.name,
            refined(beam.elements(), share / WANTED[0], order)
        ))
    }

    /// What a quantity is compared with at least, N or N m, and the share of it, or of its largest value, by which it
    /// may be off.
    fn measure_of(&self, quantity: Quantity, system: &System) -> (f64, f64) {
        let (moment, force, relieved) = (self.largest_moment, self.largest_force, &self.beams.relieved);
        let is_force = matches!(quantity, Quantity::SectionForce | Quantity::AxialStrain);
        let least = match is_force {
            true => (SMALL * force.max(moment / system.size)).max(relieved.of("N")),
            false => (SMALL * moment).max(ROUND_OFF * force * system.size).max(relieved.of("N.m")),
        };
        (least, if is_force && self.is_static { AXIAL_OFF_AT_REST } else { OFF })
    }

    /// Keeps errors of quantities where they are read.
    fn see_readings(&mut self, system: &System, state: &State, table: &Table, c: &Configuration) {
        if self.reading_warned {
            return;
        }
        let enough = self.enough();
        for (place, (quantity, sensors)) in table.points().enumerate() {
            if place == self.readings.len() {
                self.readings.push(Reading::default());
            }
            let (least, bound) = self.measure_of(quantity, system);
            let reading = &mut self.readings[place];
            let mut worst = (0.0, None);
            for sensor in sensors {
                let Some(section) = Section::new(quantity, system, c, &system.sensors[sensor]) else { continue };
                reading.largest = reading.largest.max(section.size);
                if section.off > worst.0 {
                    worst = (section.off, Some(sensor));
                }
            }
            let scale = reading.largest.max(least);
            if let (error, Some(sensor)) = worst
                && reading.off.add(error, scale, bound, enough)
                && error > (bound * scale).max(reading.worst)
            {
                (reading.worst, reading.sensor, reading.time) = (error, sensor, state.instant());
            }
        }
    }

    /// Warns of a quantity that is off where it is read.
    fn judge_readings(&mut self, system: &System, table: &Table) -> Option<String> {
        let mut found = None;
        for (place, (quantity, _)) in table.points().enumerate().take(self.readings.len()) {
            let (least, bound) = self.measure_of(quantity, system);
            let Reading { largest, worst, sensor, time, .. } = self.readings[place];
            self.readings[place].worst = 0.0;
            let share = worst / largest.max(least);
            if worst > 0.0 && share > bound {
                found = found.or_else(|| off_at(quantity, system, &system.sensors[sensor], time, share));
            }
        }
        self.reading_warned |= found.is_some();
        found
    }
}

/// Warns of `quantity`, which was off by `off` of its largest value at `sensor` at `time`, s.
fn off_at(quantity: Quantity, system: &System, sensor: &Sensor, time: f64, off: f64) -> Option<String> {
    let (beam, fraction) = sensor.on_beam?;
    let beam = &system.beams[beam];
    Some(format!(
        "the mesh is too coarse for the {} at {}@{}: at t = {} s it is off by about {:.0} % of its largest value, judged by the elements around it; \
         take elements = {} or more for this beam",
        quantity.row().word,
        beam.name,
        decimal(fraction),
        decimal(time),
        100.0 * off,
        refined(beam.elements(), off / WANTED[1], 2)
    ))
}

/// The number of elements that takes an error which is `excess` times too large away, where it falls with this order.
fn refined(elements: usize, excess: f64, order: i32) -> usize {
    let factor = excess.powf(1.0 / f64::from(order)).clamp(2.0, LARGEST_REFINEMENT);
    (factor * elements as f64).ceil() as usize
}
