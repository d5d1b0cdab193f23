//! What failed in the mechanics or the solver, where, with which numbers, and what to try.

use thiserror::Error;

/// A time as a message shows it, s: the nearest number of 12 digits, 0.6 instead of 0.6000000000000001.
pub fn decimal(time: f64) -> f64 {
    format!("{time:.11e}").parse().unwrap_or(time)
}

/// A length or an angle as a message shows it: the nearest number of 4 digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Two elements that are inside each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// The beam's name.
    pub beam: String,
    /// Number of the element in the beam, from 0.
    pub element: usize,
    /// Name of the other beam.
    pub other: String,
    /// Number of the element in the other beam, from 0.
    pub touched: usize,
    /// Distance of the axes at which they touch, m.
    pub distance: f64,
}

/// An element that is inside a convex surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Inside {
    /// The beam's name.
    pub beam: String,
    /// Number of the element in the beam, from 0.
    pub element: usize,
    /// The surface's name.
    pub surface: String,
    /// Its least radius, m.
    pub radius: f64,
}

/// A failure of mechanics or solver. A failed step leaves the state as it was, but for the counts of iterations and
/// rejections.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Error {
    /// Newton did not reach its tolerance.
    #[error(
        "no equilibrium at t = {t} s: after {iterations} iterations the last correction was {correction:.1e} at {place} \
         (tolerance {tolerance:.1e}); try a smaller step",
t = decimal(*.time)
)]
    NotConverged {
        /// Time of the step's end, s.
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Size of the last correction, lengths over the mechanism's size, slopes and angles as they are.
        correction: f64,
        /// Where it was largest.
        place: String,
        /// Its bound.
        tolerance: f64,
    },
    /// The linear system has no unique solution.
    #[error("the equations have no unique solution at t = {t} s: {what}",
t = decimal(*.time)
)]
    Singular {
        /// Time, s.
        time: f64,
        /// What moves freely, or is held twice, and what to do about it.
        what: String,
    },
    /// A tangent, a body, a frame or a joint turned too far in one step.
    #[error(
        "{place} turned by {angle:.2} rad in the step to t = {t} s (at most {limit:.2} rad); try a smaller step",
t = decimal(*.time)
)]
    Turned {
        /// Time of the step's end, s.
        time: f64,
        /// What turned.
        place: String,
        /// Its turn, rad.
        angle: f64,
        /// The bound, rad.
        limit: f64,
    },
    /// A beam has run through another one, or through itself.
    #[error(
        "element {} of {} ran through element {} of {} in the step to t = {} s; try a smaller step, or a stiffer \
         contact",
        overlap.element, overlap.beam, overlap.touched, overlap.other, decimal(*time)
    )]
    BeamThroughBeam {
        /// Time of the step's end, s.
        time: f64,
        /// The elements.
        overlap: Overlap,
    },
    /// A beam is drawn inside another one, or inside itself.
    #[error(
        "element {} of {} is drawn inside element {} of {}: their axes are nearer than half the distance at which they \
         touch, {} m; draw them further apart, or give the contact a smaller `radius`, which counts for the beams in \
         `of`",
        _0.element, _0.beam, _0.touched, _0.other, _0.distance
    )]
    DrawnInBeam(Overlap),
    /// A beam has run through a convex surface.
    #[error(
        "element {} of {} ran through surface {} (radius {:.3} m) in the step to t = {} s; try a smaller step, or a \
         stiffer contact",
        inside.element, inside.beam, inside.surface, inside.radius, decimal(*time)
    )]
    RunThrough {
        /// Time of the step's end, s.
        time: f64,
        /// The element and the surface.
        inside: Inside,
    },
    /// A beam is drawn inside a convex surface.
    #[error(
        "element {} of {} is drawn inside surface {}, deeper than half its radius of {:.3} m; draw the beam outside",
        _0.element, _0.beam, _0.surface, _0.radius
    )]
    DrawnInSurface(Inside),
    /// An element is bent, or twisted in one step, too far to be a good approximation.
    #[error("element {element} of {beam} is {what} too far at t = {t} s; try more elements or a smaller step",
t = decimal(*.time)
)]
    Distorted {
        /// Time, s.
        time: f64,
        /// The beam's name.
        beam: String,
        /// Number of the element in the beam, from 0.
        element: usize,
        /// `bent` or `twisted`.
        what: &'static str,
    },
    /// A node's slope left the range in which the element means something.
    #[error(
        "{place} is stretched to {stretch:.3} of its length at t = {t} s (allowed: 0.3 to 3); try a smaller step or a stiffer beam",
t = decimal(*.time)
)]
    Stretched {
        /// Time, s.
        time: f64,
        /// The node.
        place: String,
        /// `|r'|`, 1.
        stretch: f64,
    },
    /// The strain energy has no lower bound above this twist rate (MECHANICS, trap 9).
    #[error(
        "element {element} of {beam} is twisted by {rate:.3} rad/m at t = {t} s; above {limit:.3} rad/m its strain energy has no lower bound, \
         because strain = \"large_truncated\" or the section's fourth_moments leave the stiffening by twist out; use strain = \"large\" with the \
         section's true fourth_moments",
t = decimal(*.time)
)]
    TwistBeyondTruncation {
        /// Time, s.
        time: f64,
        /// The beam's name.
        beam: String,
        /// Number of the element in the beam, from 0.
        element: usize,
        /// Twist rate, rad/m.
        rate: f64,
        /// Its bound, rad/m.
        limit: f64,
    },
    /// A joint has come to stand the other way round: another root of its conditions (MECHANICS 6).
    #[error(
        "{joint} flipped at t = {t} s: its parts turned by more than 90 degrees in a step; try a smaller step",
t = decimal(*.time)
)]
    Flipped {
        /// Time of the step's end, s.
        time: f64,
        /// The joint.
        joint: String,
    },
    /// A joint that slides along a beam has come to its end.
    #[error(
        "{joint} has come to an end of beam {beam} at t = {t} s: hold it before \
         with a spring to the end, let it turn back earlier, or draw the beam longer",
t = decimal(*.time)
)]
    SlidOff {
        /// Time of the step's end, s.
        time: f64,
        /// The joint.
        joint: String,
        /// The beam.
        beam: String,
    },
    /// A bushing is turned so far that its rotation vector ends.
    #[error(
        "the bushing {bushing} is turned by {angle:.0} degrees at t = {t} s: a bushing is valid up to 170 degrees; use a joint with a free rotation",
t = decimal(*.time)
)]
    BushingTurned {
        /// Time of the step's end, s.
        time: f64,
        /// The bushing.
        bushing: String,
        /// Its angle, degrees.
        angle: f64,
    },
    /// A drive has missed a turn.
    #[error(
        "drive {drive} is at {reading:.3} rad instead of {prescribed:.3} rad at t = {t} s: it moves too far in a step; try a smaller step",
t = decimal(*.time)
)]
    DriveMissed {
        /// Time of the step's end, s.
        time: f64,
        /// The drive.
        drive: String,
        /// What it prescribes.
        prescribed: f64,
        /// Where its joint is.
        reading: f64,
    },
    /// A motion begins with a state in which a winch has paid out another length.
    #[error(
        "winch {winch} has paid out {then:.6} m in the state, but begins at {now:.6} m; let `length` begin there, or give its rate"
    )]
    PaidOutOtherwise {
        /// The winch.
        winch: String,
        /// What it has paid out in the state, m.
        then: f64,
        /// What it begins with, m.
        now: f64,
    },
    /// A winch hauls in too much.
    #[error(
        "winch {winch} leaves {left:.3} m of its beam at t = {t} s: at least {least:.3} m must stay; haul in less",
t = decimal(*.time)
)]
    HauledIn {
        /// Time, s.
        time: f64,
        /// The winch.
        winch: String,
        /// The free length that is left, m.
        left: f64,
        /// The smallest one, m.
        least: f64,
    },
    /// Two wheels of a rope, or a wheel and an end of it, are inside each other.
    #[error(
        "rope {rope} has no way from {a} to {b} at t = {t} s: one of them is inside the other; keep them apart, \
         or take a smaller step",
t = decimal(*.time)
)]
    RopeThroughWheel {
        /// Time, s.
        time: f64,
        /// The rope.
        rope: String,
        /// The first of them.
        a: String,
        /// The second one.
        b: String,
    },
    /// No rope is left in a span.
    #[error(
        "rope {rope} has no length left in span {span} at t = {t} s; give it more `length`, or haul in less",
t = decimal(*.time)
)]
    RopeUsedUp {
        /// Time, s.
        time: f64,
        /// The rope.
        rope: String,
        /// The span, from 1.
        span: usize,
    },
    /// A drive moves too far within one increment of a static analysis.
    #[error(
        "drive {drive} turns {turns:.1e} times from t = {begin} s to t = {end} s; a static analysis follows at most {limit} turns in each \
         simulation.step: take a smaller one, or a slower drive",
begin = decimal(*.from),
end = decimal(*.to)
)]
    DriveTooFast {
        /// The drive.
        drive: String,
        /// How many times it turns.
        turns: f64,
        /// Start, s.
        from: f64,
        /// End, s.
        to: f64,
        /// Most turns in a step.
        limit: f64,
    },
    /// A winch does not begin at the length as drawn.
    #[error(
        "winch {winch} begins at {value} m, but nothing has been paid out as drawn; let `length` begin at 0, or take initial = \"equilibrium\""
    )]
    WinchNotAtZero {
        /// The winch.
        winch: String,
        /// What it has paid out at the start, m.
        value: f64,
    },
    /// The motion does not begin as a steady rotation.
    #[error("the motion cannot begin as a steady rotation: {reason}")]
    NoSteadyStart {
        /// Why, with the remedy.
        reason: String,
    },
    /// A drive does not begin where the system is drawn.
    #[error(
        "the drive {drive} begins at {value}, but the coordinates of joints are 0 as drawn; let it begin at 0, draw the mechanism \
         there, or take initial = \"equilibrium\", which assembles it there"
    )]
    DriveNotAtZero {
        /// The drive.
        drive: String,
        /// Its value at the start, rad or m.
        value: f64,
    },
    /// A frame does not begin where it is drawn, and a joint ties it as drawn.
    #[error(
        "the frame {frame} begins {d} m and {a} rad from where it is drawn, and {joint} does not hold there; let it begin as drawn, \
         draw the mechanism there, or take initial = \"equilibrium\", which assembles it there",
d = short(*.distance),
a = short(*.angle)
)]
    FrameNotAsDrawn {
        /// The frame.
        frame: String,
        /// The joint that does not hold.
        joint: String,
        /// How far it is from its drawn position, m.
        distance: f64,
        /// How far it is turned, rad.
        angle: f64,
    },
    /// A number is not finite: a load's expression at this time, or an overflow.
    #[error("{what} is not a finite number at t = {t} s",
t = decimal(*.time)
)]
    NotFinite {
        /// Time, s.
        time: f64,
        /// What it is.
        what: String,
    },
    /// Halving did not help.
    #[error("the step from t = {t} s failed even at {step:.3e} s, 1/{parts} of the step size: {reason}",
t = decimal(*.time)
)]
    StepTooSmall {
        /// Time at which the step starts, s.
        time: f64,
        /// The smallest step tried, s.
        step: f64,
        /// Its share of the step size.
        parts: u32,
        /// What failed at last.
        reason: Box<Error>,
    },
    /// A step whose length the solver chose failed even when it was the shortest one.
    #[error(
        "the step from t = {t} s failed even at {step:.1e} s, the shortest that the solver takes: {reason}; check the loads and drives at this time, or give simulation.step",
        t = decimal(*.time)
    )]
    NoShorterStep {
        /// Time at which the step starts, s.
        time: f64,
        /// The smallest step tried, s.
        step: f64,
        /// What failed at last.
        reason: Box<Error>,
    },
    /// The error of a step is larger than the asked accuracy allows: it is taken again, shorter.
    #[error("a step of {step:.3e} s from t = {t} s has {ratio:.1} times the error that simulation.accuracy allows", t = decimal(*.time))]
    Inexact {
        /// Time at which the step starts, s.
        time: f64,
        /// Its length, s.
        step: f64,
        /// Its error over that allowed.
        ratio: f64,
    },
    /// The ramp to an equilibrium did not reach its end.
    #[error(
        "no equilibrium was found at t = {t} s: load stepping stopped at {percent:.2} % of the change of the loads ({reason}); this is a limit point \
         (snap-through), where a drive that prescribes the displacement can follow, or the mesh is too coarse{doubt}",
t = decimal(*.time), percent = 100.0 * .share
)]
    RampStuck {
        /// Time, s.
        time: f64,
        /// The share of the change of loads that was reached, 0 to 1.
        share: f64,
        /// Another possible cause, in words that continue the sentence; empty: there is none.
        doubt: String,
        /// What failed at last.
        reason: Box<Error>,
    },
    /// A step along a path of equilibria has not found where the path goes.
    #[error("the path of equilibria at t = {t} {what}; try a smaller simulation.step", t = decimal(*.parameter))]
    PathLost {
        /// Parameter of the path where the step starts.
        parameter: f64,
        /// What the path does there.
        what: String,
    },
    /// The iteration for natural modes did not come to an end.
    #[error(
        "the natural modes at t = {t} s did not converge: their shapes still change by {error:.1e}; ask for fewer or for more modes",
t = decimal(*.time)
)]
    ModesNotFound {
        /// Time, s.
        time: f64,
        /// Largest change of a shape in the last sweep, as a share.
        error: f64,
    },
    /// The solver would have to choose the steps of a system whose errors it does not know.
    #[error(
        "the solver cannot choose the steps of this mechanism: it knows the error of a step only with integrator = \"conserving\", a spectral_radius of at most 0.95 and \
         no beam of ANCF24; give simulation.step"
    )]
    StepNotGiven,
    /// Results would have to be corrected by errors of steps that the solver does not know.
    #[error(
        "the results of this mechanism cannot be corrected: the solver knows the error of a step only with integrator = \"conserving\", a spectral_radius of at most 0.95 \
         and no beam of ANCF24; remove simulation.correction"
    )]
    ErrorNotKnown,
    /// A step before the start.
    #[error("there is no initial state to step from; initialize first")]
    NotInitialized,
    /// Too many internal steps for one call: the step is far too small.
    #[error(
        "{count:.1e} internal steps of {step:e} s would lead from t = {begin} s to t = {end} s (at most 1e9); take a larger simulation.step",
begin = decimal(*.from),
end = decimal(*.to)
)]
    TooManySteps {
        /// Number of steps.
        count: f64,
        /// Internal step, s.
        step: f64,
        /// Start, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// The drawn system does not satisfy its joints.
    #[error("{joint} is not satisfied as drawn: its two sides are {gap:.3e} apart; move the parts so that they meet")]
    NotAssembled {
        /// The joint.
        joint: String,
        /// Largest condition, m or 1.
        gap: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of steps have binary tails; what a message shows has none.
    #[test]
    fn regression_times_are_shown_without_tails() {
        assert_eq!([0.1 + 0.2, 3.0 * 0.2, 1e-9, 0.0, 12.5].map(decimal), [0.3, 0.6, 1e-9, 0.0, 12.5]);
        let error = Error::NotFinite { what: "the energy".into(), time: 3.0 * 0.2 };
        assert!(error.to_string().ends_with("at t = 0.6 s"), "{error}");
    }
}
