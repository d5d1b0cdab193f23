//! The vibrations of a mechanism that turns, by its speed: followed from speed to speed, with critical speeds and the
//! limit of stability.

use super::linear::{check_poles, not_found};
use super::steady::{Frame, Rotor, Turning};
use super::{Simulation, failure, wrong};
use crate::fmi::Failure;
use crate::math::elementary::hypot;
use crate::solve::linear::dense::Complex;
use crate::solve::linear::eigen::Eigen;
use crate::solve::linearization::independent::Selection;
use crate::solve::linearization::poles::PoleKind;
use crate::solve::linearization::steady::matrix;
use crate::solve::linearization::tracking::{Spectrum, circle, continued, moves, whirl};

pub use crate::solve::linearization::tracking::Whirl;

/// Intervals of speeds are halved so often at most where it is not clear which mode is which.
const MOST_HALVINGS: u32 = 8;
/// Critical speeds and the limit of stability are found to this share of them.
const ACCURATE: f64 = 1e-7;
const MOST_ITERATIONS: usize = 60;
/// How far beside a critical speed one is looked at that has no steady rotation, as a share of it.
const BESIDE: f64 = 1e-5;
/// Sweeps of a critical speed by the secant rule.
const SWEEPS: usize = 30;
/// Damping ratio of a mode that fades beyond doubt.
const FADING: f64 = 1e-8;
/// A mode of which this share is a circle does not answer to a load that goes round the other way.
const ROUND: f64 = 0.99;
/// Poles this near to each other have vectors of one space.
const JOINED: f64 = 1e-5;

/// The speeds, and how many modes are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The name of the drive.
    pub drive: String,
    /// Its rates, ascending, rad/s.
    pub speeds: Vec<f64>,
    /// Gravity is left out.
    pub is_weightless: bool,
    /// How many modes are followed: the softest ones of the first speed.
    pub count: usize,
}

/// A mode at one speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Real and imaginary part of its pole, rad/s; the imaginary part changes its sign where a mode in a frame that
    /// turns stands still in it.
    pub value: [f64; 2],
    /// How it turns about the axis.
    pub whirl: Whirl,
    /// Whether it grows.
    pub is_unstable: bool,
}

impl Point {
    /// Its frequency with damping, rad/s.
    pub fn frequency(&self) -> f64 {
        self.value[1].abs()
    }

    /// Its damping ratio.
    pub fn damping_ratio(&self) -> f64 {
        let size = hypot(self.value[0], self.value[1]);
        if size == 0.0 { 0.0 } else { -self.value[0] / size }
    }
}

/// The force that excites a mode at a critical speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excitation {
    /// A force with the frequency of the rotation in the frame of the modes: of an unbalance in the fixed frame, of a
    /// load that stands still outside in the one that turns.
    Once,
    /// A force that stands still in the frame that turns: of an unbalance.
    TurnsAlong,
}

/// A speed at which the rotation excites a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Critical {
    /// The speed, rad/s.
    pub speed: f64,
    /// The number of the mode, from 0.
    pub mode: usize,
    /// How the mode turns.
    pub whirl: Whirl,
    /// The force that excites it.
    pub excitation: Excitation,
}

/// The vibrations by the speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Campbell {
    /// The name of the drive.
    pub drive: String,
    /// The axes in which the vibrations have their frequencies.
    pub frame: Frame,
    /// The speeds, rad/s.
    pub speeds: Vec<f64>,
    /// Each mode at all speeds.
    pub modes: Vec<Vec<Point>>,
    /// The part that each moves most at the last speed, in words.
    pub moves: Vec<String>,
    /// Critical speeds, ascending.
    pub critical: Vec<Critical>,
    /// The least speed at which a motion grows, rad/s; none: there is none up to the last speed.
    pub stability_limit: Option<f64>,
    /// How often it was not certain which mode continues which: modes that come close exchange their shapes.
    pub uncertain: usize,
    /// Sentences about the modes: which continues which, and the mesh.
    pub warnings: Vec<String>,
}

/// The system at one speed, with the modes that are followed.
struct Stop {
    turning: Turning,
    spectrum: Spectrum,
    /// The numbers of the followed modes in the spectrum.
    followed: Vec<usize>,
    /// Their vectors, for the next speed: those of an earlier one where modes of different origin coincide.
    known: Vec<Eigen>,
}

/// Follows modes.
struct Follower<'a> {
    rotor: &'a Rotor<'a>,
    frame: Frame,
    selection: &'a Selection,
    uncertain: usize,
}

fn not_certain(uncertain: usize) -> String {
    let plural = if uncertain == 1 { "" } else { "s" };
    format!(
        "at {uncertain} step{plural} of the speed it is not certain which mode continues which: modes come close there \
         and exchange their shapes; take smaller steps of the speed"
    )
}

impl Follower<'_> {
    /// The state at `speed`, with its coordinates and its modes.
    fn look(&self, speed: f64, from: Option<&Turning>) -> Result<(Turning, Selection, Spectrum), Failure> {
        let system = &*self.rotor.system;
        let turning = self.rotor.turning(speed, from)?;
        let base = &turning.bases[0];
        let selection = self.rotor.selection(base, &self.selection.chosen)?;
        let seen = (self.frame == Frame::Turning).then_some(&turning.rotation);
        let a = matrix(system, base, &selection, seen).map_err(|error| failure(&error))?;
        let spectrum = Spectrum::new(system, base, &selection, &a, speed).map_err(|_| not_found())?;
        Ok((turning, selection, spectrum))
    }

    /// The stop at `speed` after `last`, over others between where need be.
    fn advance(&mut self, last: &Stop, speed: f64, halvings: u32) -> Result<Stop, Failure> {
        let (turning, _, spectrum) = self.look(speed, Some(&last.turning))?;
        let (followed, is_certain) = continued(&last.known, &spectrum.modes);
        let from = last.turning.rotation.speed;
        if !is_certain && halvings > 0 && from != speed {
            let between = self.advance(last, 0.5 * (from + speed), halvings - 1)?;
            return self.advance(&between, speed, halvings - 1);
        }
        self.uncertain += usize::from(!is_certain);
        let vectors = |mode: usize| spectrum.modes[followed[mode]].clone();
        let joins = |mode: usize| {
            let own = vectors(mode);
            let is_near = |a: &Eigen, b: &Eigen, share: f64| (a.value - b.value).norm() <= share * a.size();
            (0..followed.len()).any(|other| {
                other != mode
                    && is_near(&own, &vectors(other), JOINED)
                    && !is_near(&last.known[mode], &last.known[other], JOINED)
            })
        };
        let known = (0..followed.len()).map(|mode| if joins(mode) { last.known[mode].clone() } else { vectors(mode) });
        let known = known.collect();
        Ok(Stop { turning, spectrum, followed, known })
    }
}

impl Stop {
    fn points(&self, rotor: &Rotor, selection: &Selection) -> Vec<Point> {
        let point = |own: &usize| {
            let mode = &self.spectrum.modes[*own];
            Point {
                value: [mode.value.re, mode.value.im],
                whirl: whirl(&rotor.system, &self.turning.bases[0], &self.turning.rotation, selection, mode),
                is_unstable: self.spectrum.kinds[*own] == PoleKind::Unstable,
            }
        };
        self.followed.iter().map(point).collect()
    }

    fn moves(&self, rotor: &Rotor, selection: &Selection) -> Vec<String> {
        let own = |mode: &usize| {
            let (base, rotation) = (&self.turning.bases[0], &self.turning.rotation);
            moves(&rotor.system, base, rotation, selection, &self.spectrum.modes[*mode])
        };
        self.followed.iter().map(own).collect()
    }

    /// The share of a mode that is a circle, negative against the rotation.
    fn circle(&self, rotor: &Rotor, selection: &Selection, mode: usize) -> f64 {
        let (base, rotation) = (&self.turning.bases[0], &self.turning.rotation);
        circle(&rotor.system, base, rotation, selection, &self.spectrum.modes[self.followed[mode]])
    }

    fn value(&self, mode: usize) -> Complex {
        self.spectrum.modes[self.followed[mode]].value
    }

    fn speed(&self) -> f64 {
        self.turning.rotation.speed
    }

    fn lacks(&self, mode: usize, kind: Lack) -> f64 {
        let Complex { re: real, im: imaginary } = self.value(mode);
        match kind {
            Lack::Frequency(Excitation::Once) => imaginary.abs() - self.speed().abs(),
            Lack::Frequency(Excitation::TurnsAlong) => imaginary,
            Lack::Damping => real,
        }
    }

    /// Whether a mode fades so fast that round-off does not tell otherwise.
    fn fades(&self, mode: usize) -> bool {
        let value = self.value(mode);
        value.re < -FADING * value.norm()
    }
}

/// A number that is 0 at a speed that is looked for.
#[derive(Clone, Copy, Debug)]
enum Lack {
    /// The distance of a frequency from that of the excitation.
    Frequency(Excitation),
    /// The real part of a pole.
    Damping,
}

impl Simulation {
    /// The vibrations of the mechanism at the speeds of `sweep`.
    ///
    /// # Errors
    /// The mechanism does not turn steadily, or has too many states.
    pub fn campbell(&self, sweep: &Sweep) -> Result<Campbell, Failure> {
        let rotor = Rotor::new(self, &sweep.drive, sweep.is_weightless)?;
        let Some(first) = sweep.speeds.first().copied() else {
            return Err(wrong(String::from("no speed is given; give at least one")));
        };
        // Every frame is right at rest.
        let moving = sweep.speeds.iter().copied().find(|speed| *speed != 0.0).unwrap_or(first);
        let (selection, frame) = rotor.frame(&rotor.turning(moving, None)?)?;
        check_poles(2 * selection.chosen.len())?;
        let mut follower = Follower { rotor: &rotor, frame, selection: &selection, uncertain: 0 };
        let (turning, own, spectrum) = follower.look(first, None)?;
        let followed = spectrum.softest(sweep.count);
        let known = followed.iter().map(|mode| spectrum.modes[*mode].clone()).collect();
        let mut last = Stop { turning, spectrum, followed, known };
        let mut modes: Vec<Vec<Point>> = last.points(&rotor, &own).into_iter().map(|point| vec![point]).collect();
        let (mut critical, mut limit) = (Vec::new(), last.spectrum.is_unstable().then_some(first));
        for speed in sweep.speeds.iter().skip(1) {
            let next = follower.advance(&last, *speed, MOST_HALVINGS)?;
            let own = rotor.selection(&next.turning.bases[0], &selection.chosen)?;
            let points = next.points(&rotor, &own);
            for (mode, point) in points.iter().enumerate() {
                modes[mode].push(*point);
                for excitation in [Excitation::Once, Excitation::TurnsAlong] {
                    let is_asked = excitation == Excitation::Once || frame == Frame::Turning;
                    let kind = Lack::Frequency(excitation);
                    let [before, after] = [&last, &next].map(|stop| stop.lacks(mode, kind));
                    if !is_asked || before == 0.0 || before * after > 0.0 {
                        continue;
                    }
                    // Loads that stand still outside go round against the rotation in the frame that turns.
                    let goes_with = frame == Frame::Turning && next.circle(&rotor, &own, mode) > ROUND;
                    if excitation == Excitation::Once && goes_with {
                        continue;
                    }
                    // A mode that stands still in that frame whirls with the rotation; beyond, it falls behind.
                    let whirl = match (excitation, point.whirl) {
                        (Excitation::TurnsAlong, Whirl::Backward) => Whirl::Forward,
                        (_, own) => own,
                    };
                    let speed = follower.crossing(&last, &next, (mode, kind))?;
                    critical.push(Critical { speed, mode, whirl, excitation });
                }
            }
            if limit.is_none() && next.spectrum.is_unstable() {
                let growing = (0..points.len()).find(|mode| points[*mode].is_unstable && last.fades(*mode));
                limit = Some(match growing {
                    Some(mode) => follower.crossing(&last, &next, (mode, Lack::Damping))?,
                    None => follower.limit(&last, *speed)?,
                });
            }
            last = next;
        }
        let own = rotor.selection(&last.turning.bases[0], &selection.chosen)?;
        let moves = last.moves(&rotor, &own);
        critical.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let Follower { uncertain, .. } = follower;
        Ok(Campbell {
            drive: sweep.drive.clone(),
            frame,
            speeds: sweep.speeds.clone(),
            modes,
            moves,
            critical,
            stability_limit: limit,
            uncertain,
            warnings: (uncertain > 0).then(|| not_certain(uncertain)).into_iter().collect(),
        })
    }
}

impl Follower<'_> {
    /// The speed between `last` and `next` at which a mode lacks nothing (Illinois rule).
    fn crossing(&mut self, last: &Stop, next: &Stop, (mode, kind): (usize, Lack)) -> Result<f64, Failure> {
        let [mut near, mut far] = [last, next].map(|stop| (stop.speed(), stop.lacks(mode, kind)));
        for _ in 0..SWEEPS {
            let speed = far.0 - far.1 * (far.0 - near.0) / (far.1 - near.1);
            let stop = match self.advance(last, speed, MOST_HALVINGS) {
                Ok(stop) => stop,
                // A critical speed itself may have no steady rotation: nothing holds the mode there.
                Err(_) if (speed - far.0).abs() <= 2.0 * BESIDE * speed.abs() => return Ok(speed),
                Err(_) => self.advance(last, (1.0 - BESIDE) * speed, MOST_HALVINGS)?,
            };
            let (speed, value) = (stop.speed(), stop.lacks(mode, kind));
            if value == 0.0 || (speed - far.0).abs() <= ACCURATE * speed.abs() {
                return Ok(speed);
            }
            if value * far.1 < 0.0 {
                near = far;
            } else {
                near.1 *= 0.5;
            }
            far = (speed, value);
        }
        Ok(far.0)
    }

    /// The least speed between `last` and `end` at which a motion grows, by bisection.
    fn limit(&self, last: &Stop, end: f64) -> Result<f64, Failure> {
        let (mut stable, mut unstable) = (last.speed(), end);
        for _ in 0..MOST_ITERATIONS {
            if (unstable - stable).abs() <= ACCURATE * unstable.abs() {
                break;
            }
            let middle = 0.5 * (stable + unstable);
            let (_, _, spectrum) = self.look(middle, Some(&last.turning))?;
            *if spectrum.is_unstable() { &mut unstable } else { &mut stable } = middle;
        }
        Ok(0.5 * (stable + unstable))
    }
}
