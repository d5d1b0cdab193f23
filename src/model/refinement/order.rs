//! How fast the errors of a motion fall with its mesh, from three meshes in turn, the coarsest of which is that of the
//! run beside the first one. A load that travels bends a wire at a kink, which no mesh resolves with its full order.

use crate::math::elementary::pow;
use crate::model::run::accuracy::Inexact;

/// The lowest order that is told from noise.
const LEAST: f64 = 0.6;
/// The highest one.
const MOST: f64 = 4.0;

/// The distances of a run from one on a coarser mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Coarse {
    /// The length of the elements of the coarser mesh, over that of the other one.
    ratio: f64,
    /// A family each, as shares of what it is compared with.
    distances: Vec<Inexact>,
}

impl Coarse {
    /// Keeps these distances from a run whose elements are so many times as long; those from a finer one tell nothing.
    pub fn of(found: Option<(f64, Vec<Inexact>)>) -> Self {
        let found = found.filter(|(ratio, _)| *ratio > 1.0);
        found.map_or_else(Self::default, |(ratio, distances)| Self { ratio, distances })
    }

    /// The order of a family whose results on a mesh `finer` times as fine are `apart` from those of that run
    /// because of the mesh; infinite: not known.
    ///
    /// The distances stand as `(ratio^p - 1)/(1 - finer^-p)` with the order `p`, which grows with it.
    pub fn order(&self, name: &str, apart: f64, finer: f64) -> f64 {
        let known = self.distances.iter().find(|own| own.name == name && own.error.is_finite());
        let Some(before) = known.filter(|_| apart > 0.0 && finer > 1.0) else { return f64::INFINITY };
        let fall = before.error / apart;
        let (mut low, mut high) = (LEAST, MOST);
        for _ in 0..40 {
            let order = 0.5 * (low + high);
            let expected = (pow(self.ratio, order) - 1.0) / (1.0 - pow(finer, -order));
            if expected < fall { low = order } else { high = order }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors `h^p` on elements of 2, 1 and 1/2, and of 2, 1 and 1/1.5.
    #[test]
    fn the_order_is_that_of_three_meshes() {
        let coarse = |order: f64| {
            let own = Inexact { name: String::from("tip.position"), error: 2_f64.powf(order) - 1.0, is_rough: false };
            Coarse::of(Some((2.0, vec![own])))
        };
        for (order, finer) in [(1.0, 2.0), (1.4, 1.5), (3.0, 2.0)] {
            let found = coarse(order).order("tip.position", 1.0 - 1.0 / f64::powf(finer, order), finer);
            assert!((found - order).abs() < 1e-9, "{found} {order}");
        }
        assert!((coarse(0.1).order("tip.position", 1.0, 2.0) - LEAST).abs() < 1e-9);
        assert!(coarse(1.0).order("tip.velocity", 1.0, 2.0).is_infinite());
    }
}
