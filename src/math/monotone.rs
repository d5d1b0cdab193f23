//! Cubic interpolation that is monotone wherever its points are: once continuously differentiable, and never beyond two
//! neighboring points (Fritsch and Carlson 1980, with the slopes of Fritsch and Butland 1984, which are those of
//! PCHIP).

use super::jet::Jet;

/// The derivative at each point. `x` ascends and has two points or more; `is_periodic`: the last point is the first one
/// again.
pub fn slopes(x: &[f64], y: &[f64], is_periodic: bool) -> Vec<f64> {
    let secant = |k: usize| (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
    let length = |k: usize| x[k + 1] - x[k];
    let last = x.len() - 1;
    let inner = |before: usize, after: usize| mean([length(before), length(after)], [secant(before), secant(after)]);
    if last == 1 {
        return if is_periodic { vec![0.0; 2] } else { vec![secant(0); 2] };
    }
    let mut slopes = vec![0.0; x.len()];
    for (k, slope) in slopes.iter_mut().enumerate() {
        *slope = match k {
            _ if is_periodic && (k == 0 || k == last) => inner(last - 1, 0),
            0 => end([length(0), length(1)], [secant(0), secant(1)]),
            k if k == last => end([length(last - 1), length(last - 2)], [secant(last - 1), secant(last - 2)]),
            k => inner(k - 1, k),
        };
    }
    slopes
}

/// The derivative between two intervals: the weighted harmonic mean of their secants; 0 at an extremum.
fn mean(lengths: [f64; 2], secants: [f64; 2]) -> f64 {
    if secants[0] * secants[1] <= 0.0 {
        return 0.0;
    }
    let weights = [lengths[0] + 2.0 * lengths[1], 2.0 * lengths[0] + lengths[1]];
    (weights[0] + weights[1]) / (weights[0] / secants[0] + weights[1] / secants[1])
}

/// The derivative at an end, from the intervals next to it: that of a parabola through three points, bounded such that
/// nothing overshoots.
fn end(lengths: [f64; 2], secants: [f64; 2]) -> f64 {
    let sum = lengths[0] + lengths[1];
    let slope = ((sum + lengths[0]) * secants[0] - lengths[0] * secants[1]) / sum;
    if slope * secants[0] <= 0.0 {
        0.0
    } else if secants[0] * secants[1] <= 0.0 && slope.abs() > 3.0 * secants[0].abs() {
        3.0 * secants[0]
    } else {
        slope
    }
}

/// The cubic between two points with the given derivatives, and its derivatives, at `x`.
pub fn cubic(ends: [f64; 2], values: [f64; 2], slopes: [f64; 2], x: f64) -> Jet {
    let length = ends[1] - ends[0];
    let secant = (values[1] - values[0]) / length;
    let second = (3.0 * secant - 2.0 * slopes[0] - slopes[1]) / length;
    let third = (slopes[0] + slopes[1] - 2.0 * secant) / (length * length);
    let step = x - ends[0];
    Jet {
        value: values[0] + step * (slopes[0] + step * (second + step * third)),
        first: slopes[0] + step * (2.0 * second + 3.0 * third * step),
        second: 2.0 * second + 6.0 * third * step,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand, from the formulas of PCHIP.
    #[test]
    fn slopes_are_those_of_pchip() {
        let slopes = slopes(&[0.0, 1.0, 3.0, 4.0, 6.0], &[0.0, 1.0, 2.0, 2.0, 5.0], false);
        // (2*1+2)*1/3 - 0.5/3 = 7/6; 9/(5/1 + 4/0.5) = 9/13; 0 next to a flat interval; ((2*2+1)*1.5 - 0)/3 = 2.5.
        for (slope, expected) in slopes.iter().zip([7.0 / 6.0, 9.0 / 13.0, 0.0, 0.0, 2.5]) {
            assert!((slope - expected).abs() < 1e-15, "{slopes:?}");
        }
    }

    /// An end must not overshoot, and a period must join with one slope.
    #[test]
    fn ends_are_bounded_and_periods_join() {
        let x = [0.0, 1.0, 2.0, 3.0];
        assert_eq!(slopes(&x, &[0.0, 0.1, -5.0, -5.0], false)[0], 3.0 * 0.1);
        assert_eq!(slopes(&x, &[0.0, 1.0, 9.0, 9.0], false)[0], 0.0);
        let periodic = slopes(&x, &[0.0, 2.0, -2.0, 0.0], true);
        assert_eq!(periodic[0], 2.0);
        assert_eq!(periodic[0], periodic[3]);
    }
}
