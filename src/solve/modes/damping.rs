//! Damping of natural modes, to first order: the shapes stay those without damping, and a mode with `xᵀ M x = 1` has
//! the damping ratio `xᵀ C x/(2 ω)`. Dry friction is left out.

use super::{Kind, Mode};
use crate::math::blocks::Blocks;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::solve::newton::kkt::Kkt;

/// The damping ratio of each of `modes` about `state`, at rest; 0 of those that do not vibrate.
pub fn damping_ratios(system: &System, state: &State, modes: &[Mode]) -> Vec<f64> {
    if !system.is_damped() && system.actuators.is_empty() {
        return vec![0.0; modes.len()];
    }
    let mut excitation = Excitation::default();
    system.excite(state.time, &state.targets, &mut excitation);
    let rates = forms(system, state, modes, |configuration, blocks| {
        system.set_damping_at_rest(configuration, &excitation, blocks);
    });
    let ratio = |(mode, rate): (&Mode, f64)| match mode.kind {
        Kind::Vibration => 0.5 * rate / mode.eigenvalue.sqrt(),
        Kind::Free | Kind::Unstable => 0.0,
    };
    modes.iter().zip(rates).map(ratio).collect()
}

/// `xᵀ C x` of each of `modes` about `state`, at rest, 1/s, by the material of the beams alone.
pub fn material_rates(system: &System, state: &State, modes: &[Mode]) -> Vec<f64> {
    forms(system, state, modes, |configuration, blocks| system.set_material_damping_at_rest(configuration, blocks))
}

/// The forms of the matrix that `set` sets, of each of `modes`.
fn forms(system: &System, state: &State, modes: &[Mode], set: impl FnOnce(&Configuration, &mut Blocks)) -> Vec<f64> {
    let mut rest = state.clone();
    rest.velocity.fill(0.0);
    rest.prescribed.stop();
    let mut cache = FrameCache::default();
    let mut blocks = Kkt::for_equilibria(system).blocks;
    set(&cache.of(system, &rest), &mut blocks);
    modes.iter().map(|mode| blocks.form(&mode.shape, &mode.shape)).collect()
}
