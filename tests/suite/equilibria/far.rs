//! Equilibria that are far from where Newton starts (MECHANICS 7.12): the axial strains that its corrections leave must
//! not stiffen beams, the forces must be exact, and Newton must still find equilibria behind a limit point.

use crate::elements::element_derivatives::{stiffness, straight};
use crate::running::{start, value};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::configuration::{BeamConfiguration, Passage};
use ancf14::mechanics::beam::element::BeamElement;
use ancf14::mechanics::geometry::triad::Triad;
use ancf14::model::simulation::Simulation;
use ancf14::solve::statics::Statics;
use nalgebra::{SMatrix, SVector};

/// A bar that a correction has turned by a small angle is longer, by the angle's square. With the force of that it
/// resists a further turn; to first order the correction was to leave no force, and the tangent is that of a bar
/// without. The forces are those of the longer bar, to the last bit.
#[test]
fn turned_bars_do_not_become_stiffer() {
    const LENGTH: f64 = 0.7;
    let triad = Triad { t: Vec3::x(), u: Vec3::y() };
    for strain in [Strain::Small, Strain::Large, Strain::LargeTruncated] {
        let element = straight(LENGTH, stiffness(strain));
        let turned = |slope: Vec3| {
            let mut q = SVector::<f64, 14>::zeros();
            q.fixed_rows_mut::<3>(3).copy_from(&slope);
            q.fixed_rows_mut::<3>(7).copy_from(&(slope * LENGTH));
            q.fixed_rows_mut::<3>(10).copy_from(&slope);
            q
        };
        let (q, correction) = (turned(Vec3::new(1.0, 0.02, 0.01)), turned(Vec3::new(0.0, 0.02, 0.01)));
        let frames = [0, 7].map(|first| NodeFrame::new(&q.as_slice()[first..first + 7], &triad));
        let c = BeamConfiguration { q: q.as_slice(), frames: &frames, holonomy: &[0.0], heats: &[], drives: &[] };
        let answer = |passage: &Passage| {
            let (mut forces, mut hessian) = (SVector::<f64, 14>::zeros(), SMatrix::<f64, 14, 14>::zeros());
            element.add_gradient_and_set_hessian(&c, passage, 1.0, forces.as_mut_slice(), hessian.as_mut_slice());
            (forces, hessian)
        };
        let (exact, fast) = (answer(&Passage::Rest), answer(&Passage::Corrected(correction.as_slice())));
        assert_eq!(exact.0, fast.0);
        // Further in the same plane, at right angles to the bar.
        let further = turned(Vec3::new(-0.02_f64.hypot(0.01).powi(2), 0.02, 0.01));
        let resistance = |hessian: &SMatrix<f64, 14, 14>| (further.transpose() * hessian * further)[0];
        let (longer, none) = (resistance(&exact.1), resistance(&fast.1));
        // The strain w²/2 = 2.5e-4 times EA = 40, over 0.7 m, and w² = 5e-4.
        assert!(longer > 3e-6 && none.abs() < 1e-12, "{strain:?}: {longer:e} {none:e}");
    }
}

/// A strip that its load bends by half its length: from the unloaded one on every correction is at most of the size of
/// the square of the one before. With the axial forces that corrections leave, a correction of 7e-4 was followed by one
/// of 2e-3.
#[test]
fn corrections_shrink_by_their_square() {
    const MODEL: &str = include_str!("../../../models/princeton_beam.toml");
    let keys = [
        ("arm.elements", "3"),
        ("arm.twist", "quadratic"),
        ("weight.force", "[0, 'P*sin(angle)', 'P*cos(angle)']"),
        ("P", "13.345"),
    ];
    let keys: Vec<_> = keys.map(|(key, value)| (key.to_owned(), value.to_owned())).into();
    let simulation =
        Simulation::load("model.toml", MODEL, &keys).unwrap_or_else(|failure| panic!("{}", failure.message));
    let (system, mut state) = (simulation.system(), simulation.state().clone());
    let mut statics = Statics::new(system, 1e-8);
    statics.find(system, &mut state, 0.0).unwrap_or_else(|failure| panic!("{failure}"));
    let convergence = statics.convergence.unwrap();
    let corrections = convergence.made();
    println!("{corrections:?}");
    // A turn of 1 rad changes all there is: the factor is of the order of 1; below 1e-8 there is round-off.
    for pair in corrections.windows(2) {
        assert!(pair[1] < 5.0 * pair[0] * pair[0] + 1e-8, "{pair:?} of {corrections:?}");
    }
    assert!(corrections[0] > 0.4, "{corrections:?}");
}

/// A shallow arch snaps through under a load that is too large for it. Behind the limit point the exact tangent finds
/// the other side, far away, for this load; for most others Newton fails with either tangent. Each equilibrium on the
/// way, also where the one before is unstable, follows from the saved state before it to the same bits.
#[test]
fn arches_that_snap_are_found_on_the_other_side() {
    let mut simulation = start(
        r#"
format = 1
[model]
name = "Arch"
gravity = [0, 0, 0]
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.flat]
shape = "rectangle"
width = 0.02
height = 0.00425
[beam.arch]
material = "steel"
section = "flat"
curve = { x = "s", y = 0, z = "0.0443*sin(pi*s)", s = [0, 1] }
elements = 4
[joint.left]
type = "revolute"
a = "ground"
b = "arch.start"
axis = [0, 1, 0]
[joint.right]
type = "revolute"
a = "ground"
b = "arch.end"
axis = [0, 1, 0]
[load.press]
at = "arch@0.5"
force = [0, 0, "-467*t"]
[output.crown]
at = "arch@0.5"
quantities = ["position"]
[simulation]
analysis = "static"
stop = 1
step = 0.0476190476
output_step = 0.0476190476
"#,
    );
    let mut told = Vec::new();
    for number in 1..=20 {
        let saved = simulation.snapshot();
        let mut go_on = || {
            let end = 0.0476190476 * f64::from(number);
            simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
            told.extend(simulation.take_warnings());
            let found = value(&simulation, "crown.position[3]").to_bits();
            let after = simulation.snapshot();
            simulation.restore(&saved);
            (found, after)
        };
        let (first, again) = (go_on(), go_on());
        assert_eq!(first.0, again.0, "row {number}");
        simulation.restore(&first.1);
    }
    assert!(told.iter().any(|sentence| sentence.starts_with("the equilibrium jumps to another branch")), "{told:?}");
    assert!(value(&simulation, "crown.position[3]") < -0.04);
}

/// Tension of a steel rod of 20 mm and `length` m between clamps under its own weight.
///
/// The string with the bending stiffness `EI` has the slope `w (x - L/2 exp((x - L/2)/l))/H` right of its middle, with
/// `l^2 = EI/H`. Its stretching `H/EA` is the mean of half the square of its slope.
fn tension(length: f64) -> f64 {
    let (axial, bending, weight) = (210e9 * 4e-4, 210e9 * 0.02_f64.powi(4) / 12.0, 7800.0 * 4e-4 * 9.81);
    let excess = |tension: f64| {
        let end = (bending / tension).sqrt();
        let slope = |x: f64| {
            let ends = ((x.abs() - 0.5 * length) / end).exp() * x.signum();
            weight / tension * (x - 0.5 * length * ends)
        };
        // Midpoints: the second derivative is bounded by the stiff ends, 0.3 m or more.
        let points = 100_000;
        let at = |point: u32| (f64::from(point) + 0.5) / f64::from(points) * length - 0.5 * length;
        let squares: f64 = (0..points).map(|point| slope(at(point)).powi(2)).sum();
        0.5 * squares / f64::from(points) - tension / axial
    };
    let (mut low, mut high) = (1.0, 1e6);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// The first correction of a slender rod between clamps is that of bending alone, 11 to 87 rad of slope. Its own
/// stretching holds it after some degrees. The load needs no ramp.
#[test]
fn slack_rods_between_clamps_need_few_iterations() {
    for (length, elements) in [(50.0, 200), (100.0, 400)] {
        let text = format!(
            "format = 1\nmodel = {{ name = \"Rod\", gravity = [0, 0, -9.81] }}\n\
             material.steel = {{ young = 210e9, poisson = 0.3, density = 7800 }}\n\
             section.square = {{ shape = \"rectangle\", width = 0.02, height = 0.02 }}\n\
             beam.rod = {{ material = \"steel\", section = \"square\", from = [0, 0, 0], to = [{length}, 0, 0], \
             elements = {elements} }}\n\
             joint.left = {{ type = \"weld\", a = \"ground\", b = \"rod.start\" }}\n\
             joint.right = {{ type = \"weld\", a = \"ground\", b = \"rod.end\" }}\n\
             output.middle = {{ at = \"rod@0.5\", quantities = [\"section_force\"] }}\n\
             simulation = {{ analysis = \"static\", stop = 1, step = 1 }}\n"
        );
        let simulation = start(&text);
        let statistics = simulation.state().statistics;
        // Corrections of 0.25 are halved until they are those of the sag, and five of Newton's own follow.
        assert!(statistics.iterations <= 15 && statistics.rejected == 0, "{statistics:?}");
        let found = value(&simulation, "middle.section_force[1]");
        let wanted = tension(length);
        // The string leaves out the square of its slope, 0.05 at most.
        assert!((found / wanted - 1.0).abs() < 2e-3, "{found} {wanted}");
    }
}
