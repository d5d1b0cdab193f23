//! The order of the blocks of a system's tangent: those of elements, bodies, load points and springs.

use super::System;
use std::ops::Range;

/// Blocks of a spring: one for each pair of its sides.
const OF_SPRING: usize = 4;

/// The numbers of the blocks of the tangent, which come first in the matrix of every solver.
#[derive(Clone, Copy, Debug)]
pub(super) struct TangentLayout {
    first_body: usize,
    first_load_point: usize,
    first_spring: usize,
}

impl TangentLayout {
    pub fn of(system: &System) -> Self {
        let first_body = system.mesh.elements.len();
        let first_load_point = first_body + system.bodies.len();
        let load_points: usize = system.loads.iter().map(|load| load.points.len()).sum();
        Self { first_body, first_load_point, first_spring: first_load_point + load_points }
    }

    pub fn element(self, number: usize) -> usize {
        number
    }

    pub fn body(self, number: usize) -> usize {
        self.first_body + number
    }

    /// The blocks of the points of all loads, load after load.
    pub fn load_points(self) -> Range<usize> {
        self.first_load_point..self.first_spring
    }

    /// The blocks of a spring, by pairs of its sides: aa, ab, ba, bb.
    pub fn spring(self, number: usize) -> Range<usize> {
        let first = self.first_spring + OF_SPRING * number;
        first..first + OF_SPRING
    }
}
