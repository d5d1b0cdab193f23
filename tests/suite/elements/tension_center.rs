//! A tension center off the axis of a beam. Axial forces along the axis must bend as the parallel-axis theorem says; a
//! beam drawn on its axis must move as one drawn through its tension centers that is held and loaded by rigid arms;
//! results must keep the element's order and their energy. A wrong sign or a missing term shows at order 1.

use crate::running::{run, start, try_start, value, vector};
use ancf14::fmi::Model;
use ancf14::math::Vec3;

/// A cantilever of 2 m along x whose rigidities are about axes through the tension center, with the strain `strain`;
/// `center` are its keys.
fn cantilever(strain: &str, center: &str, elements: usize, more: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"cantilever\"
        [section.own]
        shape = \"rigidities\"
        EA = 4e6
        EI_y = 300
        EI_z = 500
        GJ = 200
        line_density = 2
        {center}
        [beam.arm]
        section = \"own\"
        from = [0, 0, 0]
        to = [2, 0, 0]
        elements = {elements}
        twist = \"quadratic\"
        strain = \"{strain}\"
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"arm.start\"
        [output.tip]
        at = \"arm.end\"
        quantities = [\"displacement\", \"rotation\"]
        {more}"
    )
}

/// The strains that couple bending with stretching: linear, as rigidities do by default, and that of fibers.
const STRAINS: [&str; 2] = ["small", "large"];

const STATIC: &str = "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\ntolerance = 1e-11";

/// Displacement and rotation of the tip at the end.
fn tip(text: &str) -> (Vec3, Vec3) {
    let mut simulation = start(text);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"))
}

/// A force F along the axis acts at `-c` from the tension center: the curvatures are `F y/EI_z` and `F z/EI_y`, and the
/// axis strains by `F (1/EA + y²/EI_z + z²/EI_y)`. What the hand calculation leaves out, that the tension straightens
/// the beam, falls with the load: by 10 for a tenth of it.
#[test]
fn axial_forces_bend_as_the_parallel_axis_theorem_says() {
    for strain in STRAINS {
        let (y, z, length) = (0.02, -0.015, 2.0);
        let errors = [1.0, 0.1].map(|force| {
            let load = format!("[load.pull]\nat = \"arm.end\"\nforce = [\"{force}*t\", 0, 0]\n{STATIC}");
            let (found, turn) = tip(&cantilever(strain, &format!("tension_center = [{y}, {z}]"), 4, &load));
            let [about_z, about_y] = [force * y / 500.0, force * z / 300.0];
            let stretch = force * (1.0 / 4e6 + y * y / 500.0 + z * z / 300.0) * length;
            // The tip goes towards the side on which it is pulled.
            let across = Vec3::new(stretch, 0.5 * about_z * length * length, 0.5 * about_y * length * length);
            let turned = Vec3::new(0.0, -about_y * length, about_z * length);
            println!("{found} {across} {turn} {turned}");
            ((found - across).yz().norm() / across.yz().norm()).max((turn - turned).norm() / turned.norm())
        });
        assert!(errors[0] < 1e-2 && errors[1] < 0.11 * errors[0], "{errors:?}");
    }
}

/// Bent in the plane of the offset, where no torsion tells the shear centers apart: the same beam drawn through its
/// tension centers, welded to ground where it starts, and loaded at the end of a rigid arm. The axis strains by 1 %,
/// which the odd moments of fibers see to first order: what differs is of second order, and falls by 100 for a tenth of
/// the load, but for the error of the mesh.
#[test]
fn an_offset_beam_moves_as_a_centered_one_with_rigid_arms() {
    for strain in STRAINS {
        let differences = [1.0, 0.1].map(|share| {
            let load = format!(
                "at = \"PLACE\"\nforce = [\"{}*t\", \"{}*t\", 0]\nmoment = [0, 0, \"{}*t\"]\n{STATIC}",
                -20.0 * share,
                60.0 * share,
                150.0 * share
            );
            let offset = cantilever(
                strain,
                "tension_center = [0.03, 0]",
                16,
                &format!("[load.pull]\n{}", load.replace("PLACE", "arm.end")),
            );
            let arms = cantilever(
                strain,
                "",
                16,
                &format!(
                    "[point.hand]\non = \"arm.end\"\noffset = [0, -0.03, 0]\n[load.pull]\n{}",
                    load.replace("PLACE", "hand")
                ),
            )
            .replace("from = [0, 0, 0]", "from = [0, 0.03, 0]")
            .replace("to = [2, 0, 0]", "to = [2, 0.03, 0]")
            .replace("at = \"arm.end\"\n        quantities", "at = \"hand\"\n        quantities");
            let ((one, turn), (other, turned)) = (tip(&offset), tip(&arms));
            println!("{one} {other} {turn} {turned}");
            ((one - other).norm() / other.norm()).max((turn - turned).norm() / turned.norm())
        });
        println!("{differences:?}");
        // The linear law is the same about every axis: only the meshes differ.
        let bound = if strain == "small" { 1e-6 } else { 5e-3 };
        assert!(differences[0] < bound && differences[1] < 0.05 * differences[0], "{differences:?}");
    }
}

/// Bent and twisted in space by a force of some size: order 4 over coarse elements, as without an offset; beyond an
/// error of some 1e-6 of the length the order is lower.
#[test]
fn results_keep_their_order() {
    for strain in STRAINS {
        let changes = |center: &str| {
            let found = [2, 4, 8, 16].map(|elements| {
                let load = format!("[load.pull]\nat = \"arm.end\"\nforce = [\"30*t\", \"40*t\", \"50*t\"]\n{STATIC}");
                tip(&cantilever(strain, center, elements, &load)).0
            });
            let changes: Vec<f64> = found.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
            let orders: Vec<f64> = changes.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
            println!("{center}: {changes:?} {orders:?}");
            (changes, orders)
        };
        let (_, centered) = changes("");
        let (errors, orders) = changes("tension_center = [0.02, -0.015]");
        assert!(centered[0] > 3.5 && orders[0] > 3.5 && errors[2] < 2e-6, "{errors:?} {orders:?} {centered:?}");
    }
}

/// A center that is on the axis at the middle point of an element, and nowhere else, acts as one a nanometer beside:
/// the tips agree to what a nanometer does, 1e-7 of the bending.
#[test]
fn regression_a_center_that_crosses_the_axis_counts() {
    for strain in STRAINS {
        let [at, beside] = ["0.02*(s - 1)", "0.02*(s - 1) + 1e-9"].map(|y| {
            let load = format!("[load.pull]\nat = \"arm.end\"\nforce = [\"3000*t\", \"4*t\", 0]\n{STATIC}");
            tip(&cantilever(strain, &format!("tension_center = [\"{y}\", 0]"), 3, &load)).0
        });
        assert!((at - beside).norm() < 1e-6 * at.norm(), "{at} {beside}");
    }
}

/// Section forces and moments at the root are those of the reactions, in space, on any mesh.
#[test]
fn section_forces_are_those_of_the_loads() {
    for strain in STRAINS {
        let more = format!(
            "[load.pull]\nat = \"arm.end\"\nforce = [\"30*t\", \"4*t\", \"5*t\"]
        [output.held]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]
        [output.start]\nat = \"arm.start\"\nquantities = [\"section_force\", \"section_moment\"]\n{STATIC}"
        );
        for elements in [4, 8] {
            let mut simulation = start(&cantilever(strain, "tension_center = [0.02, -0.015]", elements, &more));
            simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
            for (section, joint) in
                [("section_force", "held.reaction_force"), ("section_moment", "held.reaction_moment")]
            {
                let (own, held) = (vector(&simulation, &format!("start.{section}")), vector(&simulation, joint));
                // Newton's remainder.
                assert!((own + held).norm() < 1e-9 * held.norm(), "{section}: {own} {held}");
            }
        }
    }
}

/// A beam that swings in space: energy is kept as by every beam, to the tolerance of the steps; with damping the
/// account is complete.
#[test]
fn energy_is_kept() {
    for strain in STRAINS {
        for (more, damped) in [("", false), ("damping = 1e-3", true)] {
            let center = format!("tension_center = [0.02, -0.015]\n{more}");
            let simulation = "[simulation]\nstop = 0.3\nstep = 5e-4\nspectral_radius = 1\ntolerance = 1e-11\ntotals = [\"energy\", \"work\"]";
            let text = cantilever(strain, &center, 4, simulation)
                .replace("name = \"cantilever\"", "name = \"cantilever\"\ngravity = [0, 0, -9.81]")
                .replace("twist = \"quadratic\"", "velocity = [0, 0, 0]\nangular_velocity = [0, 1, -2]");
            let mut simulation = start(&text);
            let (mut drift, mut kinetic, mut taken) = (0.0_f64, 0.0_f64, 0.0);
            let begin = value(&simulation, "energy.total");
            run(&mut simulation, 0.01, 0.3, |simulation| {
                taken = value(simulation, "work.dissipated");
                drift = drift.max((value(simulation, "energy.total") - begin + taken.abs()).abs());
                kinetic = kinetic.max(value(simulation, "energy.kinetic"));
            });
            println!("{drift:e} J of {kinetic} J, taken {taken}");
            assert!(kinetic > 0.1 && drift < 1e-5 * kinetic && (taken != 0.0) == damped, "{drift:e} {kinetic} {taken}");
        }
    }
}

/// The truncated strain has no terms for the coupling.
#[test]
fn the_truncated_strain_is_refused() {
    let text = cantilever("large_truncated", "tension_center = [0.02, 0]", 2, STATIC);
    let message = try_start(&text).err().unwrap_or_default();
    assert!(message.contains("tension center is off its axis"), "{message}");
}
