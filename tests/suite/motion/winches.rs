//! Beams that winches pay out. At a given instant such a beam is one of another free length; in motion its mass grows
//! and passes through the mesh.

use crate::curves::{Curves, load};
use crate::motion::step_derivatives::worst;
use crate::running;
use ancf14::fmi::{Model, Value};
use ancf14::solve::modes::modes;
use ancf14_testing::integrate::runge_kutta;

/// A bent and twisted cantilever of 1 m that is drawn with `length` m and pays out `paid` m, with a body, its weight
/// and a force and a moment at its end.
fn cantilever(length: f64, paid: f64, more: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"cantilever\"
        gravity = [1, -3, -2]
        [section.strip]
        shape = \"rigidities\"
        EA = 2e3
        EI_y = 3
        EI_z = 2
        GJ = 1
        line_density = 0.4
        [beam.strip]
        section = \"strip\"
        from = [0, 0, 0]
        to = [{length}, 0, 0]
        elements = 5
        {more}
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"strip.start\"
        [winch.reel]
        at = \"strip.start\"
        length = {paid}
        [load.hand]
        at = \"strip.end\"
        force = [-1, 2, 1]
        moment = [0.5, 0.2, 0.1]
        [output.end]
        at = \"strip.end\"
        quantities = [\"position\"]
        [output.within]
        at = \"strip@0.3\"
        quantities = [\"section_force\", \"section_moment\", \"curvature\", \"torsion\"]
        [output.root]
        at = \"root\"
        quantities = [\"reaction_force\", \"reaction_moment\"]
        [simulation]
        analysis = \"static\"
        stop = 1
        step = 1
        totals = [\"energy\"]"
    )
}

/// A beam that has paid out 0.4 m, or hauled it in, is the beam that is drawn as long: the same equations, but for
/// round-off, which a tolerance of 1e-10 leaves.
#[test]
fn a_length_paid_out_is_a_length_drawn() {
    // A pretwist is a torsion without stress, which stays what it is per length.
    for more in [
        "strain = \"small\"",
        "strain = \"large\"",
        "twist = \"quadratic\"",
        "strain = \"large_truncated\"",
        "pretwist = 0.3*LENGTH",
    ] {
        for paid in [0.4, -0.4] {
            let run = |length: f64, paid: &str| {
                // As drawn at t = 0, and then at the length of t = 1.
                let more = more.replace("0.3*LENGTH", &(0.3 * length).to_string());
                let text = cantilever(length, 0.0, &more).replace("length = 0\n", &format!("length = {paid}\n"));
                Curves::run(&text, &[("simulation.tolerance", "1e-12")])
            };
            let (winch, drawn) = (run(1.0, &format!("\"{paid}*t\"")), run(1.0 + paid, "0"));
            let of_outputs = ["end.position", "within.", "root.", "energy."];
            for name in winch.names().iter().filter(|name| of_outputs.iter().any(|own| name.starts_with(own))) {
                let (own, other) = (winch.last(name), drawn.last(name));
                assert!((own - other).abs() < 1e-9 * other.abs().max(1.0), "{more} {paid} {name}: {own} {other}");
            }
        }
    }
}

/// The mesh error of an equilibrium, and natural frequencies, are those of a beam drawn as long: to round-off of the
/// meshes, 1e-6, and of the modes, 1e-9.
#[test]
fn mesh_errors_and_modes_have_the_length_that_is_out() {
    let concluded = |length: f64, paid: &str| {
        let text = cantilever(length, 0.0, "").replace("length = 0\n", &format!("length = {paid}\n"));
        let mut simulation = load(&text, &[]);
        simulation.advance(1.0).unwrap();
        simulation.conclude();
        let errors: Vec<f64> = simulation.mesh_errors().iter().map(|own| own.error).collect();
        let found = modes(simulation.system(), simulation.state(), 6).unwrap();
        (errors, found.modes.iter().map(|mode| mode.eigenvalue).collect::<Vec<_>>())
    };
    let ((errors, squares), (drawn_errors, drawn_squares)) = (concluded(1.0, "0.4"), concluded(1.4, "0"));
    assert!(!errors.is_empty() && errors.len() == drawn_errors.len(), "{errors:?} {drawn_errors:?}");
    for (own, other) in errors.iter().zip(&drawn_errors) {
        assert!((own - other).abs() < 1e-6 * other.max(1e-3), "{own} {other}");
    }
    for (own, other) in squares.iter().zip(&drawn_squares) {
        assert!((own / other - 1.0).abs() < 1e-6, "{own} {other}");
    }
}

/// A rope that is drawn slack, pinned at both ends, and paid out: a catenary of the length `L = 2 a sinh(d/2a)`, with
/// the sag `a (cosh(d/2a) − 1)` and the horizontal pull `ρ g a`. The rope stretches by 1e-4, and its bending stiffness
/// rounds off its ends by `sqrt(EI/H)`, 2 mm.
#[test]
fn a_rope_that_is_paid_out_hangs_as_a_catenary() {
    let text = "format = 1
        [model]
        name = \"catenary\"
        gravity = [0, 0, -10]
        [section.rope]
        shape = \"rigidities\"
        EA = 1e5
        EI_y = 2e-5
        EI_z = 2e-5
        GJ = 1e-3
        line_density = 1
        [beam.rope]
        section = \"rope\"
        curve = { x = \"s\", y = 0, z = \"-1.2*s*(1 - s)\", s = [0, 1] }
        elements = 24
        [joint.left]
        type = \"revolute\"
        a = \"ground\"
        b = \"rope.start\"
        axis = [0, 1, 0]
        [joint.right]
        type = \"revolute\"
        a = \"ground\"
        b = \"rope.end\"
        axis = [0, 1, 0]
        [winch.reel]
        at = \"rope.end\"
        length = \"0.5*t\"
        [output.middle]
        at = \"rope@0.5\"
        quantities = [\"position\"]
        [output.pull]
        at = \"left\"
        quantities = [\"reaction_force\"]
        [simulation]
        analysis = \"static\"
        stop = 1
        step = 0.02
        output_step = 0.1";
    let curves = Curves::run(text, &[]);
    let (height, pull) = (curves.column("middle.position[3]"), curves.column("pull.reaction_force[1]"));
    let weight = curves.column("pull.reaction_force[3]");
    // The arc of a parabola that rises by 0.3 m on half a meter, `4 f/d = 1.2`.
    let drawn = 0.5 * (1.0 + 1.44_f64).sqrt() + 1.2_f64.asinh() / 2.4;
    for (row, t) in curves.time.iter().enumerate() {
        let length = drawn + 0.5 * t;
        // The half span over a, by bisection.
        let (mut low, mut high) = (1e-6_f64, 20.0_f64);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if middle.sinh() / middle < length { low = middle } else { high = middle }
        }
        let a = 0.5 / low;
        let sag = a * (low.cosh() - 1.0);
        assert!((height[row] + sag).abs() < 2e-3 * sag, "{t}: {} {sag}", height[row]);
        assert!((pull[row].abs() - 10.0 * a).abs() < 5e-3 * 10.0 * a, "{t}: {} {}", pull[row], 10.0 * a);
        // Half of the weight, of all that is out.
        assert!((weight[row].abs() - 5.0 * length).abs() < 1e-6 * length, "{t}: {}", weight[row]);
    }
}

/// A load of 20 kg on a rope of 1.2 kg/m, let down from 4 m by 6 m within 2 s, as stiff as a bar.
fn hoist(motion: &str, more: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"hoist\"
        gravity = [0, 0, -10]
        [section.rope]
        shape = \"rigidities\"
        EA = 1e7
        EI_y = 1
        EI_z = 1
        GJ = 1
        line_density = 1.2
        [beam.rope]
        section = \"rope\"
        from = [0, 0, 0]
        to = [0, 0, -4]
        y_axis = [0, 1, 0]
        elements = 4
        tension_damping = 1e-2
        [body.load]
        mass = 20
        position = [0, 0, -4]
        inertia = [1, 1, 1]
        [joint.top]
        type = \"weld\"
        a = \"ground\"
        b = \"rope.start\"
        [joint.hook]
        type = \"weld\"
        a = \"rope.end\"
        b = \"load\"
        [winch.hoist]
        at = \"rope.start\"
        {motion}
        [output.mass]
        at = \"load\"
        quantities = [\"position\", \"velocity\", \"acceleration\"]
        [output.hang]
        at = \"top\"
        quantities = [\"reaction_force\", \"reaction_moment\"]
        [output.within]
        at = \"rope@0.5\"
        quantities = [\"section_force\", \"curvature\", \"velocity\"]
        [simulation]
        initial = \"equilibrium\"
        stop = 2
        step = 1e-3
        output_step = 0.05
        totals = [\"energy\", \"work\", \"momentum\"]
        {more}"
    )
}

/// From rest to rest: `6 (10 x³ − 15 x⁴ + 6 x⁵)` with `x = t/2`.
const SMOOTH: &str = "length = \"6*(10*(t/2)^3 - 15*(t/2)^4 + 6*(t/2)^5)\"";

/// The same with its rate and acceleration, m.
fn smooth(t: f64) -> [f64; 3] {
    let x = 0.5 * t;
    [
        6.0 * x * x * x * (10.0 - 15.0 * x + 6.0 * x * x),
        3.0 * 30.0 * x * x * (1.0 - 2.0 * x + x * x),
        1.5 * 60.0 * x * (1.0 - 3.0 * x + 2.0 * x * x),
    ]
}

/// All of the rope moves as the load does: the winch holds `(m + ρ L)(g − a)`, the energies are those of a rigid rope,
/// and the winch gives what they change by. The rope stretches by 3e-5; the vibration that the jerk of the winch raises
/// is damped within 1e-2 of its period.
#[test]
fn a_heavy_rope_lets_down_a_load() {
    let drawn = hoist(SMOOTH, "");
    // A pretension is a strain without stress. Were the growth without it, damping would add a force, and the section
    // force would be lower by as much: 3.5 N was seen.
    let pulled = drawn.replace("elements = 4", "elements = 4\n        pretension = 200");
    let [own, other] = [&pulled, &drawn].map(|text| lets_down(text).column("within.section_force[1]"));
    let difference = own.iter().zip(&other).fold(0.0, |most: f64, (own, other)| most.max((own - other).abs()));
    assert!(difference < 0.2, "{difference}");
}

fn lets_down(text: &str) -> Curves {
    let curves = Curves::run(text, &[]);
    let column = |name: &str| curves.column(name);
    let (pull, height, work) = (column("hang.reaction_force[3]"), column("mass.position[3]"), column("work.drives"));
    let (kinetic, total) = (column("energy.kinetic"), column("energy.total"));
    let (momentum, drift) = (column("momentum.linear[3]"), column("work.drift"));
    for (row, &t) in curves.time.iter().enumerate() {
        let [paid, v, a] = smooth(t);
        let length = 4.0 + paid;
        let mass = 20.0 + 1.2 * length;
        assert!((height[row] + length).abs() < 1e-3, "{t}: {} {length}", height[row]);
        assert!((pull[row] - mass * (10.0 - a)).abs() < 0.5, "{t}: {} {}", pull[row], mass * (10.0 - a));
        assert!((momentum[row] + mass * v).abs() < 5e-3 * mass * 5.6, "{t}: {} {}", momentum[row], mass * v);
        assert!(
            (kinetic[row] - 0.5 * mass * v * v).abs() < 5e-3 * 500.0,
            "{t}: {} {}",
            kinetic[row],
            0.5 * mass * v * v
        );
        let gravity = -10.0 * (20.0 * length + 0.6 * length * length);
        assert!((total[row] - kinetic[row] - gravity).abs() < 0.5, "{t}: {} {gravity}", total[row] - kinetic[row]);
        assert!((work[row] - (total[row] - total[0])).abs() < 1e-4 * 2000.0, "{t}: {} {}", work[row], drift[row]);
    }
    let [first, last] = [0, curves.time.len() - 1].map(|row| pull[row]);
    assert!((first - 248.0).abs() < 1e-6 && (last - 320.0).abs() < 0.5, "{first} {last}");
    curves
}

/// The drift of the account falls with the square of the step, also 50 km away; a run with steps of its own choice has
/// no warning of its energy, and small errors.
#[test]
fn the_account_of_a_winch_closes_to_second_order() {
    let drift_of = |text: &str, step: &str| {
        let curves = Curves::run(text, &[("simulation.step", step)]);
        curves.column("work.drift").iter().fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    let text = hoist(SMOOTH, "");
    let drift = |step: &str| drift_of(&text, step);
    let far = text
        .replace("from = [0, 0, 0]", "from = [0, 0, 50000]")
        .replace("[0, 0, -4]", "[0, 0, 49996]")
        .replace("[joint.top]", "[joint.top]\n        at = [0, 0, 50000]");
    // Round-off of 1e7 J of weight.
    assert!((drift_of(&far, "1e-3") - drift("1e-3")).abs() < 1e-6, "{}", drift_of(&far, "1e-3"));
    let mut chosen = load(&text.replace("step = 1e-3\n", "\n"), &[]);
    Curves::record(&mut chosen);
    chosen.conclude();
    // Accelerations of a stiff rope are off by 0.6 %: that is told, and nothing else.
    let told = chosen.take_warnings();
    let is_small = |text: &String| text.starts_with("mass.acceleration is off by about 0.6");
    assert!(told.iter().all(is_small), "{told:?}");
    let found = ["4e-3", "2e-3", "1e-3"].map(drift);
    let orders = [0, 1].map(|k| (found[k] / found[k + 1]).log2());
    println!("{found:?} {orders:?}");
    assert!(orders.iter().all(|order| *order > 1.6), "{found:?}");
    assert!(found[2] < 1e-4 * 2000.0);
}

/// A rod on a pivot that is pushed out while it swings, as stiff as can be.
fn rod(step: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"rod\"
        gravity = [0, 0, -10]
        [section.rod]
        shape = \"rigidities\"
        EA = 1e6
        EI_y = 1e5
        EI_z = 1e5
        GJ = 1e3
        line_density = 2
        damping = 1e-3
        [beam.rod]
        section = \"rod\"
        from = [0, 0, 0]
        to = [1, 0, 0]
        elements = 3
        [joint.pivot]
        type = \"revolute\"
        a = \"ground\"
        b = \"rod.start\"
        axis = [0, 1, 0]
        [winch.push]
        at = \"rod.start\"
        length = \"0.3*t^3*(2 - t)\"
        [output.tip]
        at = \"rod.end\"
        quantities = [\"position\"]
        [output.swing]
        at = \"pivot\"
        quantities = [\"angle\"]
        [simulation]
        initial = \"as_drawn\"
        stop = 1.5
        step = {step}
        output_step = 0.05"
    )
}

/// The angular momentum of a rod that comes out of its pivot: `(ρL³/3) φ'' + ρL² L' φ' = (ρ g L²/2) cos φ`. Without the
/// Coriolis forces of what moves through the mesh, the swing would be off by a tenth. The rod bends by 1e-4.
#[test]
fn a_rod_that_is_pushed_out_swings_slower() {
    let curves = Curves::run(&rod("1e-3"), &[]);
    let angle = curves.column("swing.angle");
    let slope = |[phi, omega, t]: &[f64; 3]| {
        let (length, speed) = (1.0 + 0.3 * t * t * t * (2.0 - t), 0.3 * t * t * (6.0 - 4.0 * t));
        [*omega, 1.5 * 10.0 / length * phi.cos() - 3.0 * speed / length * omega, 1.0]
    };
    let mut state = [0.0; 3];
    for (row, &time) in curves.time.iter().enumerate() {
        while state[2] < time - 5e-4 {
            state = runge_kutta(&state, 1e-3, slope);
        }
        assert!((angle[row] - state[0]).abs() < 2e-3, "{time}: {} {}", angle[row], state[0]);
    }
    assert!(angle.iter().any(|angle| *angle > 2.0), "it has swung through");
}

/// A host that gives the length or the rate moves the load as a function of time does, as far as its straight pieces
/// follow it.
#[test]
fn a_host_pays_out() {
    let function = Curves::run(&hoist("length = \"0.5*t^2\"", ""), &[]);
    for (motion, value) in [("input = \"length\"", "length"), ("input = \"rate\"", "rate")] {
        let mut simulation = load(&hoist(motion, ""), &[]);
        let name = format!("hoist.{value}");
        let input = simulation.variables().iter().position(|variable| variable.name == name).unwrap();
        let height = function.column("mass.position[3]");
        let mut largest = 0.0_f64;
        for (row, &t) in function.time.iter().enumerate().skip(1) {
            let given = if *value == *"rate" { t } else { 0.5 * t * t };
            simulation.set_value(input, Value::Real(given)).unwrap();
            simulation.advance(t).unwrap();
            largest = largest.max((running::value(&simulation, "mass.position[3]") - height[row]).abs());
        }
        println!("{motion}: {largest:.1e} m");
        assert!(largest < 1e-5, "{motion}: {largest}");
    }
}

/// Hauling in all of a beam is refused in words, and the state before stays.
#[test]
fn a_winch_must_leave_something() {
    let mut simulation = load(&hoist("length = \"-3.9*t*t\"", ""), &[]);
    simulation.advance(0.9).unwrap();
    let failure = simulation.advance(1.2).unwrap_err().message;
    assert!(failure.contains("winch hoist leaves") && failure.contains("haul in less"), "{failure}");
}

/// A soft rope with a load that a host pays out, aslant: the free length changes strains, mass and what passes through
/// the mesh.
#[test]
fn derivatives_by_what_a_winch_pays_out() {
    for word in ["length", "rate"] {
        let model = hoist(&format!("input = \"{word}\""), "tolerance = 1e-12")
            .replace("gravity = [0, 0, -10]", "gravity = [1, 2, -10]")
            // Short and light, so that a step moves it by far more than round-off.
            .replace("-4]", "-1]")
            .replace("mass = 20", "mass = 1")
            .replace("inertia = [1, 1, 1]", "inertia = [0.1, 0.1, 0.1]")
            .replace("EA = 1e7", "EA = 1e4")
            .replace("tension_damping = 1e-2", "tension_damping = 1e-3")
            .replace("initial = \"equilibrium\"", "")
            .replace("step = 1e-3", "step = 2e-3")
            .replace("output_step = 0.05", "output_step = 2e-3")
            // The account has no derivatives by inputs.
            .replace("\"work\", ", "");
        for (step, steps) in [(6e-3, 1), (4e-3, 5)] {
            let (error, what) = worst(load(&model, &[]), step, steps);
            println!("{word}, {steps} steps: {error:.1e} ({what})");
            // The differences leave 5e-5 of a family; a term that is missing shows at 1e-2.
            assert!(error < 1e-4, "{word}: {error:.1e} ({what})");
        }
    }
}

/// Loads along a beam that is paid out act on the length that is out: in the place of gravity they move a hoist as its
/// weight does, bear on sections alike, and do the work that the weight gives away. Both runs solve the same equations,
/// to the tolerance of Newton's method.
#[test]
fn loads_along_a_beam_that_is_paid_out_are_per_length() {
    // The section lies within an element.
    let weight = hoist(SMOOTH, "").replace("rope@0.5", "rope@0.4");
    let loads = "[load.rope]\non = \"rope\"\nforce = [0, 0, -12]\n[load.hook]\nat = \"load\"\nforce = [0, 0, -200]";
    let pushed =
        weight.replace("gravity = [0, 0, -10]", "").replace("[winch.hoist]", &format!("{loads}\n[winch.hoist]"));
    let [heavy, pushed] = [&weight, &pushed].map(|text| Curves::run(text, &[("simulation.tolerance", "1e-10")]));
    for name in ["mass.position[3]", "mass.acceleration[3]", "hang.reaction_force[3]", "within.section_force[1]"] {
        let [own, other] = [&pushed, &heavy].map(|run| run.column(name));
        let most = other.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let worst = own.iter().zip(&other).fold(0.0, |worst: f64, (own, other)| worst.max((own - other).abs()));
        assert!(worst < 1e-7 * most, "{name}: {worst} of {most}");
    }
    let (work, gravity) = (pushed.column("work.loads"), heavy.column("energy.gravity"));
    let drift = [&heavy, &pushed]
        .map(|run| run.column("work.drift").iter().fold(0.0, |most: f64, drift| most.max(drift.abs())));
    println!("work {} J, drifts {drift:?} J", work.last().unwrap());
    for (work, own) in work.iter().zip(&gravity) {
        // As the account of the weight closes: to second order in the step.
        assert!((work + own - gravity[0]).abs() < 1e-4 * 2000.0, "{work} {own}");
    }
    assert!(drift[1] < 1e-4 * 2000.0, "{drift:?}");
}
