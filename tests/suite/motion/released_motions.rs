//! The motions that release energy are counted right, on every model and at random states of it. With constraints as
//! springs, eliminated without exchanges, a small pivot or a spring too soft would give another count than the
//! eigenvalues of the whole matrix do: of `[A Bᵀ; B 0]` as many are negative as there are conditions, and one more for
//! each motion that they allow and that releases energy.

use crate::motion::direct_solver::{machines, set_matrix};
use crate::random::Random;
use ancf14::solve::newton::kkt::Kkt;
use nalgebra::DMatrix;

/// An eigenvalue of the scaled matrix below this says nothing: it is round-off of the largest ones, which are some
/// units.
const ROUND_OFF: f64 = 1e-13;

/// How many eigenvalues of the matrix beyond those of its conditions are negative; None where one is round-off.
fn negative_eigenvalues(kkt: &Kkt, coordinates: usize, conditions: usize) -> Option<usize> {
    let size = coordinates + conditions;
    let mut matrix = DMatrix::<f64>::zeros(size, size);
    for (number, block) in kkt.blocks.layout().iter().enumerate() {
        // Of the gradients those that stand below: the others may have a factor.
        if block.column >= coordinates {
            continue;
        }
        for (place, value) in kkt.blocks.block(number).iter().enumerate() {
            let (row, column) = (block.row + place % block.rows, block.column + place / block.rows);
            let share = if row < coordinates { 0.5 } else { 1.0 };
            matrix[(row, column)] += share * value;
            matrix[(column, row)] += share * value;
        }
    }
    // Rows and columns of largest entry 1: signs stay, and the small ones come out of the round-off of the large ones.
    for _ in 0..3 {
        let scale: Vec<f64> = matrix.column_iter().map(|column| 1.0 / column.amax().sqrt()).collect();
        for (index, factor) in scale.iter().enumerate() {
            matrix.row_mut(index).scale_mut(*factor);
            matrix.column_mut(index).scale_mut(*factor);
        }
    }
    let eigenvalues = matrix.symmetric_eigenvalues();
    let known = eigenvalues.iter().all(|value| value.abs() > ROUND_OFF);
    known.then(|| eigenvalues.iter().filter(|value| **value < 0.0).count() - conditions)
}

#[test]
fn motions_that_release_energy_are_counted() {
    let (mut compared, mut unstable, mut held) = (0, 0, 0);
    for (name, built) in machines() {
        let (system, state) = (built.system, built.state);
        let mut kkt = Kkt::for_steps(&system);
        // Another machine changes nothing here.
        let mut random = Random(11);
        for number in 0..6 {
            // As drawn, bent by less and less; at rest, and in steps that hold some motions by their mass.
            let mut moved = state.clone();
            let reach = if number == 0 { 0.0 } else { system.size * 10_f64.powi(-number) };
            moved.q.iter_mut().for_each(|value| *value += reach * random.signed());
            let multipliers: Vec<f64> = (0..system.constraints()).map(|_| 10.0 * random.signed()).collect();
            let step = if number % 2 == 0 { 0.0 } else { 10_f64.powf(-2.0 + random.signed()) };
            set_matrix(&mut kkt, &system, &moved, step, &multipliers);
            if kkt.factorize(&system, 0.0).is_err() {
                continue;
            }
            let Some(expected) = negative_eigenvalues(&kkt, system.coordinates(), system.constraints()) else {
                continue;
            };
            println!("{name}, state {number}: {expected}");
            // What is certain must be true.
            let is_held = kkt.holds_all_motions(&system);
            assert!(
                !is_held || expected == 0,
                "{name}, state {number}: {expected} motions release energy, none was found"
            );
            held += usize::from(is_held);
            kkt.factorize(&system, 0.0).unwrap();
            assert_eq!(kkt.releasing_motions(&system), Some(expected), "{name}, state {number}");
            compared += 1;
            unstable += usize::from(expected > 0);
        }
    }
    let stable = compared - unstable;
    assert!(compared > 50 && unstable > 20, "{compared} compared, {unstable} unstable");
    // Not so with gears, with closed loops of many elements, and near buckling.
    assert!(2 * held > stable, "{held} of {stable} stable states were certain to be stable");
}
