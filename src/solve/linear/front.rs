//! A front of the multifrontal method as numbers: which unknowns it eliminates, and where what belongs to it is. The
//! elimination tree makes them (elimination_tree.rs).

use super::frontal_matrix::Shape;
use std::ops::Range;

/// A range of indices of 32 bits: a front has several, and long beams have many fronts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Indices {
    begin: u32,
    end: u32,
}

impl Indices {
    /// As a range.
    #[inline]
    pub fn range(self) -> Range<usize> {
        self.begin as usize..self.end as usize
    }

    /// How many.
    #[inline]
    pub fn count(self) -> usize {
        (self.end - self.begin) as usize
    }
}

impl From<Range<usize>> for Indices {
    fn from(range: Range<usize>) -> Self {
        Self { begin: short(range.start), end: short(range.end) }
    }
}

/// A number in 32 bits; `Fronts::new` gives up where one is too large for that.
pub fn short(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

/// Unknowns that are eliminated together. They are renumbered in the order of their elimination.
#[derive(Clone, Debug, Default)]
pub struct Front {
    /// Its pivots, renumbered: coordinates, then multipliers.
    pub pivots: Indices,
    /// Number of rows of the border.
    pub below: u32,
    /// Runs of the border among the unknowns: `Fronts::borders`.
    pub border: Indices,
    /// Where its factors begin.
    pub start: u32,
    /// Where what it leaves begins.
    pub rest: u32,
    /// What is added into it: `Fronts::pieces`.
    pub pieces: Indices,
    /// Fronts whose rest is added into it: `Fronts::children`.
    pub children: Indices,
    /// Where the rows of its own rest lie in its parent: `Fronts::runs`.
    pub runs: Indices,
}

impl Front {
    /// Of its dense matrix.
    #[inline]
    pub fn shape(&self) -> Shape {
        Shape { pivots: self.pivots.count(), border: self.below as usize }
    }

    /// Where its factors are.
    #[inline]
    pub fn factors(&self) -> Range<usize> {
        let start = self.start as usize;
        start..start + self.shape().factors()
    }

    /// Where what it leaves is, until its parent has taken it.
    #[inline]
    pub fn rest(&self) -> Range<usize> {
        let start = self.rest as usize;
        start..start + self.shape().rest()
    }
}

/// A part of a block that lies within one front.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Position of its first value among those of the blocks.
    pub source: u32,
    /// Distance of its columns there.
    pub stride: u32,
    /// Position of its first value in the columns of the front.
    pub target: u32,
    /// Number of rows.
    pub rows: u32,
    /// Number of columns.
    pub columns: u32,
}

/// Neighboring rows.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    from: u32,
    to: u32,
    length: u32,
}

impl Run {
    /// Of `length` rows.
    pub fn new(from: usize, to: usize, length: usize) -> Self {
        Self { from: short(from), to: short(to), length: short(length) }
    }

    /// Grows by `next` if that goes on where this one ends; returns whether it does.
    pub fn take_in(&mut self, next: Self) -> bool {
        let goes_on = self.from + self.length == next.from && self.to + self.length == next.to;
        self.length += if goes_on { next.length } else { 0 };
        goes_on
    }

    /// Where they come from.
    #[inline]
    pub fn from(self) -> Range<usize> {
        self.from as usize..(self.from + self.length) as usize
    }

    /// Where they go to.
    #[inline]
    pub fn to(self) -> Range<usize> {
        self.to as usize..(self.to + self.length) as usize
    }
}
