//! Beams under heat, tension and with another shape without stress, against closed forms.

use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use std::f64::consts::{PI, TAU};

/// A steel strip of 2 m along x, 20 mm wide (y) and 10 mm high (z).
pub fn strip(keys: &str, rest: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"strip\"
        [material.steel]
        young = 2.1e11
        poisson = 0.3
        density = 7850
        expansion = 1.2e-5
        [section.flat]
        shape = \"rectangle\"
        width = 0.02
        height = 0.01
        [beam.strip]
        material = \"steel\"
        section = \"flat\"
        from = [0, 0, 0]
        to = [2, 0, 0]
        {keys}
        [joint.left]
        type = \"weld\"
        a = \"ground\"
        b = \"strip.start\"
        [output.tip]
        at = \"strip.end\"
        quantities = [\"displacement\"]
        [output.middle]
        at = \"strip@0.5\"
        quantities = [\"section_force\", \"section_moment\"]
        {rest}"
    )
}

pub const HELD: &str = "[joint.right]\ntype = \"weld\"\na = \"ground\"\nb = \"strip.end\"\n";
pub const STATIC: &str = "[simulation]\nanalysis = \"static\"\nstop = 1\n";

pub const AREA: f64 = 0.02 * 0.01;
const ABOUT_Y: f64 = 0.02 * 0.01 * 0.01 * 0.01 / 12.0;

pub fn at_end(text: &str) -> ancf14::model::simulation::Simulation {
    let mut simulation = start(text);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation
}

/// Between walls, heat makes `−E A α T`, the same everywhere, and nothing moves.
#[test]
fn a_held_beam_is_compressed_by_heat() {
    for strain in ["small", "large"] {
        let keys = format!("elements = 3\nstrain = \"{strain}\"\ntemperature = \"10*t\"");
        let force = value(&at_end(&strip(&keys, &format!("{HELD}{STATIC}"))), "middle.section_force[1]");
        // Of Green's strain the force is that of a stretched section: off by the strain itself.
        assert!((force / (-2.1e11 * AREA * 1.2e-4) - 1.0).abs() < 1.3e-4, "{strain}: {force}");
    }
}

/// A free end moves by `α T L`, and bends along the arc of a gradient: `κ = α T_z` about y; neither makes force or
/// moment.
#[test]
fn a_free_beam_expands_and_bends() {
    let warm = at_end(&strip("elements = 3\ntemperature = \"100*t\"\nstrain = \"small\"", STATIC));
    assert!((vector(&warm, "tip.displacement").x / 2.4e-3 - 1.0).abs() < 1e-9);
    // To the tolerance of the equilibrium.
    assert!(value(&warm, "middle.section_force[1]").abs() < 1e-5 * 2.1e11 * AREA * 1.2e-3);
    let bent = at_end(&strip("elements = 8\ntemperature_gradient = [0, \"4e4*t\"]", STATIC));
    // The upper side is warmer: the strip bends down, along a circle of the curvature 0.48 1/m.
    let (curvature, length) = (0.48_f64, 2.0);
    let exact = [(curvature * length).sin() / curvature - length, -(1.0 - (curvature * length).cos()) / curvature];
    let tip = vector(&bent, "tip.displacement");
    assert!((tip.x - exact[0]).hypot(tip.z - exact[1]) < 1e-5, "{tip} {exact:?}");
    let moment = vector(&bent, "middle.section_moment").norm();
    // The cubic of an element leaves a circle by (κ l)²/12 at its ends, 1.2e-3.
    assert!(moment < 2e-3 * 2.1e11 * ABOUT_Y * curvature, "{moment}");
}

/// A strip between walls buckles at `4 π² E I/L²`, at a temperature of `4 π² I/(A L² α)`: there the lowest eigenvalue
/// of its vibrations goes through zero.
#[test]
fn a_heated_rail_buckles_at_its_critical_temperature() {
    let critical = 4.0 * PI * PI * ABOUT_Y / (AREA * 4.0 * 1.2e-5);
    let lowest = |temperature: f64| {
        let keys = format!("elements = 16\nstrain = \"small\"\ntemperature = {temperature}");
        let rail = start(&strip(&keys, &format!("{HELD}[simulation]\nstop = 1")));
        rail.modes(1).unwrap_or_else(|failure| panic!("{}", failure.message)).modes[0].eigenvalue
    };
    let (mut low, mut high) = (0.5 * critical, 1.5 * critical);
    assert!(lowest(low) > 0.0 && lowest(high) < 0.0);
    while high - low > 1e-7 * critical {
        let middle = 0.5 * (low + high);
        if lowest(middle) > 0.0 { low = middle } else { high = middle }
    }
    println!("{low} K of {critical} K");
    // Of order 4: 2.7e-4 with 8 elements.
    assert!((low / critical - 1.0).abs() < 3e-5, "{low} {critical}");
}

/// A strip under tension between walls keeps it, and swings as `(n/2L) √(T/ρA) √(1 + n² π² EI/(T L²))` between
/// pins, over `√(1 + n² π² I/(A L²))` by the rotary inertia.
#[test]
fn strings_sound_at_their_tension() {
    let tension: f64 = 2000.0;
    let pins = "[joint.right]\ntype = \"revolute\"\na = \"ground\"\nb = \"strip.end\"\naxis = [0, 1, 0]\n[simulation]\nstop = 1";
    let text = strip(&format!("elements = 24\nstrain = \"small\"\npretension = {tension}"), pins)
        .replace("type = \"weld\"", "axis = [0, 1, 0]\ntype = \"revolute\"");
    let string = start(&text);
    assert!((value(&string, "middle.section_force[1]") / tension - 1.0).abs() < 1e-9);
    let line_density = 7850.0 * AREA;
    let exact = |n: f64| {
        let stiff = n * n * PI * PI * 2.1e11 * ABOUT_Y / (tension * 4.0);
        let turning = n * n * PI * PI * ABOUT_Y / (AREA * 4.0);
        n / 4.0 * (tension / line_density).sqrt() * ((1.0 + stiff) / (1.0 + turning)).sqrt()
    };
    let modes = string.modes(6).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
    let found: Vec<f64> = modes.iter().map(|mode| mode.eigenvalue.sqrt() / TAU).collect();
    for n in [1.0, 2.0, 3.0] {
        let nearest = found.iter().map(|found| (found / exact(n) - 1.0).abs()).fold(f64::MAX, f64::min);
        assert!(nearest < 3e-5, "{n}: {} in {found:?}", exact(n));
    }
}

/// A strip that is an arc without stress, drawn straight: released, its equilibrium is the arc; held, it has the moment
/// `E I κ`.
#[test]
fn a_bent_strip_pulled_straight() {
    let curvature = 0.5_f64;
    let keys = format!("elements = 8\nfree_curvature = [{curvature}, 0]");
    let held = start(&strip(&keys, &format!("{HELD}{STATIC}")));
    let moment = vector(&held, "middle.section_moment");
    assert!((moment.y.abs() / (2.1e11 * ABOUT_Y * curvature) - 1.0).abs() < 1e-5, "{moment}");
    let free = start(&strip(&keys, STATIC));
    let tip = vector(&free, "tip.displacement");
    let exact = [(curvature * 2.0).sin() / curvature - 2.0, -(1.0 - (curvature * 2.0).cos()) / curvature];
    assert!((tip.x - exact[0]).hypot(tip.z - exact[1]) < 1e-5, "{tip} {exact:?}");
    // As twisted by 0.3 rad/m without stress, held straight: G Jt of a rectangle 2:1 is 0.229 times G a b³.
    let twisted = start(&strip("elements = 4\nfree_torsion = 0.3\nstrain = \"small\"", &format!("{HELD}{STATIC}")));
    let torque = vector(&twisted, "middle.section_moment").x.abs();
    assert!((torque / (2.1e11 / 2.6 * 0.229 * 0.02 * 1e-6 * 0.3) - 1.0).abs() < 3e-3, "{torque}");
}

/// Heat that comes and goes while the strip swings: the account of energy closes, with the work of heat among that of
/// loads.
#[test]
fn heat_is_in_the_account_of_energy() {
    let keys = "elements = 4\ntemperature = \"30*sin(9*t)\"\ntemperature_gradient = [0, \"2e3*sin(5*t)\"]";
    let simulation =
        "[simulation]\nstop = 1\nstep = 1e-3\nspectral_radius = 1\ntolerance = 1e-9\ntotals = [\"energy\", \"work\"]";
    let mut swinging = start(&strip(keys, simulation));
    let (mut drift, mut most) = (0.0_f64, 0.0_f64);
    run(&mut swinging, 0.01, 1.0, |simulation| {
        drift = drift.max(value(simulation, "work.drift").abs());
        most = most.max(value(simulation, "energy.total"));
    });
    println!("drift {drift:e} J of {most} J");
    assert!(most > 0.05 && drift < 1e-6 * most, "{drift} {most}");
}

/// A section that turns at a node: the gradient of the heat is that of the turned section, and so are its stress and
/// its moments. A strip of two pieces, the second turned by a right angle, is warmed along its own z: it bends the
/// first piece about y, the second one about the z of the first.
#[test]
fn heat_follows_the_axes_of_a_section_that_turns() {
    let keys = "elements = 4\ntemperature_gradient = [0, \"5e3*t\"]";
    let text = strip(keys, STATIC)
        .replace("height = 0.01", "height = 0.01\n        turn = [{ until = 1, is = 0 }, { is = \"pi/2\" }]")
        .replace("at = \"strip@0.5\"", "at = \"strip@0.5\"\n        ")
        .replace("[output.tip]", "[output.half]\nat = \"strip@0.5\"\nquantities = [\"rotation\"]\n[output.tip]");
    let turned = at_end(&text);
    // α T_z = 0.06 1/m over a length of 1 m, and no moment anywhere.
    let half = vector(&turned, "half.rotation");
    assert!((half.y.abs() / 0.06 - 1.0).abs() < 1e-3 && half.z.abs() < 1e-5, "{half}");
    // The second piece adds the curvature about its own y, which is z of the first one.
    let tip = vector(&turned, "tip.displacement");
    let exact = [0.06 * 0.5, 0.06 * 0.5 + 0.06];
    assert!((tip.y.abs() / exact[0] - 1.0).abs() < 1e-2 && (tip.z.abs() / exact[1] - 1.0).abs() < 1e-2, "{tip}");
}

/// Stress is that of beam theory, `N/A + M z/I`, in every law: a strip that a moment and a force bend and stretch to
/// more than 1 % of fiber strain.
#[test]
fn stress_is_that_of_beam_theory_in_every_law() {
    for strain in ["small", "large"] {
        let tip = "[load.bends]\nat = \"strip.end\"\nmoment = [0, \"-900*t\", 0]\nforce = [\"3e4*t\", 0, 0]";
        let stress =
            "[output.there]\nat = \"strip.end\"\nquantities = [\"section_force\", \"section_moment\", \"stress\"]";
        let text = strip(&format!("elements = 8\nstrain = \"{strain}\""), &format!("{tip}\n{stress}\n{STATIC}"));
        let bent = at_end(&text);
        let (force, moment) = (value(&bent, "there.section_force[1]"), vector(&bent, "there.section_moment"));
        let (normal, found) = (force.abs() / AREA + moment.y.abs() * 0.005 / ABOUT_Y, value(&bent, "there.stress"));
        println!("{strain}: {found:e} Pa, by forces {normal:e} Pa, {} of strain", normal / 2.1e11);
        assert!(normal > 0.01 * 2.1e11 && moment.x.hypot(moment.z) < 1e-9 * moment.y.abs(), "{normal} {moment}");
        // Newton finds the strains that bear the forces to round-off.
        assert!((found / normal - 1.0).abs() < 1e-12, "{strain}: {found:e} {normal:e}");
    }
}
