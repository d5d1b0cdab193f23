//! The energies of a state and the power of what acts on it, for integrators that take forces at instants.

use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::state::State;
use crate::mechanics::state::energy_account::Work;
use crate::mechanics::state::energy_balance::Energies;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;

/// Power by its origin at the instant `c`, W; drives but for those of springs give `driving`, and dampers take
/// `damping`.
pub(super) fn shares(
    system: &System,
    c: &Configuration,
    velocity: &[f64],
    excitation: &Excitation,
    [driving, damping]: [f64; 2],
) -> Work {
    let [loads, actuators] = system.loads_and_actuators(c, &Passage::with_velocity(velocity), excitation, velocity);
    Work { loads, actuators, drives: driving + system.power_of_frames(c, velocity), dissipated: damping, fluids: 0.0 }
}

/// The energies (J) and the power of what acts from outside (W), also by its origin, at `state`, whose last step is not
/// known or was before a break.
pub(super) fn begin_balance(system: &System, state: &State) -> (Energies, [f64; 2], Work) {
    let (mut cache, mut excitation, mut gradients) = (FrameCache::default(), Excitation::default(), Vec::new());
    let configuration = cache.of(system, state);
    system.excite(state.time, &state.targets, &mut excitation);
    system.constraint_gradients(&configuration, &mut gradients);
    let mut forces = vec![0.0; state.q.len()];
    let (energies, [acting, damping]) =
        system.energies_and_power(&configuration, &state.velocity, &excitation, &mut forces);
    let driving = system.driven_work(&gradients, &state.multipliers, &state.velocity);
    let shares = shares(system, &configuration, &state.velocity, &excitation, [driving, damping]);
    (energies, [acting + driving, damping], shares)
}

/// The work of drives along the straight way of a step, J: what they prescribe. Velocities at its ends are not, after a
/// jump: they ring with the multipliers for many steps. The multipliers of both ends come with a factor each, the
/// coordinates as they are; `way` is scratch memory.
pub(super) fn driven_work(
    system: &System,
    gradients: &[JointGradient],
    multipliers: [(&[f64], f64); 2],
    [start, end]: [&[f64]; 2],
    way: &mut [f64],
) -> f64 {
    for (way, (end, start)) in way.iter_mut().zip(end.iter().zip(start)) {
        *way = end - start;
    }
    let work = |(own, factor)| 0.5 * factor * system.driven_work(gradients, own, way);
    multipliers.map(work).iter().sum()
}
