//! Is a beam that is curved and twisted as drawn the same beam wherever it starts and however its section is named? It
//! must be free of stress as drawn, exactly, for its reference is what its own interpolation finds; drawn from the
//! other end, or with the section's axes renamed, it must bend alike to round-off. A frame that is carried differently
//! from the two ends, a reference curvature with a wrong sign or not divided by `J0`, a strain output that forgets the
//! reference: each fails here.

use crate::support::machines::{ancf14, ancf14_elements, clamp, design, energies};
use crate::support::sections::loaded_section;
use ancf14::math::curve::Curve;
use ancf14::math::jet::Jet;
use ancf14::math::quadrature::GAUSS_POINTS;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::centerline::{Centerline, Spacing};
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::constraint::joint::Joint;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::statics::Statics;
use std::sync::Arc;

/// A curve with curvature and torsion that change along it, run through forwards or backwards.
fn curve(backwards: bool) -> Curve {
    let number = Jet::constant;
    let coordinates = move |s: f64| {
        let s = Jet::variable(s);
        let s = if backwards { number(2.0) - s } else { s };
        [
            number(0.3) * s,
            number(0.25) * (number(2.5) * s).cos(),
            number(0.2) * (number(2.0) * s).sin() + s * s * number(0.05),
        ]
    };
    Curve::new(Arc::new(coordinates), [0.0, 2.0], Vec::new())
}

/// A curve in the plane of x and y.
fn planar(backwards: bool) -> Curve {
    let number = Jet::constant;
    let coordinates = move |s: f64| {
        let s = Jet::variable(s);
        let s = if backwards { number(2.0) - s } else { s };
        [number(0.4) * s, number(0.3) * (number(2.5) * s).cos(), number(0.0)]
    };
    Curve::new(Arc::new(coordinates), [0.0, 2.0], Vec::new())
}

/// How the section of a strip is drawn, and how it is loaded: force and moment at a point, then along the whole.
struct Loads {
    y_axis: [f64; 3],
    pretwist: f64,
    point: [[f64; 3]; 2],
    line: [[f64; 3]; 2],
    gravity: [f64; 3],
}

const IN_SPACE: Loads = Loads {
    y_axis: [0.2, 1.0, -0.3],
    pretwist: 4.0,
    point: [[30.0, -200.0, 150.0], [20.0, 10.0, -30.0]],
    line: [[10.0, 100.0, 200.0], [5.0, 0.0, 10.0]],
    gravity: [0.0, 0.0, -9.81],
};
const IN_PLANE: Loads = Loads {
    y_axis: [0.0, 0.0, 1.0],
    pretwist: 0.0,
    point: [[30.0, -800.0, 0.0], [0.0, 0.0, -30.0]],
    line: [[10.0, 100.0, 0.0], [0.0, 0.0, 10.0]],
    gravity: [0.0, -9.81, 0.0],
};

/// A strip along a curve: its width and height are not exchangeable.
fn strip(strain: Strain, spacing: Spacing, curve: &Curve, elements: usize, loads: &Loads) -> BeamDesign {
    let line = Centerline::curved(curve, spacing, elements).unwrap();
    BeamDesign {
        line,
        y_axis: Vec3::from(loads.y_axis),
        pretwist: loads.pretwist,
        elements: ancf14(strain, Twist::Linear),
        ..design("strip", elements)
    }
}

/// The axes of the section at the end, as drawn.
fn end_axes(beam: &BeamDesign) -> Mat3 {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    builder.drawn(&builder.section_at(number, 1.0)).axes
}

/// The strip held at `held` and loaded in full at `fraction` and along its whole length.
fn loaded(beam: &BeamDesign, [held, fraction]: [f64; 2], loads: &Loads, watched: &[f64]) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    let pose = Pose { place: builder.drawn(&builder.section_at(number, held)).place, axes: Mat3::identity() };
    let b = builder.tied(&builder.section_at(number, held), &pose);
    builder.add_joint(Joint {
        name: "root".into(),
        a: Marker::Ground(pose),
        b,
        primitives: weld::PRIMITIVES,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    });
    let growing = |v: [f64; 3]| {
        v.map(|size| Signal::Function(Arc::new(move |time| Jet { value: size * time, first: size, second: 0.0 })))
    };
    let point = builder.section_at(number, fraction);
    for (site, [force, moment]) in [(Site::Point(point), loads.point), (builder.along(number), loads.line)] {
        let (force, moment) = (growing(force), growing(moment));
        builder.add_load(Load {
            name: "load".into(),
            site,
            guide: LoadGuide::Signals { force, moment },
            direction: Direction::Global,
        });
    }
    for fraction in watched {
        builder.add_sensor(number, *fraction);
    }
    let (system, mut state) = builder.finish(Vec3::from(loads.gravity));
    Statics::new(&system, 1e-13).find(&system, &mut state, 1.0).unwrap();
    (system, state)
}

/// What the sensors see: place; strains and section moments; all with their signs of the one or the other direction of
/// drawing.
fn seen(system: &System, state: &State) -> Vec<(Vec3, [f64; 4], [f64; 4])> {
    let mut snapshot = FrameCache::default();
    let c = snapshot.of(system, state);
    let row = |number: usize| {
        let (forces, strains) = loaded_section(system, state, number);
        let [about_y, about_z] = strains.curvature;
        let [t, my, mz] = forces.moment;
        let place = system.sensors[number].marker.pose(&c).place;
        (place, [strains.axial, strains.torsion, about_y, about_z], [forces.force[0], t, my, mz])
    };
    (0..system.sensors.len()).map(row).collect()
}

/// As drawn nothing is strained, to the bit: energy, forces, and strains at every fraction, with either twist. A strip
/// of twice the curvature has a hundred joules.
#[test]
fn curved_beams_are_free_of_stress_as_drawn() {
    for strain in [Strain::Small, Strain::Large, Strain::LargeTruncated] {
        for spacing in [Spacing::Arc, Spacing::Parameter] {
            let mut beam = strip(strain, spacing, &curve(false), 9, &IN_SPACE);
            if spacing == Spacing::Parameter {
                beam.elements = ancf14(strain, Twist::Quadratic);
            }
            let mut builder = SystemBuilder::default();
            let number = builder.add_beam(&beam);
            clamp(&mut builder, number);
            for k in 0..=40 {
                builder.add_sensor(number, f64::from(k) / 40.0);
            }
            let (system, mut state) = builder.finish(Vec3::zeros());
            let [_, elastic, _] = energies(&system, &state);
            assert_eq!(elastic, 0.0);
            let mut snapshot = FrameCache::default();
            let c = snapshot.of(&system, &state);
            for (number, element) in ancf14_elements(&system).enumerate() {
                let forces = element.evaluation(&c.beams).gradient();
                assert_eq!(forces.amax(), 0.0, "element {number}");
                assert!(element.bending.iter().any(|point| point.reference[0].abs() > 0.1), "it is not curved at all");
                assert!(element.reference_twist.abs() > 0.1, "it is not twisted at all");
            }
            for (place, strains, _) in seen(&system, &state) {
                assert_eq!(strains, [0.0; 4], "at {place}");
            }
            // And it stays where it is.
            let drawn = state.q.clone();
            Statics::new(&system, 1e-12).find(&system, &mut state, 1.0).unwrap();
            let moved = state.q.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(moved < 1e-12, "{moved:e}");
        }
    }
}

/// Curvature and torsion of the reference must be those of the curve: by Frenet and Serret, turned by the pretwist, to
/// the order of the mesh.
#[test]
fn references_are_those_of_the_curve() {
    // A helix: curvature a/(a² + b²), torsion b/(a² + b²); the section keeps to its normal if it is twisted along by
    // the torsion.
    let (a, b, turns) = (0.4, 0.15, 1.5 * std::f64::consts::TAU);
    let (curvature, torsion) = (a / (a * a + b * b), b / (a * a + b * b));
    let number = Jet::constant;
    let helix = move |s: f64| {
        let s = Jet::variable(s);
        [number(a) * s.cos(), number(a) * s.sin(), number(b) * s]
    };
    let helix = Curve::new(Arc::new(helix), [0.0, turns], Vec::new());
    let mut errors = Vec::new();
    for elements in [12, 24] {
        let line = Centerline::curved(&helix, Spacing::Arc, elements).unwrap();
        // Frenet's frame turns against Bishop's by the torsion: a section that is to stay on the normal is pretwisted
        // by as much.
        let pretwist = torsion * helix.length();
        let beam = BeamDesign { line, y_axis: -Vec3::x(), pretwist, ..design("helix", elements) };
        let mut builder = SystemBuilder::default();
        let number = builder.add_beam(&beam);
        let tip = builder.drawn(&builder.section_at(number, 1.0)).axes;
        // The end's normal points to the axis: exact, for nodes are where the curve is.
        assert!((tip.column(1) - Vec3::new(-turns.cos(), -turns.sin(), 0.0)).norm() < 1e-12);
        let (system, _) = builder.finish(Vec3::zeros());
        let points = ancf14_elements(&system).flat_map(|element| &element.bending);
        let worst = points.fold(0.0, |worst: f64, point| {
            let [gamma1, gamma2, tau] = point.reference;
            worst.max((gamma1 / curvature - 1.0).abs()).max(gamma2.abs() / curvature).max((tau / torsion - 1.0).abs())
        });
        errors.push(worst);
    }
    println!("curvatures of a helix, 12 and 24 elements: {errors:?}");
    // Second derivatives of a cubic interpolation at Gauss points: order 2 at least.
    assert!(errors[0] < 3e-2 && errors[1] < 0.3 * errors[0], "{errors:?}");
}

/// Largest differences of places (m), and of strains and section forces (of their largest values), between a strip and
/// the same strip drawn from its other end. y stays, x and z of the section turn round: of all strains and moments only
/// those about y change their sign.
fn asymmetry(strain: Strain, spacing: Spacing, curve: fn(bool) -> Curve, elements: usize, loads: &Loads) -> [f64; 2] {
    let watched = [0.0, 0.2, 0.45, 1.0 / 3.0, 0.8, 1.0];
    let forth = strip(strain, spacing, &curve(false), elements, loads);
    let line = Centerline::curved(&curve(true), spacing, elements).unwrap();
    let back = BeamDesign { line, y_axis: end_axes(&forth).column(1).into(), ..forth.clone() };
    let (system, state) = loaded(&forth, [0.0, 1.0], loads, &watched);
    let (other, mirror) = loaded(&back, [1.0, 0.0], loads, &watched.map(|fraction| 1.0 - fraction));
    let (own, other) = (seen(&system, &state), seen(&other, &mirror));
    let moved = (own[5].0 - forth.line.place(1.0)).norm();
    assert!(moved > 0.05, "the load moves the tip by {moved} m only");
    let apart = own.iter().zip(&other).map(|(own, other)| (own.0 - other.0).norm()).fold(0.0, f64::max);
    let rows = |seen: &[(Vec3, [f64; 4], [f64; 4])], about_y: f64| -> Vec<[f64; 8]> {
        let row = |(_, s, f): &(Vec3, [f64; 4], [f64; 4])| {
            [s[0], s[1], s[2] * about_y, s[3], f[0], f[1], f[2] * about_y, f[3]]
        };
        seen.iter().map(row).collect()
    };
    let (own, other) = (rows(&own, 1.0), rows(&other, -1.0));
    let column = |k: usize| {
        let size = own.iter().map(|row| row[k].abs()).fold(1e-9, f64::max);
        own.iter().zip(&other).map(|(own, other)| (own[k] - other[k]).abs() / size).fold(0.0, f64::max)
    };
    [apart, (0..8).map(column).fold(0.0, f64::max)]
}

/// In its plane the strip bends alike to round-off. In space the frame inside an element begins at the element's first
/// node: the angle of the section between is collocated, and drawing the beam from the other end changes it by the
/// fourth order (MECHANICS 2.13).
#[test]
fn drawn_backwards_it_bends_alike() {
    for strain in [Strain::Small, Strain::Large] {
        for spacing in [Spacing::Arc, Spacing::Parameter] {
            let [places, strains] = asymmetry(strain, spacing, planar, 9, &IN_PLANE);
            println!("{strain:?} {spacing:?}: in the plane {places:.1e} m, {strains:.1e}");
            assert!(places < 1e-9 && strains < 1e-6, "{places:e} {strains:e}");
            let [coarse, fine] = [9, 18].map(|elements| asymmetry(strain, spacing, curve, elements, &IN_SPACE));
            println!("{strain:?} {spacing:?}: in space {coarse:?}, with twice the elements {fine:?}");
            assert!(fine[0] < 1e-6 && fine[0] < coarse[0] / 10.0, "{coarse:?} {fine:?}");
            // A strain of the wrong sign would be off by 2.
            assert!(fine[1] < 2e-2, "{fine:?}");
        }
    }
}

/// The section named anew: its y where its z was. Everything is the same but the names, to round-off.
#[test]
fn section_axes_may_be_renamed() {
    let watched = [0.0, 0.2, 1.0 / 3.0, 0.8, 1.0];
    for strain in [Strain::Small, Strain::Large] {
        let plain = strip(strain, Spacing::Arc, &curve(false), 9, &IN_SPACE);
        let start: Vec3 = plain.line.nodes[0].tangent;
        let turned =
            BeamDesign { section: Section::rectangle(0.02, 0.01), y_axis: start.cross(&plain.y_axis), ..plain.clone() };
        let (system, state) = loaded(&plain, [0.0, 1.0], &IN_SPACE, &watched);
        let (other, turned) = loaded(&turned, [0.0, 1.0], &IN_SPACE, &watched);
        for ((place, strains, forces), (place2, strains2, forces2)) in
            seen(&system, &state).into_iter().zip(seen(&other, &turned))
        {
            assert!((place - place2).norm() < 1e-10, "{:e}", (place - place2).norm());
            // The new y is the old z, the new z the old −y.
            let renamed = |[axial, torsion, about_y, about_z]: [f64; 4]| [axial, torsion, -about_z, about_y];
            for (mine, others, size) in [(strains, renamed(strains2), 1e-2), (forces, renamed(forces2), 1e2)] {
                for (mine, others) in mine.into_iter().zip(others) {
                    assert!((mine - others).abs() < 1e-8 * size, "{mine:e} {others:e}");
                }
            }
        }
    }
}

/// At the points of the energy sensors must see the energy's own strains, also far from the drawing: the quotient by
/// `J0`, the reference and the signs. Round-off of curvatures of 10/m.
#[test]
fn sensors_see_the_strains_of_the_energy() {
    let elements = 5;
    let fractions: Vec<f64> =
        (0..elements).flat_map(|k| GAUSS_POINTS.map(|xi| (k as f64 + xi) / elements as f64)).collect();
    for strain in [Strain::Small, Strain::Large] {
        let beam = strip(strain, Spacing::Arc, &curve(false), elements, &IN_SPACE);
        let (system, state) = loaded(&beam, [0.0, 1.0], &IN_SPACE, &fractions);
        let mut snapshot = FrameCache::default();
        let c = snapshot.of(&system, &state);
        for (k, sensor) in system.sensors.iter().enumerate() {
            let element = ancf14_elements(&system).nth(k / 3).unwrap();
            let expected = element.evaluation(&c.beams).strains[k % 3];
            let found = sensor.sections()[0].strains(&c);
            assert!(expected.norm() > 1e-3, "hardly strained");
            let differences =
                [found.curvature[1] - expected[0], -found.curvature[0] - expected[1], found.torsion - expected[2]];
            assert!(differences.iter().all(|difference| difference.abs() < 1e-12), "{differences:?}");
            // The drawn stretch is not 1 between the nodes of a coarse mesh: dividing by it must show.
            assert!((element.bending[1].reference_stretch - 1.0).abs() > 1e-4);
        }
    }
}

/// Section forces of a bent and twisted strip are those of statics on any mesh: what acts beyond the section, in its
/// axes. What is left is round-off along the stiff axis.
#[test]
fn section_forces_are_those_of_statics() {
    let small = Loads {
        point: [[3e-3, -2e-2, 1.5e-2], [2e-3, 1e-3, -3e-3]],
        line: [[0.0; 3]; 2],
        gravity: [0.0; 3],
        ..IN_SPACE
    };
    let [force, moment] = small.point.map(Vec3::from);
    let watched = [1.0 / 6.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 5.0 / 6.0];
    for elements in [18, 36] {
        let beam = strip(Strain::Large, Spacing::Arc, &curve(false), elements, &small);
        let (system, state) = loaded(&beam, [0.0, 1.0], &small, &watched);
        let mut snapshot = FrameCache::default();
        let c = snapshot.of(&system, &state);
        let end = system.mesh.nodes[elements].place(c.beams.q);
        let rigidity = beam.material.young * beam.section.area;
        for (number, sensor) in system.sensors.iter().enumerate() {
            let pose = sensor.marker.pose(&c);
            let beyond = pose.axes.tr_mul(&(moment + (end - pose.place).cross(&force)));
            let found = loaded_section(&system, &state, number).0;
            let (force_off, moment_off) =
                (Vec3::from(found.force) - pose.axes.tr_mul(&force), Vec3::from(found.moment) - beyond);
            // Round-off of places of a meter over the length of an element, times EA.
            let round_off = elements as f64 * f64::EPSILON * rigidity;
            assert!(force_off.norm() < round_off, "{elements}: {found:?}");
            assert!(moment_off.norm() < round_off, "{elements}: {found:?} {beyond}");
        }
    }
}

/// A quarter of a circle, unbent to a straight line by the moment EI/R at its end: errors as MECHANICS 9 gives them,
/// order 4.
#[test]
fn quarter_arc_unbends() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let number = Jet::constant;
    let arc = move |s: f64| {
        let s = Jet::variable(s) * number(quarter);
        [s.sin() * number(1.0 / quarter), (number(1.0) - s.cos()) * number(1.0 / quarter), number(0.0)]
    };
    let arc = Curve::new(Arc::new(arc), [0.0, 1.0], Vec::new());
    let mut errors = Vec::new();
    for elements in [2, 4, 8] {
        let section = Section::rectangle(0.01, 0.01);
        let beam = BeamDesign {
            line: Centerline::curved(&arc, Spacing::Arc, elements).unwrap(),
            section,
            ..design("arc", elements)
        };
        let mut builder = SystemBuilder::default();
        let number = builder.add_beam(&beam);
        clamp(&mut builder, number);
        let moment = Vec3::z() * (-quarter * beam.material.young * beam.section.second_moment_z);
        crate::support::machines::load(&mut builder, number, 1.0, Vec3::zeros(), moment);
        let end = builder.add_sensor(number, 1.0);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let mut statics = Statics::new(&system, 1e-12);
        for step in 1..=5 {
            statics.find(&system, &mut state, 0.2 * f64::from(step)).unwrap();
        }
        let mut snapshot = FrameCache::default();
        let place = system.sensors[end].marker.pose(&snapshot.of(&system, &state)).place;
        errors.push((place - Vec3::x()).norm());
    }
    println!("a quarter arc unbent, 2, 4, 8 elements: {errors:?}");
    for (error, expected) in errors.iter().zip([4.3e-4, 2.7e-5, 1.7e-6]) {
        // Both are printed with two digits.
        assert!((error / expected - 1.0).abs() < 0.05, "{errors:?}");
    }
}
