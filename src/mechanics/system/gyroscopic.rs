//! The two gyroscopic terms of the midpoint integrators (MECHANICS 7.2, 7.3, 7.5), and those of an instant, of ANCF14's
//! nodes: those of ANCF24 have a constant mass matrix in plain coordinates, and no such terms.
//!
//! `theta` is measured in the chart carried from `t_k`, so that the discrete spin depends on both configurations. One
//! half of its variation acts in the step (`C` of 7.3), the other when the momentum changes charts (7.5). Either alone
//! is unstable or loses angular momentum.

use crate::math::blocks::Blocks;
use crate::math::jet::Jet;
use crate::math::rotation::{half_turn, half_turn_by_second};
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, NODE, P, THETA};
use crate::mechanics::beam::ancf14::frame::NodeFrame;
use crate::mechanics::beam::node::Node;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;

/// `target += factor C`, `C_p = [pth kap − h Uth (kap/2 − km)]/|p_k|` at every node that has a frame (7.3), N.
///
/// `frames` are those at the start, middle and end of the step, `mass_increment` is `M Dq`, `forces` is `dU/dq − F`.
pub fn add_forces(
    system: &System,
    frames: [&FrameCache; 3],
    mass_increment: &[f64],
    forces: &[f64],
    step: f64,
    factor: f64,
    target: &mut [f64],
) {
    let [start, middle, end] = frames.map(|cache| &cache.frames);
    for ((own, middle), (first, last)) in system.mesh.framed.iter().zip(middle).zip(start.iter().zip(end)) {
        // The start's chart is centered: its reference tangent is t_k itself, so that k of the end is kb(t_k, t_{k+1}).
        let kap = half_turn(&first.t, &last.t);
        let km = half_turn(&first.t, &middle.t);
        let theta = own + THETA;
        let force = kap * (mass_increment[theta] / step) - (kap * 0.5 - km) * (step * forces[theta]);
        add_vec3(target, own + P, &(force * (factor / first.stretch)));
    }
}

/// Subtracts `h ∂C/∂q` from the element blocks of a step's matrix; what `Uth` adds is of third order in the step and
/// left out. `drives` are the values of the drives in its middle.
pub fn add_tangent(
    system: &System,
    [start, end]: [&FrameCache; 2],
    drives: &[Jet],
    mass_increment: &[f64],
    step: f64,
    blocks: &mut Blocks,
) {
    add_by_node(system, drives, blocks, |own, frame| {
        let (first, last) = (&start.frames[frame], &end.frames[frame]);
        let kap = half_turn(&first.t, &last.t);
        let spin_momentum = mass_increment[own + THETA] / step;
        let kap_p = half_turn_by_second(&first.t, &last.t, &kap) * last.t_p();
        (kap_p * (-step * spin_momentum / first.stretch), -kap / first.stretch)
    });
}

/// Adds what the force on the slope of each node has as derivatives to the element blocks of `blocks`: by the node's
/// own slope, and by the spin momentum `(M v)_theta`, which follows from the angles of this node and of its neighbors
/// through M. `drives` are the values of the drives; `derivatives` is asked with the first coordinate and the frame of
/// a node.
fn add_by_node(
    system: &System,
    drives: &[Jet],
    blocks: &mut Blocks,
    derivatives: impl Fn(usize, usize) -> (Mat3, Vec3),
) {
    for beam in &system.beams {
        for node in beam.node_range() {
            let Node::Ancf14 { start, frame } = system.mesh.nodes[node] else { continue };
            let (by_slope, by_spin) = derivatives(start, frame);
            let neighbors = beam.elements_at(node);
            let [before, after] = neighbors;
            let Some((element, local)) = after.map(|after| (after, 0)).or(before.map(|before| (before, NODE))) else {
                continue;
            };
            let block = blocks.block_mut(element);
            for column in 0..3 {
                for row in 0..3 {
                    block[(local + P + column) * ELEMENT + local + P + row] += by_slope[(row, column)];
                }
            }
            for (element, local) in neighbors.into_iter().zip([NODE, 0]) {
                let Some(number) = element else { continue };
                let Some(element) = system.mesh.elements[number].ancf14() else { continue };
                let extent = system.mesh.elements[number].extent(drives);
                let block = blocks.block_mut(number);
                for (other, column) in [THETA, NODE + THETA].into_iter().enumerate() {
                    for row in 0..3 {
                        block[column * ELEMENT + local + P + row] +=
                            by_spin[row] * extent * element.inertia.mass.spin(local / NODE, other);
                    }
                }
            }
        }
    }
}

/// Takes the momentum from the charts of the step's start to charts centered at its end: `P_p += P_theta kap/|p_{k+1}|`
/// (7.5). `frames` at the end, still relative to the references of the start.
pub fn change_charts(system: &System, frames: &FrameCache, momentum: &mut [f64]) {
    for (own, frame) in system.mesh.framed.iter().zip(&frames.frames) {
        let spin = momentum[own + THETA];
        add_vec3(momentum, own + P, &(frame.k * (spin / frame.stretch)));
    }
}

/// Takes `change`, a small change of the coordinates or of their rates, from the charts of the step's start to those of
/// its end, where a turn of a tangent alone turns no section. `frames` as for [`change_charts`].
pub fn change_charts_of_change(system: &System, frames: &FrameCache, change: &mut [f64]) {
    for (own, frame) in system.mesh.framed.iter().zip(&frames.frames) {
        change[own + THETA] -= frame.k.dot(&vec3(change, own + P)) / frame.stretch;
    }
}

/// Adds the gyroscopic force of an instant, `m_n (p' × p)/|p|³` with the spin momentum `m_n = (M v)_theta`, to the
/// left-hand side of the equations of `p` (MECHANICS 7.2); `momentum` is `M v`. It is the same in every chart.
pub fn add_rate_forces(system: &System, frames: &FrameCache, velocity: &[f64], momentum: &[f64], forces: &mut [f64]) {
    for (own, frame) in system.mesh.framed.iter().zip(&frames.frames) {
        let spin = momentum[own + THETA];
        add_vec3(forces, own + P, &(spin_force(frame, &vec3(velocity, own + P)) * spin));
    }
}

/// `(p' × p)/|p|³`: the gyroscopic force of an instant per spin momentum, 1/s.
fn spin_force(frame: &NodeFrame, slope_rate: &Vec3) -> Vec3 {
    slope_rate.cross(&frame.t) / (frame.stretch * frame.stretch)
}

/// Adds `−m_n' k/|p|` with `m_n' = (M v')_theta` to the left-hand side of the equations of `p`, in charts that are not
/// centered (MECHANICS 7.2): a turn of the tangent alone turns the section too there, so that forces along `theta`
/// count along `p`, and the spin's inertia with them. `momentum_rate` is `M v'`.
pub fn add_chart_forces(system: &System, frames: &FrameCache, momentum_rate: &[f64], forces: &mut [f64]) {
    for (own, frame) in system.mesh.framed.iter().zip(&frames.frames) {
        let rate = momentum_rate[own + THETA];
        add_vec3(forces, own + P, &(frame.k * (-rate / frame.stretch)));
    }
}

/// Adds `scale` times the derivative of [`add_rate_forces`] and [`add_chart_forces`] by the coordinates to the element
/// blocks of `blocks`, when velocities and accelerations follow the coordinates with the factors `by_q`, 1/s and 1/s².
#[inline(never)]
pub fn add_rate_tangent(
    system: &System,
    (frames, drives): (&FrameCache, &[Jet]),
    [velocity, momentum, momentum_rate]: [&[f64]; 3],
    [velocity_by_q, acceleration_by_q]: [f64; 2],
    scale: f64,
    blocks: &mut Blocks,
) {
    add_by_node(system, drives, blocks, |own, frame| {
        let frame = &frames.frames[frame];
        let (t, stretch) = (&frame.t, frame.stretch);
        let [spin, spin_rate] = [momentum, momentum_rate].map(|momentum| momentum[own + THETA]);
        let slope_rate = vec3(velocity, own + P);
        let force = spin_force(frame, &slope_rate);
        let force_p = slope_rate.cross_matrix() / stretch.powi(3) - force * t.transpose() * (3.0 / stretch);
        let force_v = -t.cross_matrix() / (stretch * stretch);
        let chart_p = frame.k * t.transpose() / (stretch * stretch) - frame.k_p() / stretch;
        let by_slope = (force_p + force_v * velocity_by_q) * spin + chart_p * spin_rate;
        let by_spin = force * velocity_by_q - frame.k * (acceleration_by_q / stretch);
        (by_slope * scale, by_spin * scale)
    });
}

/// Adds the derivative of [`add_rate_forces`] with respect to the velocities to the element blocks of `blocks`.
pub fn add_rate_damping(
    system: &System,
    (frames, drives): (&FrameCache, &[Jet]),
    [velocity, momentum]: [&[f64]; 2],
    blocks: &mut Blocks,
) {
    add_by_node(system, drives, blocks, |own, frame| {
        let frame = &frames.frames[frame];
        let force_v = -frame.t.cross_matrix() / (frame.stretch * frame.stretch);
        (force_v * momentum[own + THETA], spin_force(frame, &vec3(velocity, own + P)))
    });
}

/// A row of the matrix `N` by which charts that go with the motion change the rates of coordinates (see
/// docs/linearization.md): that of the angle of a node whose tangent turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartRate {
    /// The coordinate of the angle.
    pub angle: usize,
    /// The first coordinate of the slope.
    pub slope: usize,
    /// `−(t × t')/|p|`, 1/s.
    pub row: Vec3,
}

/// The rows of all nodes whose tangents turn with the velocities `velocity`.
pub fn chart_rates(system: &System, frames: &FrameCache, velocity: &[f64]) -> Vec<ChartRate> {
    let rows = system.mesh.framed.iter().zip(&frames.frames).map(|(own, frame)| {
        let rate = frame.t_p() * vec3(velocity, own + P);
        ChartRate { angle: own + THETA, slope: own + P, row: -frame.t.cross(&rate) / frame.stretch }
    });
    rows.filter(|own| own.row != Vec3::zeros()).collect()
}
