//! Natural modes of a simulation, as plain data: what `ancf14 modes` writes.

use crate::fmi::Failure;
use crate::math::Vec3;
use crate::math::elementary::pow;
use crate::math::vectors::vec3;
use crate::mechanics::beam::Beam;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::run::accuracy::percent;
use crate::model::run::simulation::linear::{Pole, PoleKind};
use crate::model::run::simulation::{Simulation, failure};
use crate::solve::modes;
use crate::solve::modes::damping::damping_ratios;

pub use modes::Kind;

/// Distance from equilibrium (lengths over the system's size) from which on it is worth a warning.
const BALANCED: f64 = 1e-6;
/// Skew part of the stiffness, as a share, from which on it is worth a warning.
const SYMMETRIC: f64 = 1e-8;
/// Damping ratio up to which the frequency with damping, `√(1 − ζ²)` times the one without, is the same to 2 %.
const LIGHT: f64 = 0.2;
/// Share of a frequency by which shear would lower it from which on it is worth a warning.
const SHEARED: f64 = 0.02;
/// Points of a line in each element.
const POINTS: usize = 8;

/// A position that a mode moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name in the model file: `arm.node[3]` or a body's.
    pub name: String,
    /// Where it is in the state about which the system swings, global axes, m.
    pub position: [f64; 3],
}

/// How a mode moves a position, global axes, in units of the mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Displacement, m.
    pub displacement: [f64; 3],
    /// Turn, rad.
    pub turn: [f64; 3],
}

/// A natural mode. Its shape is so large that what it moves most moves by 1 m or 1 rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// How it goes on.
    pub kind: Kind,
    /// `ω²`, 1/s².
    pub eigenvalue: f64,
    /// `xᵀ M x` of the shape: the mass that swings, kg, or kg m² if it mostly turns.
    pub modal_mass: f64,
    /// Its damping ratio to first order, without dry friction; 0 of what does not swing.
    pub damping_ratio: f64,
    /// The share by which its frequency would be lower with the shear of beams, which is left out. None: the shear
    /// stiffness of a section is not known, or it does not swing.
    pub shear: Option<f64>,
    /// The error of its frequency because of the mesh, as a share; none: not known, or it does not swing.
    pub mesh_error: Option<f64>,
    /// What it moves most, in words.
    pub moves: String,
    /// The coordinates of the system, as they change.
    pub shape: Vec<f64>,
    /// Its motion at each position.
    pub motions: Vec<Motion>,
    /// Displacements of the points of the lines, m.
    pub lines: Vec<Vec<[f64; 3]>>,
}

impl Mode {
    /// Angular frequency, rad/s; 0 of what does not swing.
    pub fn angular_frequency(&self) -> f64 {
        if self.kind == Kind::Vibration { self.eigenvalue.sqrt() } else { 0.0 }
    }

    /// Rate of the growth, 1/s; 0 of what is not unstable.
    pub fn growth_rate(&self) -> f64 {
        if self.kind == Kind::Unstable { (-self.eigenvalue).sqrt() } else { 0.0 }
    }
}

/// The lowest natural modes about the state that a simulation has reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// By rising `ω²`.
    pub modes: Vec<Mode>,
    /// Nodes of all beams, then bodies.
    pub places: Vec<Place>,
    /// How many of the positions are nodes.
    pub nodes: usize,
    /// Points of all beams close enough to each other to draw, m.
    pub lines: Vec<Vec<[f64; 3]>>,
    /// How many modes the system has.
    pub freedoms: usize,
    /// What the user should know of them.
    pub warnings: Vec<String>,
}

impl Simulation {
    /// The `count` lowest natural modes about the state that is reached.
    ///
    /// # Errors
    /// The joints hold twice what is held already, or the modes are not found.
    pub fn modes(&self, count: usize) -> Result<Modes, Failure> {
        let (system, state) = (self.system(), self.state());
        let found = modes::modes(system, state, count).map_err(|error| failure(&error))?;
        let mut snapshot = FrameCache::default();
        let configuration = snapshot.of(system, state);
        let name = |beam: &Beam, node: usize| format!("{}.node[{}]", beam.name, beam.end_of(node));
        let names = system.beams.iter().flat_map(|beam| beam.node_range().map(move |node| name(beam, node)));
        let nodes = system.mesh.nodes.iter().map(|node| system.global(node.place(&state.q)));
        let mut places: Vec<Place> =
            names.zip(nodes).map(|(name, place)| Place { name, position: place.into() }).collect();
        let nodes = places.len();
        let bodies = system
            .bodies
            .iter()
            .map(|body| Place { name: body.name.clone(), position: system.global(vec3(&state.q, body.start)).into() });
        places.extend(bodies);
        let ratios = damping_ratios(system, state, &found.modes);
        let modes = found.modes.iter().zip(&ratios).map(|(mode, ratio)| {
            let extreme = system.most_moved(&configuration, &mode.shape);
            // So that what moves most moves by one.
            let shape: Vec<f64> = mode.shape.iter().map(|value| value / extreme.amount).collect();
            let motions = system.place_motions(&configuration, &shape).into_iter();
            Mode {
                kind: mode.kind,
                eigenvalue: mode.eigenvalue,
                modal_mass: extreme.amount.powi(-2),
                damping_ratio: *ratio,
                shear: shear(system, state, mode),
                mesh_error: None,
                moves: extreme.what,
                motions: motions
                    .map(|motion| Motion { displacement: motion.displacement.into(), turn: motion.turn.into() })
                    .collect(),
                lines: lines(system, &shape),
                shape,
            }
        });
        let moving = state.velocity.iter().any(|value| *value != 0.0);
        let has_preload = self.document().simulation.preload.is_some();
        let modes: Vec<Mode> = modes.collect();
        let mut warnings = warnings((system, state), &found, &ratios, moving, has_preload);
        warnings.extend(warning_of_shear(&modes));
        Ok(Modes { modes, places, nodes, lines: drawn_lines(system, &state.q), freedoms: found.freedoms, warnings })
    }
}

/// The share by which shear would lower the frequency of a mode (docs/theory/linear-systems.md).
fn shear(system: &System, state: &State, mode: &modes::Mode) -> Option<f64> {
    let form = (mode.kind == Kind::Vibration).then(|| system.shear_form(state, &mode.shape))??;
    Some(1.0 - pow(1.0 + form / mode.eigenvalue, -0.5))
}

/// Warns of the mode that shear would change most.
fn warning_of_shear(modes: &[Mode]) -> Option<String> {
    let known = modes.iter().enumerate().filter_map(|(number, mode)| Some((number + 1, mode.shear?)));
    let (number, shear) = known.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, shear)| *shear > SHEARED)?;
    Some(format!(
        "mode {number} would have a frequency about {} lower with the shear of beams, which is left out: its waves are \
         short beside the height of the section. Take the frequencies less the shares in the column `shear`",
        percent(shear)
    ))
}

/// A mode with damping.
#[derive(Clone, Debug, PartialEq)]
pub struct DampedMode {
    /// Real and imaginary part of its pole, rad/s.
    pub value: [f64; 2],
    /// How it goes on.
    pub kind: PoleKind,
    /// `|λ|`, rad/s.
    pub natural_frequency: f64,
    /// Its damping ratio, exact: `−Re λ/|λ|`.
    pub damping_ratio: f64,
    /// The coordinate that it moves most, in words.
    pub moves: String,
}

impl Simulation {
    /// The `count` softest modes with damping about the state that is reached, at rest and without dry friction, and
    /// how many there are: by rising `|λ|`, of a pair of poles that with the positive imaginary part.
    ///
    /// # Errors
    /// There are too many states, or the poles are not found.
    pub fn damped_modes(&self, count: usize) -> Result<(Vec<DampedMode>, usize), Failure> {
        let (poles, base) = self.poles_at_rest()?;
        let mut snapshot = FrameCache::default();
        let configuration = snapshot.of(self.system(), &base.state);
        let mode = |pole: &Pole| DampedMode {
            value: pole.value,
            kind: pole.kind,
            natural_frequency: pole.natural_frequency(),
            damping_ratio: pole.damping_ratio(),
            moves: self.system().most_moved(&configuration, &pole.shape).what,
        };
        Ok((poles.iter().take(count).map(mode).collect(), poles.len()))
    }
}

/// Largest share of the kinetic energy of a mode that one element may have, of beams with fewer than [`FEW`] elements
/// and of others. The last element of a cantilever has 0.82 of it in the first mode with 3 elements, 0.60 with 5, 0.42
/// with 8; a mode of one element alone 0.74 to 1.
const MOST_OF_FEW: f64 = 0.9;
const MOST_OF_MANY: f64 = 0.65;
const FEW: usize = 6;

/// What the user should know of the modes found.
fn warnings(
    (system, state): (&System, &State),
    found: &modes::Modes,
    ratios: &[f64],
    moving: bool,
    has_preload: bool,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if found.imbalance.is_nan() || found.imbalance > BALANCED {
        let remedy = match has_preload {
            true => "for those under the preload, let what holds it, a joint, a drive or a load, act beyond t = 0",
            false => "for those about its equilibrium take simulation.initial = \"equilibrium\"",
        };
        warnings.push(format!(
            "the mechanism is not in equilibrium: these are the modes of its stiffness in this position; {remedy}"
        ));
    }
    if found.skewness > SYMMETRIC {
        warnings.push(format!(
            "loads that turn with the mechanism, or moments about axes that stand still, have no potential: the skew part of the stiffness, \
             {:.2e} of it in the softest motions, is left out. Frequencies and kinds of the modes that these loads change are not to be trusted: \
             what is called unstable may be stable, and flutter is not found; a run in time shows both",
            found.skewness
        ));
    }
    warnings.extend(lonely_elements(system, state, &found.modes));
    if moving {
        warnings.push(String::from("velocities are left out: the modes are those of the mechanism at rest"));
    }
    if let Some(number) = ratios.iter().position(|ratio| ratio.abs() > LIGHT) {
        warnings.push(format!(
            "mode {} has a damping ratio of {:.2}: frequencies and shapes are those without damping, and ratios are of first order, which is rough for ratios \
             beyond {LIGHT}; a run in time shows the damped motion",
            number + 1,
            ratios[number]
        ));
    }
    if system.has_dry_friction() {
        warnings.push(String::from(
            "dry friction is left out of the modes: what it takes depends on the amplitude, and what it holds would not vibrate",
        ));
    }
    warnings
}

/// Warns of the first mode that moves hardly anything but one element of a beam: the mesh is too coarse for it. Where
/// the axial force vanishes, as at the free end of a hanging line, an element has a shape that costs nothing at its
/// axial points: the mode is not one of the line.
fn lonely_elements(system: &System, state: &State, modes: &[modes::Mode]) -> Option<String> {
    let highest = modes.last()?.eigenvalue;
    let mut cache = FrameCache::default();
    cache.set(system, &state.q, &state.triads);
    modes.iter().enumerate().filter(|(_, mode)| mode.kind == Kind::Vibration).find_map(|(number, mode)| {
        let form = |element| system.element_mass_form(element, cache.frames(), &mode.shape);
        let mut shares = (0..system.mesh.elements.len()).map(form).enumerate();
        let (element, share) = shares.by_ref().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (beam, local) = system.beam_of(element);
        let count = beam.elements();
        let most = if count < FEW { MOST_OF_FEW } else { MOST_OF_MANY };
        // One or two elements have too few others to compare with.
        if count < 3 || share <= most {
            return None;
        }
        // The frequency of such a mode goes with the square of the number of elements.
        let enough = (2.0 * count as f64 * pow(highest / mode.eigenvalue, 0.25)).ceil();
        Some(format!(
            "mode {} moves hardly anything but element {local} of {}, {:.0} % of its kinetic energy: the mesh is too coarse for it, and where the \
             axial force vanishes it is no mode of the real beam; take {enough} elements or more",
            number + 1,
            beam.name,
            100.0 * share
        ))
    })
}

/// Points of all beams in global axes, m.
fn drawn_lines(system: &System, q: &[f64]) -> Vec<Vec<[f64; 3]>> {
    let mut lines = lines(system, q);
    lines.iter_mut().flatten().for_each(|point| *point = system.global(Vec3::from(*point)).into());
    lines
}

/// Points of all beams of what `q` interpolates: positions, or displacements.
fn lines(system: &System, q: &[f64]) -> Vec<Vec<[f64; 3]>> {
    let line = |first: usize, count: usize| {
        let points = (0..=count * POINTS).map(|point| {
            let element = &system.mesh.elements[first + (point / POINTS).min(count - 1)];
            let xi = point as f64 / POINTS as f64 - (point / POINTS).min(count - 1) as f64;
            element.axis_point(xi, q).into()
        });
        points.collect()
    };
    system.beams.iter().map(|beam| line(beam.first_element, beam.elements())).collect()
}
