//! The natural cubic spline through points over their chord length: twice differentiable, straight at both ends.
//!
//! Between `P_i` and `P_(i+1)`, h apart, with second derivatives `M_i` and a, b the distances to the two:
//! `r = (M_i b³ + M_(i+1) a³)/6h + (P_i/h − M_i h/6) b + (P_(i+1)/h − M_(i+1) h/6) a`.

use super::Vec3;
use super::curve::Curve;
use super::jet::Jet;
use std::sync::Arc;

/// The spline; its parameter is the chord length from the first point, m. Two points or more, no two neighbors at one
/// position.
pub fn through(points: &[Vec3]) -> Curve {
    let mut knots = vec![0.0];
    for pair in points.windows(2) {
        knots.push(knots[knots.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let bends = second_derivatives(points, &knots);
    let range = [0.0, knots[knots.len() - 1]];
    let limits = knots.clone();
    let points = points.to_vec();
    let coordinates = move |s: f64| {
        let piece = knots.partition_point(|knot| *knot <= s).clamp(1, knots.len() - 1) - 1;
        let h = knots[piece + 1] - knots[piece];
        let (a, b) = (s - knots[piece], knots[piece + 1] - s);
        let [p0, p1, m0, m1] = [points[piece], points[piece + 1], bends[piece], bends[piece + 1]];
        let [c0, c1] = [p0 / h - m0 * (h / 6.0), p1 / h - m1 * (h / 6.0)];
        let place = (m0 * b.powi(3) + m1 * a.powi(3)) / (6.0 * h) + c0 * b + c1 * a;
        let first = (m1 * (a * a) - m0 * (b * b)) / (2.0 * h) + c1 - c0;
        let second = (m0 * b + m1 * a) / h;
        [0, 1, 2].map(|i| Jet { value: place[i], first: first[i], second: second[i] })
    };
    Curve::new(Arc::new(coordinates), range, limits)
}

/// `M_i`: `h_(i-1) M_(i-1) + 2 (h_(i-1) + h_i) M_i + h_i M_(i+1) = 6 (d_i − d_(i-1))`, d the chords' slopes, and 0 at
/// both ends.
fn second_derivatives(points: &[Vec3], knots: &[f64]) -> Vec<Vec3> {
    let last = points.len() - 1;
    let step = |i: usize| knots[i + 1] - knots[i];
    let slope = |i: usize| (points[i + 1] - points[i]) / step(i);
    // Elimination downwards: `M_i + upper_i M_(i+1) = right_i`.
    let (mut upper, mut right) = (vec![0.0; last + 1], vec![Vec3::zeros(); last + 1]);
    for i in 1..last {
        let pivot = 2.0 * (step(i - 1) + step(i)) - step(i - 1) * upper[i - 1];
        upper[i] = step(i) / pivot;
        right[i] = ((slope(i) - slope(i - 1)) * 6.0 - right[i - 1] * step(i - 1)) / pivot;
    }
    for i in (1..last).rev() {
        right[i] = right[i] - right[i + 1] * upper[i];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 3]; 5] =
        [[0.0, 0.0, 0.0], [1.0, 0.2, 0.0], [1.5, 1.0, 0.3], [1.4, 2.0, -0.5], [3.0, 2.0, 1.0]];

    fn points() -> Vec<Vec3> {
        POINTS.map(Vec3::from).to_vec()
    }

    /// What a natural spline is: through its points, twice continuously differentiable, without curvature at its ends.
    #[test]
    fn spline_is_smooth_and_natural() {
        let points = points();
        let spline = through(&points);
        let mut s = 0.0;
        for (k, point) in points.iter().enumerate() {
            s += if k > 0 { (point - points[k - 1]).norm() } else { 0.0 };
            let [place, first, second] = spline.at(s);
            assert!((place - point).norm() < 1e-14);
            let [_, first_before, second_before] = spline.at(s.next_down());
            assert!((first - first_before).norm() < 1e-13 && (second - second_before).norm() < 1e-12);
        }
        let [begin, end] = spline.range;
        assert!(spline.at(begin)[2].norm() == 0.0 && spline.at(end)[2].norm() < 1e-13);
    }

    /// Two points are a straight line, and a turned order of the points the same curve.
    #[test]
    fn spline_has_no_favorite_direction() {
        let line = through(&points()[..2]);
        let [_, first, second] = line.at(0.3);
        assert!((first.norm() - 1.0).abs() < 1e-15 && second.norm() == 0.0);
        let (forth, back) = (through(&points()), through(&points().into_iter().rev().collect::<Vec<_>>()));
        let length = forth.range[1];
        for k in 0..=20 {
            let s = length * f64::from(k) / 20.0;
            assert!((forth.at(s)[0] - back.at(length - s)[0]).norm() < 1e-14);
        }
    }
}
