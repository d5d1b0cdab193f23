//! The natural sizes of unknowns, by which they can be compared in a mechanism of any size.

/// The natural size of each unknown: that of the mechanism, m, for a position, 1 for slopes, angles and directors, and
/// for multipliers, which the solvers scale by their rows.
#[derive(Clone, Debug)]
pub struct Units {
    size: f64,
    is_position: Vec<bool>,
}

impl Units {
    /// Of a mechanism of `size` m.
    pub fn new(size: f64, is_position: Vec<bool>) -> Self {
        Self { size, is_position }
    }

    /// Number of unknowns.
    pub fn count(&self) -> usize {
        self.is_position.len()
    }

    /// The sizes, in the order of the unknowns.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.is_position.iter().map(|is_position| if *is_position { self.size } else { 1.0 })
    }
}
