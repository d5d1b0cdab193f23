//! A section given by its rigidities has these rigidities, at every size of the strains: `M = EI κ`, `T = GJ τ`, `N = EA ε`, with strains per undeformed length. All rods here are thick: as
//! rectangles with these rigidities their fibers would strain by 10 % and more, which is 1 to 4 % of a displacement.

use crate::running::{start, value, vector};
use ancf14::fmi::Model;
use ancf14::math::Vec3;

/// A rod of 10 m along x, held at its start, with what follows in `section` and `more`.
fn rod(section: &str, elements: usize, more: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"rod\"
        [section.own]
        shape = \"rigidities\"
        GJ = 100
        line_density = 1
        {section}
        [beam.rod]
        section = \"own\"
        from = [0, 0, 0]
        to = [10, 0, 0]
        elements = {elements}
        twist = \"quadratic\"
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"rod.start\"
        [output.tip]
        at = \"rod.end\"
        quantities = [\"displacement\", \"rotation\"]
        [load.tip]
        at = \"rod.end\"
        {more}
        [simulation]
        analysis = \"static\"
        stop = 1
        step = 0.005
        tolerance = 1e-10"
    )
}

const ROUND: &str = "EA = 1e4\nEI_y = 100\nEI_z = 100";
const LENGTH: f64 = 10.0;

/// Displacement and rotation of the tip at the times `times`.
fn tips(text: &str, times: &[f64]) -> Vec<(Vec3, Vec3)> {
    let mut simulation = start(text);
    let found = times.iter().map(|time| {
        simulation.advance(*time).unwrap_or_else(|failure| panic!("{}", failure.message));
        (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"))
    });
    found.collect()
}

/// The tip of the rod at the end.
fn tip(text: &str) -> (Vec3, Vec3) {
    tips(text, &[1.0])[0]
}

/// The moment 2 pi EI/L closes a circle about either axis: 16 elements of a beam miss the start by 1e-4 of its length (docs/validation.md), 32 by 6e-6.
#[test]
fn the_moment_of_a_full_turn_closes_the_circle() {
    for moment in ["[0, 0, \"20*pi*t\"]", "[0, \"20*pi*t\", 0]"] {
        for (elements, bound) in [(16, 1.1e-4), (32, 7e-6)] {
            let (moved, _) = tip(&rod(ROUND, elements, &format!("moment = {moment}")));
            let gap = (moved + Vec3::x() * LENGTH).norm() / LENGTH;
            println!("{elements}: {gap:e}");
            assert!(gap < bound, "{gap:e}");
        }
    }
}

/// The right moment turns a tapered rod by `M ∫ ds/EI` along it, and its tip is where the integral of that slope is; here EI falls to a third.
#[test]
fn a_tapered_rod_turns_by_the_integral_of_its_flexibility() {
    let section = "EA = 1e4\nEI_y = 100\nEI_z = \"100/(0.5 + s/10)\"";
    let (moved, turn) = tip(&rod(section, 32, "moment = [0, 0, \"10*pi*t\"]"));
    // κ = 0.1π (0.5 + s/10): the slope by integration in closed form, the place by the midpoint rule, right to 1e-7 m.
    let slope = |s: f64| 0.1 * std::f64::consts::PI * (0.5 * s + s * s / 20.0);
    let count = 20_000;
    let width = LENGTH / f64::from(count);
    let place = (0..count)
        .map(|k| (f64::from(k) + 0.5) * width)
        .fold(Vec3::zeros(), |sum, s| sum + Vec3::new(slope(s).cos(), slope(s).sin(), 0.0) * width);
    let error = (moved + Vec3::x() * LENGTH - place).norm() / LENGTH;
    println!("{error:e} {turn}");
    // As the circle above, with half the turn.
    assert!(error < 7e-6 && (turn.z.abs() - std::f64::consts::PI).abs() < 1e-5, "{error:e} {turn}");
}

/// The tip of a cantilever of length L with the force P across it, along and across, by shooting with the classical Runge-Kutta method: `θ'' = −P cos θ (1 + P sin θ/EA)/EI`.
fn elastica([force, bending, axial, length]: [f64; 4]) -> [f64; 2] {
    let steps = 2000;
    let h = length / f64::from(steps);
    let end = |start: f64| {
        let rate = |[theta, bend, _, _]: [f64; 4]| {
            let stretch = 1.0 + force * theta.sin() / axial;
            [bend, -force * theta.cos() * stretch / bending, stretch * theta.cos(), stretch * theta.sin()]
        };
        let moved = |y: [f64; 4], h: f64, r: [f64; 4]| std::array::from_fn(|i| y[i] + h * r[i]);
        (0..steps).fold([0.0, start, 0.0, 0.0], |y, _| {
            let a = rate(y);
            let b = rate(moved(y, 0.5 * h, a));
            let c = rate(moved(y, 0.5 * h, b));
            let d = rate(moved(y, h, c));
            std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
        })
    };
    let (mut low, mut high) = (0.0, 2.0 * force * length / bending);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if end(middle)[1] < 0.0 { low = middle } else { high = middle }
    }
    let [_, _, x, y] = end(low);
    [x, y]
}

/// A cantilever with P L²/EI = 3, whose axis stretches by up to 2.5 %; without stretching the reference is that of the elliptic integrals.
#[test]
fn a_thick_cantilever_bends_as_the_elastica() {
    let [x, y] = elastica([3.0, 1.0, 1e9, 1.0]);
    // Bisshopp and Drucker, as in tests/references/elastica.csv: eight decimals.
    assert!((y - 0.603_253_44).abs() < 1e-7 && (1.0 - x - 0.254_420_18).abs() < 1e-7, "{x} {y}");
    let [x, y] = elastica([300.0, 1600.0, 1e4, 4.0]);
    let text =
        rod("EA = 1e4\nEI_y = 1600\nEI_z = 1600", 16, "force = [0, \"300*t\", 0]").replace("to = [10,", "to = [4,");
    let (moved, _) = tip(&text);
    println!("{} {} {x} {y}", moved.x + 4.0, moved.y);
    // 16 elements: 3e-6 of the length for the elastica of docs/validation.md.
    assert!((moved.x + 4.0 - x).abs().max((moved.y - y).abs()) < 3e-6 * 4.0, "{moved} {x} {y}");
}

/// How far the tip has moved along z when a dead moment and a dead force, both along z, have wound a rod of one rigidity in bending and torsion to a helix.
///
/// With `EI = GJ` the moment in the world is `EI` times the turn of the tangent per length, so that `t' = (m + p × f) × t/EI` and `p' = −(1 + f·t/EA) t` for the way `p` from here to the tip. Both loads are
/// along z: a turn about z changes nothing, and the height of the tangent at the tip, `sought`, is all that is not known there; at the root it is 0.
fn helix(share: f64, sought: &mut [f64; 2]) -> f64 {
    let (force, moment) = (Vec3::z() * (50.0 * share), Vec3::z() * (200.0 * std::f64::consts::PI * share));
    let steps = 4000;
    let h = LENGTH / f64::from(steps);
    let root = |height: f64| {
        let rate = |(way, t): (Vec3, Vec3)| {
            ((t * (1.0 + force.dot(&t) / 1e4)), -((moment + way.cross(&force)) / 100.0).cross(&t))
        };
        let moved = |(way, t): (Vec3, Vec3), h: f64, (a, b): (Vec3, Vec3)| (way + a * h, t + b * h);
        (0..steps).fold((Vec3::zeros(), Vec3::new((1.0 - height * height).sqrt(), 0.0, height)), |y, _| {
            let a = rate(y);
            let b = rate(moved(y, 0.5 * h, a));
            let c = rate(moved(y, 0.5 * h, b));
            let d = rate(moved(y, h, c));
            moved(y, h / 6.0, (a.0 + (b.0 + c.0) * 2.0 + d.0, a.1 + (b.1 + c.1) * 2.0 + d.1))
        })
    };
    // Newton by differences, from where the last two loads lead to.
    let mut height = 2.0 * sought[1] - sought[0];
    for _ in 0..20 {
        let (here, beside) = (root(height).1.z, root(height + 1e-7).1.z);
        height -= here * 1e-7 / (beside - here);
    }
    *sought = [sought[1], height];
    root(height).0.z
}

/// Ten turns about an axis across the rod, pulled out along it: the tip is at −0.608 m at a fifth of the load, and at −0.126 m at the end.
#[test]
fn a_rod_wound_to_a_helix_of_ten_turns() {
    let text = rod(ROUND, 100, "force = [0, 0, \"50*t\"]\nmoment = [0, 0, \"200*pi*t\"]");
    let found = tips(&text, &[0.2, 1.0]);
    let mut sought = [0.0; 2];
    let exact: Vec<f64> = (1..=50).map(|k| helix(f64::from(k) / 50.0, &mut sought)).collect();
    println!("{} {} of {} {}", found[0].0.z, found[1].0.z, exact[9], exact[49]);
    assert!((exact[9] + 0.6084).abs() < 1e-4 && (exact[49] + 0.1264).abs() < 1e-4, "{} {}", exact[9], exact[49]);
    // An element turns by 7 degrees, and at the end by 36: with 200 and 400 of them the errors there are 6e-6 and 4e-7 m, of order 4.
    for (tip, exact, bound) in [(found[0].0, exact[9], 5e-6), (found[1].0, exact[49], 1.5e-4)] {
        assert!((tip.z - exact).abs() < bound, "{tip} {exact}");
    }
}

/// A fifth of its length longer, a rod has the torsion T/GJ per undeformed length, and bends as that length says: `EI θ'' = P (1 + P/EA) θ`, `θ = M sinh(k s)/(EI k cosh(k L))` under a
/// small moment at its end. Curvatures per deformed length would change `k` by a tenth.
#[test]
fn strains_are_per_undeformed_length() {
    let (force, torque, moment) = (2000.0_f64, 3.0, 0.1);
    let pulled = |moment: [f64; 3]| {
        let [x, _, z] = moment;
        tip(&rod(ROUND, 160, &format!("force = [\"{force}*t\", 0, 0]\nmoment = [\"{x}*t\", 0, \"{z}*t\"]")))
    };
    let [(moved, twisted), (_, bent)] = [[torque, 0.0, 0.0], [0.0, 0.0, moment]].map(pulled);
    let rate = (force * 1.2 / 100.0_f64).sqrt();
    let slope = moment / (100.0 * rate) * (rate * LENGTH).tanh();
    println!("{moved} {twisted} {bent} {slope}");
    // Elements are 0.3 times as long as the bend at the tip, 1/k: they miss 1e-5 of it.
    assert!((moved.x - 0.2 * LENGTH).abs() < 1e-8 * LENGTH, "{moved}");
    assert!(
        (twisted.x - torque * LENGTH / 100.0).abs() < 1e-8 && (bent.z / slope - 1.0).abs() < 1e-4,
        "{twisted} {bent}"
    );
}

/// A rod drawn with half of its length and paid out to all of it closes the circle as the whole one does.
#[test]
fn a_rod_that_is_paid_out_closes_the_circle() {
    let text = rod(ROUND, 32, "moment = [0, 0, \"20*pi*t\"]").replace("to = [10,", "to = [5,")
        + "\n[winch.reel]\nat = \"rod.start\"\nlength = \"5*t\"";
    let mut simulation = start(&text);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let gap = (vector(&simulation, "tip.displacement") + Vec3::x() * 5.0).norm() / LENGTH;
    println!("{gap:e} {}", value(&simulation, "energy.elastic"));
    // Energy M²L/2EI; the mesh leaves 1e-5 of it out.
    let energy = (20.0 * std::f64::consts::PI).powi(2) * LENGTH / 200.0;
    assert!(gap < 7e-6 && (value(&simulation, "energy.elastic") / energy - 1.0).abs() < 2e-5, "{gap:e}");
}
