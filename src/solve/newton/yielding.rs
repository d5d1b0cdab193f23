//! How stiff the springs are that stand for conditions where motions are counted.
//!
//! A condition is measured by the softest coordinate that it acts on. Bodies have no stiffness of their own: their
//! rigidity is measured by the springs of their joints. Measured by the stiffest coordinate of the mechanism, its
//! round-off would hide soft motions.

use crate::math::blocks::Blocks;
use crate::mechanics::system::System;

/// A diagonal below this share of the largest one is round-off.
const VANISHING: f64 = 1e-13;

/// How many joints away from a stiffness a body finds it, at most.
const MOST_PASSES: usize = 8;

/// A condition: its unknowns and gradient.
type Gradient = Vec<(usize, f64)>;

/// The stiffness of each condition that gives it the size of the coordinates that it acts on. `joints` are the first
/// of each joint's constraint blocks among `blocks`: columns of a and b, rows of a and b; `scale` is the scaling of the
/// unknowns.
pub(super) fn stiffnesses(
    system: &System,
    blocks: &Blocks,
    joints: &[usize],
    scale: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let coordinates = system.coordinates();
    let mut stiffnesses: Vec<f64> = (0..system.constraints()).map(|row| scale(coordinates + row).powi(2)).collect();
    let is_soft = soft_coordinates(system, blocks);
    let mut rootless = Vec::new();
    let mut local = vec![0.0; coordinates];
    for ((joint, rows), first) in system.joints_with_rows().zip(joints) {
        let sides = [(&joint.a, first + 2), (&joint.b, first + 3)];
        for (condition, row) in rows.clone().enumerate() {
            let gradient: Gradient = sides
                .iter()
                .flat_map(|(marker, block)| {
                    let values = blocks.block(*block).iter().skip(condition).step_by(rows.len()).copied();
                    marker.coordinates(&system.mesh).zip(values)
                })
                .filter(|(_, value)| *value != 0.0)
                .collect();
            if gradient.iter().all(|(unknown, _)| is_soft[*unknown]) {
                rootless.push((row, gradient));
            } else {
                add_spring(&gradient, stiffnesses[row], &mut local);
            }
        }
    }
    for _ in 0..MOST_PASSES {
        let before = rootless.len();
        let held = local.clone();
        rootless.retain(|(row, gradient)| {
            let shares = gradient.iter().filter(|(unknown, _)| held[*unknown] > 0.0);
            let largest = shares.fold(0.0_f64, |largest, (unknown, value)| largest.max(value * value / held[*unknown]));
            if largest > 0.0 {
                stiffnesses[*row] = stiffnesses[*row].min(1.0 / largest);
                add_spring(gradient, stiffnesses[*row], &mut local);
            }
            largest == 0.0
        });
        if rootless.is_empty() || rootless.len() == before {
            break;
        }
    }
    stiffnesses
}

fn add_spring(gradient: &Gradient, stiffness: f64, local: &mut [f64]) {
    gradient.iter().for_each(|(unknown, value)| local[*unknown] += stiffness * value * value);
}

/// Whether each coordinate has no stiffness of its own, or only round-off of the others'.
fn soft_coordinates(system: &System, blocks: &Blocks) -> Vec<bool> {
    let mut diagonal = vec![0.0; system.coordinates()];
    for (number, block) in blocks.layout().iter().enumerate() {
        let values = blocks.block(number);
        let end = (block.row + block.rows).min(block.column + block.columns).min(diagonal.len());
        for unknown in block.row.max(block.column)..end {
            diagonal[unknown] += values[(unknown - block.column) * block.rows + unknown - block.row];
        }
    }
    for (unknown, value) in diagonal.iter_mut().enumerate() {
        let unit = if system.is_place(unknown) { system.size } else { 1.0 };
        *value = value.abs() * unit * unit;
    }
    let largest = diagonal.iter().fold(0.0_f64, |largest, value| largest.max(*value));
    diagonal.iter().map(|value| *value <= VANISHING * largest).collect()
}
