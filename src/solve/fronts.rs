//! In which order a constrained system is eliminated, and where its numbers go then: the fronts of the multifrontal method.
//!
//! Unknowns that blocks never part make a group: the coordinates of a node or of a body, the multipliers of a joint. A front eliminates one
//! group of coordinates and the multipliers that all other coordinates of which are gone: a multiplier has no pivot of its own before.
//! What is left of a front is added into its parent, the front of the first unknown of its border. Bodies come last: without a mass they have
//! pivots only when what they are joined to is gone.

use super::front_matrix::Shape;
use super::linear::minimum_degree;
use crate::math::blocks::Blocks;
use std::ops::Range;

/// Unknowns that are eliminated together. They are renumbered in the order of their elimination.
#[derive(Clone, Debug, Default)]
pub struct Front {
    /// Its pivots, renumbered: coordinates, then multipliers.
    pub pivots: Range<usize>,
    /// Of its dense matrix.
    pub shape: Shape,
    /// Runs of the border among the unknowns: [`Fronts::borders`].
    pub border: Range<usize>,
    /// Where its dense matrix begins.
    pub start: usize,
    /// What is added into it: [`Fronts::pieces`].
    pub pieces: Range<usize>,
    /// Fronts whose rest is added into it: [`Fronts::children`].
    pub children: Range<usize>,
    /// Where the rows of its own rest lie in its parent: [`Fronts::runs`].
    pub runs: Range<usize>,
}

/// A part of a block that lies within one front.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Place of its first value among those of the blocks.
    pub source: usize,
    /// Distance of its columns there.
    pub stride: usize,
    /// Place of its first value in the matrix of the front.
    pub target: usize,
    /// First row, not renumbered.
    pub row: usize,
    /// First column, not renumbered.
    pub column: usize,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
}

/// Neighbouring rows.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The first one where they come from.
    pub from: usize,
    /// The first one where they go to.
    pub to: usize,
    /// How many.
    pub length: usize,
}

/// All fronts, in the order of their elimination; children come before parents.
#[derive(Debug)]
pub struct Fronts {
    /// The fronts.
    pub fronts: Vec<Front>,
    /// `from` is a row of a front's matrix, `to` a renumbered unknown.
    pub borders: Vec<Run>,
    /// Parts of the matrix, front after front.
    pub pieces: Vec<Piece>,
    /// Children of each front, front after front.
    pub children: Vec<usize>,
    /// `from` is a row of a front's matrix, `to` one of its parent's.
    pub runs: Vec<Run>,
    /// Of each renumbered unknown, its number in the system.
    pub unknowns: Vec<usize>,
    /// Length of all dense matrices together.
    pub storage: usize,
    /// Longest column of a front.
    pub longest: usize,
}

/// Groups of unknowns that no block parts.
struct Groups {
    /// First unknown of each; at the end the number of unknowns.
    starts: Vec<usize>,
    /// Group of each unknown.
    of: Vec<usize>,
}

impl Groups {
    fn new(size: usize, blocks: &Blocks) -> Self {
        let mut begins = vec![false; size + 1];
        begins[0] = true;
        begins[size] = true;
        for block in blocks.layout() {
            for place in [block.row, block.row + block.rows, block.column, block.column + block.columns] {
                begins[place] = true;
            }
        }
        let starts: Vec<usize> = (0..=size).filter(|place| begins[*place]).collect();
        let lengths = starts.windows(2).map(|ends| ends[1] - ends[0]).enumerate();
        let of = lengths.flat_map(|(group, length)| std::iter::repeat_n(group, length)).collect();
        Self { starts, of }
    }

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The groups of the unknowns `range`.
    fn within(&self, range: Range<usize>) -> Range<usize> {
        if range.is_empty() { 0..0 } else { self.of[range.start]..self.of[range.end - 1] + 1 }
    }
}

impl Fronts {
    /// For the pattern of `blocks`, of `size` unknowns; those up to `kinds[0]` are of nodes, up to `kinds[1]` of bodies, the others multipliers. None where
    /// there is no such order: a multiplier acts on nothing.
    pub fn new(size: usize, kinds: [usize; 2], blocks: &Blocks) -> Option<Self> {
        let groups = Groups::new(size, blocks);
        let multipliers = groups.starts.partition_point(|start| *start < kinds[1])..groups.count();
        let bodies = groups.starts.partition_point(|start| *start < kinds[0]);
        let mut links: Vec<Vec<usize>> = vec![Vec::new(); groups.count()];
        for block in blocks.layout() {
            for row in groups.within(block.row..block.row + block.rows) {
                for column in groups.within(block.column..block.column + block.columns) {
                    if row != column {
                        links[row].push(column);
                        links[column].push(row);
                    }
                }
            }
        }
        for list in &mut links {
            list.sort_unstable();
            list.dedup();
        }
        // Coordinates alone: those that a multiplier ties together are neighbours.
        let coordinates = multipliers.start;
        let mut graph: Vec<Vec<usize>> = (0..coordinates)
            .map(|group| links[group].iter().copied().filter(|other| *other < coordinates).collect())
            .collect();
        for multiplier in multipliers.clone() {
            let tied = &links[multiplier];
            if tied.is_empty() || tied.iter().any(|group| *group >= coordinates) {
                return None;
            }
            for group in tied {
                graph[*group].extend(tied.iter().filter(|other| *other != group));
            }
        }
        for list in &mut graph {
            list.sort_unstable();
            list.dedup();
        }
        let mut order = minimum_degree(&graph)?;
        order.sort_by_key(|group| *group >= bodies);
        Some(Self::with_order(&groups, &links, &order, multipliers, blocks))
    }

    fn with_order(
        groups: &Groups,
        links: &[Vec<usize>],
        order: &[usize],
        multipliers: Range<usize>,
        blocks: &Blocks,
    ) -> Self {
        // The front of each group.
        let mut front_of = vec![0; groups.count()];
        order.iter().enumerate().for_each(|(front, group)| front_of[*group] = front);
        let mut members: Vec<Vec<usize>> = order.iter().map(|group| vec![*group]).collect();
        for multiplier in multipliers {
            let host = links[multiplier].iter().map(|group| front_of[*group]).max().unwrap_or_default();
            front_of[multiplier] = host;
            members[host].push(multiplier);
        }
        let length = |group: usize| groups.starts[group + 1] - groups.starts[group];
        let (mut unknowns, mut renumbered) = (Vec::with_capacity(groups.of.len()), vec![0; groups.count()]);
        let mut fronts = vec![Front::default(); order.len()];
        for (front, members) in fronts.iter_mut().zip(&members) {
            front.pivots.start = unknowns.len();
            for group in members {
                renumbered[*group] = unknowns.len();
                unknowns.extend(groups.starts[*group]..groups.starts[*group + 1]);
            }
            front.pivots.end = unknowns.len();
        }

        // Borders: groups that are eliminated later, from the matrix and from what children leave.
        let mut borders: Vec<Vec<usize>> = vec![Vec::new(); fronts.len()];
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); fronts.len()];
        for front in 0..fronts.len() {
            let later = |group: &usize| front_of[*group] > front;
            let own = members[front].iter().flat_map(|group| &links[*group]).copied().filter(later);
            let left = children[front].iter().flat_map(|child| &borders[*child]).copied().filter(later);
            let mut border: Vec<usize> = own.chain(left).collect();
            border.sort_unstable_by_key(|group| renumbered[*group]);
            border.dedup();
            if let Some(first) = border.first() {
                children[front_of[*first]].push(front);
            }
            borders[front] = border;
        }

        let mut all = Self {
            fronts,
            borders: Vec::new(),
            pieces: Vec::new(),
            children: Vec::new(),
            runs: Vec::new(),
            unknowns,
            storage: 0,
            longest: 0,
        };
        // Row of a group in a front.
        let row_in = |all: &Self, front: usize, group: usize| {
            let own = &all.fronts[front];
            if front_of[group] == front {
                return renumbered[group] - own.pivots.start;
            }
            let before = borders[front].iter().take_while(|other| **other != group);
            own.pivots.len() + before.map(|other| length(*other)).sum::<usize>()
        };
        for front in 0..all.fronts.len() {
            let start = all.borders.len();
            let mut row = all.fronts[front].pivots.len();
            for group in &borders[front] {
                push_run(&mut all.borders, start, Run { from: row, to: renumbered[*group], length: length(*group) });
                row += length(*group);
            }
            let end = all.borders.len();
            let first = all.children.len();
            all.children.extend(&children[front]);
            let own = &mut all.fronts[front];
            own.shape = Shape { pivots: own.pivots.len(), border: row - own.pivots.len() };
            (own.border, own.start, own.children) = (start..end, all.storage, first..all.children.len());
            all.storage += own.shape.size();
            all.longest = all.longest.max(own.shape.stride());
        }
        for front in 0..all.fronts.len() {
            let start = all.runs.len();
            if let Some(parent) = borders[front].first().map(|group| front_of[*group]) {
                let mut from = all.fronts[front].pivots.len();
                for group in &borders[front] {
                    let run = Run { from, to: row_in(&all, parent, *group), length: length(*group) };
                    push_run(&mut all.runs, start, run);
                    from += run.length;
                }
            }
            all.fronts[front].runs = start..all.runs.len();
        }

        let mut pieces: Vec<(usize, Piece)> = Vec::new();
        let mut source = 0;
        for block in blocks.layout() {
            for row in groups.within(block.row..block.row + block.rows) {
                for column in groups.within(block.column..block.column + block.columns) {
                    let front = front_of[row].min(front_of[column]);
                    let place =
                        row_in(&all, front, row) + all.fronts[front].shape.stride() * row_in(&all, front, column);
                    let [own_row, own_column] = [groups.starts[row], groups.starts[column]];
                    let piece = Piece {
                        source: source + own_row - block.row + (own_column - block.column) * block.rows,
                        stride: block.rows,
                        target: all.fronts[front].start + place,
                        row: own_row,
                        column: own_column,
                        rows: length(row),
                        columns: length(column),
                    };
                    pieces.push((front, piece));
                }
            }
            source += block.rows * block.columns;
        }
        pieces.sort_by_key(|(front, _)| *front);
        let mut first = 0;
        for (front, own) in all.fronts.iter_mut().enumerate() {
            let count = pieces[first..].partition_point(|(other, _)| *other == front);
            own.pieces = first..first + count;
            first += count;
        }
        all.pieces = pieces.into_iter().map(|(_, piece)| piece).collect();
        all
    }
}

/// Appends a run, or lengthens the last one since `start` that it goes on from.
fn push_run(runs: &mut Vec<Run>, start: usize, run: Run) {
    if let Some(last) = runs[start..].last_mut()
        && last.from + last.length == run.from
        && last.to + last.length == run.to
    {
        last.length += run.length;
        return;
    }
    runs.push(run);
}
