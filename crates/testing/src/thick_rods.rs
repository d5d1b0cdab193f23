//! Rods that are given by their rigidities, thick as rectangles that have these, and where their tips must be:
//! `M = EI κ`, `T = GJ τ`, `N = EA ε`, with strains per undeformed length.

use crate::integrate::runge_kutta;
use ancf14::math::Vec3;
use std::f64::consts::PI;

/// The rigidities of a rod whose fibers strain by 11 % in a circle of 10 m around, if it is a rectangle; `GJ` is 100.
pub const ROUND: &str = "EA = 1e4\nEI_y = 100\nEI_z = 100";
/// Those of a cantilever of 4 m that a force of 300 N across it bends: P L²/EI = 3.
pub const SHORT: &str = "EA = 1e4\nEI_y = 1600\nEI_z = 1600";
/// The loads of the helix of ten turns.
pub const WINDING: &str = "force = [0, 0, \"50*t\"]\nmoment = [0, 0, \"200*pi*t\"]";

/// Steps of the rule of Runge and Kutta along a rod: halved, nothing changes by more than 1e-8 m.
const STEPS: u32 = 4000;

/// A rod of `length` m along x in `elements` elements, held at its start and loaded at its end; `section` and `load`
/// are keys, and `beam` those of the beam.
pub fn rod(section: &str, (length, elements, beam): (f64, usize, &str), load: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"Rod\"
        [section.own]
        shape = \"rigidities\"
        GJ = 100
        line_density = 1
        {section}
        [beam.rod]
        section = \"own\"
        from = [0, 0, 0]
        to = [{length}, 0, 0]
        elements = {elements}
        {beam}
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"rod.start\"
        [output.tip]
        at = \"rod.end\"
        quantities = [\"displacement\", \"rotation\"]
        [load.tip]
        at = \"rod.end\"
        {load}
        [simulation]
        analysis = \"static\"
        stop = 1
        step = 0.005
        output_step = 0.005
        tolerance = 1e-10"
    )
}

/// The place, along and across, of the tip of a cantilever with the force `P` across it, its bending rigidity `EI`, its
/// axial one `EA` and its length, by shooting: `θ'' = −P cos θ (1 + P sin θ/EA)/EI`.
pub fn elastica([force, bending, axial, length]: [f64; 4]) -> [f64; 2] {
    let step = length / f64::from(STEPS);
    let slope = |[theta, bend, _, _]: &[f64; 4]| {
        let stretch = 1.0 + force * theta.sin() / axial;
        [*bend, -force * theta.cos() * stretch / bending, stretch * theta.cos(), stretch * theta.sin()]
    };
    let end = |bend: f64| (0..STEPS).fold([0.0, bend, 0.0, 0.0], |rod, _| runge_kutta(&rod, step, slope));
    // The tip has no curvature: below the root's right one its moment is on the other side.
    let (mut low, mut high) = (0.0, 2.0 * force * length / bending);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if end(middle)[1] < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [_, _, along, across] = end(low);
    [along, across]
}

/// How far the tip of a rod of 10 m and of the rigidities [`ROUND`] moves along z at each of `count` equal shares of
/// the loads [`WINDING`], m.
///
/// With `EI = GJ` the moment in the world is `EI` times the turn of the tangent per length: `t' = (m + p × f) × t/EI`
/// and `p' = −(1 + f·t/EA) t`, where `p` is the way to the tip. Both loads are along z, so that a turn about z changes
/// nothing, and one number is sought: the height of the tangent at the tip with which it is 0 at the root.
pub fn helix(count: u32) -> Vec<f64> {
    let mut heights = [0.0; 2];
    let at = |share: f64, heights: &mut [f64; 2]| {
        let (force, moment) = (Vec3::z() * (50.0 * share), Vec3::z() * (200.0 * PI * share));
        // From the tip to the root.
        let slope =
            |[way, t]: &[Vec3; 2]| [t * (1.0 + force.dot(t) / 1e4), t.cross(&(moment + way.cross(&force))) / 100.0];
        let root = |height: f64| {
            let tip = [Vec3::zeros(), Vec3::new((1.0 - height * height).sqrt(), 0.0, height)];
            (0..STEPS).fold(tip, |rod, _| runge_kutta(&rod, 10.0 / f64::from(STEPS), slope))
        };
        // Newton by differences, from where the last two loads lead to.
        let mut height = 2.0 * heights[1] - heights[0];
        for _ in 0..6 {
            let (here, beside) = (root(height)[1].z, root(height + 1e-7)[1].z);
            height -= here * 1e-7 / (beside - here);
        }
        *heights = [heights[1], height];
        root(height)[0].z
    };
    (1..=count).map(|k| at(f64::from(k) / f64::from(count), &mut heights)).collect()
}
