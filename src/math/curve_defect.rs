//! What keeps a curve from being the line of a beam: it is not finite, stands still, jumps, has a corner, or bends too
//! far in one element.
//!
//! Jumps and corners are found wherever they are, by what the derivative does not explain: `r(b) − r(a) − ∫ r' ds` is
//! the jump between a and b, `t(b) − t(a) − ∫ t' ds` the corner.

use super::Vec3;
use super::curve::Curve;
use super::integral::Integral;
use crate::math::elementary::asin;

/// What is wrong with a curve, and where. Lengths in m, angles in rad, `s` the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveDefect {
    /// The whole is a single point.
    NoLength,
    /// Position or derivatives are not finite numbers.
    NotFinite {
        /// Where.
        s: f64,
    },
    /// Its length, or how far it turns, cannot be found: it is infinite there, or oscillates faster than anything can
    /// follow.
    Unmeasured {
        /// Where it is worst.
        s: f64,
    },
    /// The derivative vanishes: there is no tangent.
    Cusp {
        /// Where.
        s: f64,
    },
    /// The curve is interrupted.
    Jump {
        /// Where.
        s: f64,
        /// How wide.
        size: f64,
        /// Length of the element in which it is.
        length: f64,
    },
    /// The tangent is.
    Corner {
        /// Where.
        s: f64,
        /// How sharp.
        angle: f64,
    },
    /// The tangent turns too far from one end of an element to the other.
    Bend {
        /// Where the element begins and ends.
        range: [f64; 2],
        /// How far.
        angle: f64,
    },
}

/// Widest jump, of the length of the element in which it is: below, the element's own interpolation is no better. The
/// paper's spring has jumps of 2e-4 of an element's length.
pub const LARGEST_JUMP: f64 = 1e-2;
/// Sharpest corner, rad, 2 degrees: what numbers of four digits leave where pieces should meet smoothly.
pub const LARGEST_CORNER: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// Farthest turning of the tangent in one element, and of the section by pretwist, rad: a right angle, beyond which the
/// interpolation is no likeness of the curve, and the bending of a pretwisted element none of the beam's.
pub const LARGEST_BEND: f64 = std::f64::consts::FRAC_PI_2;
/// Least `|r'|`, of its mean in the element.
const SLOWEST: f64 = 1e-6;
/// Places of an element between which the least `|r'|` is looked for.
const SAMPLES: usize = 16;
/// How well jumps (of the length), corners and bends (rad) are measured: far below their bounds.
const MEASURE: f64 = 1e-6;
/// Length that may be unknown, of the whole.
const UNKNOWN: f64 = 1e-6;
/// Halvings until a position is known to the last digit.
const HALVINGS: usize = 60;

/// What keeps the curve from having a length; without such a defect its nodes can be found.
pub fn of_length(curve: &Curve) -> Option<CurveDefect> {
    let [begin, end] = curve.range;
    let finite = |s: f64| curve.at(s).iter().take(2).all(|vector| vector.iter().all(|value| value.is_finite()));
    if let Some(s) = [begin, end].into_iter().find(|s| !finite(*s)) {
        return Some(CurveDefect::NotFinite { s });
    }
    if !curve.length().is_finite() {
        let s = located(begin, end, |from, to| if curve.arc(from, to).is_finite() { 0.0 } else { 1.0 });
        return Some(CurveDefect::NotFinite { s });
    }
    let length = curve.measured(&|s| curve.speed(s), begin, end, 0.0);
    if length.missed > UNKNOWN * length.value {
        return Some(CurveDefect::Unmeasured { s: length.at });
    }
    (length.value == 0.0).then_some(CurveDefect::NoLength)
}

/// What keeps the stretch between two nodes, of the arc length `length`, from being an element; [`of_length`] has found
/// nothing.
pub fn of_element(curve: &Curve, from: f64, to: f64, length: f64) -> Option<CurveDefect> {
    if let Some(s) = standstill(curve, from, to, SLOWEST * length / (to - from)) {
        return Some(CurveDefect::Cusp { s });
    }
    let jump = |from, to| unexplained(curve, (from, to), MEASURE * length, |s| curve.at(s)[0], |s| curve.at(s)[1]);
    let gap = jump(from, to);
    let size = gap.value;
    // Where the quadrature has failed, nothing tells a jump from what it missed.
    let is_known = gap.missed <= 0.5 * LARGEST_JUMP * length;
    if is_known && size > LARGEST_JUMP * length {
        return Some(CurveDefect::Jump { s: located(from, to, |from, to| jump(from, to).value), size, length });
    }
    let corner = |from, to| unexplained(curve, (from, to), MEASURE, |s| curve.tangent(s), |s| curve.tangent_rate(s));
    let gap = if is_known { corner(from, to) } else { gap };
    let is_known = is_known && gap.missed <= 0.5 * LARGEST_CORNER;
    let angle = if is_known { 2.0 * asin((0.5 * gap.value).min(1.0)) } else { 0.0 };
    if angle > LARGEST_CORNER {
        return Some(CurveDefect::Corner { s: located(from, to, |from, to| corner(from, to).value), angle });
    }
    let turning = |from, to| curve.measured(&|s| curve.tangent_rate(s).norm(), from, to, MEASURE);
    let turned = turning(from, to);
    let angle = turned.value + angle;
    if !(size + angle).is_finite() {
        let s = located(from, to, |from, to| if turning(from, to).value.is_finite() { 0.0 } else { 1.0 });
        return Some(CurveDefect::NotFinite { s });
    }
    if turned.missed > 0.5 * LARGEST_BEND {
        return Some(CurveDefect::Unmeasured { s: turned.at });
    }
    if angle > LARGEST_BEND {
        return Some(CurveDefect::Bend { range: [from, to], angle });
    }
    (!is_known).then_some(CurveDefect::Unmeasured { s: gap.at })
}

/// `|f(to) − f(from) − ∫ f' ds|`, and how well it is known.
fn unexplained(
    curve: &Curve,
    (from, to): (f64, f64),
    error: f64,
    f: impl Fn(f64) -> Vec3,
    rate: impl Fn(f64) -> Vec3,
) -> Integral {
    let explained = [0, 1, 2].map(|i| curve.measured(&|s| rate(s)[i], from, to, error));
    let value = (f(to) - f(from) - Vec3::from(explained.map(|part| part.value))).norm();
    let [x, y, z] = explained;
    Integral { value, ..x.and(y).and(z) }
}

/// Where a quantity of intervals comes from: always in the half that has more of it, between them if neither has any.
fn located(mut from: f64, mut to: f64, size: impl Fn(f64, f64) -> f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            break;
        }
        let [left, right] = [size(from, middle), size(middle, to)];
        if left == 0.0 && right == 0.0 {
            return middle;
        }
        if left >= right {
            to = middle;
        } else {
            from = middle;
        }
    }
    to
}

/// Where `|r'|` is least, if it is below `slowest` there.
fn standstill(curve: &Curve, from: f64, to: f64, slowest: f64) -> Option<f64> {
    // The sign of d|r'|²/ds.
    let quickening = |s: f64| {
        let [_, first, second] = curve.at(s);
        first.dot(&second) > 0.0
    };
    let sample = |k: usize| from + (to - from) * (k as f64 / SAMPLES as f64);
    let least = (0..SAMPLES).filter_map(|k| {
        let (mut low, mut high) = (sample(k), sample(k + 1));
        if quickening(low) || !quickening(high) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *if quickening(middle) { &mut high } else { &mut low } = middle;
        }
        Some(high)
    });
    [from, to].into_iter().chain(least).find(|s| curve.speed(*s) <= slowest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::jet::Jet;
    use std::sync::Arc;

    fn number(value: f64) -> Jet {
        Jet::constant(value)
    }

    /// The defect of a curve over [-1, 1] as a single element.
    fn defect(limits: &[f64], coordinates: impl Fn(Jet) -> [Jet; 3] + Send + Sync + 'static) -> Option<CurveDefect> {
        let coordinates = Arc::new(move |s| coordinates(Jet::variable(s)));
        let curve = Curve::new(coordinates, [-1.0, 1.0], limits.to_vec());
        of_length(&curve).or_else(|| of_element(&curve, -1.0, 1.0, curve.length()))
    }

    /// Each defect must be found where it is, at a limit of pieces or hidden in a function; `s` to the last digits.
    #[test]
    fn flaws_are_found_where_they_are() {
        let near = |s: f64, expected: f64| (s - expected).abs() < 1e-9;
        assert_eq!(defect(&[], |_| [number(3.0); 3]), Some(CurveDefect::NoLength));
        let root = defect(&[], |s| [s, (number(0.3) - s).sqrt(), number(0.0)]);
        assert!(matches!(root, Some(CurveDefect::NotFinite { s: 1.0 })), "{root:?}");
        let gap = defect(&[], |s| [s, ((s - number(0.25)) * (s - number(0.75))).sqrt(), number(0.0)]);
        // As near as the quadrature comes to the edge of what is not defined.
        assert!(matches!(gap, Some(CurveDefect::NotFinite { s }) if (s - 0.25).abs() < 1e-3), "{gap:?}");
        let infinite = defect(&[], |s| [s, (s * s).power(number(0.75)), number(0.0)]);
        assert!(matches!(infinite, Some(CurveDefect::NotFinite { s }) if near(s, 0.0)), "{infinite:?}");
        let cusp = defect(&[], |s| {
            let s = s - number(0.123);
            [s * s, s * s * s, number(0.0)]
        });
        assert!(matches!(cusp, Some(CurveDefect::Cusp { s }) if near(s, 0.123)), "{cusp:?}");
        let still = defect(&[], |s| [s * s, number(0.0), number(0.0)]);
        assert!(matches!(still, Some(CurveDefect::Cusp { s }) if near(s, 0.0)), "{still:?}");
        let jump = defect(&[], |s| [s, (s - number(0.3)).sign(), number(0.0)]);
        assert!(matches!(jump, Some(CurveDefect::Jump { s, size, .. }) if near(s, 0.3) && near(size, 2.0)), "{jump:?}");
        let corner = defect(&[], |s| [s, (s - number(0.3)).abs() * number(0.1), number(0.0)]);
        let angle = 2.0 * 0.1_f64.atan();
        assert!(
            matches!(corner, Some(CurveDefect::Corner { s, angle: a }) if near(s, 0.3) && near(a, angle)),
            "{corner:?}"
        );
        let pieces = defect(&[0.3], move |s| match s.value < 0.3 {
            true => [s, number(0.0), number(0.0)],
            false => [s, number(0.1) * (s - number(0.3)), number(0.5)],
        });
        assert!(
            matches!(pieces, Some(CurveDefect::Jump { s, size, .. }) if near(s, 0.3) && near(size, 0.5)),
            "{pieces:?}"
        );
        let pole = defect(&[], |s| [s, (s - number(0.3)).power(number(-1.0)), number(0.0)]);
        assert!(matches!(pole, Some(CurveDefect::Unmeasured { s }) if (s - 0.3).abs() < 1e-3), "{pole:?}");
        let wild = defect(&[], |s| [s, (s * number(1e6)).sin() * number(1e-3), number(0.0)]);
        assert!(matches!(wild, Some(CurveDefect::Unmeasured { .. })), "{wild:?}");
        let coil = defect(&[], |s| [s, (s * number(1e6)).sin(), (s * number(1e6)).cos()]);
        assert!(matches!(coil, Some(CurveDefect::Bend { angle, .. }) if angle > 1.9e6), "{coil:?}");
        let bend = defect(&[], |s| [s.sin(), s.cos(), number(0.0)]);
        assert!(matches!(bend, Some(CurveDefect::Bend { angle, .. }) if near(angle, 2.0)), "{bend:?}");
    }

    /// What is below the bounds must pass: a short arc, an inflexion, small jumps and corners.
    #[test]
    fn sound_curves_have_no_flaw() {
        let half = number(0.5);
        assert_eq!(defect(&[], move |s| [(half * s).sin(), (half * s).cos(), number(0.0)]), None);
        assert_eq!(defect(&[], |s| [s, s * s * s * number(0.2), number(0.0)]), None);
        assert_eq!(defect(&[], |s| [s, (s - number(0.3)).sign() * number(1e-3), number(0.0)]), None);
        assert_eq!(defect(&[], |s| [s, s.abs() * number(0.01), number(0.0)]), None);
    }
}
