//! The constant mass matrix, factorized once for a system: `M⁻¹`.
//!
//! It falls apart into chains of unknowns that have nothing to do with each other: along a beam the coordinates along
//! x, those along y, those along z, and the angles; each coordinate of a body. The three axes have the same masses and
//! share a factor. In the order of the nodes a chain has entries beside its diagonal only.

use super::Singular;
use super::cholesky::Cholesky;
use crate::math::blocks::Blocks;

/// Axes of space: so many chains may be alike.
const AXES: usize = 3;

/// Unknowns that masses tie together, and those like them along the next axes.
#[derive(Debug)]
pub struct Chain {
    /// How many axes it stands for: 1 or 3.
    pub width: usize,
    /// The unknowns along the first axis; those along the next ones follow each of them.
    pub unknowns: Vec<usize>,
    factor: Cholesky,
}

impl Chain {
    /// `vector = M⁻¹ vector` of its own unknowns.
    pub fn solve(&self, vector: &mut [f64]) {
        if self.width == AXES {
            self.factor.solve_at::<AXES>(&self.unknowns, vector);
        } else {
            self.factor.solve_at::<1>(&self.unknowns, vector);
        }
    }

    /// Whether `other` is the same along axis number `axis`.
    fn is_like(&self, other: &Self, axis: usize) -> bool {
        let mut pairs = self.unknowns.iter().zip(&other.unknowns);
        self.factor == other.factor && pairs.all(|(first, next)| first + axis == *next)
    }
}

/// The chains of a system.
#[derive(Debug)]
pub struct MassFactor {
    /// In the order of their first unknowns.
    pub chains: Vec<Chain>,
}

impl MassFactor {
    /// Of the mass matrix of `coordinates` unknowns that `blocks` hold.
    ///
    /// # Errors
    /// Something has no mass.
    pub fn new(coordinates: usize, blocks: &Blocks) -> Result<Self, Singular> {
        // Of each unknown one of its chain that does not come later, at last the first one; the last unknown in its
        // column.
        let mut chain: Vec<usize> = (0..coordinates).collect();
        let mut last: Vec<usize> = (0..coordinates).collect();
        each_entry(coordinates, blocks, |row, column, _| {
            let [a, b] = [row, column].map(|unknown| root(&mut chain, unknown));
            (chain[a.max(b)], last[column]) = (a.min(b), last[column].max(row));
        });
        let mut chains: Vec<Chain> = Vec::new();
        // Of each unknown its position in its chain; of each first unknown the number of its chain.
        let (mut slot, mut number) = (vec![0; coordinates], vec![0; coordinates]);
        for unknown in 0..coordinates {
            let begin = root(&mut chain, unknown);
            chain[unknown] = begin;
            if begin == unknown {
                number[unknown] = chains.len();
                chains.push(Chain { width: 1, unknowns: Vec::new(), factor: Cholesky::default() });
            }
            let own = &mut chains[number[begin]].unknowns;
            slot[unknown] = own.len();
            own.push(unknown);
        }
        for own in &mut chains {
            own.unknowns.shrink_to_fit();
            own.factor = Cholesky::new(own.unknowns.iter().map(|unknown| slot[last[*unknown]]));
        }
        each_entry(coordinates, blocks, |row, column, value| {
            chains[number[chain[row]]].factor.column_mut(slot[column])[slot[row] - slot[column]] += value;
        });
        let mut diagonal = Vec::new();
        for own in &mut chains {
            own.factor.factorize(&mut diagonal)?;
        }
        Ok(Self { chains: merged(chains) })
    }

    /// `vector = M⁻¹ vector`.
    pub fn solve(&self, vector: &mut [f64]) {
        self.chains.iter().for_each(|chain| chain.solve(vector));
    }
}

/// Calls `entry` with row, column and value of all entries on and below the diagonal.
fn each_entry(coordinates: usize, blocks: &Blocks, mut entry: impl FnMut(usize, usize, f64)) {
    for (number, block) in blocks.layout().iter().enumerate() {
        if block.row.max(block.column) >= coordinates || block.rows == 0 {
            continue;
        }
        for (column, values) in blocks.block(number).chunks_exact(block.rows).enumerate() {
            let column = block.column + column;
            for (row, value) in (block.row..).zip(values) {
                if row >= column && *value != 0.0 {
                    entry(row, column, *value);
                }
            }
        }
    }
}

/// The first unknown of the chain that `unknown` is known to be in; the way there becomes shorter.
fn root(chain: &mut [usize], mut unknown: usize) -> usize {
    while chain[unknown] != unknown {
        chain[unknown] = chain[chain[unknown]];
        unknown = chain[unknown];
    }
    unknown
}

/// Makes one of each three neighbors that are alike.
fn merged(chains: Vec<Chain>) -> Vec<Chain> {
    let mut all = Vec::with_capacity(chains.len());
    let mut rest = chains.into_iter();
    while let Some(mut own) = rest.next() {
        if let [second, third, ..] = rest.as_slice()
            && own.is_like(second, 1)
            && own.is_like(third, 2)
        {
            own.width = AXES;
            rest.nth(1);
        }
        all.push(own);
    }
    all
}
