//! The line of a rope that is tight over wheels whose axes have one direction: straight pieces and arcs.
//!
//! Across the axes, signed radii `a`, `b` are positive where the rope runs anticlockwise. The piece from one wheel to
//! the next has the direction `(cos δ, sin δ)` with `sin(δ − θ) = (a − b)/|D|`, where `D` leads from center to center
//! at the angle `θ`. It leaves the first wheel `a (sin δ, −cos δ)` from its center. Along the axes the rope rises
//! evenly, so that its tangent does not jump where pieces meet.

use crate::math::elementary::{asin, atan2, hypot, sin_cos};
use std::f64::consts::TAU;

/// An arc that is a whole turn but for round-off, rad: the rope passes the wheel without an arc.
const NO_ARC: f64 = 1e-9;

/// A wheel, in a plane across its axis, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Its center.
    pub center: [f64; 2],
    /// Radius of the line, positive where it runs anticlockwise; 0: a point.
    pub radius: f64,
    /// Whole turns beyond the arc between both straight pieces.
    pub laps: u32,
}

/// A straight piece or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    /// Length of the line before it, m.
    begin: f64,
    /// Center of the arc, or where the straight piece begins, m.
    origin: [f64; 2],
    /// Radius with its sign, m; 0: straight.
    radius: f64,
    /// Direction where it begins, rad.
    heading: f64,
    /// Number of the wheel that an arc is on.
    wheel: Option<usize>,
}

/// The line across the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct TightLine {
    pieces: Vec<Piece>,
    /// Length, m; not a number where the wheels are too far away to compute with.
    pub length: f64,
}

/// One of two neighboring wheels is inside the other one: the number of the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoWay(pub usize);

/// A straight piece between two wheels.
#[derive(Clone, Copy)]
struct Run {
    heading: f64,
    length: f64,
}

impl TightLine {
    /// The line from the first to the last wheel, of which both may be points. `closed`: around all wheels and back,
    /// from the middle of the straight piece between the last and the first wheel; on a single wheel a circle.
    ///
    /// # Errors
    /// Two neighbors have no common tangent.
    pub fn over(wheels: &[Wheel], closed: bool) -> Result<Self, NoWay> {
        let mut line = Self { pieces: Vec::new(), length: 0.0 };
        if let ([wheel], true) = (wheels, closed) {
            line.add(0.0, wheel.radius, TAU * wheel.radius.abs(), wheel.center, Some(0));
            return Ok(line);
        }
        let count = wheels.len();
        let last = if closed { count } else { count - 1 };
        let between = |k: usize| run(&wheels[k], &wheels[(k + 1) % count]).ok_or(NoWay(k));
        let runs = (0..last).map(between).collect::<Result<Vec<_>, _>>()?;
        let mut before = None;
        if closed {
            let Run { heading, length } = runs[count - 1];
            let [x, y] = touch(&wheels[count - 1], heading);
            let (sine, cosine) = sin_cos(heading);
            line.add(heading, 0.0, 0.5 * length, [x + 0.5 * length * cosine, y + 0.5 * length * sine], None);
            before = Some(heading);
        }
        for (k, run) in runs.iter().enumerate() {
            if let Some(before) = before {
                line.add_arc(&wheels[k], k, before, run.heading);
            }
            let length = if k + 1 == count { 0.5 * run.length } else { run.length };
            line.add(run.heading, 0.0, length, touch(&wheels[k], run.heading), None);
            before = Some(run.heading);
        }
        Ok(line)
    }

    /// The arc on a wheel between two headings, in the sense of its turn.
    fn add_arc(&mut self, wheel: &Wheel, number: usize, before: f64, after: f64) {
        let between = ((after - before) * wheel.radius.signum()).rem_euclid(TAU);
        let between = if between > TAU - NO_ARC { 0.0 } else { between };
        let angle = between + TAU * f64::from(wheel.laps);
        self.add(before, wheel.radius, angle * wheel.radius.abs(), wheel.center, Some(number));
    }

    fn add(&mut self, heading: f64, radius: f64, length: f64, origin: [f64; 2], wheel: Option<usize>) {
        if length > 0.0 {
            self.pieces.push(Piece { begin: self.length, origin, radius, heading, wheel });
            self.length += length;
        } else if length.is_nan() {
            self.length = f64::NAN;
        }
    }

    /// Position (m), direction and curvature vector (1/m) after the length `s`; the later piece where two meet.
    pub fn at(&self, s: f64) -> [[f64; 2]; 3] {
        let number = self.pieces.partition_point(|piece| piece.begin <= s).saturating_sub(1);
        let Piece { begin, origin: [x, y], radius, heading, .. } = self.pieces[number];
        let along = s - begin;
        if radius == 0.0 {
            let (sine, cosine) = sin_cos(heading);
            return [[x + along * cosine, y + along * sine], [cosine, sine], [0.0; 2]];
        }
        let (sine, cosine) = sin_cos(heading + along / radius);
        [[x + radius * sine, y - radius * cosine], [cosine, sine], [-sine / radius, cosine / radius]]
    }

    /// The lengths at which pieces meet, m.
    pub fn limits(&self) -> Vec<f64> {
        self.pieces.iter().skip(1).map(|piece| piece.begin).collect()
    }

    /// The arcs: the number of the wheel, and the lengths at which the arc begins and ends, m.
    pub fn arcs(&self) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let ends = self.pieces.iter().skip(1).map(|piece| piece.begin).chain([self.length]);
        self.pieces.iter().zip(ends).filter_map(|(piece, end)| Some((piece.wheel?, [piece.begin, end])))
    }
}

/// The straight piece from wheel to wheel; none: one is inside the other.
fn run(a: &Wheel, b: &Wheel) -> Option<Run> {
    let [x, y] = [b.center[0] - a.center[0], b.center[1] - a.center[1]];
    let (distance, across) = (hypot(x, y), a.radius - b.radius);
    if distance <= across.abs() {
        return None;
    }
    let length = ((distance - across) * (distance + across)).sqrt();
    Some(Run { heading: atan2(y, x) + asin(across / distance), length })
}

/// Where a line with this heading touches a wheel.
fn touch(wheel: &Wheel, heading: f64) -> [f64; 2] {
    let (sine, cosine) = sin_cos(heading);
    [wheel.center[0] + wheel.radius * sine, wheel.center[1] - wheel.radius * cosine]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn wheel(center: [f64; 2], radius: f64, laps: u32) -> Wheel {
        Wheel { center, radius, laps }
    }

    /// Largest distance of the ends of neighboring pieces, in position and direction.
    fn gap(line: &TightLine) -> f64 {
        let near = 1e-12 * line.length;
        let step = |s: f64| {
            let [before, after] = [line.at(s - near), line.at(s)];
            (0..2).flat_map(|k| (0..2).map(move |i| (before[k][i] - after[k][i]).abs())).fold(0.0, f64::max)
        };
        line.limits().into_iter().map(step).fold(0.0, f64::max)
    }

    /// Belts have the lengths of the textbooks, open and crossed.
    #[test]
    fn belts_have_their_lengths() {
        let (small, large, distance) = (0.05, 0.15, 0.6);
        let angle = f64::asin((large - small) / distance);
        let open = 2.0 * distance * angle.cos() + large * (PI + 2.0 * angle) + small * (PI - 2.0 * angle);
        let angle = f64::asin((large + small) / distance);
        let crossed = 2.0 * distance * angle.cos() + (large + small) * (PI + 2.0 * angle);
        for (turns, length) in [([1.0, 1.0], open), ([-1.0, -1.0], open), ([1.0, -1.0], crossed)] {
            let wheels = [wheel([0.0; 2], small * turns[0], 0), wheel([distance, 0.0], large * turns[1], 0)];
            let line = TightLine::over(&wheels, true).unwrap();
            assert!((line.length - length).abs() < 1e-14, "{turns:?}: {} for {length}", line.length);
            assert!(gap(&line) < 1e-9);
            let [first, last] = [0.0, line.length].map(|s| line.at(s));
            let apart = (0..2).map(|i| (first[0][i] - last[0][i]).abs().max((first[1][i] - last[1][i]).abs()));
            assert!(apart.fold(0.0, f64::max) < 1e-14);
        }
    }

    /// Over a post from below and back up: a quarter of a turn, with whole turns added.
    #[test]
    fn whole_turns_add_to_an_arc() {
        for laps in [0, 3] {
            let ends = [wheel([-1.0, -0.1], 0.0, 0), wheel([0.1, 1.0], 0.0, 0)];
            let line = TightLine::over(&[ends[0], wheel([0.0; 2], 0.1, laps), ends[1]], false).unwrap();
            let arc = 0.1 * (FRAC_PI_2 + TAU * f64::from(laps));
            assert!((line.length - (2.0 + arc)).abs() < 1e-14);
            assert!(gap(&line) < 1e-9);
            let (number, [begin, end]) = line.arcs().next().unwrap();
            assert!(number == 1 && (begin - 1.0).abs() < 1e-14 && (end - begin - arc).abs() < 1e-14);
        }
    }

    /// A line that touches a wheel without bending has no arc on it, in whatever direction round-off turns it: a whole
    /// turn would be longer by `2πr`.
    #[test]
    fn wheels_that_are_only_touched_have_no_arc() {
        for k in 0..200 {
            let (sine, cosine) = (0.0314 * f64::from(k)).sin_cos();
            let turned = |x: f64, y: f64| [x * cosine - y * sine, x * sine + y * cosine];
            let [from, to] = [-1.0, 1.0].map(|x| wheel(turned(x, -0.1), 0.0, 0));
            let line = TightLine::over(&[from, wheel([0.0; 2], 0.1, 0), to], false).unwrap();
            assert!((line.length - 2.0).abs() < 1e-8, "{k}: {}", line.length);
        }
    }

    /// Wheels that are nowhere have a line of no length, which says so.
    #[test]
    fn wheels_that_are_nowhere() {
        for nowhere in [f64::NAN, f64::INFINITY, 1e300] {
            for closed in [true, false] {
                let wheels = [wheel([nowhere, 0.0], 0.1, 0), wheel([0.0; 2], 0.2, 0)];
                let line = TightLine::over(&wheels, closed);
                assert!(line.is_err() || line.is_ok_and(|line| !line.length.is_finite()), "{nowhere} {closed}");
            }
        }
    }

    #[test]
    fn wheels_inside_each_other_have_no_way() {
        let wheels = [wheel([0.0; 2], 0.0, 0), wheel([1.0, 0.0], 0.5, 0), wheel([1.2, 0.0], 0.1, 0)];
        assert_eq!(TightLine::over(&wheels, false), Err(NoWay(1)));
    }
}
