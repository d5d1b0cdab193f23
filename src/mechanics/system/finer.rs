//! A state of a system on a mesh twice as fine: the same shape.

use super::System;
use super::frame_cache::FrameCache;
use crate::math::elementary::atan2;
use crate::math::hermite;
use crate::math::rotation::carry;
use crate::math::vectors::set_vec3;
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, NODE, P, R, THETA, interpolate};
use crate::mechanics::beam::ancf14::element::Element;
use crate::mechanics::contact::pieces::CELLS;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;
use std::f64::consts::TAU;

/// How far the lengths of two elements may differ from that of the one that they divide, relative.
const SAME_LENGTH: f64 = 1e-9;

impl System {
    /// Sets `state`, one of this system as drawn, to the shape of `from`, a state of `coarse`: the same mechanism with
    /// half the elements in every beam, or as many. Returns false for elements other than ANCF14, for beams whose finer
    /// mesh moves the nodes, and where positions count from another origin.
    pub fn take_shape(&self, state: &mut State, coarse: &Self, from: &State) -> bool {
        let (own, other) = (self.mesh.coordinates(), coarse.mesh.coordinates());
        let fits = self.origin == coarse.origin
            && self.beams.len() == coarse.beams.len()
            && state.q.len() - own == from.q.len() - other;
        if !fits || state.multipliers.len() != from.multipliers.len() {
            return false;
        }
        state.q[own..].copy_from_slice(&from.q[other..]);
        let mut frames = FrameCache::default();
        let c = frames.of(coarse, from);
        for (beam, coarse_beam) in self.beams.iter().zip(&coarse.beams) {
            if beam.elements() == coarse_beam.elements() {
                for (own, other) in beam.element_range().zip(coarse_beam.element_range()) {
                    let [own, other] =
                        [(self, own), (coarse, other)].map(|(system, k)| system.mesh.elements[k].ancf14());
                    let (Some(own), Some(other)) = (own, other) else { return false };
                    copy([own, other], state, from);
                }
                continue;
            }
            if beam.elements() != 2 * coarse_beam.elements() {
                return false;
            }
            let pairs = self.mesh.elements[beam.element_range()].chunks_exact(2);
            for (pair, number) in pairs.zip(coarse_beam.element_range()) {
                let [Some(first), Some(second)] = [pair[0].ancf14(), pair[1].ancf14()] else { return false };
                let Some(element) = coarse.mesh.elements[number].ancf14() else { return false };
                if (first.length + second.length - element.length).abs() > SAME_LENGTH * element.length {
                    return false;
                }
                divide([first, second], (number, element), &c, (state, from));
            }
        }
        copy_all_but_the_mesh(state, from);
        self.take_memory(&mut state.lists.memory, coarse, &from.lists.memory);
        // Along a beam there is one an element.
        self.set_heats(from.instant(), &from.targets, &mut state.prescribed.heats);
        true
    }

    /// Sets what the forces of this system remember to what those of `coarse` do: equilibria with friction depend on
    /// the way to them. Each cell of a contact has the displacement of the one that it is a part of.
    fn take_memory(&self, memory: &mut [f64], coarse: &Self, from: &[f64]) {
        for (own, other) in self.springs.iter().zip(&coarse.springs) {
            if let (Some(own), Some(other)) = (own.memory, other.memory) {
                memory[own] = from[other];
            }
        }
        for ((_, own), (_, other)) in self.slides().zip(coarse.slides()) {
            memory[own.memory] = from[other.memory];
        }
        for (contact, coarse) in self.contacts.iter().zip(&coarse.contacts) {
            let (Some(own), Some(other)) = (contact.friction, coarse.friction) else { continue };
            let parts = contact.elements.len() / coarse.elements.len().max(1);
            for cell in 0..contact.elements.len() * CELLS {
                let [to, of] = [own.memory + 3 * cell, other.memory + 3 * (cell / parts)];
                memory[to..to + 3].copy_from_slice(&from[of..of + 3]);
            }
        }
        for (own, other) in self.ropes.iter().zip(&coarse.ropes) {
            let [to, of] = [own, other].map(|rope| rope.memory..rope.memory + rope.remembered());
            memory[to].copy_from_slice(&from[of]);
        }
    }
}

/// Sets the nodes and the holonomy angle of an element to those of the same one in `from`.
fn copy(elements: [&Element; 2], state: &mut State, from: &State) {
    let [own, other] = elements.map(|element| element.place);
    let nodes = other.start..other.start + ELEMENT;
    state.q[own.start..own.start + ELEMENT].copy_from_slice(&from.q[nodes]);
    for node in 0..2 {
        state.triads[own.frame + node] = from.triads[other.frame + node];
    }
    state.holonomy[own.branch] = from.holonomy[other.branch];
}

/// Sets the nodes and holonomy angles of two elements to the shape of `element`, number `number` of the configuration
/// `c`, that of `from`.
fn divide(
    [first, second]: [&Element; 2],
    (number, element): (usize, &Element),
    c: &Configuration,
    (state, from): (&mut State, &State),
) {
    for (target, source) in [(first.place, 0), (second.place, 1)] {
        // The second node of the second element is that of the whole one.
        let (start, frame) = (target.start + source * NODE, target.frame + source);
        let own = element.place.start + source * NODE;
        state.q[start..start + NODE].copy_from_slice(&from.q[own..own + NODE]);
        state.triads[frame] = from.triads[element.place.frame + source];
    }
    let xi = first.length / (first.length + second.length);
    let section = Marker::section(number, xi).pose(c);
    let slope = interpolate(&hermite::shape_x(xi, element.length), element.own(&from.q));
    let begin = element.frames(&c.beams)[0];
    let t = slope.normalize();
    let triad = Triad::new(&t, &carry(&begin.t, &t, &begin.u));
    let y = section.axes.column(1);
    let angle = atan2(y.dot(&triad.t.cross(&triad.u)), y.dot(&triad.u));
    let before = from.q[element.place.start + THETA];
    let turns = ((before - angle) / TAU).round();
    let start = second.place.start;
    set_vec3(&mut state.q, start + R, &section.place);
    set_vec3(&mut state.q, start + P, &slope);
    state.q[start + THETA] = angle + turns * TAU;
    state.triads[second.place.frame] = triad;
    // The frame in the middle has been carried from the first node: all of the angle is in the second half.
    state.holonomy[first.place.branch] = 0.0;
    state.holonomy[second.place.branch] = from.holonomy[element.place.branch];
}

/// Takes what drives, loads and joints have in `from`.
fn copy_all_but_the_mesh(state: &mut State, from: &State) {
    state.time = from.time;
    state.multipliers.clone_from(&from.multipliers);
    state.relative_values.clone_from(&from.relative_values);
    state.rotations.clone_from(&from.rotations);
    state.prescribed.copy_from(&from.prescribed);
    state.targets.copy_from(&from.targets);
    state.excitation.copy_from(&from.excitation);
    state.path.clone_from(&from.path);
    (state.balance, state.statistics) = (from.balance, from.statistics);
    state.velocity.fill(0.0);
}
