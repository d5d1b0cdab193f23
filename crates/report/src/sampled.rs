//! Linear systems in discrete time: their inputs are held for a step, as by a controller that samples.

use ancf14::linear::{Matrix, System};
use ancf14::model::linear::Linear;

/// The system `x[n+1] = A x[n] + B (u[n] − u₀)` of `linear`, whose inputs are held for `step`, s: exact at the ends of
/// steps, with the matrix exponential. None: the step is so long that a number is not finite.
pub fn held(linear: &Linear, step: f64) -> Option<Linear> {
    let [a, b, c, d] = [&linear.a, &linear.b, &linear.c, &linear.d].map(|own| Matrix {
        rows: own.rows,
        columns: own.columns,
        values: own.values.clone(),
    });
    let [a, b] = System::new(a, b, c, d)?.held(step)?;
    let mut sampled = linear.clone();
    sampled.a.values = a.values;
    sampled.b.values = b.values;
    Some(sampled)
}
