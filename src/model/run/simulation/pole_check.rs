//! A pole as a run shows it: the check of linear systems by the solver itself.

use super::solver::Solver;
use super::{Simulation, failure, wrong};
use crate::fmi::{Failure, Model};
use crate::math::elementary::{acos, ln};
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::variation::Variation;
use crate::solve::linearization::poles::Pole;
use crate::solve::modes::subspace::dot;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Largest motion of the run, over the size of the mechanism or rad: nonlinear terms have its square.
const AMPLITUDE: f64 = 1e-5;
/// Length of the run, in periods, and at most in times over which the motion fades by e.
const PERIODS: f64 = 20.0;
const FADINGS: f64 = 7.0;
/// Samples of the motion in a period.
const SAMPLES: f64 = 24.0;
/// Internal steps of a period: the midpoint rule is off by `(ω h)²/12`, 2e-5 of the frequency.
pub const STEPS: f64 = 400.0;

impl Simulation {
    /// The pole that a run shows which begins at the start of this simulation, at rest, moved a little by the vector of
    /// `pole`, a vibration.
    ///
    /// # Errors
    /// The model is one of equilibria, or a step fails.
    pub fn observe_pole(&mut self, pole: &Pole) -> Result<[f64; 2], Failure> {
        if matches!(self.runner.solver, Solver::Statics(_) | Solver::None) {
            return Err(wrong(String::from("a run in time checks a pole: this is a static analysis")));
        }
        let system = Arc::clone(&self.runner.system);
        let (mut change, mut frames) = (Variation::default(), FrameCache::default());
        let state = &mut self.runner.state;
        let (start, begin) = (state.q.clone(), state.time);
        frames.set(&system, &state.q, &state.triads);
        let mut filter = vec![0.0; start.len()];
        system.mass_times(MassAt::new(&state.prescribed.drives, &frames), &pole.shape, &mut filter);

        let factor = AMPLITUDE / system.correction_size(&pole.shape).0;
        let ([real, imaginary], [q_real, q_imaginary]) = (pole.value, &pole.parts);
        change.set_zero(state);
        for (index, (own_real, own_imaginary)) in q_real.iter().zip(q_imaginary).enumerate() {
            change.lists.q[index] = factor * own_real;
            change.lists.velocity[index] = factor * (real * own_real - imaginary * own_imaginary);
        }
        change.apply(&system, 1.0, state, &mut frames);
        self.runner.set_motion("the velocities of the mode", &mut Vec::new()).map_err(|error| failure(&error))?;

        let period = TAU / imaginary;
        let fading = if real < 0.0 { FADINGS / -real } else { f64::INFINITY };
        let count = (SAMPLES * (PERIODS * period).min(fading) / period).ceil().max(SAMPLES);
        let mut signal = Vec::new();
        let interval = period / SAMPLES;
        for number in 0..=count as usize {
            if number > 0 {
                self.advance(begin + number as f64 * interval)?;
            }
            let moved: Vec<f64> = self.runner.state.q.iter().zip(&start).map(|(now, start)| now - start).collect();
            signal.push(dot(&filter, &moved));
        }
        Ok(fitted(&signal, interval))
    }
}

/// The pole of a vibration with the values `signal`, `interval` s from each other (Prony), by least squares:
/// `x_(k+1) = a x_k + b x_(k−1)`.
fn fitted(signal: &[f64], interval: f64) -> [f64; 2] {
    let (last, now, next) = (&signal[..signal.len() - 2], &signal[1..signal.len() - 1], &signal[2..]);
    let [[xx, xy], [_, yy]] = [[dot(now, now), dot(now, last)], [0.0, dot(last, last)]];
    let [x, y] = [dot(now, next), dot(last, next)];
    let determinant = xx * yy - xy * xy;
    let (a, b) = ((x * yy - y * xy) / determinant, (y * xx - x * xy) / determinant);
    let size = (-b).sqrt();
    [ln(size) / interval, acos(0.5 * a / size) / interval]
}
