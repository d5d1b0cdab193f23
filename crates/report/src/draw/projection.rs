//! From three dimensions to paper: the directions from which a picture may be seen.

/// A direction of view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// x to the right, z up, y into the depth and shortened.
    #[default]
    Oblique,
    /// Along y: x to the right, z up.
    Front,
    /// Against z: x to the right, y up.
    Top,
    /// Against x: y to the right, z up.
    Side,
    /// Isometric, from the right, the front and above: all axes are shortened by the same.
    Isometric,
}

/// The words of `--view`, the default first.
pub const PROJECTIONS: [(&str, Projection); 5] = [
    ("oblique", Projection::Oblique),
    ("front", Projection::Front),
    ("top", Projection::Top),
    ("side", Projection::Side),
    ("iso", Projection::Isometric),
];

/// The depth axis of the oblique view on paper: direction and shortening.
const DEPTH: [f64; 2] = [0.42, 0.30];

impl Projection {
    /// A point or a direction on paper before scaling: to the right, up.
    pub fn flat(self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let [half, third, sixth] = [2.0, 3.0, 6.0].map(|square: f64| square.sqrt().recip());
        match self {
            Self::Oblique => [x + DEPTH[0] * y, z + DEPTH[1] * y],
            Self::Front => [x, z],
            Self::Top => [x, y],
            Self::Side => [y, z],
            Self::Isometric => [half * (x + y), sixth * (y - x) + 2.0_f64.sqrt() * third * z],
        }
    }

    /// How far a direction points out of the paper, to who looks at it.
    pub fn toward(self, [x, y, z]: [f64; 3]) -> f64 {
        match self {
            Self::Oblique | Self::Front => -y,
            Self::Top => z,
            Self::Side => x,
            Self::Isometric => (x - y + z) / 3.0_f64.sqrt(),
        }
    }

    /// In words, for a caption.
    pub fn words(self) -> &'static str {
        match self {
            Self::Oblique => "seen obliquely: x to the right, z up, y into the depth and shortened",
            Self::Front => "seen from the front, along y: x to the right, z up",
            Self::Top => "seen from above: x to the right, y up",
            Self::Side => "seen from the right, against x: y to the right, z up",
            Self::Isometric => "isometric, seen from the right, the front and above",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// But for the oblique one, a view shows lengths in the paper as they are: what it shows and what points out of the
    /// paper add up to the length.
    #[test]
    fn views_are_right_angled() {
        for (word, view) in PROJECTIONS.into_iter().skip(1) {
            for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -2.0, 0.7]] {
                let [right, up] = view.flat(direction);
                let length: f64 = direction.iter().map(|value| value * value).sum();
                // Rounding.
                assert!((right * right + up * up + view.toward(direction).powi(2) - length).abs() < 1e-14, "{word}");
            }
        }
    }

    /// Each view is seen from its side: right, up and out of the paper are a right-handed triad, and z never points
    /// down.
    #[test]
    fn views_are_right_handed() {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (word, view) in PROJECTIONS {
            let [[a, b], [c, d], [e, f]] = axes.map(|axis| view.flat(axis));
            let [p, q, r] = axes.map(|axis| view.toward(axis));
            let determinant = p * (c * f - d * e) - q * (a * f - b * e) + r * (a * d - b * c);
            assert!(determinant > 0.0 && f >= 0.0, "{word}: {determinant}");
        }
    }
}
