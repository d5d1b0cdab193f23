//! The two gyroscopic terms of the midpoint integrators (MECHANICS 7.2, 7.3, 7.5).
//!
//! `theta` is measured in the chart carried from `t_k`, so that the discrete spin depends on both configurations. One half of
//! its variation acts in the step (`C` of 7.3), the other when the momentum changes charts (7.5). Either alone is unstable
//! or loses angular momentum.

use crate::math::blocks::Blocks;
use crate::math::rotation::{half_turn, half_turn_by_second};
use crate::mechanics::beam::coordinates::{ELEMENT, NODE, P, THETA, add_vec3, vec3};
use crate::mechanics::beam::frame::NodeFrame;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// `target += factor C`, `C_p = [pth kap − h Uth (kap/2 − km)]/|p_k|` at every node (7.3), N.
///
/// `frames` are those at the start, middle and end of the step, `mass_increment` is `M Dq`, `forces` is `dU/dq − F`.
pub fn add_forces(
    frames: [&[NodeFrame]; 3],
    mass_increment: &[f64],
    forces: &[f64],
    step: f64,
    factor: f64,
    target: &mut [f64],
) {
    let [start, middle, end] = frames;
    for (node, (first, last)) in start.iter().zip(end).enumerate() {
        // The start's chart is centred: its reference tangent is t_k itself, so that k of the end is kb(t_k, t_{k+1}).
        let kap = half_turn(&first.t, &last.t);
        let km = half_turn(&first.t, &middle[node].t);
        let theta = NODE * node + THETA;
        let force = kap * (mass_increment[theta] / step) - (kap * 0.5 - km) * (step * forces[theta]);
        add_vec3(target, NODE * node + P, &(force * (factor / first.stretch)));
    }
}

/// Subtracts `h ∂C/∂q` from the element blocks of a step's matrix; what `Uth` adds is of third order in the step and left out.
pub fn add_tangent(
    system: &System,
    start: &[NodeFrame],
    end: &[NodeFrame],
    mass_increment: &[f64],
    step: f64,
    blocks: &mut Blocks,
) {
    for beam in &system.beams {
        for place in 0..=beam.elements {
            let node = beam.first_node + place;
            let (first, last) = (&start[node], &end[node]);
            let kap = half_turn(&first.t, &last.t);
            let spin_momentum = mass_increment[NODE * node + THETA] / step;

            // By the end's slope at fixed spin momentum.
            let kap_p = half_turn_by_second(&first.t, &last.t, &kap) * last.t_p() * (spin_momentum / first.stretch);
            let (element, local) = if place < beam.elements { (place, 0) } else { (place - 1, NODE) };
            let block = blocks.block_mut(beam.first_element + element);
            for column in 0..3 {
                for row in 0..3 {
                    block[(local + P + column) * ELEMENT + local + P + row] -= step * kap_p[(row, column)];
                }
            }
            // By the increments of theta, of this node and of its neighbours through M.
            let scaled = kap / first.stretch;
            let neighbours = [(place > 0).then(|| place - 1), (place < beam.elements).then_some(place)];
            for (element, local) in neighbours.into_iter().zip([NODE, 0]) {
                let Some(element) = element.map(|element| beam.first_element + element) else { continue };
                let mass = &system.elements[element].mass;
                let block = blocks.block_mut(element);
                for column in [THETA, NODE + THETA] {
                    for row in 0..3 {
                        block[column * ELEMENT + local + P + row] -= scaled[row] * mass[(local + THETA, column)];
                    }
                }
            }
        }
    }
}

/// Takes the momentum from the charts of the step's start to charts centred at its end: `P_p += P_theta kap/|p_{k+1}|` (7.5).
/// `frames` at the end, still relative to the references of the start.
pub fn change_charts(frames: &[NodeFrame], momentum: &mut [f64]) {
    for (frame, momentum) in frames.iter().zip(momentum.chunks_exact_mut(NODE)) {
        let spin = momentum[THETA];
        add_vec3(momentum, P, &(frame.k * (spin / frame.stretch)));
    }
}

/// Adds the gyroscopic force of an instant, `m_n (p' × p)/|p|³` with the spin momentum `m_n = (M v)_theta`, to the left-hand
/// side of the equations of `p` (MECHANICS 7.2); the charts are centred.
pub fn add_rate_forces(system: &System, state: &State, forces: &mut [f64]) {
    for element in &system.elements {
        let start = NODE * element.node;
        for local in [0, NODE] {
            // What this element adds to the node's spin momentum: of the angles only.
            let spin: f64 = [THETA, NODE + THETA]
                .into_iter()
                .map(|column| element.mass[(local + THETA, column)] * state.velocity[start + column])
                .sum();
            let (p, p_t) = (vec3(&state.q, start + local + P), vec3(&state.velocity, start + local + P));
            add_vec3(forces, start + local + P, &(p_t.cross(&p) * (spin / p.norm().powi(3))));
        }
    }
}
