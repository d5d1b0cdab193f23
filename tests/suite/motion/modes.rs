//! Natural modes against closed forms, against the tables of MECHANICS 9, and against the time integration of the same
//! machine. A wrong constraint, a forgotten load or multiplier stiffness, or a lost vector of a pair each shows in one
//! of these.

use crate::running::start;
use crate::support::machines::{clamp, design, integrate, load};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::{BeamDesign, Elements};
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::modes::Kind;
use ancf14::model::simulation::Simulation;
use ancf14::solve::modes::{Modes, modes};
use std::f64::consts::PI;

fn cantilever(beam: &BeamDesign) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    clamp(&mut builder, number);
    builder.finish(Vec3::zeros())
}

fn frequencies(found: &Modes) -> Vec<f64> {
    found.modes.iter().filter(|mode| mode.kind == Kind::Vibration).map(|mode| mode.eigenvalue.sqrt()).collect()
}

/// The relative error of the frequency nearest to `exact`.
fn error(found: &[f64], exact: f64) -> f64 {
    found.iter().map(|own| (own / exact - 1.0).abs()).fold(f64::INFINITY, f64::min)
}

/// `√(E I/(ρ A))`, m²/s.
fn bending_speed(beam: &BeamDesign, moment: f64) -> f64 {
    (beam.material.young * moment / (beam.material.density * beam.section.area)).sqrt()
}

/// The largest product `x_iᵀ M x_j` of two shapes.
fn largest_product(system: &System, found: &Modes) -> f64 {
    let mut largest = 0.0_f64;
    for (number, a) in found.modes.iter().enumerate() {
        let mut mass = vec![0.0; a.shape.len()];
        system.mass_times(MassAt::CONSTANT, &a.shape, &mut mass);
        for b in &found.modes[..number] {
            largest = largest.max(b.shape.iter().zip(&mass).map(|(b, mass)| b * mass).sum::<f64>().abs());
        }
    }
    largest
}

/// Errors that MECHANICS 9 gives for 8 elements: 2.1e-6, 8.0e-5, 1.6e-3, 6.2e-7; the third bending mode, which it does
/// not give, has that of the order 4 in the wave's length, 80e-6 (7.85/4.69)⁴.
#[test]
fn cantilevers_meet_the_closed_forms() {
    for section in [Section::rectangle(0.01, 0.02), Section::circle(0.01)] {
        let beam = BeamDesign { section, ..design("beam", 8) };
        let (system, state) = cantilever(&beam);
        let found = modes(&system, &state, 24).unwrap();
        let own = frequencies(&found);
        assert_eq!(own.len(), 24);
        assert!(own.is_sorted());
        let (material, section) = (&beam.material, &beam.section);
        let torsion =
            0.5 * PI * (material.shear * section.torsion_constant / (material.density * section.polar_moment)).sqrt();
        let axial = 0.5 * PI * (material.young / material.density).sqrt();
        let roots = [(1.875_104_068_711_961, 3e-6), (4.694_091_132_974_175, 1e-4), (7.854_757_438_237_613, 7e-4)];
        for moment in [section.second_moment_y, section.second_moment_z] {
            for (root, bound) in roots {
                let error = error(&own, root * root * bending_speed(&beam, moment));
                println!("bending {root:.3}: {error:.2e}");
                assert!(error < bound, "{error:e}");
            }
        }
        let errors = [error(&own, torsion), error(&own, axial)];
        println!("torsion {:.2e}, axial {:.2e}", errors[0], errors[1]);
        assert!(errors[0] < 2e-3 && errors[1] < 1e-6);
        // Round-off of the sums of a few hundred products.
        assert!(largest_product(&system, &found) < 1e-9);
        assert_eq!(found.imbalance, 0.0);
        assert_eq!(found.skewness, 0.0);
    }
}

/// Both modes of each pair of a round beam come out, one along y and one along z, at one frequency to the round-off of
/// the stiffness.
#[test]
fn round_beams_have_pairs() {
    let beam = BeamDesign { section: Section::circle(0.01), ..design("beam", 8) };
    let (system, state) = cantilever(&beam);
    let found = modes(&system, &state, 6).unwrap();
    for pair in found.modes.chunks(2) {
        let [a, b] = [&pair[0], &pair[1]];
        assert!((a.eigenvalue / b.eigenvalue - 1.0).abs() < 1e-10, "{} {}", a.eigenvalue, b.eigenvalue);
        let tip = a.shape.len() - 7;
        let other = a.shape[tip + 2].abs().max(b.shape[tip + 1].abs());
        assert!(other < 1e-9 * a.shape[tip + 1].abs().min(b.shape[tip + 2].abs()), "{other:e}");
    }
}

/// A beam that floats in an oblique direction has six free modes and then theory's; more modes than it has are not made
/// up.
#[test]
fn floating_beams_have_six_free_modes() {
    let beam =
        BeamDesign { line: Centerline::straight(Vec3::zeros(), Vec3::new(0.6, 0.48, 0.64), 8), ..design("beam", 8) };
    let mut builder = SystemBuilder::default();
    builder.add_beam(&beam);
    let (system, state) = builder.finish(Vec3::zeros());
    let found = modes(&system, &state, 1000).unwrap();
    assert_eq!(found.modes.len(), 63);
    let kinds: Vec<Kind> = found.modes.iter().map(|mode| mode.kind).collect();
    assert!(
        kinds[..6].iter().all(|kind| *kind == Kind::Free) && kinds[6..].iter().all(|kind| *kind == Kind::Vibration)
    );
    let exact = 4.730_040_744_862_704_f64.powi(2) * bending_speed(&beam, beam.section.second_moment_z);
    let first = frequencies(&found)[0];
    // Order 4 in the wave's length, from the 2.1e-6 of the clamped beam: (4.73/1.875)⁴ times as much.
    println!("first bending, free: {:.2e}", first / exact - 1.0);
    assert!((first / exact - 1.0).abs() < 1e-4);
    // Few modes are the first of many: each comes out by itself.
    let few = frequencies(&modes(&system, &state, 8).unwrap());
    for (few, many) in few.iter().zip(frequencies(&found)) {
        assert!((few / many - 1.0).abs() < 1e-9, "{few} {many}");
    }
}

/// A beam and a body that float beside each other have twelve free modes; the body, which is rigid, has nothing else.
#[test]
fn floating_bodies_have_free_modes_only() {
    let mut builder = SystemBuilder::default();
    builder.add_beam(&design("beam", 4));
    builder.add_body(&BodyDesign {
        name: "disk".into(),
        mass: 3.0,
        position: Vec3::y(),
        inertia: ancf14::math::Mat3::from_diagonal(&Vec3::new(0.2, 0.1, 0.1)),
        axes: ancf14::math::Mat3::identity(),
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::zeros(),
    });
    let (system, state) = builder.finish(Vec3::zeros());
    let found = modes(&system, &state, 16).unwrap();
    let free = found.modes.iter().filter(|mode| mode.kind == Kind::Free).count();
    assert_eq!((free, found.freedoms), (12, 41));
}

const SHAFT: &str = include_str!("../../../models/rotating_shaft.toml");

fn shaft(overrides: &[(&str, &str)], count: usize) -> Vec<f64> {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let text = SHAFT.replace("[beam.shaft]", "[beam.shaft]\nrotary_inertia = false");
    let mut simulation = Simulation::load("shaft.toml", &text, &overrides).unwrap();
    Model::initialize(&mut simulation, 0.0).unwrap();
    simulation.modes(count).unwrap().modes.iter().map(|mode| mode.angular_frequency()).collect()
}

/// The paper's shaft without rotary inertia at rest: MECHANICS 9, to its last printed digit; and about the equilibrium under gravity, with 6
/// elements.
#[test]
fn the_shaft_has_the_frequencies_of_its_table() {
    let straight = shaft(&[("gravity[3]", "0"), ("shaft.elements", "24")], 6);
    for (own, (table, digit)) in
        straight.iter().zip([(56.932, 1e-3), (57.074, 1e-3), (204.16, 1e-2), (289.6, 0.1), (291.1, 0.1), (464.0, 0.1)])
    {
        assert!((own - table).abs() < 0.51 * digit, "{own} {table}");
    }
    let sagging = shaft(&[], 2);
    for (own, exact) in sagging.iter().zip([56.929, 57.071]) {
        assert!((own / exact - 1.0).abs() < 1e-4, "{own} {exact}");
    }
}

fn body(place: &str, rest: &str) -> String {
    format!(
        r#"
format = 1
[model]
name = "Body"
gravity = [0, 0, -9.81]
[body.bob]
mass = 2
position = {place}
inertia = [0.1, 0.2, 0.3]
{rest}
[output.at_bob]
at = "bob"
quantities = ["position"]
[simulation]
stop = 1
step = 0.1
output_step = 0.1
"#
    )
}

const HINGE: &str = r#"
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
"#;

/// `ω² = m g d/(J + m d²)` of a pendulum, all of it from the force in its hinge; upside down it is the rate of the
/// fall, squared.
#[test]
fn pendulums_swing_and_fall() {
    let exact = 2.0 * 9.81 * 0.7 / (0.2 + 2.0 * 0.49);
    for (place, kind, sign) in [("[0, 0, -0.7]", Kind::Vibration, 1.0), ("[0, 0, 0.7]", Kind::Unstable, -1.0)] {
        let found = start(&body(place, HINGE)).modes(3).unwrap();
        assert_eq!((found.modes.len(), found.freedoms), (1, 1));
        let mode = &found.modes[0];
        assert_eq!((mode.kind, mode.moves.as_str()), (kind, "bob, along x"));
        // A body of six freedoms in twelve coordinates: round-off of a few sums.
        assert!((sign * mode.eigenvalue / exact - 1.0).abs() < 1e-12, "{} {exact}", mode.eigenvalue);
        assert!(found.warnings.is_empty() && found.nodes == 0 && found.places.len() == 1, "{:?}", found.warnings);
        // What moves most moves by one: m + J/d².
        assert!((mode.modal_mass - (2.0 + 0.2 / 0.49)).abs() < 1e-12);
    }
    // Held out at the side it would fall: its stiffness is no equilibrium's, and that is said.
    let aside = start(&body("[0.7, 0, 0]", HINGE)).modes(1).unwrap();
    assert!(aside.warnings.iter().any(|warning| warning.contains("initial = \"equilibrium\"")), "{:?}", aside.warnings);
}

/// A body on six springs: `k/m` and `k/J`, each in its own direction.
#[test]
fn a_body_on_springs_has_their_frequencies() {
    let cushion = r#"
[joint.cushion]
type = "bushing"
a = "ground"
b = "bob"
stiffness = [200, 800, 1800]
rotational_stiffness = [320, 5000, 14700]
"#;
    let text = body("[0, 0, 0]", cushion).replace("-9.81", "0");
    let found = start(&text).modes(6).unwrap();
    let expected = [
        (100.0, "along x"),
        (400.0, "along y"),
        (900.0, "along z"),
        (3200.0, "turning about x"),
        (25000.0, "turning about y"),
        (49000.0, "turning about z"),
    ];
    for (mode, (exact, moves)) in found.modes.iter().zip(expected) {
        assert!((mode.eigenvalue / exact - 1.0).abs() < 1e-12, "{} {exact}", mode.eigenvalue);
        assert_eq!(mode.moves, format!("bob, {moves}"));
    }
}

/// The crane hangs its load from a boom and a rope under tension: started along a mode, the integrator must swing in
/// that mode, and no other, with the period of the implicit midpoint rule, `tan(ω' h/2) = ω h/2`.
#[test]
fn a_machine_swings_in_its_modes() {
    let overrides = ["steel.damping=0", "wire.damping=0", "foot.input=false"].map(|text| {
        let (key, value) = text.split_once('=').unwrap();
        (key.to_owned(), value.to_owned())
    });
    let crane = include_str!("../../../models/crane.toml");
    let mut simulation = Simulation::load("crane.toml", crane, &overrides).unwrap();
    Model::initialize(&mut simulation, 0.0).unwrap();
    let (system, rest) = (simulation.system(), simulation.state().clone());
    let found = modes(system, &rest, 8).unwrap();
    for (number, step) in [(1, 0.05), (5, 0.005)] {
        let mode = &found.modes[number];
        let omega = mode.eigenvalue.sqrt();
        // In units of the mode: some tenths of a millimeter, large against what the equilibrium is exact to.
        let amplitude = 1e-2;
        let speed = amplitude * omega;
        let mut state = rest.clone();
        state.velocity = mode.shape.iter().map(|value| speed * value).collect();
        let mut mass = vec![0.0; mode.shape.len()];
        system.mass_times(MassAt::CONSTANT, &mode.shape, &mut mass);
        let discrete = 2.0 / step * (0.5 * omega * step).atan();
        let (mut count, mut largest) = (0, 0.0_f64);
        integrate(system, &mut state, 1.0, (step, 200), |state| {
            let reached: f64 =
                mass.iter().zip(state.q.iter().zip(&rest.q)).map(|(mass, (q, rest))| mass * (q - rest)).sum();
            let expected = amplitude * (discrete * step * f64::from(count)).sin();
            largest = largest.max((reached - expected).abs() / amplitude);
            count += 1;
        })
        .unwrap();
        println!("mode {}: {omega:.4} rad/s, off by {:.1e} of the amplitude", number + 1, largest);
        // The amplitude as a turn, 1e-4, some periods of it.
        assert!(largest < 1e-3, "{largest:e}");
    }
}

/// A moment about an axis that stands still, at a free end, has no potential: said, with its size; a dead force has
/// one.
#[test]
fn loads_without_potential_are_told() {
    let skewness = |force: Vec3, moment: Vec3| {
        let mut builder = SystemBuilder::default();
        let beam = builder.add_beam(&design("beam", 4));
        clamp(&mut builder, beam);
        load(&mut builder, beam, 1.0, force, moment);
        let (system, mut state) = builder.finish(Vec3::zeros());
        state.time = 1.0;
        modes(&system, &state, 4).unwrap().skewness
    };
    assert_eq!(skewness(Vec3::new(-50.0, 0.0, 0.0), Vec3::zeros()), 0.0);
    assert!(skewness(Vec3::zeros(), Vec3::x() * 5.0) > 1e-3);
}

/// Beck's column bears its follower load up to `20.05 E I/L²`; without the skew part it is called unstable at half of
/// that. The warning must say that kinds are not to be trusted then, not only that flutter is lost.
#[test]
fn regression_kinds_are_not_to_be_trusted_under_follower_loads() {
    let text = include_str!("../../../models/cantilever.toml");
    let load = "[load.push]\nat = \"arm.end\"\nforce = [-1e3, 0, 0]\nfollower = true\n\n[simulation]";
    let found = start(&text.replace("[simulation]", load)).modes(1).unwrap();
    assert!(
        found.warnings.iter().any(|warning| warning.contains("what is called unstable may be stable")),
        "{:?}",
        found.warnings
    );
    assert_eq!(found.nodes, found.places.len());
}

/// Without torsion the bending modes stay what they are, and no mode of torsion is near.
#[test]
fn beams_without_torsion_have_bending_modes() {
    use ancf14::mechanics::beam::design::Torsion;
    let [free, stiff] = [Torsion::Free, Torsion::Suppressed].map(|torsion| {
        let (system, state) = cantilever(&BeamDesign {
            elements: Elements::Ancf14 { strain: Strain::Small, twist: Twist::Linear, torsion },
            ..design("beam", 4)
        });
        frequencies(&modes(&system, &state, 4).unwrap())
    });
    for (free, stiff) in free.iter().zip(stiff) {
        assert!((free / stiff - 1.0).abs() < 1e-10, "{free} {stiff}");
    }
}

/// However many softer motions there are, none that is unstable is missed: an upright pendulum beside six bodies on
/// soft mounts, one mode asked for. `ω² = −m g l/(m l² + J)`.
#[test]
fn unstable_modes_are_not_hidden_by_softer_ones() {
    let mut text = String::from(
        "format = 1\n[model]\nname = \"Hidden\"\ngravity = [0, 0, -9.81]\n[body.upright]\nmass = 2\ninertia = [0.01, 0.01, 0.01]\n\
         position = [0, 0, 0.1]\n[joint.foot]\ntype = \"revolute\"\na = \"ground\"\nb = \"upright\"\nat = [0, 0, 0]\naxis = [1, 0, 0]\n",
    );
    for k in 0..6 {
        text += &format!(
            "[body.soft{k}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{}, 0, 0]\n[joint.mount{k}]\ntype = \"bushing\"\na = \"ground\"\n\
             b = \"soft{k}\"\nstiffness = [1, 1, 1]\nrotational_stiffness = [1, 1, 1]\n",
            k + 1
        );
    }
    text += "[simulation]\nstop = 1\nstep = 1e-3\noutput_step = 1e-2\n";
    let mode = &start(&text).modes(1).unwrap().modes[0];
    assert_eq!(mode.kind, Kind::Unstable);
    let exact = -2.0 * 9.81 * 0.1 / (2.0 * 0.01 + 0.01);
    assert!((mode.eigenvalue / exact - 1.0).abs() < 1e-9, "{} {exact}", mode.eigenvalue);
}

/// Bodies that nothing holds have no stiffness at all, not even a scale of one: six free motions, and one more with a
/// hinge.
#[test]
fn bodies_without_any_stiffness_move_freely() {
    let body = |name: &str, x: f64| format!("[body.{name}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{x}, 0, 0]\n");
    let model = |rest: &str| {
        format!("format = 1\n[model]\nname = \"Free\"\n{rest}[simulation]\nstop = 1\nstep = 1e-3\noutput_step = 1e-2\n")
    };
    let hinge = "[joint.hinge]\ntype = \"revolute\"\na = \"one\"\nb = \"two\"\nat = [0.5, 0, 0]\naxis = [0, 0, 1]\n";
    for (text, count) in [(model(&body("one", 0.0)), 6), (model(&(body("one", 0.0) + &body("two", 1.0) + hinge)), 7)] {
        let modes = start(&text).modes(20).unwrap().modes;
        assert_eq!(modes.len(), count);
        assert!(modes.iter().all(|mode| mode.kind == Kind::Free), "{modes:?}");
    }
}

/// A bow that is let go at the end of its preload is in no equilibrium then. It has the equilibrium of its preload behind
/// it, so that a start from an equilibrium is no remedy.
#[test]
fn modes_after_a_preload_offer_no_equilibrium() {
    let text = std::fs::read_to_string(ancf14_testing::root().join("models/bow.toml")).unwrap();
    let mut simulation = Simulation::load("bow.toml", &text, &[]).unwrap();
    simulation.initialize(0.0).unwrap();
    let warnings = simulation.modes(1).unwrap().warnings;
    let told: Vec<_> = warnings.iter().filter(|own| own.starts_with("the mechanism is not in equilibrium")).collect();
    assert!(matches!(&told[..], [one] if one.ends_with("act beyond t = 0")), "{warnings:?}");
}
