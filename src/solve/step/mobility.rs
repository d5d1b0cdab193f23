//! How easily a step moves a spring or damper: `J (M + h²/4 K)⁻¹ Jᵀ` of what it measures, on the motions that the
//! constraints allow. One over it is the mass, or the moment of inertia, that a damper has to stop within a step; the
//! stiffness of a beam holds the little inertia of its end.

use crate::mechanics::force::spring::Spring;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::kkt::Kkt;

/// Most numbers that all solves together may touch: with thousands of springs on thousands of elements, mobilities
/// would take longer than a run.
const MOST_WORK: usize = 20_000_000;

/// Sets the mobility of all springs of `system`, which may all be given a damper, in steps of `step` s from the state
/// as drawn, `state`. Where constraints are redundant none is known, and the start says so.
pub fn set_mobilities(system: &mut System, state: &State, step: f64) {
    let size = system.coordinates() + system.constraints();
    if system.springs.is_empty() || system.springs.len() * size > MOST_WORK {
        return;
    }
    let mut kkt = Kkt::for_steps(system);
    let (mut cache, mut gradients, mut forces) = (FrameCache::default(), Vec::new(), vec![0.0; system.coordinates()]);
    let configuration = cache.of(system, state);
    let (free, tangent) = (Excitation::default(), &mut kkt.blocks);
    system.forces_and_tangent(&configuration, &Passage::Rest, &free, 0.25 * step * step, &mut forces, tangent);
    system.add_mass(MassAt::from(&configuration), 1.0, tangent);
    kkt.set_curvatures_and_gradients(system, &configuration, &vec![0.0; system.constraints()], 1.0, &mut gradients);
    kkt.set_constraints(system, &gradients, &gradients, 1.0);
    if kkt.factorize(system, state.time).is_err() {
        return;
    }
    let mobility = |spring: &Spring| {
        let coordinate = &system.relative_coordinates[spring.coordinate];
        let sides = [&coordinate.a, &coordinate.b].map(|side| side.coordinates(&system.mesh));
        let by_sides = coordinate.gradient(&configuration);
        let mut vector = vec![0.0; size];
        for (side, own) in sides.iter().zip(&by_sides) {
            vector[side.clone()].iter_mut().zip(own).for_each(|(target, value)| *target += value);
        }
        kkt.solve_again(&mut vector).ok()?;
        let along = sides.iter().zip(&by_sides).flat_map(|(side, own)| vector[side.clone()].iter().zip(own));
        let mobility: f64 = along.map(|(moved, value)| moved * value).sum();
        (mobility.is_finite() && mobility > 0.0).then_some(mobility)
    };
    let found: Vec<Option<f64>> = system.springs.iter().map(mobility).collect();
    for (spring, mobility) in system.springs.iter_mut().zip(found) {
        spring.mobility = mobility.unwrap_or(0.0);
    }
}
