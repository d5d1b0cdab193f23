//! Elastic foundations against closed forms and by their energy.

use crate::random::Random;
use crate::running::{goes_on_to_the_bit, run, start, try_start, value, vector};
use crate::support::machines::built;
use crate::support::tangent::{check_damping_matrix, forces_at_rest};
use ancf14::fmi::{Model, Value};
use ancf14::math::Vec3;
use ancf14::math::rotation::rotation_matrix;
use ancf14::mechanics::beam::ancf14::coordinates::{ELEMENT, SHAPE_PLACES};
use ancf14::mechanics::beam::configuration::Dissipation;
use ancf14::mechanics::marker::configuration::{Passage, TimeStep};
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::steady::Spin;

/// A rail of 1 N m² and 2 kg/m on `foundation`.
fn rail(elements: usize, length: f64, foundation: &str, rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rail\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 2\n\
         [beam.rail]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [{length}, 0, 0]\nelements = {elements}\n\
         [foundation.bed]\non = \"rail\"\n{foundation}\n\
         [joint.guide]\ntype = \"bushing\"\na = \"ground\"\nb = \"rail.start\"\nstiffness = [0, 1, 0]\n\
         rotational_stiffness = [1, 0, 0]\n{rest}"
    )
}

/// The stiffness that makes the length `1/λ` of Hetényi's beams 1 m, N/m²: `λ⁴ = k/(4 EI)`.
const UNIT: &str = "stiffness = [4, 4, 4]";

/// Hetényi's infinite beam under a force `P`: deflection `P λ/(2 k)` and moment `P/(4 λ)` under it, and the deflection
/// `P λ/(2 k) e^(−λx)(cos λx + sin λx)` beside it. A beam of `24/λ` differs from it by `e^(−12)`; the force makes slopes
/// of 1e-5, whose squares are left out.
#[test]
fn infinite_beam_under_a_force() {
    let rest = "[load.wheel]\nat = \"rail@0.5\"\nforce = [0, 0, \"-1e-4*t\"]\n\
        [output.under]\nat = \"rail@0.5\"\nquantities = [\"displacement\", \"section_moment\"]\n\
        [output.beside]\nat = \"rail@0.55\"\nquantities = [\"displacement\", \"section_moment\"]\n\
        [output.bed]\nat = \"bed\"\nquantities = [\"reaction_force\", \"energy\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut own = start(&rail(48, 24.0, UNIT, rest));
    run(&mut own, 1.0, 1.0, |_| {});
    let (p, x) = (1e-4_f64, 1.2_f64);
    let near = |name: &str, found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-3, "{name}: {found:e}, expected {expected:e}");
    };
    near("deflection", -vector(&own, "under.displacement").z, p / 8.0);
    near("moment", vector(&own, "under.section_moment").y.abs(), p / 4.0);
    near("beside", -vector(&own, "beside.displacement").z, p / 8.0 * (-x).exp() * (x.cos() + x.sin()));
    near(
        "moment beside",
        vector(&own, "beside.section_moment").y.abs(),
        p / 4.0 * (-x).exp() * (x.sin() - x.cos()).abs(),
    );
    near("force", vector(&own, "bed.reaction_force").z, p);
    // Of the work P w/2 the foundation stores three quarters.
    near("energy", value(&own, "bed.energy"), 0.75 * p * p / 16.0);
}

/// Hetényi's semi-infinite beam under a force at its end: `2 P λ/k`, and none of the moment there.
#[test]
fn semi_infinite_beam_under_a_force() {
    let rest = "[load.wheel]\nat = \"rail.start\"\nforce = [0, 0, \"-1e-4*t\"]\n\
        [output.under]\nat = \"rail.start\"\nquantities = [\"displacement\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut own = start(&rail(24, 12.0, UNIT, rest));
    run(&mut own, 1.0, 1.0, |_| {});
    let found = -vector(&own, "under.displacement").z;
    assert!((found / (1e-4 / 2.0) - 1.0).abs() < 1e-3, "{found:e}");
}

/// The first frequencies of a hinged beam: `ω² = (EI (n π/L)⁴ + k)/m`; the second bends with eight elements
/// a half wave, whose energy is `(π/8)⁴/720` too high, 3e-5.
#[test]
fn frequencies_of_a_hinged_beam() {
    let rest = "[joint.pin]\ntype = \"spherical\"\na = \"ground\"\nb = \"rail.end\"\n\
        [joint.hinge]\ntype = \"spherical\"\na = \"ground\"\nb = \"rail.start\"\n[simulation]\nstop = 1\n";
    let own = start(&rail(16, 2.0, "stiffness = [0, 300, 50]", rest));
    let found = own.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
    let bent = |n: f64, k: f64| ((n * std::f64::consts::PI / 2.0).powi(4) + k) / 2.0;
    let mut expected = [bent(1.0, 50.0), bent(2.0, 50.0), bent(1.0, 300.0)];
    expected.sort_by(f64::total_cmp);
    for own in expected {
        let nearest = found.iter().map(|mode| (mode.eigenvalue / own - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-4, "{own}: {nearest:e} of {:?}", found.iter().map(|m| m.eigenvalue).collect::<Vec<_>>());
    }
}

/// A stiff bar on a foundation that only pushes, under a force at an eccentricity `e`: of a length `L` the part
/// `3 (L/2 − e)` bears, and the end sinks by `2 P/(k a)`. The bar bends by 1e-6 of that.
#[test]
fn a_rigid_bar_lifts_off() {
    let text = "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, 0]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e8\nEI_y = 1e7\nEI_z = 1e7\nGJ = 1e6\nline_density = 1\n\
        [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 3\n\
        [foundation.bed]\non = \"bar\"\npushes = [0, 0, 2]\nstiffness = 1e4\n\
        [joint.guide]\ntype = \"bushing\"\na = \"ground\"\nb = \"bar.start\"\nstiffness = [1, 1, 0]\n\
        rotational_stiffness = [1, 0, 1]\n\
        [load.push]\nat = \"bar@0.7\"\nforce = [0, 0, \"-10*t\"]\n\
        [output.end]\nat = \"bar.end\"\nquantities = [\"displacement\"]\n\
        [output.start]\nat = \"bar.start\"\nquantities = [\"displacement\"]\n\
        [output.bed]\nat = \"bed\"\nquantities = [\"reaction_force\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut own = start(text);
    run(&mut own, 0.5, 1.0, |_| {});
    let (bears, k) = (0.9, 1e4);
    let (end, begin) = (-vector(&own, "end.displacement").z, -vector(&own, "start.displacement").z);
    assert!((end / (2.0 * 10.0 / (k * bears)) - 1.0).abs() < 1e-4, "{end:e}");
    assert!((begin / end + 0.1 / 0.9).abs() < 1e-4, "{begin:e}");
    assert!((vector(&own, "bed.reaction_force").z - 10.0).abs() < 1e-6);
}

const MOVING: &str = "[load.wheel]\nat = \"rail@0.4\"\nforce = [0, 0, \"if(t < 0.05, -20, 0)\"]\n\
    [output.end]\nat = \"rail.end\"\nquantities = [\"position\"]\n\
    [output.bed]\nat = \"bed\"\nquantities = [\"energy\"]\n\
    [simulation]\nstop = 0.5\nstep = 2e-3\nspectral_radius = 1\ntotals = [\"energy\", \"work\"]\n";

const KINDS: [&str; 4] = [
    "stiffness = [1e3, 2e3, 4e3]\naxes = \"section\"\nover = [0.1, 0.77]",
    "stiffness = [1e3, 2e3, 4e3]\ndamping = [1, 2, 30]",
    "pushes = [0.1, 0, 1]\nstiffness = 4e3",
    "pushes = [0, 0, 1]\nstiffness = 4e3\ndamping = 30\nover = [0.2, 0.9]",
];

/// After the force has gone the energy stays, but for what the damping takes, also where the rail lifts off: what is left
/// are the third-order terms of elastic forces, 1e-3 of the energy.
#[test]
fn energy_stays() {
    for kind in KINDS {
        let mut own = start(&rail(6, 2.0, kind, MOVING));
        let mut largest = 0.0_f64;
        run(&mut own, 0.01, 0.5, |own| largest = largest.max(value(own, "energy.total")));
        let drift = value(&own, "work.drift");
        assert!(largest > 1e-3 && drift.abs() < 1e-3 * largest, "{kind}: {drift:e} of {largest:e}");
        let taken = value(&own, "work.dissipated");
        assert!((taken > 0.01 * largest) == kind.contains("damping"), "{kind}: {taken:e}");
    }
}

/// A run goes on from a saved state to the bit.
#[test]
fn states_go_on_to_the_bit() {
    for kind in KINDS {
        let mut own = start(&rail(4, 2.0, kind, MOVING));
        run(&mut own, 0.1, 0.1, |_| {});
        goes_on_to_the_bit(&mut own, 0.2);
    }
}

/// The tangent against central differences of the forces: 1e-6 of the largest force, by their round-off and the square of
/// their step.
#[test]
fn the_tangent_is_the_derivative() {
    for kind in KINDS {
        let (system, state) = built(&rail(2, 2.0, kind, "[simulation]\nstop = 1\n"));
        let mut random = Random(7);
        let q: Vec<f64> = state.q.iter().map(|own| own + 0.02 * random.signed()).collect();
        let direction: Vec<f64> = q.iter().map(|_| random.signed()).collect();
        let moved = |h: f64| -> Vec<f64> { q.iter().zip(&direction).map(|(own, by)| own + h * by).collect() };
        let (_, tangent) = forces_at_rest(&system, &state, &q);
        let mut product = vec![0.0; q.len()];
        tangent.multiply_add(&direction, &mut product);
        let [plus, minus] = [1e-6, -1e-6].map(|h| forces_at_rest(&system, &state, &moved(h)).0);
        let scale = product.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
        for (index, own) in product.iter().enumerate() {
            let found = (plus[index] - minus[index]) / 2e-6;
            assert!((found - own).abs() < 1e-6 * scale, "{kind}, {index}: {found} {own}");
        }
    }
}

/// A direction of 0 is a mistake.
#[test]
fn a_direction_of_zero_is_a_mistake() {
    let text = rail(2, 1.0, "pushes = [0, 0, 0]\nstiffness = 1", "[simulation]\nstop = 1\n");
    let message = try_start(&text).unwrap_err();
    assert!(message.contains("must have a direction"), "{message}");
}

/// A stiff bar sinks by `P/(k a)` on the part `a` of its length that the foundation supports, without a turn under a
/// force in its middle. The bar bends by 1e-6 of that; both ends of the part are inside elements.
#[test]
fn a_part_of_a_bar_is_supported() {
    let text = "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, 0]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e8\nEI_y = 1e7\nEI_z = 1e7\nGJ = 1e6\nline_density = 1\n\
        [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 3\n\
        [foundation.bed]\non = \"bar\"\nover = [0.1, 0.78]\nstiffness = [0, 0, 1e4]\n\
        [joint.guide]\ntype = \"bushing\"\na = \"ground\"\nb = \"bar.start\"\nstiffness = [1, 1, 0]\n\
        rotational_stiffness = [1, 0, 1]\n\
        [load.push]\nat = \"bar@0.44\"\nforce = [0, 0, \"-10*t\"]\n\
        [output.end]\nat = \"bar.end\"\nquantities = [\"displacement\"]\n\
        [output.start]\nat = \"bar.start\"\nquantities = [\"displacement\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut own = start(text);
    run(&mut own, 1.0, 1.0, |_| {});
    for name in ["start.displacement", "end.displacement"] {
        let found = -vector(&own, name).z;
        assert!((found / (10.0 / (1e4 * 0.68)) - 1.0).abs() < 1e-4, "{name}: {found:e}");
    }
}

/// A foundation in the axes of the sections, or one that pushes, turns with a copy of its beam: so do displacements, to
/// the tolerance of the solution.
#[test]
fn foundations_turn_with_copies() {
    for kind in ["stiffness = [1, 20, 90]\naxes = \"section\"", "pushes = [0, 0.3, 1]\nstiffness = 90"] {
        let mut own = start(&format!(
            "format = 1\n[model]\nname = \"Copies\"\ngravity = [0, 0, 0]\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 2\n\
             [copy.rails]\ncount = 2\nturn = {{ axis = [1, 2, 3], angle = \"0.7*(k - 1)\" }}\n\
             [copy.rails.beam.rail]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 4\n\
             [copy.rails.foundation.bed]\non = \"rail\"\n{kind}\n\
             [copy.rails.joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rail.start\"\n\
             [copy.rails.load.wheel]\nat = \"rail.end\"\nforce = [0, \"-1*t\", \"-2*t\"]\n\
             [output.first]\nat = \"rail_1.end\"\nquantities = [\"displacement\"]\n\
             [output.second]\nat = \"rail_2.end\"\nquantities = [\"displacement\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\n"
        ));
        run(&mut own, 0.5, 1.0, |_| {});
        let turn = rotation_matrix(&(Vec3::new(1.0, 2.0, 3.0).normalize() * 0.7));
        let [first, second] = ["first", "second"].map(|name| vector(&own, &format!("{name}.displacement")));
        assert!(
            first.norm() > 1e-2 && (second - turn * first).norm() < 1e-6 * first.norm(),
            "{kind}: {first} {second}"
        );
    }
}

/// A stiffness that changes between two states of equilibrium makes the second that of a model with the new value, to
/// the tolerance of the solution.
#[test]
fn a_foundation_is_tuned_between_steps() {
    let rest = "[load.wheel]\nat = \"rail@0.5\"\nforce = [0, 0, \"-1*t\"]\n\
        [output.under]\nat = \"rail@0.5\"\nquantities = [\"displacement\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let cases = [
        ("stiffness = [4, 4, 40]", "stiffness = [4, 4, 90]", "bed.stiffness[3]"),
        ("pushes = [0, 0, 1]\nstiffness = 40", "pushes = [0, 0, 1]\nstiffness = 90", "bed.stiffness"),
    ];
    for (before, after, name) in cases {
        let mut own = start(&rail(6, 3.0, before, rest));
        run(&mut own, 0.5, 0.5, |_| {});
        let at = own.variables().iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no {name}"));
        own.set_value(at, Value::Real(90.0)).unwrap_or_else(|failure| panic!("{}", failure.message));
        own.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let mut other = start(&rail(6, 3.0, after, rest));
        run(&mut other, 0.5, 1.0, |_| {});
        let [found, expected] = [&own, &other].map(|own| vector(own, "under.displacement").z);
        assert!((found / expected - 1.0).abs() < 1e-6, "{name}: {found:e}, expected {expected:e}");
    }
}

/// The forces of foundations on all coordinates over a step of 0.01 s between the coordinates `ends`, and their tangent
/// times `along`.
fn forces_over_a_step(system: &System, before: &State, ends: [&[f64]; 2], along: &[f64]) -> [Vec<f64>; 2] {
    let frames = ends.map(|q| {
        let mut frames = FrameCache::default();
        frames.set(system, q, &before.triads);
        frames
    });
    let [start, end] = [0, 1].map(|side| system.configuration(ends[side], &frames[side], before, &before.prescribed));
    let passage = Passage::Step(TimeStep {
        start: &start,
        end: &end,
        increment: &[],
        duration: 0.01,
        velocity: &[],
        dissipation: Dissipation::new(0.8),
        strain_rates: &[],
        predicted_rates: &[],
        velocity_lead: &[],
        starts: &[],
    });
    let [mut forces, mut product] = [(); 2].map(|()| vec![0.0; along.len()]);
    for bed in &system.foundations[0].beds {
        let element = &system.mesh.elements[bed.element];
        let range = element.coordinates();
        let mut block = vec![0.0; ELEMENT * ELEMENT];
        system.foundations[0].each_bearing(bed, element, (&end, &passage), 1.0, &mut |own| {
            for (weight, place) in own.weights.iter().zip(SHAPE_PLACES) {
                (0..3).for_each(|axis| forces[range.start + place + axis] -= own.force[axis] * weight);
            }
            own.add_to(&own.stiffness, 1.0, &mut block);
        });
        for (column, by) in block.chunks(ELEMENT).zip(&along[range.clone()]) {
            product[range.clone()].iter_mut().zip(column).for_each(|(sum, own)| *sum += own * by);
        }
    }
    [forces, product]
}

/// The damping of a foundation on both sides is in the damping matrix of modes.
#[test]
fn the_damping_matrix_is_the_derivative() {
    let (system, state) = built(&rail(2, 2.0, KINDS[1], "[simulation]\nstop = 1\n"));
    check_damping_matrix(&system, state, KINDS[1]);
}

/// A foundation that only pushes and that a bar presses down all along is one that acts on both sides, also in an element
/// that it supports in part: the moments of sections before its end, on it and behind it are the same but for round-off.
#[test]
fn sections_beside_the_end_of_a_foundation() {
    let moments = |foundation: &str| {
        let text = rail(
            2,
            2.0,
            foundation,
            "[load.press]\non = \"rail\"\nforce = [0, 0, \"-t\"]\n\
             [output.cut]\non = \"rail\"\nstations = 21\nquantities = [\"section_moment\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\n",
        );
        let mut own = start(&text);
        run(&mut own, 1.0, 1.0, |_| {});
        (1..=21).map(|station| value(&own, &format!("cut.section_moment[{station},2]"))).collect::<Vec<_>>()
    };
    let pushing = moments("over = [0.2, 0.8]\npushes = [0, 0, 1]\nstiffness = 100");
    let sided = moments("over = [0.2, 0.8]\nstiffness = [0, 0, 100]");
    let scale = sided.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
    assert!(scale > 0.05, "{scale}");
    for (station, (pushing, sided)) in pushing.iter().zip(&sided).enumerate() {
        assert!((pushing - sided).abs() < 1e-8 * scale, "{station}: {pushing} {sided}");
    }
}

/// Over a step the tangent is twice the derivative by the end. On both sides differences are off by their round-off,
/// 1e-7. On one side a point that lifts off or lands leaves how the pieces move to the iteration; with damping there,
/// the force is cut off between the points too, and its derivative is rougher.
#[test]
fn the_tangent_of_a_step_is_twice_the_derivative() {
    for (kind, bound) in KINDS.into_iter().zip([1e-7, 1e-7, 2e-2]) {
        let (system, state) = built(&rail(2, 2.0, kind, "[simulation]\nstop = 1\n"));
        let mut random = Random(7);
        let begin: Vec<f64> = state.q.iter().map(|own| own + 0.02 * random.signed()).collect();
        let end: Vec<f64> = begin.iter().map(|own| own + 0.002 * random.signed()).collect();
        let along: Vec<f64> = end.iter().map(|_| random.signed()).collect();
        let over = |h: f64| {
            let end: Vec<f64> = end.iter().zip(&along).map(|(own, by)| own + h * by).collect();
            forces_over_a_step(&system, &state, [&begin, &end], &along)
        };
        let [[_, product], [plus, _], [minus, _]] = [0.0, 1e-6, -1e-6].map(over);
        let scale = product.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
        assert!(scale > 1.0, "{kind} does not act");
        for (index, own) in product.iter().enumerate() {
            let found = (plus[index] - minus[index]) / 1e-6;
            assert!((found - own).abs() < bound * scale, "{kind}, {index}: {found} {own}");
        }
    }
}

/// No steady rotation is looked for on a foundation.
#[test]
fn steady_rotation_on_a_foundation_is_refused() {
    let text = "format = 1\n[model]\nname = \"Blade\"\ngravity = [0, 0, 0]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 2\n\
        [beam.blade]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
        [foundation.bed]\non = \"blade\"\nstiffness = [0, 0, 4]\n\
        [joint.hub]\ntype = \"revolute\"\na = \"ground\"\nb = \"blade.start\"\naxis = [0, 0, 1]\n\
        [drive.motor]\njoint = \"hub\"\ncoordinate = \"angle\"\nvalue = 0\n[simulation]\nstop = 1\n";
    let own = start(text);
    let spin = Spin { drive: String::from("motor"), speed: 1.0, is_weightless: false };
    let message = own.linearize_steady(&spin, Some(&[]), None).unwrap_err().message;
    assert!(message.contains("a foundation") && message.contains("does not turn steadily"), "{message}");
}
