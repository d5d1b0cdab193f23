//! Natural modes: `K x = ω² M x` on the motions that the constraints allow, `G x = 0`, about a state at rest.
//!
//! `K` holds the stiffness of sections, springs and loads and the curvature of the constraints under their forces.
//! Drives and moving frames stand where they are; damping (see damping.rs) and velocities are left out. The block of
//! subspace.rs is taken through `K + μ M`, `μ > 0` beyond the most unstable motion: systems that can move freely have a
//! singular `K`, unstable ones an indefinite one.

pub mod damping;
pub mod slowest;
pub mod subspace;

use self::subspace::{Subspace, combination, dot};
use crate::error::Error;
use crate::math::blocks::Blocks;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::irregular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::response::{Responder, Response};

/// `ω²` below this share of what its terms would add up to without canceling is round-off. Measured: 2e-16 and below
/// for free beams in any direction, 2e-11 for the first mode of a beam a thousand times as long as high, 16 elements,
/// in an oblique direction.
pub const ROUND_OFF: f64 = 2e-14;

/// Vectors beside the wanted ones, at least: the more, the faster the last of these come out.
const GUARDS: usize = 8;
/// Most sweeps; ten are usual, hundreds where an unstable motion is far below many soft ones.
const MOST_SWEEPS: usize = 2000;
/// Errors of the vectors at which the sweeps end: `ω²` has their square.
const ACCURATE: f64 = 1e-10;
/// Errors at which the sweeps end when they do not fall any more: round-off of stiff systems.
const ACCEPTABLE: f64 = 1e-6;
/// A vector whose number can be trusted to one digit.
const ROUGH: f64 = 0.1;

/// First `μ`, and the least, as shares of the `ω²` of a motion without pattern, which is near the largest one of the
/// system.
const FIRST_SHIFT: f64 = 1e-8;
const LEAST_SHIFT: f64 = 1e-14;
/// `μ` as a share of an `ω²` a little beyond the wanted ones, and as a multiple of what is beyond zero.
const SHIFT_BELOW: f64 = 0.1;
const SHIFT_BEYOND: f64 = 4.0;
/// Factor by which `μ` is raised while motions release energy, and how often at most: beyond all that doubles can tell
/// apart.
const RAISE: f64 = 10.0;
const MOST_SHIFTS: usize = 30;
/// A change of `μ` by less than this factor is not worth a factorization.
const WORTHWHILE: f64 = 10.0;

/// `ω²` that differ by less than this share are one: their motions are sorted by what they move most.
const SAME: f64 = 1e-8;

/// How a natural mode goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Its amplitude grows as `exp(√(−ω²) t)`.
    Unstable,
    /// Nothing holds it: `ω²` is zero to round-off.
    Free,
    /// It swings at `ω`.
    Vibration,
}

/// A natural mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// How it goes on.
    pub kind: Kind,
    /// `ω²`, 1/s².
    pub eigenvalue: f64,
    /// Its shape, a change of the coordinates with `xᵀ M x = 1`.
    pub shape: Vec<f64>,
}

/// The natural modes about a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// The lowest, by rising `ω²`.
    pub modes: Vec<Mode>,
    /// How many motions the constraints leave.
    pub freedoms: usize,
    /// How far from the state the nearest equilibrium is by its stiffness: lengths over the system's size, slopes, rad.
    pub imbalance: f64,
    /// Largest skew part of the stiffness (follower loads, moments about axes that stand still) between two of the
    /// softest motions, also beyond those asked for, as a share of the larger of their `|ω²|`. Modes are those of the
    /// symmetric part.
    pub skewness: f64,
}

/// The `count` lowest modes about `state`, at rest, without dry friction: it would hold a joint by the stiffness of
/// sticking.
///
/// # Errors
/// The constraints are redundant, a number is not finite, or the sweeps do not converge.
pub fn modes(system: &System, state: &State, count: usize) -> Result<Modes, Error> {
    let time = state.time;
    let rest = at_rest(state);
    let mut response = Response::default();
    Responder::new(system).respond(system, &rest, &mut response)?;
    let mut kkt = Kkt::for_equilibria(system);
    // A joint that friction holds is in balance, and vibrates here all the same.
    let without_friction = system.has_dry_friction().then(|| system.without_dry_friction());
    let stiffness = linearize(without_friction.as_ref().unwrap_or(system), &rest, &response.multipliers, &mut kkt);
    let symmetric = stiffness.symmetric_part();

    let constraints = system.constraints() - system.released_constraints(&state.prescribed);
    let freedoms = system.coordinates().saturating_sub(constraints);
    let wanted = count.min(freedoms);
    let mut cache = FrameCache::default();
    cache.set(system, &rest.q, &rest.triads);
    let mass = MassAt::new(&rest.prescribed.drives, &cache).wet(&rest.q, time);
    let mut block = Subspace::new(system, mass, wanted + GUARDS.max(wanted).min(freedoms - wanted));
    let [stiff, forced] = scales(system, mass, &symmetric, &response);
    let largest = stiff + forced;
    // Without any stiffness every shift is as good.
    let [mut shift, mut least] =
        if largest > 0.0 { [FIRST_SHIFT, LEAST_SHIFT].map(|share| share * largest) } else { [1.0; 2] };
    shift = positive_shift(system, mass, &mut kkt, &symmetric, shift, time)?;
    kkt.check_unique(system, time)?;
    let imbalance = imbalance(system, mass, &response.acceleration, &mut kkt);

    let mut last = f64::INFINITY;
    for number in 0.. {
        let swept = block.sweep(system, mass, &mut kkt);
        let Ok(ritz) = swept else { return Err(Error::ModesNotFound { time, error: last }) };
        // The first sweep has only brought the vectors to the constraints.
        if number == 0 {
            continue;
        }
        let mut found: Vec<(f64, f64)> = ritz.iter().map(|ritz| (1.0 / ritz.inverse - shift, ritz.error)).collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let lowest = found.iter().filter(|own| own.1 < ROUGH).map(|own| own.0).fold(0.0, f64::min);
        // Of a vector beyond the wanted ones: these may all be zero, where nothing holds the system or it is about to
        // buckle.
        let beyond = found.get(wanted + GUARDS / 2).or(found.last()).map_or(0.0, |own| own.0);
        found.truncate(wanted);
        let error = found.iter().map(|own| own.1).fold(0.0, f64::max);
        let better = (SHIFT_BELOW * beyond).max(-SHIFT_BEYOND * lowest).max(least);
        if number >= MOST_SWEEPS {
            return Err(Error::ModesNotFound { time, error });
        } else if WORTHWHILE * better < shift {
            let lower = positive_shift(system, mass, &mut kkt, &symmetric, better, time)?;
            if WORTHWHILE * better < lower {
                // Below this one round-off counts motions that release energy: another attempt would end here again.
                least = lower;
            }
            shift = lower;
            last = f64::INFINITY;
        } else if error < ACCURATE || error < ACCEPTABLE && error > 0.5 * last {
            break;
        } else {
            last = error;
        }
    }
    let mut modes: Vec<Mode> = block.vectors().iter().map(|shape| mode(&symmetric, shape, forced)).collect();
    modes.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
    sort_out(system, &mut modes);
    // Of all vectors: one mode alone has no skew part.
    let skewness = skewness(&stiffness, &modes);
    modes.truncate(wanted);
    Ok(Modes { modes, freedoms, imbalance, skewness })
}

/// `state` at rest.
fn at_rest(state: &State) -> State {
    let mut rest = state.clone();
    rest.velocity.fill(0.0);
    rest.prescribed.stop();
    rest
}

/// Factorizes `K + μ M` with the least `μ` of `shift`, ten times it, and so on, with which no motion releases energy,
/// and returns it: the block then finds the lowest modes first, however unstable, and misses none.
///
/// # Errors
/// The matrix is singular.
pub fn positive_shift(
    system: &System,
    mass: MassAt,
    kkt: &mut Kkt,
    stiffness: &Blocks,
    mut shift: f64,
    time: f64,
) -> Result<f64, Error> {
    for _ in 0..MOST_SHIFTS {
        kkt.blocks.clone_from(stiffness);
        system.add_mass(mass, shift, &mut kkt.blocks);
        kkt.factorize(system, time)?;
        if kkt.releasing_motions(system).is_none_or(|count| count == 0) {
            break;
        }
        shift *= RAISE;
    }
    Ok(shift)
}

/// The `μ` to begin with where nothing is known but the stiffness, 1/s².
pub fn first_shift(system: &System, mass: MassAt, stiffness: &Blocks) -> f64 {
    let (vector, square) = without_pattern(system, mass);
    FIRST_SHIFT * stiffness.magnitude(&vector) / square
}

/// A motion without pattern, and `xᵀ M x` of it.
fn without_pattern(system: &System, mass: MassAt) -> (Vec<f64>, f64) {
    let vector: Vec<f64> = (0..system.coordinates()).map(|index| irregular(index) * size(system, index)).collect();
    let mut momentum = vec![0.0; vector.len()];
    system.mass_times(mass, &vector, &mut momentum);
    let square = dot(&vector, &momentum);
    (vector, square)
}

/// What coordinate `index` is measured in: the system's size, m, or 1.
fn size(system: &System, index: usize) -> f64 {
    if system.is_place(index) { system.size } else { 1.0 }
}

/// Sets the blocks of `kkt` to stiffness and constraints at `state`, whose constraints transmit `multipliers`; returns
/// them.
pub(in crate::solve) fn linearize(system: &System, state: &State, multipliers: &[f64], kkt: &mut Kkt) -> Blocks {
    set_stiffness(system, state, multipliers, kkt);
    kkt.blocks.clone()
}

/// As [`linearize`], but for what it returns.
fn set_stiffness(system: &System, state: &State, multipliers: &[f64], kkt: &mut Kkt) {
    let (mut snapshot, mut excitation) = (FrameCache::default(), Excitation::default());
    let configuration = snapshot.of(system, state);
    system.excite(state.time, &state.targets, &mut excitation);
    let (mut forces, mut gradients) = (vec![0.0; system.coordinates()], Vec::new());
    system.forces_and_tangent(&configuration, &Passage::Rest, &excitation, 1.0, &mut forces, &mut kkt.blocks);
    kkt.set_curvatures_and_gradients(system, &configuration, multipliers, 1.0, &mut gradients);
    kkt.set_constraints(system, &gradients, &gradients, 1.0);
}

/// `ω²` of a motion without pattern, if nothing canceled, 1/s²: by the stiffness, and by what the forces that act, of
/// constraints and of inertia, would do in such a motion: a stiffness far below that is round-off of theirs.
fn scales(system: &System, mass: MassAt, stiffness: &Blocks, response: &Response) -> [f64; 2] {
    let (vector, square) = without_pattern(system, mass);
    let mut inertia = vec![0.0; vector.len()];
    system.mass_times(mass, &response.acceleration, &mut inertia);
    let transmitted: f64 = response.multipliers.iter().map(|force| force.abs() * system.size).sum();
    let accelerating: f64 = inertia.iter().enumerate().map(|(index, force)| force.abs() * size(system, index)).sum();
    [stiffness.magnitude(&vector) / square, (transmitted + accelerating) / square]
}

/// Size of the correction by which Newton would go to the equilibrium from where the system has this `acceleration`.
pub(in crate::solve) fn imbalance(system: &System, mass: MassAt, acceleration: &[f64], kkt: &mut Kkt) -> f64 {
    let mut right = vec![0.0; system.coordinates() + system.constraints()];
    system.mass_times(mass, acceleration, &mut right[..system.coordinates()]);
    // Without a solution it is far from any.
    if kkt.solve_again(&mut right).is_err() { f64::INFINITY } else { system.correction_size(&right).0 }
}

/// The mode of a converged `shape`; its Rayleigh quotient has the square of the shape's error.
fn mode(stiffness: &Blocks, shape: &[f64], forced: f64) -> Mode {
    let eigenvalue = stiffness.form(shape, shape);
    let kind = kind(stiffness, shape, eigenvalue, forced);
    Mode { kind, eigenvalue, shape: shape.to_vec() }
}

/// What a motion with `xᵀ K x = eigenvalue` does, as far as the round-off of the stiffness, and of forces that amount
/// to `forced`, tells.
pub fn kind(stiffness: &Blocks, shape: &[f64], eigenvalue: f64, forced: f64) -> Kind {
    let noise = ROUND_OFF * (stiffness.magnitude(shape) + forced);
    if eigenvalue < -noise {
        Kind::Unstable
    } else if eigenvalue <= noise {
        Kind::Free
    } else {
        Kind::Vibration
    }
}

/// Turns the shapes of each frequency that comes more than once so that the first has all of what they move most, the
/// second all of what is left then, and so on: a round beam's go along the axes.
fn sort_out(system: &System, modes: &mut [Mode]) {
    let same = |a: &Mode, b: &Mode| match (a.kind, b.kind) {
        (Kind::Free, Kind::Free) => true,
        (Kind::Free, _) | (_, Kind::Free) => false,
        _ => (a.eigenvalue - b.eigenvalue).abs() <= SAME * a.eigenvalue.abs().max(b.eigenvalue.abs()),
    };
    for group in modes.chunk_by_mut(same) {
        for first in 0..group.len() - 1 {
            turn_to_largest(system, &mut group[first..]);
        }
    }
}

/// Turns shapes among themselves so that the first has all of the coordinate that they move most.
fn turn_to_largest(system: &System, group: &mut [Mode]) {
    let mut largest = (0, 0.0);
    for index in 0..system.coordinates() {
        let sum = group.iter().map(|mode| mode.shape[index].powi(2)).sum::<f64>().sqrt() / size(system, index);
        // What is larger by round-off only does not count.
        if sum > (1.0 + SAME) * largest.1 {
            largest = (index, sum);
        }
    }
    let mut mirror: Vec<f64> = group.iter().map(|mode| mode.shape[largest.0]).collect();
    let norm = dot(&mirror, &mirror).sqrt();
    mirror.iter_mut().for_each(|value| *value /= norm);
    mirror[0] -= 1.0;
    let square = dot(&mirror, &mirror);
    if square <= SAME * SAME {
        return;
    }
    // Householder's reflection that takes their shares of that coordinate to the first.
    let shapes: Vec<Vec<f64>> = group.iter().map(|mode| mode.shape.clone()).collect();
    let across = combination(&shapes, &mirror);
    for (mode, share) in group.iter_mut().zip(&mirror) {
        mode.shape.iter_mut().zip(&across).for_each(|(value, across)| *value -= 2.0 * share / square * across);
    }
}

/// See [`Modes::skewness`].
fn skewness(stiffness: &Blocks, modes: &[Mode]) -> f64 {
    let mut largest = 0.0_f64;
    for (number, a) in modes.iter().enumerate() {
        for b in &modes[..number] {
            let skew = 0.5 * (stiffness.form(&a.shape, &b.shape) - stiffness.form(&b.shape, &a.shape)).abs();
            let size = a.eigenvalue.abs().max(b.eigenvalue.abs());
            let noise = [a, b].map(|mode| stiffness.magnitude(&mode.shape));
            if skew > ROUND_OFF * noise[0].max(noise[1]) {
                largest = largest.max(skew / size);
            }
        }
    }
    largest
}
