//! What dampers add to the equations: those in the material of beams, and the damping matrix of springs too.

use super::equations::{add, add_corner};
use crate::math::blocks::Blocks;
use crate::mechanics::beam::coordinates::{ELEMENT, ElementMatrix, ElementVector, NODE};
use crate::mechanics::beam::damping;
use crate::mechanics::configuration::{Configuration, Passage, Rates};
use crate::mechanics::system::{System, linear_evaluation};

impl System {
    /// The elements whose material is damped.
    fn damped_elements(&self) -> impl Iterator<Item = usize> + '_ {
        self.elements
            .iter()
            .enumerate()
            .filter(|(_, element)| element.stiffness.damping != 0.0)
            .map(|(number, _)| number)
    }

    /// Adds the viscous forces of the beams' material.
    pub(super) fn add_material_damping(&self, c: &Configuration, passage: &Passage, forces: &mut [f64]) {
        for number in self.damped_elements() {
            let force = match &passage.rates {
                Rates::Rest => return,
                Rates::Step { start, end, duration } => {
                    let start = damping::strains(&linear_evaluation(start, number));
                    let (middle, end) = (linear_evaluation(c, number), linear_evaluation(end, number));
                    damping::force_over_step(&start, &middle, &end, *duration)
                }
                Rates::Instant(velocity) => {
                    damping::force(&linear_evaluation(c, number), &self.own_velocity(number, velocity))
                }
            };
            add(forces, NODE * self.elements[number].node, force.as_slice());
        }
    }

    /// [`Self::add_material_damping`], and `scale` times the derivative as [`System::forces_and_tangent`] counts it.
    pub(super) fn add_material_damping_and_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        for number in self.damped_elements() {
            let (force, by_q) = match &passage.rates {
                Rates::Rest => return,
                Rates::Step { start, end, duration } => {
                    let start = damping::strains(&linear_evaluation(start, number));
                    let (middle, end) = (linear_evaluation(c, number), linear_evaluation(end, number));
                    damping::force_and_tangent_over_step(&start, &middle, &end, *duration)
                }
                Rates::Instant(velocity) => {
                    let (here, velocity) = (linear_evaluation(c, number), self.own_velocity(number, velocity));
                    (damping::force(&here, &velocity), damping::force_q(&here, &velocity))
                }
            };
            add(forces, NODE * self.elements[number].node, force.as_slice());
            add_element(tangent, number, scale, &by_q);
        }
    }

    /// Adds `factor` times the derivative of the forces by the velocities, at an instant, to the first blocks of `tangent`.
    pub fn add_damping_matrix(&self, c: &Configuration, factor: f64, tangent: &mut Blocks) {
        for number in self.damped_elements() {
            add_element(tangent, number, factor, &damping::force_v(&linear_evaluation(c, number)));
        }
        let points: usize = self.loads.iter().map(|load| load.points.len()).sum();
        let first = self.elements.len() + self.bodies.len() + points;
        for (number, spring) in self.springs.iter().enumerate().filter(|(_, spring)| spring.damping != 0.0) {
            let counts = self.sides(spring.gauge).map(|marker| marker.coordinates(&self.elements).len());
            for (place, part) in spring.damping_matrix(&self.gauges[spring.gauge], c).iter().enumerate() {
                let (rows, columns) = (counts[place / 2], counts[place % 2]);
                let block = tangent.block_mut(first + 4 * number + place);
                add_corner(block, rows, columns, |row, column| factor * part[(row, column)]);
            }
        }
    }

    fn own_velocity(&self, number: usize, velocity: &[f64]) -> ElementVector {
        let start = NODE * self.elements[number].node;
        ElementVector::from_column_slice(&velocity[start..start + ELEMENT])
    }
}

fn add_element(tangent: &mut Blocks, number: usize, factor: f64, matrix: &ElementMatrix) {
    for (target, value) in tangent.block_mut(number).iter_mut().zip(matrix.as_slice()) {
        *target += factor * value;
    }
}
