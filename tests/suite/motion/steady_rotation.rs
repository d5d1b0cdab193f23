//! Relative equilibria of mechanisms that turn steadily, and the poles about them: of rotating cantilevers against
//! Wright's table, of an overhung rotor, without and with internal damping, against the closed form. Without the terms
//! of the frame that turns, flapping blades have a false damping, and directors among the states would shift torsion
//! by the speed. A mechanism whose motion is periodic must be refused.

use ancf14::model::campbell::{Campbell, Excitation, Sweep, Whirl};
use ancf14::model::linear::{Linear, Pole};
use ancf14::model::simulation::Simulation;
use ancf14::model::steady::{Frame, Spin};
use ancf14_testing::curves::load;
use nalgebra::{Complex, Matrix4};
use std::f64::consts::PI;

const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7850.0;
/// Height of the blade, m: `EA L²/EI = 12 (L/h)²` is 1e9, so that the tension does not lengthen it.
const HEIGHT: f64 = 1.095_445_115_010_332_2e-4;

/// So narrow that the inertia about its axis, a share of `(b/L)²` of the flapping, is not seen.
const BLADE: &str = r#"format = 1
model = { name = "Blade", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.strip = { shape = "rectangle", width = 1e-3, height = 1.0954451150103322e-4 }
beam.blade = { material = "steel", section = "strip", from = [0, 0, 0], to = [1, 0, 0], elements = 16, rotary_inertia = false }
joint.hub = { type = "revolute", a = "ground", b = "blade.start", axis = [0, 0, 1] }
drive.motor = { joint = "hub", coordinate = "angle", value = 0 }
simulation = { stop = 1, step = 1e-3 }
"#;

/// An overhung rotor on a shaft without mass.
const ROTOR: &str = r#"format = 1
model = { name = "Overhung", gravity = [0, 0, 0] }
material.light = { young = 2.1e11, poisson = 0.3, density = 1e-3 }
section.rod = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "light", section = "rod", from = [0, 0, 0], to = [0.5, 0, 0], elements = 4 }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.04, 0.022, 0.022] }
joint.bearing = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.hub = { type = "weld", a = "shaft.end", b = "disk" }
drive.motor = { joint = "bearing", coordinate = "angle", value = 0 }
simulation = { stop = 1, step = 1e-3 }
"#;
/// Mass, polar and diametral inertia of the disk, length of the shaft.
const DISK: [f64; 4] = [5.0, 0.04, 0.022, 0.5];

fn steady(model: &Simulation, speed: f64) -> Result<Linear, String> {
    let spin = Spin { drive: String::from("motor"), speed, is_weightless: false };
    model.linearize_steady(&spin, Some(&[]), None).map_err(|failure| failure.message)
}

fn frame(found: &Linear) -> Frame {
    found.steady.as_ref().expect("it is about a rotation").frame
}

/// The pole nearest to `exact` or to its conjugate, and the relative error.
fn nearest(poles: &[Pole], exact: Complex<f64>) -> (Complex<f64>, f64) {
    let exact = Complex::new(exact.re, exact.im.abs());
    let values = poles.iter().map(|pole| Complex::new(pole.value[0], pole.value[1]));
    let found = values.min_by(|a, b| (a - exact).norm().total_cmp(&(b - exact).norm())).unwrap();
    (found, (found - exact).norm() / exact.norm())
}

/// The four poles of the overhung rotor in the fixed frame, with the damping `c` (s) of the shaft, which turns:
/// `M z'' + (c K − i Ω Jp) z' + (1 − i Ω c) K z = 0` of the complex deflection and slope; forward whirl has a positive
/// imaginary part.
fn whirls(speed: f64, damping: f64) -> Vec<Complex<f64>> {
    let [mass, polar, diametral, length] = DISK;
    let rigidity = YOUNG * PI * 0.01_f64.powi(4) / 4.0;
    let [k11, k12, k22] = [12.0 / length, -6.0, 4.0 * length].map(|factor| factor * rigidity / (length * length));
    let (stiffness, inertia) = ([[k11, k12], [k12, k22]], [mass, diametral]);
    let turned = Complex::new(1.0, -speed * damping);
    let matrix = Matrix4::from_fn(|row, column| {
        let (line, own) = (row % 2, column % 2);
        match (row < 2, column < 2) {
            (true, false) if line == own => Complex::from(1.0),
            (true, _) => Complex::from(0.0),
            (false, true) => -turned * stiffness[line][own] / inertia[line],
            (false, false) => {
                let gyroscopic = if line == 1 && own == 1 { speed * polar } else { 0.0 };
                Complex::new(-damping * stiffness[line][own], gyroscopic) / inertia[line]
            }
        }
    });
    matrix.schur().unpack().1.diagonal().iter().copied().collect()
}

/// Sixteen elements leave 1e-7 at rest and 1e-5 at the largest speed. Wright, Smith, Thresher and Wang, Vibration modes
/// of centrifugally stiffened beams, J. Appl. Mech. 49 (1982): the first flapping frequency over `√(EI/ρA L⁴)`, exact to
/// five digits after the point at `η = 3`. The last digit of the others is 1e-4. Round-off of the stiff axial modes,
/// 1e11 times as stiff, leaves 1e-11 of damping.
#[test]
fn flapping_of_a_rotating_cantilever_meets_the_table() {
    let model = load(BLADE, &[]);
    let unit = (YOUNG * HEIGHT * HEIGHT / 12.0 / DENSITY).sqrt();
    for (eta, table, bound) in [(0.0, 3.5160, 1e-5), (3.0, 4.79728, 1e-5), (6.0, 7.3604, 1e-5), (12.0, 13.1702, 2e-5)] {
        let found = steady(&model, eta * unit).unwrap();
        let (pole, error) = nearest(&found.poles(&model).unwrap(), Complex::new(0.0, table * unit));
        println!("eta {eta}: {:.6}, error {error:.1e}, damping {:.1e}", pole.im / unit, pole.re / pole.im);
        assert!(error < bound && (pole.re / pole.im).abs() < 1e-10, "eta {eta}: {:.6} {error:.1e}", pole.im / unit);
        assert!(eta == 0.0 || frame(&found) == Frame::Turning);
    }
}

/// Round-off of the stiff modes of the shaft leaves 1e-8. At 1500 rad/s the rotor has a frequency below the speed.
#[test]
fn whirl_of_an_overhung_rotor_meets_the_closed_form() {
    let model = load(ROTOR, &[]);
    for speed in [0.0, 100.0, 500.0, 1500.0] {
        let found = steady(&model, speed).unwrap();
        assert_eq!(frame(&found), Frame::Fixed);
        let poles = found.poles(&model).unwrap();
        for exact in whirls(speed, 0.0) {
            let (pole, error) = nearest(&poles, exact);
            println!("{speed} rad/s: {:.4}, error {error:.1e}", exact.im);
            assert!(error < 1e-7 && (pole.re / pole.im).abs() < 1e-8, "{speed}: {exact} {pole} {error:.1e}");
        }
    }
}

/// Damping of the shaft turns with it: above the critical speed the forward whirl grows.
#[test]
fn internal_damping_makes_forward_whirl_grow() {
    let model = load(&ROTOR.replace("density = 1e-3", "density = 1e-3, damping = 2e-5"), &[]);
    for (speed, grows) in [(50.0, None), (150.0, Some(0.0502)), (400.0, Some(0.2633))] {
        let poles = steady(&model, speed).unwrap().poles(&model).unwrap();
        let exact = whirls(speed, 2e-5);
        let largest = exact.iter().map(|own| own.re).fold(f64::MIN, f64::max);
        match grows {
            Some(rate) => assert!((largest - rate).abs() < 1e-4, "{speed}: {largest}"),
            None => assert!(largest < 0.0, "{speed}: {largest}"),
        }
        for exact in exact {
            let (pole, error) = nearest(&poles, exact);
            println!("{speed} rad/s: {exact:.4}, error {error:.1e}");
            assert!(error < 1e-6 && (pole.re - exact.re).abs() < 1e-6 * exact.norm(), "{exact} {pole}");
            assert_eq!(pole.re > 0.0, exact.re > 0.0, "{exact} {pole}");
        }
    }
}

/// A mass on a spring that turns about an axis across it: the spring is stretched by `m Ω² l/(k − m Ω²)`.
#[test]
fn a_mass_on_a_spring_moves_outwards() {
    const MASS: &str = r#"format = 1
model = { name = "Governor", gravity = [0, 0, -9.81] }
body.arm = { mass = 1, position = [0, 0, 0], inertia = [0.01, 0.01, 0.01] }
body.mass = { mass = 2, position = [0.3, 0, 0], inertia = [0.001, 0.001, 0.001] }
joint.shaft = { type = "revolute", a = "ground", b = "arm", at = [0, 0, 0], axis = [0, 0, 1] }
joint.slide = { type = "prismatic", a = "arm", b = "mass", at = [0.3, 0, 0], axis = [1, 0, 0], stiffness = 1000 }
drive.motor = { joint = "shaft", coordinate = "angle", value = 0 }
output.mass = { at = "slide", quantities = ["distance"] }
simulation = { stop = 1, step = 1e-3 }
"#;
    let model = load(MASS, &[]);
    let found = steady(&model, 15.0).unwrap();
    let exact = 2.0 * 225.0 * 0.3 / (1000.0 - 2.0 * 225.0);
    assert!((found.outputs[0].value - exact).abs() < 1e-10, "{} {exact}", found.outputs[0].value);
    let (_, error) = nearest(&found.poles(&model).unwrap(), Complex::new(0.0, ((1000.0 - 450.0) / 2.0_f64).sqrt()));
    assert!(error < 1e-10, "{error:.1e}");
}

/// A rigid blade on a hinge across the axis, whose states are those of a turn: in the frame that turns it flaps with
/// `ω² = Ω² (Iz − Ix + m e l)/Iy`, with the moments of inertia about the hinge, at the distance `e` from the axis, and
/// the distance `l` of its center from there.
#[test]
fn a_hinged_blade_flaps() {
    const HINGED: &str = r#"format = 1
model = { name = "Hinged", gravity = [0, 0, 0] }
body.hub = { mass = 1, position = [0, 0, 0], inertia = [0.01, 0.01, 0.01] }
body.blade = { mass = 2, position = [0.5, 0, 0], inertia = [0.003, 0.02, 0.021] }
joint.shaft = { type = "revolute", a = "ground", b = "hub", at = [0, 0, 0], axis = [0, 0, 1] }
joint.hinge = { type = "revolute", a = "hub", b = "blade", at = [0.1, 0, 0], axis = [0, 1, 0] }
drive.motor = { joint = "shaft", coordinate = "angle", value = 0 }
simulation = { stop = 1, step = 1e-3 }
"#;
    let model = load(HINGED, &[]);
    let found = steady(&model, 20.0).unwrap();
    assert_eq!(frame(&found), Frame::Turning);
    let steiner: f64 = 2.0 * 0.4 * 0.4;
    let ratio = (0.021 + steiner - 0.003 + 2.0 * 0.1 * 0.4) / (0.02 + steiner);
    let poles = found.poles(&model).unwrap();
    let (_, error) = nearest(&poles, Complex::new(0.0, 20.0 * ratio.sqrt()));
    assert!(poles.len() == 1 && error < 1e-9, "{poles:?} {error:.1e}");
}

/// A flywheel in a bearing of the ground that a spring turns with the shaft: it turns too, since the spring would wind
/// up otherwise. About the rotation it swings with `ω² = k/J`.
#[test]
fn springs_take_along_what_they_hold() {
    const WHEEL: &str = r#"format = 1
model = { name = "Flywheel", gravity = [0, 0, 0] }
body.shaft = { mass = 1, position = [0, 0, 0], inertia = [0.01, 0.01, 0.01] }
body.wheel = { mass = 1, position = [0, 0, 0.2], inertia = [0.02, 0.02, 0.03] }
joint.bearing = { type = "revolute", a = "ground", b = "shaft", at = [0, 0, 0], axis = [0, 0, 1] }
joint.other = { type = "revolute", a = "ground", b = "wheel", at = [0, 0, 0.2], axis = [0, 0, 1] }
joint.coupling = { type = "bushing", a = "shaft", b = "wheel", at = [0, 0, 0.1], stiffness = [0, 0, 0], rotational_stiffness = [0, 0, 12] }
drive.motor = { joint = "bearing", coordinate = "angle", value = 0 }
simulation = { stop = 1, step = 1e-3 }
"#;
    let model = load(WHEEL, &[]);
    let found = steady(&model, 30.0).unwrap();
    let (_, error) = nearest(&found.poles(&model).unwrap(), Complex::new(0.0, 20.0));
    assert!(error < 1e-9, "{error:.1e}");
}

/// Gravity across the axis, and a blade in a support that is not round, are periodic; a drive of a distance turns
/// nothing.
#[test]
fn periodic_motions_are_refused() {
    let model = load(&BLADE.replace("gravity = [0, 0, 0]", "gravity = [0, -9.81, 0]"), &[]);
    let message = steady(&model, 1.0).unwrap_err();
    assert!(message.contains("gravity is not along the axis") && message.contains("--without-gravity"), "{message}");
    let spin = Spin { drive: String::from("motor"), speed: 1.0, is_weightless: true };
    assert!(model.linearize_steady(&spin, Some(&[]), Some(&[])).is_ok());

    // A force that stands still in space does not turn with the blade.
    let pushed = BLADE.replace("drive.motor", "load.push = { at = \"blade.end\", force = [0, 1e-6, 0] }\ndrive.motor");
    let message = steady(&load(&pushed, &[]), 1.0).unwrap_err();
    assert!(message.contains("the equations of motion do not hold any more"), "{message}");

    let flat = ROTOR.replace("shape = \"circle\", radius = 0.01", "shape = \"rectangle\", width = 0.02, height = 0.01");
    let sliding = flat.replace(
        "joint.bearing",
        "body.house = { mass = 1, position = [0, 0, 0], inertia = [1, 1, 1] }\n\
         joint.guide = { type = \"prismatic\", a = \"ground\", b = \"house\", axis = [0, 1, 0], stiffness = 1e5 }\n\
         joint.bearing",
    );
    let sliding = sliding.replace("a = \"ground\", b = \"shaft.start\"", "a = \"house\", b = \"shaft.start\"");
    let message = steady(&load(&sliding, &[]), 50.0).unwrap_err();
    assert!(message.contains("is periodic, not steady") && message.contains("37 degrees"), "{message}");
    // Each alone is steady, in a frame of its own.
    assert_eq!(frame(&steady(&load(&flat, &[]), 50.0).unwrap()), Frame::Turning);
    let round =
        sliding.replace("shape = \"rectangle\", width = 0.02, height = 0.01", "shape = \"circle\", radius = 0.01");
    assert_eq!(frame(&steady(&load(&round, &[]), 50.0).unwrap()), Frame::Fixed);
}

fn campbell(model: &Simulation, speeds: Vec<f64>, count: usize) -> Campbell {
    let sweep = Sweep { drive: String::from("motor"), speeds, is_weightless: false, count };
    model.campbell(&sweep).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// The overhung rotor from rest to 2600 rad/s: the modes are followed with the closed form of their own whirl, the second
/// backward one through the frequency of torsion near 2100 rad/s; critical speeds and the limit of stability meet it. Damping that turns with the shaft does nothing
/// where the whirl has its speed, so that forward whirl grows from its critical speed on.
#[test]
fn modes_of_an_overhung_rotor_are_followed() {
    let model = load(&ROTOR.replace("density = 1e-3", "density = 1e-3, damping = 2e-5"), &[]);
    let speeds: Vec<f64> = (0..=26).map(|number| 100.0 * f64::from(number)).collect();
    let found = campbell(&model, speeds.clone(), 5);
    assert_eq!((found.frame, found.uncertain), (Frame::Fixed, 0));
    let mut whirling = 0;
    for points in &found.modes {
        if points[1].whirl == Whirl::None {
            continue;
        }
        whirling += 1;
        assert!(points.iter().skip(1).all(|point| point.whirl == points[1].whirl), "{points:?}");
        for (speed, point) in speeds.iter().zip(points) {
            let sign = if points[1].whirl == Whirl::Forward { 1.0 } else { -1.0 };
            let own = Complex::new(point.value[0], sign * point.value[1]);
            let exact = whirls(*speed, 2e-5);
            let error = exact.iter().map(|exact| (exact - own).norm() / exact.norm()).fold(f64::INFINITY, f64::min);
            assert!(error < 1e-6, "{speed} rad/s: {own} {error:.1e}");
        }
        // The same mode at neighboring speeds: frequencies go on smoothly.
        let second = |k: usize| points[k - 1].value[1] - 2.0 * points[k].value[1] + points[k + 1].value[1];
        assert!((1..points.len() - 1).all(|k| second(k).abs() < 60.0), "{points:?}");
    }
    assert_eq!(whirling, 4);
    // Whirls move along all directions; torsion turns.
    let named = |mode: usize| found.modes[mode][1].whirl == Whirl::None;
    for (mode, moves) in found.moves.iter().enumerate() {
        assert!(moves.starts_with("shaft.") && moves.ends_with("turning about x") == named(mode), "{:?}", found.moves);
    }

    // Where a frequency is the speed: (k11 − m Ω²)(k22 − Jd Ω² ± Jp Ω²) = k12², one forward, as Jp > Jd, two backward.
    let crossings = |polar: f64| {
        let [mass, _, diametral, length] = DISK;
        let rigidity = YOUNG * PI * 0.01_f64.powi(4) / 4.0;
        let [k11, k12, k22] = [12.0 / length, -6.0, 4.0 * length].map(|factor| factor * rigidity / (length * length));
        let (a, b, c) = (mass * (diametral - polar), -(mass * k22 + (diametral - polar) * k11), k11 * k22 - k12 * k12);
        let root = (b * b - 4.0 * a * c).sqrt();
        [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().filter(|own| *own > 0.0).map(f64::sqrt)
    };
    let forward = crossings(DISK[1]).next().unwrap();
    let limit = found.stability_limit.unwrap();
    println!("limit {limit:.5}, error {:.1e}", limit / forward - 1.0);
    // The growth rises by 1e-3 1/s per rad/s, and has the round-off of the stiff modes, 1e-8 of the pole.
    assert!((limit / forward - 1.0).abs() < 2e-5, "{limit} {forward}");

    let found = campbell(&load(ROTOR, &[]), speeds, 5);
    let critical: Vec<_> = found.critical.iter().filter(|own| own.whirl != Whirl::None).collect();
    let mut exact: Vec<(f64, Whirl)> = crossings(DISK[1]).map(|own| (own, Whirl::Forward)).collect();
    exact.extend(crossings(-DISK[1]).map(|own| (own, Whirl::Backward)));
    exact.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(critical.len(), exact.len(), "{critical:?} {exact:?}");
    for (own, (speed, whirl)) in critical.iter().zip(exact) {
        println!("critical {:.5}, error {:.1e}", own.speed, own.speed / speed - 1.0);
        assert!((own.speed / speed - 1.0).abs() < 1e-6 && own.whirl == whirl, "{own:?} {speed}");
        assert_eq!(own.excitation, Excitation::Once);
    }
    assert_eq!(found.stability_limit, None);
}

/// The tilt of a thin disk, whose polar inertia is twice the other one, whirls too. Its directors along the axis have no
/// inertia, so that the circle is not seen in `zᴴ M (ω × z)`.
#[test]
fn thin_disks_whirl() {
    let model = load(&ROTOR.replace("inertia = [0.04, 0.022, 0.022]", "inertia = [0.04, 0.02, 0.02]"), &[]);
    let found = campbell(&model, vec![50.0, 100.0], 5);
    let mut whirls: Vec<Whirl> = found.modes.iter().map(|points| points[1].whirl).collect();
    whirls.retain(|whirl| *whirl != Whirl::None);
    assert_eq!(whirls, [Whirl::Backward, Whirl::Forward, Whirl::Backward, Whirl::Forward]);
}

/// A shaft with a disk in its middle that has an unbalance, without damping, in the frame that turns: where it turns a
/// little faster than its critical speed, a pole is small, and its round-off, that of both frequencies, is no growth.
#[test]
fn round_off_beside_a_critical_speed_is_no_growth() {
    let text = r#"format = 1
model = { name = "Jeffcott", gravity = [0, 0, 0] }
section.shaft = { shape = "rigidities", EA = 6.6e7, EI_y = 1649.3, EI_z = 1649.3, GJ = 1268.7, line_density = 1e-3 }
beam.shaft = { section = "shaft", from = [0, 0, 0], to = [1, 0, 0] }
body.disk = { mass = 5, position = [0.5, 0, 2e-4], inertia = [0.025, 0.0125, 0.0125] }
joint.hub = { type = "weld", a = "shaft@0.5", b = "disk", at = [0.5, 0, 0] }
joint.left = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.right = { type = "inline", a = "ground", b = "shaft.end", axis = [1, 0, 0] }
drive.motor = { joint = "left", coordinate = "angle", value = 0 }
simulation = { stop = 1 }
"#;
    let found = campbell(&load(text, &[]), (0..=15).map(|number| 20.0 * f64::from(number)).collect(), 8);
    assert_eq!((found.frame, found.stability_limit), (Frame::Turning, None));
    // Clamped and pinned: 768/7 EI/L³, but for the inertia of the disk and the stretch by the unbalance.
    let critical: f64 = (768.0 / 7.0 * 1649.3 / 5.0_f64).sqrt();
    let unbalance = found.critical.iter().find(|own| own.excitation == Excitation::TurnsAlong).unwrap();
    assert!((unbalance.speed / critical - 1.0).abs() < 0.01, "{} {critical}", unbalance.speed);
}

/// A round rotor at rest has pairs of modes with one pole. Both are followed where one is asked for: alone it would have
/// no vectors of its own, and could become the forward mode as well as the backward one.
#[test]
fn modes_with_one_pole_are_followed_together() {
    let found = campbell(&load(ROTOR, &[]), vec![0.0, 50.0, 100.0], 1);
    assert_eq!((found.modes.len(), found.uncertain), (2, 0));
    let [one, other] = [0, 1].map(|mode| found.modes[mode][2].whirl);
    assert!(one != other && one != Whirl::None && other != Whirl::None, "{one:?} {other:?}");
}

/// A shaft with a disk in bearings, which `MOUNTS` holds.
const SHAFT: &str = r#"format = 1
model = { name = "Shaft", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.rod = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.025, 0.0125, 0.0125] }
joint.hub = { type = "weld", a = "shaft@0.5", b = "disk" }
joint.left = { type = "revolute", a = "LEFT", b = "shaft.start", axis = [1, 0, 0] }
joint.right = { type = "cylindrical", a = "RIGHT", b = "shaft.end", axis = [1, 0, 0] }
drive.motor = { joint = "left", coordinate = "angle", value = 0 }
simulation = { stop = 1, step = 1e-3 }
"#;
const RINGS: &str = r#"
body.ring_1 = { mass = 1e-3, position = [0, 0, 0], inertia = [1e-6, 1e-6, 1e-6] }
body.ring_2 = { mass = 1e-3, position = [1, 0, 0], inertia = [1e-6, 1e-6, 1e-6] }
joint.mount_1 = { type = "bushing", a = "ground", b = "ring_1", stiffness = [1e9, 1e9, 1e9], rotational_stiffness = [1e8, 1e8, 1e8] }
joint.mount_2 = { type = "bushing", a = "ground", b = "ring_2", stiffness = [1e9, 1e9, 1e9], rotational_stiffness = [1e8, 1e8, 1e8] }
"#;

/// Rings that bushings hold to the ground do not turn with the shaft, neither that of the drive nor the other one. With
/// stiff bushings the whirl is that in rigid bearings; they give by `48 EI/L³/1e9` = 8e-5 of the shaft.
#[test]
fn rings_on_bushings_stand_still() {
    let model = |left: &str, right: &str, mounts: &str| {
        let (head, tail) = SHAFT.split_once("simulation").unwrap();
        let text = format!("{head}simulation{tail}{mounts}").replace("LEFT", left).replace("RIGHT", right);
        load(&text, &[])
    };
    let whirl = |model: &Simulation| {
        let found = steady(model, 50.0).unwrap();
        assert_eq!(frame(&found), Frame::Fixed);
        let poles = found.poles(model).unwrap();
        let mut swings: Vec<f64> = poles.iter().map(|pole| pole.value[1]).filter(|swing| *swing > 1.0).collect();
        swings.sort_by(f64::total_cmp);
        [swings[0], swings[1]]
    };
    let rigid = whirl(&model("ground", "ground", ""));
    let soft = whirl(&model("ring_1", "ring_2", RINGS));
    for (rigid, soft) in rigid.iter().zip(soft) {
        assert!((soft / rigid - 1.0).abs() < 2e-4, "{soft} {rigid}");
    }
}

/// A rotor in two equal soft bearings, one of which lets it tilt: its other housing has one pole, 1e4 rad/s, for three
/// tilts. Vectors of it that are nearly parallel would mix it with all other modes. Each critical speed is that of the
/// closed form: of the bounce along three axes, and of the tilt, `(k₁ − I ω²)(k₂ − I ω²) = (Iₚ Ω ω)²` with `ω = Ω`.
#[test]
fn equal_bearings_have_no_critical_speeds_of_their_own() {
    let text = r#"format = 1
model = { name = "EqualBearings", gravity = [0, 0, 0] }
body.rotor = { mass = 40, position = [0, 0, 0], inertia = [0.3, 1.5, 1.5] }
body.house_1 = { mass = 1, position = [-0.4, 0, 0], inertia = [1e-2, 1e-2, 1e-2] }
body.house_2 = { mass = 1, position = [0.4, 0, 0], inertia = [1e-2, 1e-2, 1e-2] }
joint.mount_1 = { type = "bushing", a = "ground", b = "house_1", stiffness = [1e6, 1e5, 2e5], rotational_stiffness = [1e6, 0, 0] }
joint.mount_2 = { type = "bushing", a = "ground", b = "house_2", stiffness = [1e6, 1e5, 2e5], rotational_stiffness = [1e6, 1e6, 1e6] }
joint.bearing_1 = { type = "revolute", a = "house_1", b = "rotor", at = [-0.4, 0, 0], axis = [1, 0, 0] }
joint.bearing_2 = { type = "inline", a = "house_2", b = "rotor", at = [0.4, 0, 0], axis = [1, 0, 0] }
drive.motor = { joint = "bearing_1", coordinate = "angle", value = 0 }
simulation = { stop = 1 }
"#;
    let found = campbell(&load(text, &[]), (0..=7).map(|number| 30.0 * f64::from(number)).collect(), 10);
    assert_eq!((found.uncertain, found.stability_limit), (0, None));
    let bounce = [(2e5, 42.0), (4e5, 42.0), (1e6, 41.0)].map(|(stiffness, mass): (f64, f64)| (stiffness / mass).sqrt());
    let (inertia, polar, [soft, stiff]) = (1.5 + 0.01 + 2.0 * 0.16, 0.3, [2e5, 4e5].map(|own| own * 0.16));
    let (square, linear) = (inertia * inertia - polar * polar, inertia * (soft + stiff));
    let root = f64::sqrt(linear * linear - 4.0 * square * soft * stiff);
    let tilt = [-root, root].map(|root: f64| ((linear + root) / (2.0 * square)).sqrt());
    let mut exact: Vec<f64> = bounce.into_iter().chain(tilt).collect();
    exact.sort_by(f64::total_cmp);
    let mut speeds: Vec<f64> = found.critical.iter().map(|own| own.speed).collect();
    speeds.sort_by(f64::total_cmp);
    assert_eq!(speeds.len(), exact.len(), "{speeds:?} {exact:?}");
    for (found, exact) in speeds.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
    }
}

/// A shaft whose other end is held against its rotation winds up: no steady rotation of it exists.
#[test]
fn shafts_that_are_held_at_their_other_end_are_refused() {
    let model = |right: &str| {
        let text = SHAFT.replace("LEFT", "ground").replace("RIGHT", "ground");
        load(&text.replace("type = \"cylindrical\"", &format!("type = \"{right}\"")), &[])
    };
    assert!(steady(&model("inline"), 50.0).is_ok());
    let message = steady(&model("prismatic"), 50.0).unwrap_err();
    assert!(message.contains("joints hold its part to the ground"), "{message}");
}
