//! Whether a mesh is too coarse for what the system does, by the energy that its elements leave out.

use crate::error::decimal;
use crate::math::elementary::pow;
use crate::mechanics::output::fiber_strain::{self, FiberStrain};
use crate::mechanics::output::mesh_error::{Deformation, MeshError};
use crate::mechanics::state::State;
use crate::mechanics::state::energy_balance::Energies;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::scale::Beams;
use serde::{Deserialize, Serialize};

/// Energy that a mesh may leave out in dynamics, of the largest energy: under loads displacements are off by as much,
/// and 1 % is called right.
const LEFT_OUT: f64 = 0.01;
/// The same in equilibrium, where no passing wave adds to it: energies are off by up to twice the share of
/// displacements.
const LEFT_OUT_AT_REST: f64 = 0.005;
/// Energy left out that the mesh that is recommended should have.
const WANTED: f64 = 1e-3;
/// Largest refinement that is recommended at a time: an estimate from a mesh that resolves nothing says little about a
/// much finer one.
const LARGEST_REFINEMENT: f64 = 8.0;

/// In dynamics one communication point of so many is looked at, which makes the look cheap beside the steps,
const STRIDE: u64 = 4;
/// and so many must show it: a sudden load bends the nearest element first, until the wave is as long as some.
const SIGHTINGS: u32 = 3;
/// Looks after which a mesh that may be too coarse is judged, if the run does not end before: what elements leave out
/// of the little energy at a start does not matter once the mechanism has more.
const LASTING: u32 = 200;
/// Departures of the law of large strain from rigidities that are told, in percent: less says nothing.
const TOLD: f64 = 0.1;

/// What has been seen of the mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeshWatch {
    is_static: bool,
    points: u64,
    largest_energy: f64,
    energy: Sightings,
    energy_warned: bool,
    /// The most that elements have left out beyond the bound; none, or judged already.
    suspect: Option<Suspect>,
    /// Looks since the first error that is still to be judged.
    looks: u32,
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

impl MeshWatch {
    /// Of a run of this analysis.
    pub fn new(analysis: Analysis) -> Self {
        Self { is_static: analysis == Analysis::Static, ..Self::default() }
    }

    /// Warns of no mesh that is too coarse: a comparison judges it.
    pub fn trust(&mut self) {
        self.energy_warned = true;
    }

    /// Whether a mesh that is too coarse was warned of.
    pub fn has_warned(&self) -> bool {
        self.energy_warned
    }

    /// Looks at a new state and returns what the user should know of its mesh by now.
    pub fn look(&mut self, system: &System, state: &State, frames: &mut FrameCache) -> Vec<String> {
        let point = self.points;
        self.points = point.wrapping_add(1);
        let is_skipped = !self.is_static && !point.is_multiple_of(STRIDE);
        let has_warned = self.energy_warned;
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
        let fibers = self.fibers(system, state, &error.fibers);
        if has_warned || error.energy <= error.round_off {
            return fibers.into_iter().collect();
        }
        self.see_energy(state, &error);
        if self.suspect.is_some() {
            self.looks += 1;
        }
        let judged = if self.looks >= LASTING { self.judge(system) } else { None };
        judged.into_iter().chain(fibers).collect()
    }

    /// Judges the energy that elements have left out by what the run has come to, and returns what the user should know
    /// of its mesh.
    pub fn judge(&mut self, system: &System) -> Option<String> {
        self.looks = 0;
        self.judge_energy(system)
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
        let departures = [
            (bending, "bending moments", "EI times the curvature, 1.25 times the square of the bending strain"),
            (axial, "axial forces", "EA times the elongation"),
        ];
        let told = departures.iter().filter(|(departure, ..)| *departure >= TOLD);
        let told: Vec<_> =
            told.map(|(own, force, law)| format!("{force} differ by about {own:.1} % from {law}")).collect();
        Some(format!(
            "fibers of beam {} strain by about {:.0} % at t = {} s: the law of strain = \"large\", Green's strain \
             times Young's modulus, makes {}; if these should stay in proportion, take strain = \"small\" for the \
             beam, or a section of shape = \"rigidities\"",
            system.beam_of(fibers.element).0.name,
            100.0 * fibers.largest(),
            decimal(state.instant()),
            told.join(", and "),
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
            refined(beam.elements(), share / WANTED, order)
        ))
    }
}

/// The number of elements that takes an error which is `excess` times too large away, where it falls with this order.
fn refined(elements: usize, excess: f64, order: i32) -> usize {
    let factor = pow(excess, 1.0 / f64::from(order)).clamp(2.0, LARGEST_REFINEMENT);
    (factor * elements as f64).ceil() as usize
}
