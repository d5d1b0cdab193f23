//! Independent coordinates: as many of the system's as the constraints leave, in which all changes are told.
//!
//! The turn of a body about fixed axes, `½ Σ d × dd` over its directors `d`, stands for its directors, which are never
//! independent: those of a body that turns would be the coordinates of a rotating frame.

use crate::math::blocks::Blocks;
use crate::math::vectors::{set_vec3, vec3};
use crate::math::{Mat3, Vec3};
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::system::System;
use crate::solve::linear::dense::{Dense, PivotedQr};

/// How much rather coordinates of bodies depend on the others than those of nodes, and directors than both.
const BODY_WEIGHT: f64 = 1e3;
const DIRECTOR_WEIGHT: f64 = 1e6;
/// Share of a condition that is left when it follows from others: round-off, times the weights.
const ROUND_OFF: f64 = 1e-12;
/// Factor that makes known coordinates the last ones of the pivots: a power of 2, which changes no digit.
const LAST: f64 = 1.0 / (1_u64 << 60) as f64;
/// Coordinates of a position, the first ones of every node and body.
const POSITION: usize = 3;

/// An independent coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Independent {
    /// One of the system's.
    Coordinate(usize),
    /// The turn of a body about a fixed axis.
    Turn {
        /// The number of the body.
        body: usize,
        /// The axis.
        axis: usize,
    },
}

/// The independent coordinates, and how all others follow them.
#[derive(Clone, Debug)]
pub struct Selection {
    /// The coordinates.
    pub chosen: Vec<Independent>,
    /// Changes of all coordinates with each of them, which the constraints allow: a column each.
    pub shapes: Dense,
    /// The axes that they are counted along, where these are not the global ones.
    axes: Option<Mat3>,
}

impl Selection {
    /// Selects by the gradients of the constraints in `kkt_blocks`, at the coordinates `q`, along `axes`; the
    /// coordinates `known` where they are given. None: the constraints are redundant, or nothing can move.
    pub fn new(
        system: &System,
        kkt_blocks: &Blocks,
        q: &[f64],
        (axes, known): (&Mat3, Option<&[Independent]>),
        released: usize,
    ) -> Option<Self> {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        let turns = POSITION * system.bodies.len();
        let mut gradient = Dense::zeros(conditions + turns, coordinates + turns);
        for (number, block) in kkt_blocks.layout().iter().enumerate() {
            if block.row < coordinates || block.column >= coordinates {
                continue;
            }
            for (entry, value) in kkt_blocks.block(number).iter().enumerate() {
                let (row, column) = (block.row - coordinates + entry % block.rows, block.column + entry / block.rows);
                gradient.column_mut(column)[row] += value;
            }
        }
        for (body, own) in system.bodies.iter().enumerate() {
            for axis in 0..POSITION {
                let row = conditions + POSITION * body + axis;
                for local in POSITION..BODY {
                    let mut director = [0.0; POSITION];
                    director[local % POSITION] = 1.0;
                    let turn = vec3(q, own.start + local - local % POSITION).cross(&Vec3::from(director)) * 0.5;
                    gradient.column_mut(own.start + local)[row] = turn[axis];
                }
                gradient.column_mut(coordinates + POSITION * body + axis)[row] = -1.0;
            }
        }
        let axes = (*axes != Mat3::identity()).then_some(*axes);
        if let Some(axes) = &axes {
            for first in vectors(system) {
                let columns = [0, 1, 2].map(|axis| gradient.column(first + axis).to_vec());
                for axis in 0..POSITION {
                    for (row, value) in gradient.column_mut(first + axis).iter_mut().enumerate() {
                        *value = (0..POSITION).map(|from| columns[from][row] * axes[(from, axis)]).sum();
                    }
                }
            }
        }
        let mut weights: Vec<f64> = (0..coordinates + turns).map(|index| weight(system, index)).collect();
        for known in known.into_iter().flatten() {
            weights[known.column(coordinates)] *= LAST;
        }
        scale(&mut gradient, &weights);
        let wanted = conditions + turns - released;
        let factor = PivotedQr::new(gradient, ROUND_OFF);
        if factor.rank < wanted || factor.rank == factor.order.len() {
            return None;
        }
        let rank = factor.rank;
        if let Some(known) = known
            && (known.len() != factor.order.len() - rank
                || known.iter().any(|own| factor.order[..rank].contains(&own.column(coordinates))))
        {
            return None;
        }
        let mut columns: Vec<usize> = (rank..factor.order.len()).collect();
        columns.sort_by_key(|column| factor.order[*column]);
        let mut shapes = Dense::zeros(coordinates, columns.len());
        for (number, column) in columns.iter().enumerate() {
            let own = factor.order[*column];
            let shape = shapes.column_mut(number);
            if own < coordinates {
                shape[own] = 1.0;
            }
            for (dependent, share) in factor.order[..rank].iter().zip(factor.combination(*column)) {
                if *dependent < coordinates {
                    shape[*dependent] = -share * weights[*dependent] / weights[own];
                }
            }
        }
        if let Some(axes) = &axes {
            for number in 0..columns.len() {
                let shape = shapes.column_mut(number);
                for first in vectors(system).take_while(|first| *first < coordinates) {
                    let turned = axes * vec3(shape, first);
                    set_vec3(shape, first, &turned);
                }
            }
        }
        let chosen = columns.iter().map(|column| match factor.order[*column] {
            own if own < coordinates => Independent::Coordinate(own),
            own => Independent::Turn { body: (own - coordinates) / POSITION, axis: (own - coordinates) % POSITION },
        });
        Some(Self { chosen: chosen.collect(), shapes, axes })
    }

    /// The name of each: `arm.node[3].position[2]`, `.slope[2]`, `.twist`; `cart.position[1]`, `.rotation[2]`.
    pub fn names(&self, system: &System) -> Vec<String> {
        let name = |own: &Independent| match *own {
            Independent::Turn { body, axis } => format!("{}.rotation[{}]", system.bodies[body].name, axis + 1),
            Independent::Coordinate(index) => system.coordinate_name(index),
        };
        self.chosen.iter().map(name).collect()
    }

    /// The unit of each.
    pub fn units(&self, system: &System) -> Vec<&'static str> {
        let unit = |own: &Independent| match *own {
            Independent::Turn { .. } => "rad",
            Independent::Coordinate(index) => system.coordinate_unit(index),
        };
        self.chosen.iter().map(unit).collect()
    }

    /// Sets `own` to the independent ones of `values`, changes of all coordinates or of their rates. A turn of a body
    /// is the sum of `factor ½ Σ left × right` over its directors and over `pairs`.
    pub(super) fn read(&self, system: &System, pairs: &[(f64, &[f64], &[f64])], values: &[f64], own: &mut [f64]) {
        for (target, chosen) in own.iter_mut().zip(&self.chosen) {
            *target = match *chosen {
                Independent::Coordinate(index) => match (&self.axes, system.vector_of(index)) {
                    (Some(axes), Some(first)) => axes.column(index - first).dot(&vec3(values, first)),
                    _ => values[index],
                },
                Independent::Turn { body, axis } => {
                    let start = system.bodies[body].start;
                    let mut sum = Vec3::zeros();
                    for (factor, left, right) in pairs {
                        for director in (POSITION..BODY).step_by(POSITION) {
                            let first = start + director;
                            sum += vec3(left, first).cross(&vec3(right, first)) * (0.5 * factor);
                        }
                    }
                    self.axes.map_or(sum[axis], |axes| axes.column(axis).dot(&sum))
                }
            };
        }
    }
}

impl Independent {
    /// Its number among the coordinates of the system, which are `coordinates`, and the turns of bodies behind them.
    fn column(self, coordinates: usize) -> usize {
        match self {
            Self::Coordinate(index) => index,
            Self::Turn { body, axis } => coordinates + POSITION * body + axis,
        }
    }
}

/// The first ones of all vectors among the coordinates, and of the turns of bodies behind them.
fn vectors(system: &System) -> impl Iterator<Item = usize> {
    let coordinates = system.coordinates();
    let own = (0..coordinates).filter(|index| system.vector_of(*index) == Some(*index));
    own.chain((0..system.bodies.len()).map(move |body| coordinates + POSITION * body))
}

/// How rather coordinate `index` depends on the others, in its own unit.
fn weight(system: &System, index: usize) -> f64 {
    let nodes = system.mesh.coordinates();
    if index < nodes {
        if system.is_place(index) { system.size } else { 1.0 }
    } else if index >= system.coordinates() {
        BODY_WEIGHT
    } else if system.is_place(index) {
        BODY_WEIGHT * system.size
    } else {
        DIRECTOR_WEIGHT
    }
}

/// Multiplies the columns by their weights, and rows so that the largest entries are 1.
fn scale(matrix: &mut Dense, weights: &[f64]) {
    let mut largest = vec![0.0_f64; matrix.rows];
    for (number, weight) in weights.iter().enumerate() {
        for (value, largest) in matrix.column_mut(number).iter_mut().zip(&mut largest) {
            *value *= weight;
            *largest = largest.max(value.abs());
        }
    }
    for number in 0..weights.len() {
        for (value, largest) in matrix.column_mut(number).iter_mut().zip(&largest) {
            if *largest > 0.0 {
                *value /= largest;
            }
        }
    }
}
