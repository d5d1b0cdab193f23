//! Relative equilibria: a mechanism that turns steadily, found by Newton's iteration instead of a run that settles.
//!
//! ```text
//! dU/dq − F(q, v) + M a + gyro + Gᵀ λ = 0,   g = 0,   v = ω × (r − r₀),   a = ω × (ω × (r − r₀))
//! ```
//!
//! Velocities and accelerations follow the coordinates, and the tangent has their parts. A state that turns is steady
//! if the equations hold after a turn, too.

use super::base::{BALANCED, Base, imbalance_of};
use super::independent::Selection;
use super::state_space::Reduction;
use super::{Linearization, Tangents};
use crate::error::Error;
use crate::math::Mat3;
use crate::mechanics::state::{State, viscous_rates};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::rotation::Rotation;
use crate::mechanics::system::variation::follow;
use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::newton::kkt::Kkt;
use crate::solve::newton::not_converged;
use crate::solve::step::response::{Responder, Response};

/// Corrections at which the iteration ends, as [`System::motion_size`]; it goes on while they halve, to round-off.
const ACCURATE: f64 = 1e-9;
const MOST_ITERATIONS: usize = 40;
/// A correction beyond this leads nowhere.
const LARGEST: f64 = 2.0;
/// The speed is raised in increments that are halved so often at most.
const MOST_HALVINGS: u32 = 10;

/// Share of a pole by which two matrices may differ that are the same, and round-off of a product whose terms cancel.
const SAME: f64 = 1e-6;
const ROUND_OFF: f64 = 1e-13;

/// The turn after which the equations are looked at again, rad: 37 degrees, no symmetry of a mechanism.
pub const OTHER_ANGLE: f64 = 37.0 * std::f64::consts::PI / 180.0;

/// The axes in which a linear system does not change while the mechanism turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The global ones: a round rotor in any support.
    Fixed,
    /// Those that turn: any rotor in a support that is round.
    Turning,
}

/// Why there is no steady rotation.
#[derive(Clone, Debug, PartialEq)]
pub enum Unsteady {
    /// Newton has not found it.
    NotFound(Error),
    /// The equations do not hold after a turn: how far the equilibrium would be, as [`Base::imbalance`].
    Periodic(f64),
}

impl From<Error> for Unsteady {
    fn from(error: Error) -> Self {
        Self::NotFound(error)
    }
}

/// Takes `state` to the relative equilibrium of `rotation`, with its velocities: from a smaller speed in increments
/// where need be. `from` is the speed that `state` turns steadily with, rad/s; 0 also where it is not known.
///
/// # Errors
/// Newton has not found it.
pub fn find(system: &System, rotation: &Rotation, from: f64, state: &mut State) -> Result<(), Error> {
    let (mut reached, mut increment, mut halvings) = (from, rotation.speed - from, 0);
    viscous_rates::clear(state);
    loop {
        let is_last = increment.abs() >= (rotation.speed - reached).abs();
        let speed = if is_last { rotation.speed } else { reached + increment };
        let mut next = state.clone();
        match iterate(system, &rotation.with_speed(speed), &mut next) {
            Ok(()) => {
                *state = next;
                if is_last {
                    return Ok(());
                }
                reached = speed;
            }
            // The state as drawn may be far from equilibrium.
            Err(_) if halvings < MOST_HALVINGS && rotation.speed != from => {
                halvings += 1;
                increment *= 0.5;
            }
            Err(reason) => return Err(reason),
        }
    }
}

/// Newton's iteration at one speed.
fn iterate(system: &System, rotation: &Rotation, state: &mut State) -> Result<(), Error> {
    let (coordinates, time) = (state.q.len(), state.time);
    let (mut kkt, mut responder, mut frames) =
        (Kkt::for_equilibria(system), Responder::new(system), FrameCache::default());
    let mut right = vec![0.0; coordinates + system.constraints()];
    let mut last = f64::INFINITY;
    follow(system, state, &mut frames);
    for iteration in 1..=MOST_ITERATIONS {
        rotation.set_motion(system, state);
        let acceleration = rotation.acceleration(&state.q);
        let response = Response { acceleration, multipliers: state.multipliers.clone() };
        responder.balance(system, state, &response, &mut right)?;
        let configuration = frames.of(system, state);
        system.constraint_conditions(&configuration, &mut right[coordinates..]);
        right[coordinates..].iter_mut().for_each(|value| *value = -*value);

        set_tangent(system, rotation, state, &response, &mut kkt);
        kkt.solve(system, &mut right, time)?;
        let size = system.motion_size(&right[..coordinates]);
        let is_useless = !size.is_finite() || size > LARGEST;
        if is_useless || iteration == MOST_ITERATIONS {
            return Err(not_converged(system, &right, (iteration, size), time, ACCURATE));
        }
        let (change, multipliers) = right.split_at(coordinates);
        state.q.iter_mut().zip(change).for_each(|(value, change)| *value += change);
        state.multipliers.iter_mut().zip(multipliers).for_each(|(value, change)| *value += change);
        follow(system, state, &mut frames);
        if size < ACCURATE && size >= 0.5 * last {
            break;
        }
        last = size;
    }
    kkt.check_unique(system, time)?;
    rotation.set_motion(system, state);
    Ok(())
}

/// Sets the matrix of `kkt` to the derivative of the equations at `state`.
fn set_tangent(system: &System, rotation: &Rotation, state: &State, response: &Response, kkt: &mut Kkt) {
    let coordinates = state.q.len();
    let Tangents { mut by_q, by_v, by_spin, gradients } = Tangents::new(system, state, response, kkt);
    let mut cache = FrameCache::default();
    cache.set(system, &state.q, &state.triads);
    kkt.blocks.clear();
    system.add_mass(MassAt::new(&state.prescribed.drives, &cache), 1.0, &mut kkt.blocks);
    let mass = kkt.blocks.leading(coordinates);
    rotation.add_velocity_part(&state.q, &by_v, &mut by_q);
    rotation.add_velocity_part(&state.q, &by_spin, &mut by_q);
    rotation.add_acceleration_part(&mass, &mut by_q);
    kkt.blocks.set_leading(coordinates, &by_q);
    kkt.set_constraints(system, &gradients, &gradients, 1.0);
}

/// The bases of linear systems about `state`, which turns steadily with `rotation`: now, and after [`OTHER_ANGLE`].
///
/// # Errors
/// The equations do not hold there, or the constraints are redundant.
pub fn bases(system: &System, rotation: &Rotation, state: &State) -> Result<[Base; 2], Unsteady> {
    let base = |state: State, multipliers: Vec<f64>| {
        let response = Response { acceleration: rotation.acceleration(&state.q), multipliers };
        Base { state, response, is_at_rest: false, is_still: false, imbalance: 0.0 }
    };
    let mut turned = state.clone();
    rotation.advance(system, OTHER_ANGLE, &mut turned);
    let mut response = Response::default();
    Responder::new(system).respond(system, &turned, &mut response)?;
    let steady = rotation.acceleration(&turned.q);
    response.acceleration.iter_mut().zip(steady).for_each(|(own, steady)| *own -= steady);
    let distance = imbalance_of(system, &turned, &response)?;
    if distance.is_nan() || distance > BALANCED {
        return Err(Unsteady::Periodic(distance));
    }
    let multipliers = state.multipliers.clone();
    Ok([base(state.clone(), multipliers), base(turned, response.multipliers)])
}

/// The matrix `A` about `base` in `selection`; as seen from a frame that turns with `rotation`, if one is given.
///
/// # Errors
/// The constraints are redundant.
pub fn matrix(
    system: &System,
    base: &Base,
    selection: &Selection,
    rotation: Option<&Rotation>,
) -> Result<Dense, Error> {
    let reduction = Reduction::new((system, base, &()), Linearization::new(system, base)?, selection);
    let mut reduction = match rotation {
        Some(rotation) => reduction.seen_from(rotation),
        None => reduction,
    };
    Ok(reduction.matrices(0, |_, _, _| ())?.a)
}

/// The independent coordinates, and the axes in which the linear system about both `bases` is the same in its `modes`
/// softest modes; no axes: in none.
///
/// # Errors
/// The constraints are redundant, or poles are not found; none: nothing can move.
pub fn frame(
    system: &System,
    rotation: &Rotation,
    bases: &[Base; 2],
    modes: usize,
) -> Result<Option<(Selection, Option<Frame>)>, Error> {
    let [first, second] = bases;
    let linearization = Linearization::new(system, first)?;
    let Some(selection) = linearization.select(system, first) else { return Ok(None) };
    let other = Linearization::new(system, second)?;
    for frame in [Frame::Fixed, Frame::Turning] {
        let (axes, seen) = match frame {
            Frame::Fixed => (Mat3::identity(), None),
            Frame::Turning => (rotation.turn(OTHER_ANGLE), Some(rotation)),
        };
        let Some(again) = other.select_along(system, second, &axes, Some(&selection.chosen)) else { continue };
        let own = matrix(system, first, &selection, seen)?;
        if is_same(&own, &matrix(system, second, &again, seen)?, modes) {
            return Ok(Some((selection, Some(frame))));
        }
    }
    Ok(Some((selection, None)))
}

/// Whether `a` and `b` have the same `modes` softest modes: `yᵢᵀ (b − a) xⱼ` with the left and right vectors of `a`
/// changes no pole, apart from round-off of what cancels in `a`.
fn is_same(a: &Dense, b: &Dense, modes: usize) -> bool {
    let Ok(mut found) = a.eigensystem() else { return false };
    found.retain(|own| own.value.im >= 0.0);
    found.sort_by(|one, other| one.size().total_cmp(&other.size()));
    found.truncate(modes);
    let mut change = b.clone();
    change.values.iter_mut().zip(&a.values).for_each(|(change, own)| *change -= own);
    found.iter().all(|one| {
        found.iter().all(|other| {
            let [there, back] = [[one, other], [other, one]].map(|[left, right]| {
                let by = form(&change, &left.left, &right.right);
                (by, ROUND_OFF * a.magnitude(&left.left, &right.right))
            });
            let moved = (there.0 * back.0).sqrt();
            moved <= SAME * one.size().max(other.size()) + (there.1 * back.1).sqrt()
        })
    })
}

/// `|leftᵀ matrix right|`.
fn form(matrix: &Dense, left: &[Complex], right: &[Complex]) -> f64 {
    let part = |of: fn(&Complex) -> f64| matrix.times(&right.iter().map(of).collect::<Vec<f64>>());
    let [real, imaginary] = [part(|own| own.re), part(|own| own.im)];
    let products = left.iter().zip(real.into_iter().zip(imaginary));
    products.map(|(left, (real, imaginary))| left * Complex::new(real, imaginary)).sum::<Complex>().norm()
}
