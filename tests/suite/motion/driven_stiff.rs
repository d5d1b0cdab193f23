//! Reactions and efforts of parts that are far stiffer than steps resolve, where frames and drives move them with jerk.
//! Newton's law gives them: `F = m a`.
//!
//! The numerical dissipation must not see rigid or driven motion. One that used the velocities at the start of a step
//! as they were held the nodes of a stiff part back by 1e-11 m, which the stiffness turned into forces: they grew with
//! Young's modulus and with the mesh, to 14 % of `m a` for a wire of 48 elements.

use ancf14_testing::curves::Curves;
use std::f64::consts::PI;

const STEP: f64 = 4e-3;
const LENGTH: f64 = 0.3;
const DENSITY: f64 = 6500.0;
/// Radius of the wire, m.
const THIN: f64 = 0.2e-3;
/// By then the start is forgotten: what alternates has lost a tenth in each of 250 steps, 1e-11 of it is left.
const FORGOTTEN: f64 = 1.0;
/// Young's moduli, Pa.
const MODULI: [f64; 3] = [1e9, 6e10, 1e12];
/// The weight of the velocities in the dissipation, with the default spectral radius of 0.9 (MECHANICS 7.6).
const PSI: f64 = 0.1 * 0.1 / (2.0 * 1.9 * 1.9);
const MESHES: [usize; 4] = [1, 4, 12, 64];

/// A bar of `radius` along x, moved by `parts`.
fn model(radius: f64, parts: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Bar\"\n[material.stuff]\nyoung = 6e10\npoisson = 0.3\ndensity = {DENSITY}\n\
         [section.round]\nshape = \"circle\"\nradius = {radius}\n\
         [beam.bar]\nmaterial = \"stuff\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [{LENGTH}, 0, 0]\nelements = 4\n{parts}\
         [simulation]\nstop = 2\nstep = {STEP}\noutput_step = 0.02\n"
    )
}

fn mass(radius: f64) -> f64 {
    DENSITY * PI * radius * radius * LENGTH
}

/// What round-off of positions of `reach` m does to the axial force of an element, N: twice the last digit of both
/// ends, over its length.
fn round_off(radius: f64, young: f64, elements: usize, reach: f64) -> f64 {
    young * PI * radius * radius * 4.0 * f64::EPSILON * reach / (LENGTH / elements as f64)
}

/// What steps may leave of the axial force of an element, N: a refinement of 1e-12 m and less is taken for round-off,
/// at both ends, and what alternates of it loses a tenth a step: ten of them add up.
fn left(radius: f64, young: f64, elements: usize) -> f64 {
    young * PI * radius * radius * 2e-11 / (LENGTH / elements as f64)
}

/// The rows of a run once the start is forgotten: time and the wanted columns.
fn rows(text: &str, young: f64, elements: usize, integrator: &str, columns: &[&str]) -> Vec<(f64, Vec<f64>)> {
    let (young, elements, integrator) = (young.to_string(), elements.to_string(), format!("\"{integrator}\""));
    let overrides = [
        ("stuff.young", young.as_str()),
        ("bar.elements", elements.as_str()),
        ("simulation.integrator", integrator.trim_matches('"')),
    ];
    let run = Curves::run(text, &overrides);
    let columns: Vec<Vec<f64>> = columns.iter().map(|name| run.column(name)).collect();
    let of_row = |(row, time): (usize, &f64)| (*time, columns.iter().map(|column| column[row]).collect());
    run.time.iter().enumerate().map(of_row).filter(|(time, _)| *time >= FORGOTTEN).collect()
}

fn each(mut check: impl FnMut(f64, usize, &str)) {
    for integrator in ["conserving", "generalized_alpha"] {
        for young in MODULI {
            for elements in MESHES {
                check(young, elements, integrator);
            }
        }
    }
}

/// Checks that `column` of `text` is `moved`, kg, times the acceleration of a way `0.2 t³/6` of the wire: steps of
/// second order have no error of their own then.
fn assert_pushes(text: &str, column: &str, moved: f64) {
    each(|young, elements, integrator| {
        for (time, found) in rows(text, young, elements, integrator, &[column]) {
            let wanted = moved * 0.2 * time;
            let tolerance = 1e-6 * wanted + round_off(THIN, young, elements, LENGTH + 0.2 * time.powi(3) / 6.0);
            assert!(
                (found[0] - wanted).abs() < tolerance,
                "{integrator}, {young:e} Pa, {elements} elements, {time} s: {} N, wanted {wanted} N within {tolerance:e} N",
                found[0]
            );
        }
    });
}

/// A frame pushes the wire along its axis with constant jerk.
#[test]
fn pushed_bars_need_their_mass_times_their_acceleration() {
    let text = model(
        THIN,
        "[frame.push]\nposition = [\"0.2*t^3/6\", 0, 0]\n[joint.grip]\ntype = \"weld\"\na = \"push\"\nb = \"bar.start\"\n\
         [output.pusher]\nat = \"push\"\nquantities = [\"reaction_force\"]\n",
    );
    assert_pushes(&text, "pusher.reaction_force[1]", mass(THIN));
}

/// A drive moves a slider with a body as heavy as the wire in front of it: its effort accelerates both.
#[test]
fn efforts_accelerate_what_they_drive() {
    let carried = mass(THIN);
    let text = model(
        THIN,
        &format!(
            "[body.slider]\nmass = {carried}\nposition = [0, 0, 0]\ninertia = [1e-8, 1e-8, 1e-8]\n\
             [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"slider\"\naxis = [1, 0, 0]\n\
             [joint.grip]\ntype = \"weld\"\na = \"slider\"\nb = \"bar.start\"\n\
             [drive.pusher]\njoint = \"rail\"\ncoordinate = \"distance\"\nvalue = \"0.2*t^3/6\"\n\
             [output.seen]\nat = \"pusher\"\nquantities = [\"effort\"]\n"
        ),
    );
    assert_pushes(&text, "seen.effort", 2.0 * carried);
}

/// A frame shakes the wire. Strains whose means over steps balance the changes of the velocities are off by the share
/// `(1/6 + chi) (ω h)²`, whatever the mesh and the modulus are. The wire itself is off by `(ω L/c)²/3`, with the speed
/// of sound `c`. The dissipation sees `(ω h/2)³` of the false rates at the driven node, whose velocity is `h²/12` of
/// the jerk apart from the next one's.
#[test]
fn shaken_bars_need_their_mass_times_their_acceleration() {
    let (radius, frequency) = (THIN, 20.0);
    let text = model(
        radius,
        &format!(
            "[frame.push]\nposition = [\"0.01*(1 - cos({frequency}*t))\", 0, 0]\n\
             [joint.grip]\ntype = \"weld\"\na = \"push\"\nb = \"bar.start\"\n\
             [output.pusher]\nat = \"push\"\nquantities = [\"reaction_force\"]\n"
        ),
    );
    let largest = mass(radius) * 0.01 * frequency * frequency;
    each(|young, elements, integrator| {
        let stretching = (frequency * LENGTH).powi(2) * DENSITY / young / 3.0;
        // Generalized-alpha has a larger constant, below 1/2.
        let share = if integrator == "conserving" { 1.0 / 6.0 + 0.025 } else { 0.5 };
        let jerk = 0.01 * frequency.powi(3);
        let false_rate = STEP * STEP * jerk / 12.0 / (LENGTH / elements as f64);
        let tolerance = largest * (1.2 * share * (frequency * STEP).powi(2) + stretching)
            + 2.0 * PSI * STEP * (0.5 * frequency * STEP).powi(3) * young * PI * radius * radius * false_rate
            + left(radius, young, elements);
        for (time, found) in rows(&text, young, elements, integrator, &["pusher.reaction_force[1]"]) {
            let wanted = largest * (frequency * time).cos();
            assert!(
                (found[0] - wanted).abs() < tolerance,
                "{integrator}, {young:e} Pa, {elements} elements, {time} s: {} N, wanted {wanted} N within {tolerance:e} N",
                found[0]
            );
        }
    });
}

/// A frame turns a thick bar about its end with a growing acceleration: the weld bears the centripetal force `m ω² L/2`
/// and the transverse one `m α L/2`, in axes that turn along. Positions and velocities at the ends of steps, of which
/// the velocities of rigid turns are off by `(ω h)²/12`, make this a geometry that a dissipation with velocities takes
/// for stretching.
#[test]
fn turned_bars_need_centripetal_forces() {
    let radius = 0.02;
    let text = model(
        radius,
        "[frame.turn]\nposition = [0, 0, 0]\nrotation = [0, 0, \"t^3/3\"]\n[joint.grip]\ntype = \"weld\"\na = \"turn\"\nb = \"bar.start\"\n\
         [output.turner]\nat = \"turn\"\nquantities = [\"reaction_force\"]\n",
    );
    // A softer bar bends: (ω/ω1)² with its lowest frequency ω1 is 1e-5 here.
    for (young, elements) in [1, 4].map(|elements| (2e11, elements)) {
        for (time, found) in
            rows(&text, young, elements, "conserving", &["turner.reaction_force[1]", "turner.reaction_force[2]"])
        {
            let (angle, rate, acceleration) = (time.powi(3) / 3.0, time * time, 2.0 * time);
            let scale = 0.5 * mass(radius) * LENGTH;
            // The fourth derivative of a direction at the angle t³/3.
            let bend = rate.powi(4) + 6.0 * rate * rate * acceleration + 3.0 * acceleration.powi(2) + 8.0 * rate;
            let (centripetal, transverse) = (scale * rate * rate, scale * acceleration);
            let wanted = [
                -centripetal * angle.cos() - transverse * angle.sin(),
                -centripetal * angle.sin() + transverse * angle.cos(),
            ];
            // Strains are off by less than h²/5 of the second derivative of the acceleration.
            let tolerance = scale * (STEP * STEP / 5.0) * bend + left(radius, young, elements);
            for (found, wanted) in found.iter().zip(wanted) {
                assert!(
                    (found - wanted).abs() < tolerance,
                    "{young:e} Pa, {elements} elements, {time} s: {found} N, wanted {wanted} N within {tolerance:e} N"
                );
            }
        }
    }
}
