//! A curve in space by a parameter `s`, with exact derivatives: arc length, turning, and where the nodes of a beam go.
//!
//! `r(s)`, `r'`, `r''` by the parameter; tangent `t = r'/|r'|`, `t' = (r'' − t (t·r''))/|r'|`; arc length `∫ |r'| ds`.

use super::Vec3;
use super::integral::Integral;
use super::jet::Jet;
use super::rotation::normal_projector;
use std::fmt;
use std::sync::Arc;

/// What gives the three coordinates of a point with their derivatives by the parameter, m.
pub type Coordinates = Arc<dyn Fn(f64) -> [Jet; 3] + Send + Sync>;

/// A curve over a range of its parameter.
#[derive(Clone)]
pub struct Curve {
    coordinates: Coordinates,
    /// The parameter at the start and at the end, ascending.
    pub range: [f64; 2],
    /// Where pieces of the curve meet, ascending, inside the range: at a limit it is the later piece that is evaluated.
    limits: Vec<f64>,
}

impl fmt::Debug for Curve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Curve").field("range", &self.range).field("limits", &self.limits).finish_non_exhaustive()
    }
}

/// How far the arc length up to a node may be off, of the element's length: what the quadrature resolves.
const ARC_AGREEMENT: f64 = 1e-14;
/// Newton's steps and halvings at most: halving alone ends at neighboring numbers after 60 or so.
const MOST_STEPS: u32 = 200;

impl Curve {
    /// Over the ascending `range`; `limits` are the places in it where its pieces meet, in any order.
    pub fn new(coordinates: Coordinates, range: [f64; 2], mut limits: Vec<f64>) -> Self {
        let [begin, end] = range;
        limits.retain(|limit| begin < *limit && *limit < end);
        limits.sort_by(f64::total_cmp);
        limits.dedup();
        Self { coordinates, range, limits }
    }

    /// `r, r', r''` at the parameter `s`: m, and m per unit of s.
    pub fn at(&self, s: f64) -> [Vec3; 3] {
        let [x, y, z] = (self.coordinates)(s);
        [
            Vec3::new(x.value, y.value, z.value),
            Vec3::new(x.first, y.first, z.first),
            Vec3::new(x.second, y.second, z.second),
        ]
    }

    /// `|r'|`, m per unit of s.
    pub fn speed(&self, s: f64) -> f64 {
        self.at(s)[1].norm()
    }

    /// `t`, unit.
    pub fn tangent(&self, s: f64) -> Vec3 {
        self.at(s)[1].normalize()
    }

    /// `t'`, 1 per unit of s.
    pub fn tangent_rate(&self, s: f64) -> Vec3 {
        let [_, first, second] = self.at(s);
        let speed = first.norm();
        normal_projector(&(first / speed)) * second / speed
    }

    /// The limits of pieces after `from` and up to `to`, where the later piece is evaluated already.
    pub fn limits_between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> + '_ {
        self.limits.iter().copied().filter(move |limit| from < *limit && *limit <= to)
    }

    /// `∫ f ds`, piece by piece; errors below `error` are not pursued.
    pub fn integral(&self, f: &impl Fn(f64) -> f64, from: f64, to: f64, error: f64) -> f64 {
        self.measured(f, from, to, error).value
    }

    /// `∫ f ds` as above, and how well it is known.
    pub fn measured(&self, f: &impl Fn(f64) -> f64, from: f64, to: f64, error: f64) -> Integral {
        let mut begin = from;
        let ends = self.limits_between(from, to).chain([to]);
        ends.map(|end| Integral::of(f, std::mem::replace(&mut begin, end), end, error))
            .fold(Integral::default(), Integral::and)
    }

    /// Arc length from one parameter to another, m.
    pub fn arc(&self, from: f64, to: f64) -> f64 {
        self.integral(&|s| self.speed(s), from, to, 0.0)
    }

    /// Arc length of the whole, m.
    pub fn length(&self) -> f64 {
        let [begin, end] = self.range;
        self.arc(begin, end)
    }

    /// The parameters of the ends of `count` elements between equal steps of the parameter.
    pub fn equal_steps(&self, count: usize) -> Vec<f64> {
        let [begin, end] = self.range;
        let inner = (0..count).map(|k| begin + (end - begin) * (k as f64 / count as f64));
        inner.chain([end]).collect()
    }

    /// The parameters of the ends of `count` elements of equal arc length.
    pub fn equal_arcs(&self, count: usize) -> Vec<f64> {
        let step = self.length() / count as f64;
        let mut nodes = vec![self.range[0]];
        for k in 1..count {
            nodes.push(self.advanced(nodes[k - 1], step));
        }
        nodes.push(self.range[1]);
        nodes
    }

    /// The parameter at which the arc from `from` has the length `arc`, m: Newton's method, kept inside a bracket.
    fn advanced(&self, from: f64, arc: f64) -> f64 {
        let (mut low, mut high) = (from, self.range[1]);
        let mut s = from + arc / self.speed(from);
        for _ in 0..MOST_STEPS {
            if !(low < s && s < high) {
                s = 0.5 * (low + high);
            }
            let excess = self.arc(from, s) - arc;
            // At the ends of the bracket no number is left between.
            if excess.abs() <= ARC_AGREEMENT * arc || s <= low || s >= high {
                break;
            }
            if excess > 0.0 {
                high = s;
            } else {
                low = s;
            }
            s -= excess / self.speed(s);
        }
        s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn curve(range: [f64; 2], coordinates: impl Fn(Jet) -> [Jet; 3] + Send + Sync + 'static) -> Curve {
        Curve::new(Arc::new(move |s| coordinates(Jet::variable(s))), range, Vec::new())
    }

    fn number(value: f64) -> Jet {
        Jet::constant(value)
    }

    /// Helix: the closed form. Ellipse with the half-axes 2 and 1: `8 E(3/4)`, the complete elliptic integral to all
    /// digits.
    #[test]
    fn arc_lengths_are_exact_to_round_off() {
        let helix = curve([0.0, 3.0], |s| [number(0.3) * s, (number(TAU) * s).cos(), (number(TAU) * s).sin()]);
        assert!((helix.length() - 3.0 * TAU.hypot(0.3)).abs() < 1e-13);
        let ellipse = curve([0.0, TAU], |s| [number(2.0) * s.cos(), s.sin(), number(0.0)]);
        assert!((ellipse.length() - 9.688_448_220_547_676).abs() < 1e-13, "{}", ellipse.length());
    }

    /// Nodes at equal arcs must be where the arc length says, also where the speed changes by a factor of a hundred.
    #[test]
    fn nodes_divide_the_arc_equally() {
        let cubic = curve([0.1, 1.0], |s| [s * s * s, s * s, number(0.0)]);
        let nodes = cubic.equal_arcs(7);
        assert_eq!((nodes[0], nodes[7], nodes.len()), (0.1, 1.0, 8));
        let step = cubic.length() / 7.0;
        for pair in nodes.windows(2) {
            assert!((cubic.arc(pair[0], pair[1]) / step - 1.0).abs() < 1e-13);
        }
        assert_eq!(cubic.equal_steps(4)[2], 0.1 + 0.9 * 0.5);
    }

    /// A piece that begins inside the range must count with its own derivatives: a straight line, then half a circle.
    #[test]
    fn pieces_are_measured_one_by_one() {
        let coordinates = |s: f64| {
            let s = Jet::variable(s);
            if s.value < 1.0 {
                return [s, number(0.0), number(0.0)];
            }
            let angle = (s - number(1.0)) * number(PI);
            [number(1.0) + angle.sin(), number(1.0) - angle.cos(), number(0.0)]
        };
        let hook = Curve::new(Arc::new(coordinates), [0.0, 2.0], vec![7.0, 1.0]);
        assert!((hook.length() - 1.0 - PI).abs() < 1e-14);
        assert_eq!(hook.limits_between(0.0, 2.0).collect::<Vec<_>>(), [1.0]);
        let rate = hook.tangent_rate(1.5);
        assert!((rate - Vec3::new(-PI, 0.0, 0.0)).norm() < 1e-14, "{rate}");
    }
}
