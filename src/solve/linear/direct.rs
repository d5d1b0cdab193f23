//! The direct solver of a constrained system: front by front (`multifrontal`), and a general sparse LU (`sparse_lu`)
//! where that gives no accurate solution, as without the mass of a body or with a floating system.

use super::elimination_tree::Unknowns;
use super::multifrontal::Multifrontal;
use super::sparse_lu::SparseLu;
use super::transposed::Room;
use super::units::Units;
use super::{Regularity, Singular};
use crate::math::blocks::Blocks;

/// A matrix, and its factorization. Its pattern changes only where blocks that are zero most of the time become others:
/// the order of elimination is a function of the matrix alone.
#[derive(Debug)]
pub struct DirectSolver {
    unknowns: Unknowns,
    units: Units,
    fronts: Option<Multifrontal>,
    /// The occasional blocks that the fronts know.
    awake: Vec<usize>,
    /// Made when it is first needed.
    general: Option<Box<SparseLu>>,
    /// Whether the fronts have factorized the last matrix.
    is_frontal: bool,
    /// Whether the general one is solved with.
    is_general: bool,
    /// How many factorizations the general one had to make.
    fallbacks: u64,
}

impl DirectSolver {
    /// For the pattern of `blocks`; `units` is the natural size of each unknown.
    pub fn new(unknowns: Unknowns, units: Units, blocks: &Blocks) -> Self {
        let fronts = Multifrontal::new(unknowns, blocks);
        let awake = blocks.awake().collect();
        Self { unknowns, units, fronts, awake, general: None, is_frontal: false, is_general: false, fallbacks: 0 }
    }

    /// Takes the values of `blocks` (of the same layout as at the start) and factorizes. They must not change as long
    /// as the factorization is used.
    ///
    /// # Errors
    /// The matrix is singular, or a value not finite.
    pub fn factorize(&mut self, blocks: &Blocks) -> Result<(), Singular> {
        self.is_general = false;
        if !blocks.awake().eq(self.awake.iter().copied()) {
            self.awake = blocks.awake().collect();
            self.fronts = Multifrontal::new(self.unknowns, blocks);
        }
        let Self { units, fronts, .. } = self;
        self.is_frontal = fronts.as_mut().is_some_and(|fronts| fronts.factorize(units, blocks).is_ok());
        if self.is_frontal { Ok(()) } else { self.fall_back(blocks) }
    }

    /// Sets the scaling of all unknowns by the values of `blocks`, without a factorization, and forgets the last one.
    /// Returns whether the scaling is known.
    pub fn set_scale(&mut self, blocks: &Blocks) -> bool {
        (self.is_frontal, self.is_general) = (false, false);
        let Self { units, fronts, .. } = self;
        fronts.as_mut().map(|fronts| fronts.set_scale(units, blocks)).is_some()
    }

    /// Solves for the right side `vector`, in place, refined until the backward error is at round-off. `blocks` are
    /// those that were factorized.
    ///
    /// # Errors
    /// The solution is not finite or not accurate: the matrix is singular to working precision. `vector` is then
    /// spoilt.
    pub fn solve(&mut self, blocks: &Blocks, vector: &mut [f64]) -> Result<(), Singular> {
        if !self.is_general {
            if self.is_frontal
                && let Some(fronts) = &mut self.fronts
                && fronts.solve(blocks, vector).is_ok()
            {
                return Ok(());
            }
            self.fall_back(blocks)?;
        }
        self.general.as_mut().ok_or(Singular)?.solve(vector)
    }

    /// As [`Self::solve`], for a correction that is far smaller than what it corrects: with the factors as they are,
    /// which a solution to round-off has shown to do.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn solve_roughly(&mut self, blocks: &Blocks, vector: &mut [f64]) -> Result<(), Singular> {
        match &mut self.fronts {
            Some(fronts) if self.is_frontal && !self.is_general => {
                fronts.substitute_in(vector);
                Ok(())
            }
            _ => self.solve(blocks, vector),
        }
    }

    /// As [`Self::solve`], with the transposed matrix.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn solve_transposed(&mut self, blocks: &Blocks, vector: &mut [f64]) -> Result<(), Singular> {
        let mut room = Room::default();
        if !self.is_general {
            if self.is_frontal
                && let Some(fronts) = &mut self.fronts
                && fronts.solve_transposed(blocks, vector, &mut room).is_ok()
            {
                return Ok(());
            }
            self.fall_back(blocks)?;
        }
        self.general.as_mut().ok_or(Singular)?.solve_transposed(blocks, vector, &mut room)
    }

    /// Factorizes with the general solver, as the other one did not do.
    fn fall_back(&mut self, blocks: &Blocks) -> Result<(), Singular> {
        self.factorize_generally(blocks)?;
        self.is_general = true;
        Ok(())
    }

    fn factorize_generally(&mut self, blocks: &Blocks) -> Result<(), Singular> {
        self.fallbacks += 1;
        if self.general.is_none() {
            self.general = Some(Box::new(SparseLu::new(&self.units, blocks)?));
        }
        self.general.as_mut().ok_or(Singular)?.factorize(blocks)
    }

    /// Scaling of unknown `index`: what it is measured in.
    pub fn scale(&self, index: usize) -> f64 {
        match (&self.fronts, &self.general) {
            (_, Some(general)) if self.is_general => general.scale(index),
            (Some(fronts), _) => fronts.scale(index),
            _ => 1.0,
        }
    }

    /// Whether the factorized matrix, `blocks`, is regular to working precision. That it is the fronts may show; that
    /// it is not takes pivots sought among all rows. The answer is of the matrix alone, whatever has been solved with
    /// it.
    pub fn regularity(&mut self, blocks: &Blocks) -> Regularity {
        if self.is_frontal && self.fronts.as_mut().is_some_and(|fronts| fronts.is_surely_regular(blocks)) {
            return Regularity::Regular;
        }
        if !self.is_general && self.factorize_generally(blocks).is_err() {
            return Regularity::Unknown;
        }
        self.general.as_mut().map_or(Regularity::Unknown, |general| general.regularity())
    }

    /// Sign of the determinant of the factorized matrix; 0: not known, as the general solver keeps its exchanges to
    /// itself.
    pub fn sign(&self) -> i8 {
        self.fronts.as_ref().filter(|_| self.is_frontal).map_or(0, Multifrontal::sign)
    }

    /// How many factorizations the general solver had to make.
    pub fn fallbacks(&self) -> u64 {
        self.fallbacks
    }
}
