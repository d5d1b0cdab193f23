//! In which order a constrained system is eliminated, and where its numbers go then: the fronts of the multifrontal
//! method.
//!
//! Unknowns that blocks never part make a group: the coordinates of a node or of a body, the multipliers of a joint. A
//! front eliminates one group of coordinates and multipliers that act on it, each in the first front that has
//! coordinates left for it: what only joints hold has no pivots without them. What is left of a front is added into its
//! parent, the front of the first unknown of its border. Bodies come last, or early, which keeps fronts small where
//! there are many: with masses anywhere, without masses where their joints give them pivots (waiting_bodies.rs).

use super::front::{Front, Indices, Piece, Run, short};
use super::frontal_matrix::Shape;
use super::ordering::minimum_degree;
use super::waiting_bodies::{Unordered, has_room, in_time};
use crate::math::blocks::Blocks;
use std::ops::Range;

/// As how many groups of coordinates a body counts in the search for an order: more than the neighbors of a node of a
/// beam.
const BODY_WEIGHT: usize = 4;

/// What the unknowns of a constrained system are, in their order.
#[derive(Clone, Copy, Debug)]
pub struct Unknowns {
    /// Number of coordinates of nodes.
    pub nodes: usize,
    /// Number of coordinates of bodies.
    pub bodies: usize,
    /// Number of multipliers.
    pub multipliers: usize,
    /// Whether the matrix has the masses in it, with which a body's own part of it is regular.
    pub inertia: bool,
}

impl Unknowns {
    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.nodes + self.bodies
    }

    /// Number of all.
    pub fn count(&self) -> usize {
        self.coordinates() + self.multipliers
    }
}

/// Conditions that hold a body in all its motions.
const WELD: usize = 6;

/// Most groups that a condition holds at one time: the sides of a joint or of a gear. One on more slides along a beam.
const MOST_HELD: usize = 4;

/// Without masses, how many times fewer multiplications bodies must take early than last: where they are few, one order
/// is as good as the other, and last they have pivots for sure.
const WORTHWHILE: u64 = 2;

/// Most values of all factors and of the largest front: 2 GB.
const MOST_VALUES: u64 = 1 << 28;

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
    pub children: Vec<u32>,
    /// `from` is a row of a front's matrix, `to` one of its parent's.
    pub runs: Vec<Run>,
    /// Of each renumbered unknown, its number in the system.
    pub unknowns: Vec<u32>,
    /// Length of all factors together.
    pub storage: usize,
    /// Length of what fronts leave at the same time.
    pub rests: usize,
    /// Longest columns of a border.
    pub right: usize,
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

    /// The unknowns of a group.
    fn unknowns(&self, group: usize) -> Range<usize> {
        self.starts[group]..self.starts[group + 1]
    }

    /// The groups of the unknowns `range`.
    fn within(&self, range: Range<usize>) -> Range<usize> {
        if range.is_empty() { 0..0 } else { self.of[range.start]..self.of[range.end - 1] + 1 }
    }

    /// For each group, in order, the other groups that share a block with it.
    fn links(&self, blocks: &Blocks) -> Vec<Vec<usize>> {
        let mut links: Vec<Vec<usize>> = vec![Vec::new(); self.count()];
        for (_, block) in blocks.in_use() {
            for row in self.within(block.row..block.row + block.rows) {
                for column in self.within(block.column..block.column + block.columns) {
                    if row != column {
                        links[row].push(column);
                        links[column].push(row);
                    }
                }
            }
        }
        sort_each(&mut links);
        links
    }
}

/// The neighbors of each of the first `coordinates` groups among them: those that share a block with it, and those that
/// a multiplier ties to it. None where a multiplier acts on nothing, or on another multiplier.
fn coordinate_graph(links: &[Vec<usize>], coordinates: usize) -> Option<Vec<Vec<usize>>> {
    let (of_coordinates, of_multipliers) = links.split_at(coordinates);
    let among = |list: &Vec<usize>| list.iter().copied().filter(|other| *other < coordinates).collect();
    let mut graph: Vec<Vec<usize>> = of_coordinates.iter().map(among).collect();
    for tied in of_multipliers {
        if tied.is_empty() || tied.iter().any(|group| *group >= coordinates) {
            return None;
        }
        if tied.len() > MOST_HELD {
            continue;
        }
        for group in tied {
            graph[*group].extend(tied.iter().filter(|other| *other != group));
        }
    }
    sort_each(&mut graph);
    Some(graph)
}

/// Lets each of the groups from `bodies` on count for many, by vertices with the same neighbors: the groups tied to a
/// body stay in the borders up to it, so that it should come late.
fn weigh_bodies(graph: &mut Vec<Vec<usize>>, bodies: usize) {
    for body in bodies..graph.len() {
        for _ in 1..BODY_WEIGHT {
            let (own, tied) = (graph.len(), graph[body].clone());
            tied.iter().for_each(|group| graph[*group].push(own));
            graph[body].push(own);
            graph.push([tied, vec![body]].concat());
        }
    }
    sort_each(graph);
}

fn sort_each(lists: &mut [Vec<usize>]) {
    for list in lists {
        list.sort_unstable();
        list.dedup();
    }
}

impl Fronts {
    /// The order for the pattern of the `blocks` in use. None where there is no such order, since a multiplier acts on
    /// nothing, or where the fronts need too much memory.
    pub fn new(kinds: Unknowns, blocks: &Blocks) -> Option<Self> {
        let groups = Groups::new(kinds.count(), blocks);
        let multipliers = groups.starts.partition_point(|start| *start < kinds.coordinates())..groups.count();
        let bodies = groups.starts.partition_point(|start| *start < kinds.nodes);
        let links = groups.links(blocks);
        let coordinates = multipliers.start;
        let mut graph = coordinate_graph(&links, coordinates)?;
        weigh_bodies(&mut graph, bodies);
        let mut order = minimum_degree(&graph)?;
        order.retain(|group| *group < coordinates);
        let in_order = |list: &[usize], filled, most| Order::new(&groups, &links, list, filled, most);
        // Groups that a joint may hold in all their motions, and how much worse a later order may be.
        let none = coordinates..coordinates;
        let (early, least) = if bodies == coordinates {
            (None, 1)
        } else if kinds.inertia {
            (in_order(&order, none.clone(), u64::MAX), 1)
        } else {
            let lengths: Vec<usize> = (0..groups.count()).map(|group| groups.unknowns(group).len()).collect();
            let unordered = Unordered { bodies, multipliers, links: &links, lengths: &lengths };
            (in_order(&in_time(&unordered, &order), bodies..coordinates, u64::MAX), WORTHWHILE)
        };
        order.sort_by_key(|group| *group >= bodies);
        let most = early.as_ref().map_or(u64::MAX, |early| early.operations.saturating_mul(least));
        let order = in_order(&order, none, most).or(early)?;
        let fronts = Self::with_order(&order, blocks);
        let most = fronts.storage.max(fronts.rests).max(blocks.values().len());
        u32::try_from(most).is_ok().then_some(fronts)
    }

    fn with_order(order: &Order<'_>, blocks: &Blocks) -> Self {
        let (mut borders, mut runs, mut children, mut unknowns) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut storage, mut longest, mut right) = (0, 0, 0);
        let mut places = Places::default();
        let mut fronts: Vec<Front> = Vec::with_capacity(order.members.len());
        for (front, border) in order.borders.iter().enumerate() {
            let begin = [unknowns.len(), borders.len(), runs.len(), children.len()];
            for group in &order.members[front] {
                unknowns.extend(order.groups.unknowns(*group).map(short));
            }
            let pivots = begin[0]..unknowns.len();
            let mut row = pivots.len();
            for group in border {
                let length = order.groups.unknowns(*group).len();
                let run = |to: usize| Run::new(row, to, length);
                push_run(&mut borders, begin[1], run(order.renumbered[*group]));
                if let Some(parent) = order.parent(front) {
                    push_run(&mut runs, begin[2], run(order.row_in(parent, *group)));
                }
                row += length;
            }
            children.extend(order.children[front].iter().copied().map(short));
            let shape = Shape { pivots: pivots.len(), border: row - pivots.len() };
            // Its own is written when those of its children have been read.
            for child in &order.children[front] {
                let rest = fronts[*child].rest();
                places.give_back(rest.start, rest.len());
            }
            let rest = places.take(shape.rest());
            fronts.push(Front {
                pivots: pivots.into(),
                below: short(shape.border),
                border: (begin[1]..borders.len()).into(),
                start: short(storage),
                rest: short(rest),
                pieces: Indices::default(),
                children: (begin[3]..children.len()).into(),
                runs: (begin[2]..runs.len()).into(),
            });
            storage += shape.factors();
            longest = longest.max(shape.stride());
            right = right.max(shape.right());
        }
        let rests = places.end;
        // Lists that doubled as they grew may be half empty.
        borders.shrink_to_fit();
        runs.shrink_to_fit();
        children.shrink_to_fit();
        unknowns.shrink_to_fit();
        let mut all =
            Self { fronts, borders, pieces: Vec::new(), children, runs, unknowns, storage, rests, right, longest };
        all.cut(order, blocks);
        all
    }

    /// Cuts the blocks into pieces, each for the front of the first of its two groups that is eliminated.
    fn cut(&mut self, order: &Order<'_>, blocks: &Blocks) {
        let groups = order.groups;
        let mut pieces: Vec<(usize, Piece)> = Vec::new();
        for (source, block) in blocks.in_use() {
            for row in groups.within(block.row..block.row + block.rows) {
                for column in groups.within(block.column..block.column + block.columns) {
                    let front = order.front_of[row].min(order.front_of[column]);
                    let stride = self.fronts[front].shape().stride();
                    let target = order.row_in(front, row) + stride * order.row_in(front, column);
                    let [rows, columns] = [row, column].map(|group| groups.unknowns(group));
                    let piece = Piece {
                        source: short(source + rows.start - block.row + (columns.start - block.column) * block.rows),
                        stride: short(block.rows),
                        target: short(target),
                        rows: short(rows.len()),
                        columns: short(columns.len()),
                    };
                    pieces.push((front, piece));
                }
            }
        }
        pieces.sort_by_key(|(front, _)| *front);
        let mut first = 0;
        for (front, own) in self.fronts.iter_mut().enumerate() {
            let count = pieces[first..].partition_point(|(other, _)| *other == front);
            own.pieces = (first..first + count).into();
            first += count;
        }
        // Collecting a vector in place would keep the room of the numbers that are left out.
        self.pieces = pieces.iter().map(|(_, piece)| *piece).collect();
    }
}

/// Memory that is taken and given back in a known order.
#[derive(Debug, Default)]
struct Places {
    /// Gaps: where each begins, and how long it is.
    gaps: Vec<(usize, usize)>,
    end: usize,
}

impl Places {
    /// The first gap that is long enough, or new memory.
    fn take(&mut self, length: usize) -> usize {
        if let Some(gap) = self.gaps.iter_mut().find(|(_, room)| *room >= length) {
            let begin = gap.0;
            *gap = (begin + length, gap.1 - length);
            return begin;
        }
        self.end += length;
        self.end - length
    }

    /// Makes a gap, one with its neighbors.
    fn give_back(&mut self, begin: usize, length: usize) {
        let place = self.gaps.partition_point(|(other, _)| *other < begin);
        self.gaps.insert(place, (begin, length));
        self.gaps.dedup_by(|next, before| {
            let touches = before.0 + before.1 == next.0;
            before.1 += if touches { next.1 } else { 0 };
            touches
        });
        self.gaps.retain(|(_, room)| *room > 0);
    }
}

/// Which groups are eliminated in which front, and which are left then.
struct Order<'a> {
    groups: &'a Groups,
    /// The front of each group.
    front_of: Vec<usize>,
    /// First renumbered unknown of each group.
    renumbered: Vec<usize>,
    /// Groups of each front: one of coordinates, then multipliers.
    members: Vec<Vec<usize>>,
    /// Groups that are left of each front, in the order of their elimination.
    borders: Vec<Vec<usize>>,
    /// Fronts whose rest goes into each.
    children: Vec<Vec<usize>>,
    /// Multiplications that an elimination takes.
    operations: u64,
}

impl<'a> Order<'a> {
    /// Of the groups of coordinates in the order `list`; `links` are the neighbors of each group, `filled` the groups
    /// that one joint may hold in all their motions. None where an elimination takes more than `most` multiplications
    /// or too much memory.
    fn new(groups: &'a Groups, links: &[Vec<usize>], list: &[usize], filled: Range<usize>, most: u64) -> Option<Self> {
        let multipliers = list.len()..groups.count();
        let mut front_of = vec![0; groups.count()];
        list.iter().enumerate().for_each(|(front, group)| front_of[*group] = front);
        let mut members: Vec<Vec<usize>> = list.iter().map(|group| vec![*group]).collect();
        let mut rooms: Vec<usize> = list.iter().map(|group| groups.unknowns(*group).len()).collect();
        // Those that only one group can take, as the rigidity of a body, before those that may go elsewhere.
        let (bound, free): (Vec<usize>, Vec<usize>) = multipliers.partition(|multiplier| links[*multiplier].len() == 1);
        for multiplier in bound.into_iter().chain(free) {
            let rows = groups.unknowns(multiplier).len();
            let mut tied: Vec<usize> = links[multiplier].iter().map(|group| front_of[*group]).collect();
            tied.sort_unstable();
            // One that keeps a coordinate to itself. With as many conditions as coordinates there may be no pivot: a
            // rod between two balls turns about itself all the same. Only a weld is sure to hold all.
            let roomy = |least: usize| tied.iter().find(|front| rooms[**front] >= least);
            let taken = |front: &&usize| has_room(rooms[**front], rows, filled.contains(&list[**front]));
            let exact = roomy(rows).filter(|_| rows == WELD);
            // The gradient of a slide by most groups is 0: it has its pivot behind all of them.
            let first = if tied.len() > MOST_HELD { None } else { tied.iter().find(taken).or(exact) };
            let host = first.or(tied.last()).copied().unwrap_or_default();
            rooms[host] = rooms[host].saturating_sub(rows);
            front_of[multiplier] = host;
            members[host].push(multiplier);
        }
        let (mut renumbered, mut count) = (vec![0; groups.count()], 0);
        for group in members.iter().flatten() {
            renumbered[*group] = count;
            count += groups.unknowns(*group).len();
        }
        // What is eliminated later: neighbors in the matrix, and what children leave.
        let mut borders: Vec<Vec<usize>> = vec![Vec::new(); list.len()];
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); list.len()];
        let length = |list: &[usize]| -> u64 { list.iter().map(|group| groups.unknowns(*group).len() as u64).sum() };
        let (mut operations, mut values) = (0_u64, 0);
        for front in 0..list.len() {
            let own = members[front].iter().flat_map(|group| &links[*group]);
            let left = children[front].iter().flat_map(|child| &borders[*child]);
            let mut border: Vec<usize> = own.chain(left).copied().filter(|group| front_of[*group] > front).collect();
            border.sort_unstable_by_key(|group| renumbered[*group]);
            border.dedup();
            if let Some(first) = border.first() {
                children[front_of[*first]].push(front);
            }
            let (pivots, below) = (length(&members[front]), length(&border));
            operations = operations.saturating_add((below..below + pivots).map(|left| left * left).sum());
            values += pivots * (pivots + 2 * below);
            let is_too_large = values + below * below > MOST_VALUES || pivots > u64::from(u16::MAX);
            if operations > most || is_too_large {
                return None;
            }
            borders[front] = border;
        }
        Some(Self { groups, front_of, renumbered, members, borders, children, operations })
    }

    /// The front that gets what is left of another one.
    fn parent(&self, front: usize) -> Option<usize> {
        self.borders[front].first().map(|group| self.front_of[*group])
    }

    /// The first row of a group in a front.
    fn row_in(&self, front: usize, group: usize) -> usize {
        let before = self.members[front].iter().chain(&self.borders[front]).take_while(|other| **other != group);
        before.map(|other| self.groups.unknowns(*other).len()).sum()
    }
}

/// Appends a run, or lengthens the last one since `start` that it goes on from.
fn push_run(runs: &mut Vec<Run>, start: usize, run: Run) {
    if runs[start..].last_mut().is_some_and(|last| last.take_in(run)) {
        return;
    }
    runs.push(run);
}
