//! Pulses that are shorter than a step must not be lost, whatever way they are written: their impulse is momentum of
//! the body that they act on. A step that looks at a function in its middle only sees nothing of them, or takes them
//! for the whole of the step.

use crate::curves::Curves;
use crate::running::{start, value};
use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::notes::notes;

/// A body of 1 kg on a slider.
const BODY: &str = "format = 1\n[model]\nname = \"Pulse\"\ngravity = [0, 0, 0]\n\
    [body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
    [joint.j]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [1, 0, 0]\n\
    [output.p]\nat = \"j\"\nquantities = [\"distance\", \"distance_rate\"]\n";
/// At rest, chosen steps are a fiftieth of this, 0.04 s.
const RUN: &str = "[simulation]\nstop = 2\noutput_step = 2\n";
const FIXED: &[(&str, &str)] = &[("simulation.step", "4e-3")];

/// Rows of a table of 1 N s, before 1 s and behind it.
const ROWS: &str = "[[0, 0], [1.0005, 0], [1.001, 1000], [1.0015, 1000], [1.002, 0], [3, 0]]";

fn load(force: &str) -> String {
    format!("[load.l]\nat = \"b\"\nforce = [\"{force}\", 0, 0]\n")
}

fn actuator(effort: &str) -> String {
    format!("[actuator.a]\njoint = \"j\"\ncoordinate = \"distance\"\neffort = \"{effort}\"\n")
}

fn table(rows: &str, more: &str) -> String {
    format!("[function.f]\ntable = {rows}\n{more}")
}

/// The speed behind a pulse.
fn speed(parts: &str, overrides: &[(&str, &str)]) -> f64 {
    Curves::run(&format!("{BODY}{parts}{RUN}"), overrides).last("p.distance_rate")
}

/// Chosen steps, fixed ones, and those of generalized-alpha: each must give 1 m/s, but for an error of `tolerance`, of
/// `alpha_tolerance` for generalized-alpha.
fn gives_its_impulse(ways: &[(&str, String)], tolerance: f64, alpha_tolerance: f64) {
    let alpha = [FIXED, &[("simulation.integrator", "generalized_alpha")]].concat();
    for (name, parts) in ways {
        for (overrides, tolerance) in [(&[][..], tolerance), (FIXED, tolerance), (&alpha[..], alpha_tolerance)] {
            let speed = speed(parts, overrides);
            assert!((speed - 1.0).abs() < tolerance, "{name} with {overrides:?}: {speed} m/s");
        }
    }
}

/// A constant force between two switches, or straight lines between corners: steps end at all of them, and the impulse
/// is right to the round-off of the forces' times. Generalized-alpha starts anew at jumps only; behind a corner it goes
/// on with the accelerations of a step of another length, which moves its impulse by a share of one step.
#[test]
fn regression_pulses_between_switches_give_their_impulse() {
    let exact = [
        ("comparisons", load("if(t > 1.0005 and t < 1.0015, 1000, 0)")),
        ("a product", load("1000*(t > 1.0005)*(t < 1.0015)")),
        ("or", load("1000*(1 - (t < 1.0005 or t >= 1.0015))")),
        ("step", load("1000*(step(1.0005, t) - step(1.0015, t))")),
        ("floor", load("1000*(floor((t - 0.0005)*1000) == 1000)")),
        ("unequal floors", load("if(floor((t - 0.0005)*1000) != 1000, 0, 1000)")),
        ("ceil", load("1000*(ceil(t - 1.0005) - ceil(t - 1.0015))*(t > 0.5)")),
        ("mod", load("if(mod(t, 1.5) > 1.0005 and mod(t, 1.5) < 1.0015, 1000, 0)")),
        ("sign", load("500*(sign(t - 1.0005) - sign(t - 1.0015))")),
        ("the sign of a parabola", load("500*(1 - sign((t - 1.001)^2 - 2.5e-7))")),
        ("atan2", load("1000/pi*(atan2(0*t, 1.0005 - t) - atan2(0*t, 1.0015 - t))")),
        (
            "functions in functions",
            load("1000*g(t)")
                + "[function.g]\nargument = \"x\"\nvalue = \"h(x - 1)\"\n\
                   [function.h]\nargument = \"y\"\nvalue = \"y > 0.0005 and y < 0.0015\"\n",
        ),
        (
            "parameters",
            load("P*(t > from)*(t < from + length)") + "[parameters]\nP = 1000\nfrom = 1.0005\nlength = 1e-3\n",
        ),
        ("an actuator", actuator("if(t > 1.0005 and t < 1.0015, 1000, 0)")),
        ("an actuator that follows", actuator("if(t > 1.0005 and t < 1.0015 and j.distance < 1, 1000, 0)")),
    ];
    let corners = [
        ("a minimum", load("1e6*(min(t, 1.0015) - min(t, 1.0005))*(t < 1.0015)/0.5")),
        ("a maximum", load("1000*max(0, 1 - abs(t - 1.0015)/1e-3)")),
        ("a table", load("f(t)") + &table(ROWS, "")),
        ("a table of a remainder", load("f(mod(t, 1.5))") + &table(ROWS, "")),
        ("a table that repeats itself", load("f(t)*(t > 0.9)") + &table(ROWS, "outside = \"repeat\"\n")),
    ];
    gives_its_impulse(&exact, 1e-9, 1e-9);
    gives_its_impulse(&corners, 1e-9, 0.2);
}

/// A smooth pulse takes about thirty steps, whose midpoints miss 2e-4 of its impulse each at most, of both signs;
/// chosen steps look at it with the accuracy of 1e-3. Generalized-alpha weighs the ends of steps whose lengths change
/// by factors of two.
#[test]
fn regression_smooth_pulses_give_their_impulse() {
    let gauss = |width: f64| format!("exp(-((t - 1.0015)/{width:e})^2)/{width:e}/sqrt(pi)");
    let ways = [
        ("Gauss, 0.3 ms", load(&gauss(3e-4))),
        ("Gauss, 10 us", load(&gauss(1e-5))),
        ("Gauss, 0.1 us", load(&gauss(1e-7))),
        ("Gauss on a load that begins later", load(&format!("{} + 10*(t > 3)", gauss(1e-5)))),
        ("a hyperbolic cosine", load("1/(2e-5*cosh((t - 1.0015)/1e-5)^2)")),
        ("smoothstep", load("1000*(smoothstep(1.0003, 1.0007, t) - smoothstep(1.0013, 1.0017, t))")),
        ("half a sine", load("1000*pi*max(0, sin(2*pi*1000*t))*(t > 1)*(t < 1.0005)")),
        ("a monotone table", load("f(t)") + &table(ROWS, "interpolation = \"monotone\"\n")),
        ("a monotone table of a remainder", load("f(mod(t, 1.5))") + &table(ROWS, "interpolation = \"monotone\"\n")),
        ("an actuator", actuator(&gauss(1e-5))),
        ("a table of a parabola", load("f(1 + (t - 1)/1 + 0*t^2)") + &table(ROWS, "interpolation = \"monotone\"\n")),
    ];
    gives_its_impulse(&ways, 3e-3, 0.1);
}

/// The rows of a table of `t^2` are met at the roots of `t`: the area of the table over `2 t`, within the accuracy.
#[test]
fn regression_rows_of_a_table_of_a_square_end_steps() {
    let rows = "[[0, 0], [1.001, 0], [1.00101, 1000], [1.00299, 1000], [1.003, 0], [9, 0]]";
    let exact = 1.99 / (2.0 * 1.002_f64.sqrt());
    for overrides in [&[][..], FIXED] {
        let speed = speed(&(load("f(t^2)") + &table(rows, "")), overrides);
        assert!((speed - exact).abs() < 1e-6, "{overrides:?}: {speed}, not {exact}");
    }
}

/// A drive whose rate is a pulse of 1 m: it ends 1 m further, to the round-off of the integral.
#[test]
fn regression_a_pulse_of_a_rate_is_integrated() {
    for rate in ["if(t > 1.0005 and t < 1.0015, 1000, 0)", "exp(-((t - 1.0015)/1e-5)^2)/1e-5/sqrt(pi)"] {
        let drive = format!("[drive.d]\njoint = \"j\"\ncoordinate = \"distance\"\nrate = \"{rate}\"\n");
        for overrides in [&[][..], FIXED] {
            let text = format!("{BODY}{drive}{RUN}");
            let distance = Curves::run(&text, overrides).last("p.distance");
            assert!((distance - 1.0).abs() < 1e-9, "{rate} with {overrides:?}: {distance} m");
        }
    }
}

/// A frame at the end of a spring of 1 N/m moves by 1000 m and back within 1 ms, as the square of half a sine: 0.5 N s,
/// which the spring, of a period of 6 s, hands on. Behind it the body swings with that speed at first, `v cos(t)`.
/// Fixed steps give it to the round-off of half a dozen steps through the pulse; in chosen ones the numerical
/// dissipation of the spring, of first order in the step, adds up to a third.
#[test]
fn regression_a_pulse_of_a_frame_moves_what_hangs_on_it() {
    let frame = "[frame.f]\nposition = [\"1000*if(t > 1.0005 and t < 1.0015, sin(pi*(t - 1.0005)/1e-3)^2, 0)\", 0, 0]\n\
        [point.p]\non = \"f\"\noffset = [-2000, 0, 0]\n[spring.s]\na = \"p\"\nb = \"b\"\nstiffness = 1\nlength = 2000\n";
    let exact = 0.5 * (2.0_f64 - 1.001).cos();
    for (overrides, tolerance) in [(&[][..], 0.3), (FIXED, 5e-3)] {
        let speed = speed(frame, overrides);
        assert!((speed - exact).abs() < tolerance * exact, "{overrides:?}: {speed} m/s, not {exact} m/s");
    }
}

/// A latch that holds for 1 ms, by the square of the time: steps and the search for switches once looked at 10,000
/// instants only.
#[test]
fn regression_a_short_hold_is_not_passed_over() {
    let lock = "[lock.k]\njoint = \"j\"\ncoordinate = \"distance\"\nactive = \"t^2 > 1.000001 and t^2 < 1.000002\"\n";
    let moving = BODY.replace("inertia", "velocity = [1, 0, 0]\ninertia");
    let speed = Curves::run(&format!("{moving}{lock}{RUN}"), &[]).last("p.distance_rate");
    assert!(speed.abs() < 1e-12, "{speed} m/s");
}

/// The steps that a run takes.
fn steps(parts: &str, overrides: &[(&str, &str)]) -> f64 {
    let totals = format!("{RUN}totals = [\"statistics\"]\n");
    Curves::run(&format!("{BODY}{parts}{totals}"), overrides).last("statistics.steps")
}

/// A load that steps resolve costs none: fixed steps are those of the grid, and chosen ones are as many as they were
/// before anything looked for pulses, to the step.
#[test]
fn smooth_loads_cost_no_steps() {
    let chosen = [
        ("100*sin(5*t)", 427.0),
        ("100*sin(50*t)", 1595.0),
        ("100*exp(-((t - 1)/0.2)^2)", 686.0),
        ("100*smoothstep(0, 1, t)", 502.0),
        ("3 + t^2", 73.0),
    ];
    for (force, count) in chosen {
        assert_eq!([steps(&load(force), FIXED), steps(&load(force), &[])], [500.0, count], "{force}");
    }
}

/// A switch a microsecond would be two million steps: they do not end there, and a sentence says so.
#[test]
fn too_many_switches_are_told_and_passed_over() {
    for force in ["mod(t, 1e-6)", "mod(t, 1e-9)", "sin(1e8*t) > 0", "abs(sin(1e9*t))"] {
        let text = format!("{BODY}{}{RUN}", load(force));
        let warnings = notes(&Document::parse("m.toml", &text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        assert!(warnings.iter().any(|one| one.contains("switches every")), "{force}: {warnings:?}");
        let mut simulation = start(&text);
        simulation.advance(2.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        assert!(value(&simulation, "statistics.steps") < 1e5, "{force}");
    }
}

/// Four thousand switches: a force of 1 N that is on for three tenths of two seconds, 0.3 ms each time.
#[test]
fn a_pulse_width_is_kept() {
    for overrides in [&[][..], FIXED] {
        let speed = speed(&load("mod(t, 1e-3) < 3e-4"), overrides);
        // The round-off of the remainder moves each switch by 1e-16 s or so.
        assert!((speed - 0.6).abs() < 1e-9, "{overrides:?}: {speed} m/s");
    }
}
