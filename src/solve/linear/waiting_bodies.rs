//! When a body may be eliminated where the matrix has no masses.
//!
//! A body has no stiffness of its own: its pivots are its joints, or the stiffness that eliminated neighbors leave on
//! it. Its six conditions of rigidity leave six motions. One joint more, to one neighbor or to the ground, is
//! independent of them whatever else the mechanism has, so that the body may be eliminated with all its joints to one
//! neighbor. With joints to several neighbors it waits until the others are eliminated: two balls on one rod would hold
//! its spin neither way. Then every condition on the body is eliminated with it or before it, and what can still move
//! has the stiffness of the mechanism with the later neighbors held. Bodies that wait to the end come last.

use std::ops::Range;

/// Conditions that make a body rigid.
const RIGIDITY: usize = 6;

/// Groups of unknowns: coordinates of nodes, from `bodies` on those of bodies, then multipliers.
pub struct Unordered<'a> {
    /// First group of a body.
    pub bodies: usize,
    /// Groups of multipliers.
    pub multipliers: Range<usize>,
    /// The other groups that share a block with each.
    pub links: &'a [Vec<usize>],
    /// Number of unknowns of each group.
    pub lengths: &'a [usize],
}

/// The groups of coordinates in the order `wanted`, but each body as soon as it may be eliminated.
pub fn in_time(groups: &Unordered<'_>, wanted: &[usize]) -> Vec<usize> {
    let mut ordering = Ordering {
        groups,
        rooms: groups.lengths[..groups.multipliers.start].to_vec(),
        is_hosted: vec![false; groups.links.len()],
        is_waiting: vec![false; groups.multipliers.start],
        order: Vec::with_capacity(wanted.len()),
    };
    ordering.host_bound();
    for group in wanted {
        ordering.append_or_wait(*group);
    }
    let mut order = std::mem::take(&mut ordering.order);
    order.extend(wanted.iter().filter(|group| ordering.is_waiting[**group]));
    order
}

struct Ordering<'a> {
    groups: &'a Unordered<'a>,
    /// Coordinates of each group that no condition has taken.
    rooms: Vec<usize>,
    /// Whether a multiplier, by its group, is eliminated with a group of coordinates.
    is_hosted: Vec<bool>,
    is_waiting: Vec<bool>,
    order: Vec<usize>,
}

impl Ordering<'_> {
    fn is_body(&self, group: usize) -> bool {
        group >= self.groups.bodies
    }

    /// Gives multipliers that act on one group to that group.
    fn host_bound(&mut self) {
        for multiplier in self.groups.multipliers.clone() {
            if let [only] = self.groups.links[multiplier][..] {
                self.rooms[only] = self.rooms[only].saturating_sub(self.groups.lengths[multiplier]);
                self.is_hosted[multiplier] = true;
            }
        }
    }

    /// Multipliers on `group` that nothing has taken.
    fn unhosted(&self, group: usize) -> impl Iterator<Item = usize> {
        let multipliers = &self.groups.multipliers;
        self.groups.links[group].iter().copied().filter(|other| multipliers.contains(other) && !self.is_hosted[*other])
    }

    /// Whether all conditions on a body that are left tie it to one neighbor, and leave it no motion too few.
    fn is_ready(&self, body: usize) -> bool {
        let room = self.groups.lengths[body].saturating_sub(RIGIDITY);
        let is_grounded = self.rooms[body] < room;
        let mut neighbor = None;
        let mut rows = 0;
        for multiplier in self.unhosted(body) {
            rows += self.groups.lengths[multiplier];
            for other in self.groups.links[multiplier].iter().filter(|other| **other != body) {
                if is_grounded || *neighbor.get_or_insert(*other) != *other {
                    return false;
                }
            }
        }
        rows <= self.rooms[body]
    }

    fn append_or_wait(&mut self, group: usize) {
        if self.is_body(group) && !self.is_ready(group) {
            self.is_waiting[group] = true;
            return;
        }
        let mut ready = vec![group];
        while let Some(next) = ready.pop() {
            self.append(next);
            for multiplier in self.groups.links[next].iter().filter(|other| self.groups.multipliers.contains(other)) {
                for other in &self.groups.links[*multiplier] {
                    if self.is_waiting.get(*other) == Some(&true) && self.is_ready(*other) {
                        self.is_waiting[*other] = false;
                        ready.push(*other);
                    }
                }
            }
        }
    }

    /// Appends a group, which takes the multipliers that it has room for.
    fn append(&mut self, group: usize) {
        let own: Vec<usize> = self.unhosted(group).collect();
        for multiplier in own {
            let rows = self.groups.lengths[multiplier];
            if has_room(self.rooms[group], rows, self.is_body(group)) {
                self.rooms[group] -= rows;
                self.is_hosted[multiplier] = true;
            }
        }
        self.order.push(group);
    }
}

/// Whether a group with `room` coordinates takes `rows` conditions: a node keeps a coordinate to itself, a body may be
/// held in all its motions.
pub fn has_room(room: usize, rows: usize, is_body: bool) -> bool {
    if is_body { room >= rows } else { room > rows }
}
