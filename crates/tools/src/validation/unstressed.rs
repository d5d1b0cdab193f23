//! Beams with another shape without stress, and beams with heat, against closed forms.

use super::{Section, critical, study};
use ancf14::fmi::Model;
use ancf14::math::integral::integral;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;
use ancf14_testing::running::{value, vector};
use std::f64::consts::PI;

const MODEL: &str = include_str!("unstressed.toml");
const HELD: &str = "\n[joint.right]\ntype = \"weld\"\na = \"ground\"\nb = \"strip.end\"\n";

/// Curvature without stress, 1/m.
const FREE: f64 = 0.5;
/// Gradient of the temperature, K/m, as it is written, and its growth along the strip, 1/m.
const GRADIENT: f64 = 4e4;
const WAVE: f64 = 1.5;
/// Temperature at the start of the bar, K.
const WARMTH: f64 = 100.0;

/// The equilibrium at the end of a model with numbers of elements and other overrides.
fn at_end(text: &str, elements: u32, overrides: &[(&str, &str)]) -> Simulation {
    let count = elements.to_string();
    let mut simulation = load(text, &[&[("strip.elements", count.as_str())], overrides].concat());
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation
}

/// How far the tip is from that of the curve with the turn `turn` at the arc length, over the length.
fn tip_error(simulation: &Simulation, turn: impl Fn(f64) -> f64) -> f64 {
    let length = value(simulation, "strip.to[1]");
    let exact = [integral(&|s| turn(s).cos(), 0.0, length) - length, -integral(&|s| turn(s).sin(), 0.0, length)];
    let tip = vector(simulation, "tip.displacement");
    (tip.x - exact[0]).hypot(tip.z - exact[1]) / length
}

/// How far the moment between two walls is from `E I κ`, relative.
fn moment_error(simulation: &Simulation) -> f64 {
    let stiffness =
        value(simulation, "steel.young") * value(simulation, "flat.width") * value(simulation, "flat.height").powi(3)
            / 12.0;
    (vector(simulation, "middle.section_moment").y.abs() / (stiffness * FREE) - 1.0).abs()
}

pub fn write(section: &mut Section) {
    section.say(
        "A steel strip of 2 m, clamped at one end (`crates/tools/src/validation/unstressed.toml`), equilibria of `strain = \"large\"`. *Arc let go*: `free_curvature`, drawn straight; without stress it is an arc, \
         whose closed form is Hencky's for a bar that is curved without stress. The error is the distance of the tip over the length. *Arc held*: between two walls its moment is E I kappa; the quartic term of large strain adds 3/40 (kappa h)^2 of it with any mesh. *Gradient along the \
         strip*: a gradient of the temperature that grows as a sine of the arc length; the curvature is alpha times the gradient, and the tip follows by quadrature. *Bar*: its temperature \
         grows as an exponential of the arc length (`strain = \"small\"`); the error is that of its elongation.",
    );
    let counts = [2_u32, 4, 8, 16];
    let errors = |error: &dyn Fn(u32) -> f64| counts.iter().map(|elements| error(*elements)).collect::<Vec<f64>>();
    let free = format!("[{FREE}, 0]");
    let gradient = format!("[0, \"{GRADIENT}*sin({WAVE}*s)*t\"]");
    let warmth = format!("{WARMTH}*exp(s)*t");
    let held = format!("{MODEL}{HELD}");
    let columns = [
        (
            String::from("arc let go"),
            errors(&|n| tip_error(&at_end(MODEL, n, &[("strip.free_curvature", &free)]), |s| FREE * s)),
        ),
        (String::from("arc held"), errors(&|n| moment_error(&at_end(&held, n, &[("strip.free_curvature", &free)])))),
        (
            String::from("gradient along the strip"),
            errors(&|n| {
                let bent = at_end(MODEL, n, &[("strip.temperature_gradient", &gradient)]);
                let most = value(&bent, "steel.expansion") * GRADIENT / WAVE;
                tip_error(&bent, |s| most * (1.0 - (WAVE * s).cos()))
            }),
        ),
        (
            String::from("bar"),
            errors(&|n| {
                let warm = at_end(MODEL, n, &[("strip.temperature", &warmth), ("strip.strain", "small")]);
                let exact = value(&warm, "steel.expansion") * WARMTH * value(&warm, "strip.to[1]").exp_m1();
                (vector(&warm, "tip.displacement").x / exact - 1.0).abs()
            }),
        ),
    ];
    section.say(&study::table("elements", &counts.map(f64::from), &columns));
    let drawn = load(MODEL, &[]);
    let [length, height, expansion] = ["strip.to[1]", "flat.height", "steel.expansion"].map(|name| value(&drawn, name));
    // 4 π² I/(A L² α).
    let exact = PI * PI * height * height / (3.0 * length * length * expansion);
    section.say(&format!(
        "The same strip between two walls is heated (`strain = \"small\"`). It buckles at 4 pi^2 I/(A L^2 alpha) = {exact:.6} K, where the lowest eigenvalue of its stiffness passes zero; relative errors.",
    ));
    let warming = format!("{exact}*t");
    let overrides = [("strip.temperature", warming.as_str()), ("strip.strain", "small"), ("simulation.stop", "1.5")];
    let buckling = |elements: u32| {
        let count = elements.to_string();
        let all = [&[("strip.elements", count.as_str())], &overrides[..]].concat();
        (critical::time(&held, &all, [0.9, 1.2]) - 1.0).abs()
    };
    let counts = [4_u32, 8, 16];
    let column = (String::from("critical temperature"), counts.iter().map(|elements| buckling(*elements)).collect());
    section.say(&study::table("elements", &counts.map(f64::from), &[column]));
}
