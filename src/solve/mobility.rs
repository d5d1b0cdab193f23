//! How easily a spring or damper is moved: `J M⁻¹ Jᵀ` of what it measures, on the motions that the constraints allow. One over it is the mass, or
//! the moment of inertia, that it holds.

use super::kkt::Kkt;
use crate::mechanics::sensor::Snapshot as FrameCache;
use crate::mechanics::spring::reading_q;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Sets the mobility of all dampers of `system` as drawn, `state`. Where constraints are redundant none is known, and the start says so.
pub fn set_mobilities(system: &mut System, state: &State) {
    if system.springs.iter().all(|spring| spring.damping == 0.0) {
        return;
    }
    let mut kkt = Kkt::for_projections(system);
    let (mut cache, mut gradients) = (FrameCache::default(), Vec::new());
    let configuration = cache.of(system, state);
    system.constraint_gradients(&configuration, &mut gradients);
    system.add_mass(1.0, &mut kkt.blocks);
    kkt.set_constraints(system, &gradients, &gradients, 1.0);
    if kkt.factorize(system, state.time).is_err() {
        return;
    }
    let mut mobility = |number: usize| {
        let gauge = &system.gauges[system.springs[number].gauge];
        let sides = [&gauge.a, &gauge.b].map(|side| side.coordinates(&system.mesh));
        let by_sides = reading_q(gauge, &configuration);
        let mut vector = vec![0.0; system.coordinates() + system.constraints()];
        for (side, own) in sides.iter().zip(&by_sides) {
            vector[side.clone()].iter_mut().zip(own).for_each(|(target, value)| *target += value);
        }
        kkt.solve_again(&mut vector).ok()?;
        let along = sides.iter().zip(&by_sides).flat_map(|(side, own)| vector[side.clone()].iter().zip(own));
        let mobility: f64 = along.map(|(moved, value)| moved * value).sum();
        (mobility.is_finite() && mobility > 0.0).then_some(mobility)
    };
    let found: Vec<Option<f64>> = (0..system.springs.len())
        .map(|number| if system.springs[number].damping == 0.0 { None } else { mobility(number) })
        .collect();
    for (spring, mobility) in system.springs.iter_mut().zip(found) {
        spring.mobility = mobility.unwrap_or(0.0);
    }
}
