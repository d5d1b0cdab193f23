//! The forces of a system and their derivatives.

use crate::random::Random;
use ancf14::math::blocks::Blocks;
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;

/// All forces at rest at the coordinates `q`, after the accepted state `before`, and their tangent.
pub fn forces_at_rest(system: &System, before: &State, q: &[f64]) -> (Vec<f64>, Blocks) {
    forces_under(system, before, q, &Excitation::default())
}

/// The same under what acts from outside.
pub fn forces_under(system: &System, before: &State, q: &[f64], excitation: &Excitation) -> (Vec<f64>, Blocks) {
    let mut frames = FrameCache::default();
    frames.set(system, q, &before.triads);
    let c = system.configuration(q, &frames, before, &before.prescribed);
    let mut blocks = Blocks::default();
    system.push_tangent_blocks(&mut blocks);
    let mut forces = vec![0.0; q.len()];
    system.forces_and_tangent(&c, &Passage::Rest, excitation, 1.0, &mut forces, &mut blocks);
    (forces, blocks)
}

/// The damping matrix is the derivative of the forces with respect to the velocities, at random ones: differences of
/// forces that are linear there are off by their round-off.
pub fn check_damping_matrix(system: &System, mut state: State, name: &str) {
    let mut random = Random(9);
    state.velocity = state.q.iter().map(|_| 0.1 * random.signed()).collect();
    let [along, left] = [(); 2].map(|()| state.q.iter().map(|_| random.signed()).collect::<Vec<_>>());
    let mut frames = FrameCache::default();
    frames.set(system, &state.q, &state.triads);
    let c = system.configuration(&state.q, &frames, &state, &state.prescribed);
    let excitation = Excitation::default();
    let mut blocks = Blocks::default();
    system.push_tangent_blocks(&mut blocks);
    system.set_damping(&c, &state.velocity, &excitation, &mut blocks);
    let found = blocks.form(&left, &along);
    let [plus, minus] = [1e-3, -1e-3].map(|share| {
        let velocity: Vec<f64> = state.velocity.iter().zip(&along).map(|(v, change)| v + share * change).collect();
        let mut forces = vec![0.0; velocity.len()];
        system.forces(&c, &Passage::with_velocity(&velocity), &excitation, &mut forces);
        forces.iter().zip(&left).map(|(force, weight)| force * weight).sum::<f64>()
    });
    let expected = (plus - minus) / 2e-3;
    assert!(found.abs() > 1e-3 && (found / expected - 1.0).abs() < 1e-8, "{name}: {found} {expected}");
}
