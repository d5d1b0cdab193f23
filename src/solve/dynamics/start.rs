//! The state at the start: joints hold as drawn, velocities are what the joints allow.

use crate::error::{Error, decimal};
use crate::math::Vec3;
use crate::math::rotation::rotation_vector_near;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::input::guide::Guide;
use crate::mechanics::input::switch::{Hold, Switch};
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::{State, Statistics};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::kkt::Kkt;
use crate::solve::statics::Statics;
use crate::solve::step::projection::Projection;

/// Largest gap of a joint as drawn, in m per m of the system's size (at least 1 m) or as the cosine of an angle:
/// rounding of the file's numbers.
const DRAWN_GAP: f64 = 1e-9;
/// Velocities whose change has less than this share of their kinetic energy are taken as given.
const CHANGED: f64 = 1e-12;

/// A damper that stops what it holds within less than this share of a step is not resolved by it: the step takes its
/// rate at the end, not in the middle.
const UNRESOLVED: f64 = 0.5;
/// A damper that begins to move by less than this share of the mechanism's size in a step, or by less than this angle
/// in rad, is at rest.
const MOVED: f64 = 1e-6;

/// Increments of the static path that leads to the initial equilibrium.
const INCREMENTS: u32 = 50;

/// Most combinations of engaged switches that are looked at.
const MOST_COMBINATIONS: usize = 100;

/// An integrator of motion, as the start sees it.
pub trait Dynamics {
    /// Its linear system.
    fn kkt(&mut self) -> &mut Kkt;

    /// Sets what it keeps in `state` besides position and motion, which are set: nothing.
    ///
    /// # Errors
    /// The constraints are redundant.
    fn begin(&mut self, _system: &System, _state: &mut State) -> Result<(), Error> {
        Ok(())
    }
}

impl<I: Dynamics> Dynamics for Box<I> {
    fn kkt(&mut self) -> &mut Kkt {
        self.as_mut().kkt()
    }

    fn begin(&mut self, system: &System, state: &mut State) -> Result<(), Error> {
        self.as_mut().begin(system, state)
    }
}

/// Checks that the joints hold as drawn.
///
/// # Errors
/// A joint's sides are apart.
pub fn check_assembled(system: &System, state: &State) -> Result<(), Error> {
    match first_gap(system, state) {
        None => Ok(()),
        Some((joint, gap)) => Err(Error::NotAssembled { joint: joint.name.clone(), gap }),
    }
}

/// Checks that no beam is drawn inside of what it touches: it might leave on the other side, and no step is right.
///
/// # Errors
/// A beam is inside another one, or inside a surface.
pub fn check_apart(system: &System, state: &State) -> Result<(), Error> {
    let mut cache = FrameCache::default();
    let c = cache.of(system, state);
    system.check_contacts(&c, state, state.time).map_err(|found| match found {
        Error::BeamThroughBeam { overlap, .. } => Error::DrawnInBeam(overlap),
        Error::RunThrough { inside, .. } => Error::DrawnInSurface(inside),
        other => other,
    })
}

/// The first joint whose sides are apart, with its gap.
fn first_gap<'s>(system: &'s System, state: &State) -> Option<(&'s Joint, f64)> {
    let mut cache = FrameCache::default();
    let configuration = cache.of(system, state);
    for joint in &system.joints {
        let mut phi = vec![0.0; joint.rows()];
        joint.phi(&configuration, &mut phi);
        let gap = phi.iter().fold(0.0_f64, |gap, value| gap.max(value.abs()));
        // A gap that is not a number counts as one.
        if gap.is_nan() || gap > DRAWN_GAP * system.size.max(1.0) {
            return Some((joint, gap));
        }
    }
    None
}

/// Checks that the winches of `state`, the start of a motion, have paid out what they had in the state `from` that it
/// begins with.
///
/// # Errors
/// One has not.
pub fn check_paid_out(system: &System, from: &State, state: &State) -> Result<(), Error> {
    for winch in &system.winches {
        let [then, now] = [from, state].map(|state| state.prescribed.drives[winch.drive].value);
        let gap = (now - then).abs();
        if gap.is_nan() || gap > DRAWN_GAP * system.size.max(1.0) {
            return Err(Error::PaidOutOtherwise { winch: system.drives[winch.drive].name.clone(), then, now });
        }
    }
    Ok(())
}

/// Checks that the drives begin where the system is drawn: at zero.
///
/// # Errors
/// One does not, or is not defined at the start.
pub fn check_drives(system: &System, state: &State) -> Result<(), Error> {
    if let Some(what) = system.undefined(state.time) {
        return Err(Error::NotFinite { time: state.time, what });
    }
    let motion = system.prescribe_start(state.time, &state.prescribed, &state.targets);
    for (drive, jet) in system.drives.iter().zip(&motion.drives) {
        if jet.value.is_nan() || jet.value.abs() > DRAWN_GAP {
            let (name, value) = (drive.name.clone(), jet.value);
            return Err(match drive.coordinate {
                Some(_) => Error::DriveNotAtZero { drive: name, value },
                None => Error::WinchNotAtZero { winch: name, value },
            });
        }
    }
    Ok(())
}

/// Moves the frames from where they are drawn to where they begin. Springs and bushings may be displaced there, and
/// free coordinates of joints too.
///
/// # Errors
/// A joint does not hold there.
pub fn move_frames(system: &System, state: &mut State) -> Result<(), Error> {
    let motion = system.prescribe_start(state.time, &state.prescribed, &state.targets);
    let drawn = state.prescribed.frames.clone();
    if motion.frames.iter().zip(&drawn).all(|(begun, drawn)| begun.pose == drawn.pose) {
        return Ok(());
    }
    state.prescribed.frames = motion.frames;
    let Some((joint, gap)) = first_gap(system, state) else {
        let mut frames = FrameCache::default();
        frames.of(system, state);
        system.carry_references(state, &frames);
        return Ok(());
    };
    let begun = &state.prescribed.frames;
    let way = |side: &Marker| {
        let Marker::Frame { frame, .. } = *side else { return None };
        let (from, to) = (drawn[frame].pose, begun[frame].pose);
        let turn = rotation_vector_near(&(to.axes * from.axes.transpose()), &Vec3::zeros());
        (from != to).then(|| (frame, (to.place - from.place).norm(), turn.norm()))
    };
    Err(match way(&joint.a).or_else(|| way(&joint.b)) {
        Some((frame, distance, angle)) => {
            let (frame, joint) = (system.moving_frames[frame].name.clone(), joint.name.clone());
            Error::FrameNotAsDrawn { frame, joint, distance, angle }
        }
        None => Error::NotAssembled { joint: joint.name.clone(), gap },
    })
}

/// Finds the equilibrium at `start`, s, from the system as drawn: drives stand still at their values of that time.
/// Where the time of `state` is an earlier one, by a path of equilibria from there to the start, each of the instant
/// just before its time: what jumps or switches at the start itself does so after the last one. On the way a drive
/// whose rate the host gives stands still. Velocities are zero then. Returns what the user should know of it.
///
/// # Errors
/// There is none, or a part of the system can move freely.
pub fn find_equilibrium(system: &System, state: &mut State, start: f64, tolerance: f64) -> Result<Vec<String>, Error> {
    let mut statics = Statics::new(system, tolerance);
    let begin = state.time;
    statics.find(system, state, begin)?;
    if begin < start {
        follow_path(system, &mut statics, state, start)?;
    }
    state.velocity.fill(0.0);
    // A motion may go on freely.
    state.held.clear();
    // Counts are those of the motion.
    state.statistics = Statistics::default();
    Ok(statics.take_remarks())
}

/// Takes `state` from its equilibrium along a path to the one just before `start`, s, and to what is engaged at
/// `start`.
fn follow_path(system: &System, statics: &mut Statics, state: &mut State, start: f64) -> Result<(), Error> {
    let wanted = state.targets.clone();
    state.targets.straight = true;
    let drives = system.drives.iter().zip(&mut state.targets.drives);
    drives.filter(|(drive, _)| matches!(drive.guide, Guide::HostRate)).for_each(|(_, rate)| *rate = 0.0);
    let begin = state.time;
    for number in 1..=INCREMENTS {
        let share = f64::from(number) / f64::from(INCREMENTS);
        let instant = before(if number == INCREMENTS { start } else { begin + share * (start - begin) });
        statics.find_engaged(system, state, instant, instant)?;
    }
    state.time = start;
    state.targets = wanted;
    // For a host, the motion begins here.
    state.targets.departure.time = start;
    if system.switches_at(state, start) {
        system.switch(state, start);
    }
    Ok(())
}

/// The instant just before `time`, s; not so near to 0 that a processor may take it for 0.
fn before(time: f64) -> f64 {
    if time == 0.0 { -f64::MIN_POSITIVE } else { time.next_down() }
}

/// The dampers that stop what they hold within far less than a step of `step` s, and that begin to move: each as a
/// sentence.
pub fn unresolved_dampers(system: &System, state: &State, step: f64) -> Vec<String> {
    let mut cache = FrameCache::default();
    let configuration = cache.of(system, state);
    let begins = |spring: &&Spring| {
        let coordinate = &system.relative_coordinates[spring.coordinate];
        let moved = step * coordinate.rate(&configuration, &state.velocity).abs();
        let unit = if matches!(coordinate.measure, Measure::Distance(_) | Measure::Length) { system.size } else { 1.0 };
        spring.decay_rate() * UNRESOLVED * step > 1.0 && moved > MOVED * unit
    };
    let told = system.springs.iter().filter(begins).map(|spring| {
        format!(
            "the damper of {} stops what it holds within {:.1e} s, less than simulation.step = {step} s resolves: the way until then is off by up to that of half \
             a step; take a smaller step if it matters",
            spring.name,
            1.0 / spring.decay_rate()
        )
    });
    told.collect()
}

/// The first combination of what switches engage later, at their breaks, in which constraints are redundant where the
/// system is drawn: as a sentence. Where a host switches, nothing is known.
pub fn redundant_later(system: &System, integrator: &mut impl Dynamics, state: &State) -> Option<String> {
    let mut seen: Vec<Vec<bool>> = vec![system.holds_at(state.time, &state.targets).collect()];
    let later = system.breaks.iter().copied().filter(|time| *time > state.time);
    for time in later.filter(|time| system.switches.iter().filter_map(Switch::signal).any(|own| own.breaks_at(*time))) {
        let engaged: Vec<bool> = system.holds_at(time, &state.targets).collect();
        if seen.len() == MOST_COMBINATIONS || seen.contains(&engaged) {
            continue;
        }
        let mut then = state.clone();
        then.prescribed.holds = engaged.iter().copied().map(Hold::drawn).collect();
        let projected = Projection::once(system)
            .set_velocity(system, integrator.kkt(), &mut FrameCache::default(), &mut then)
            .and_then(|()| integrator.kkt().check_unique(system, time));
        if let Err(Error::Singular { what, .. }) = projected {
            return Some(format!("from t = {} s on, {what}", decimal(time)));
        }
        seen.push(engaged);
    }
    None
}

/// Sets momenta and velocities at the start: the velocities nearest to the given ones, in the metric of the kinetic
/// energy, that the constraints, drives and moving frames allow (MECHANICS 6). Returns the kinetic energy of the change
/// as a share of the given one; 0 when nothing was given or changed.
///
/// # Errors
/// The constraints are redundant: the error names a joint.
pub fn set_motion(system: &System, integrator: &mut impl Dynamics, state: &mut State) -> Result<f64, Error> {
    if let Some(what) = system.undefined(state.time) {
        return Err(Error::NotFinite { time: state.time, what });
    }
    state.prescribed = system.prescribe_start(state.time, &state.prescribed, &state.targets);
    let mut cache = FrameCache::default();
    let drawn = cache.of(system, state);
    if let Some(what) = system.undefined_law(&drawn, |coordinate, _| coordinate.rate(&drawn, &state.velocity)) {
        return Err(Error::NotFinite { time: state.time, what });
    }
    let given = state.velocity.clone();
    system.set_momentum(state);
    Projection::of_impact(system).set_velocity(system, integrator.kkt(), &mut FrameCache::default(), state)?;
    integrator.kkt().check_unique(system, state.time)?;
    system.set_momentum(state);
    state.constraint_momenta.fill(0.0);
    integrator.begin(system, state)?;
    let change: Vec<f64> = state.velocity.iter().zip(&given).map(|(now, given)| now - given).collect();
    cache.set(system, &state.q, &state.triads);
    let mass = MassAt::new(&state.prescribed.drives, &cache);
    let kinetic = |velocity: &[f64]| system.kinetic_energy_of_mesh(mass, velocity);
    let (changed, given) = (kinetic(&change), kinetic(&given));
    // Whoever divides first and chooses afterwards, as compilers do, must not divide by 0: hosts may trap that.
    let share = changed / f64::max(given, f64::MIN_POSITIVE);
    Ok(if given > 0.0 && changed > CHANGED * given { share } else { 0.0 })
}
