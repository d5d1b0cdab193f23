//! Loads at any fraction of a beam and along a beam, against the closed forms of the linear cantilever: the cubic
//! element is exact at its nodes for them, so that only the squares of the small strains are left.

use crate::support::machines::{clamp, design};
use ancf14::math::Vec3;
use ancf14::math::vectors::vec3;
use ancf14::mechanics::beam::ancf14::coordinates::THETA;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::design::{BeamDesign, Elements, Torsion};
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::statics::Statics;

const DEAD: Direction = Direction::Global;

/// Tip displacement and twist angle at the tip of a cantilever of 1 m along x under one load.
fn tip(
    beam: &BeamDesign,
    site: impl Fn(&SystemBuilder, usize) -> Site,
    force: Vec3,
    moment: Vec3,
    direction: Direction,
) -> (Vec3, f64) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    clamp(&mut builder, number);
    let constant = |v: Vec3| [0, 1, 2].map(|i| Signal::Constant(v[i]));
    let site = site(&builder, number);
    builder.add_load(Load {
        name: "load".into(),
        site,
        guide: LoadGuide::Signals { force: constant(force), moment: constant(moment) },
        direction,
    });
    builder.add_sensor(number, 1.0);
    let (system, mut state) = builder.finish(Vec3::zeros());
    Statics::new(&system, 1e-10).find(&system, &mut state, 0.0).unwrap();
    let mut snapshot = FrameCache::default();
    let twist = system.sensors[0].twist(&system, &snapshot.of(&system, &state));
    (vec3(&state.q, state.q.len() - 7) - Vec3::x(), twist)
}

fn at(fraction: f64) -> impl Fn(&SystemBuilder, usize) -> Site {
    move |builder, beam| Site::Point(builder.section_at(beam, fraction))
}

fn everywhere(builder: &SystemBuilder, beam: usize) -> Site {
    builder.along(beam)
}

#[test]
fn closed_forms_of_the_cantilever() {
    let beam = design("beam", 4);
    let bending = beam.material.young * beam.section.second_moment_y;
    let torsion = beam.material.shear * beam.section.torsion_constant;
    let size = 1e-2;
    // Inside an element, at a node, near the root.
    for a in [0.6, 0.75, 0.1] {
        let (moved, _) = tip(&beam, at(a), Vec3::z() * size, Vec3::zeros(), DEAD);
        let expected = size * a * a * (3.0 - a) / (6.0 * bending);
        assert!((moved[2] / expected - 1.0).abs() < 1e-6, "force at {a}: {:e}", moved[2] / expected - 1.0);
        // A moment about +y bends the beam downwards.
        let (moved, _) = tip(&beam, at(a), Vec3::zeros(), Vec3::y() * size, DEAD);
        let expected = -size * a * (2.0 - a) / (2.0 * bending);
        assert!((moved[2] / expected - 1.0).abs() < 1e-6, "moment at {a}: {:e}", moved[2] / expected - 1.0);
        // Twist is linear in the element: a torque inside is shared by the nodes, which is exact at the tip.
        let (_, turned) = tip(&beam, at(a), Vec3::zeros(), Vec3::x() * size, DEAD);
        let expected = size * a / torsion;
        assert!((turned / expected - 1.0).abs() < 1e-6, "torque at {a}: {:e}", turned / expected - 1.0);
    }
    let (moved, _) = tip(&beam, everywhere, Vec3::z() * size, Vec3::zeros(), DEAD);
    assert!((moved[2] / (size / (8.0 * bending)) - 1.0).abs() < 1e-6);
    let (_, turned) = tip(&beam, everywhere, Vec3::zeros(), Vec3::x() * size, DEAD);
    assert!((turned / (0.5 * size / torsion) - 1.0).abs() < 1e-6);
}

/// A follower force stays across the beam: bent by 60 degrees it pushes the tip back towards the root more than a dead
/// one does. A dead moment and a follower moment in one plane are the same.
#[test]
fn followers_turn_with_the_section() {
    let beam = design("beam", 8);
    let bending = beam.material.young * beam.section.second_moment_y;
    let (dead, _) = tip(&beam, at(1.0), Vec3::z() * (2.0 * bending), Vec3::zeros(), DEAD);
    let (follower, _) = tip(&beam, at(1.0), Vec3::z() * (2.0 * bending), Vec3::zeros(), Direction::Follower);
    assert!(follower[0] < dead[0] - 0.05, "{dead} {follower}");
    let moment = Vec3::y() * -bending;
    let (dead, _) = tip(&beam, at(1.0), Vec3::zeros(), moment, DEAD);
    let (follower, _) = tip(&beam, at(1.0), Vec3::zeros(), moment, Direction::Follower);
    assert!(dead[2] > 0.3 && (dead - follower).norm() < 1e-9, "{dead} {follower}");
}

/// Without torsion the section follows the Bishop frame: ten thousand times stiffer, MECHANICS 3.6.
#[test]
fn suppressed_torsion_does_not_twist() {
    let free = design("beam", 4);
    let stiff = BeamDesign {
        elements: Elements::Ancf14 { strain: Strain::Small, twist: Twist::Linear, torsion: Torsion::Suppressed },
        ..free.clone()
    };
    let torque = Vec3::x() * 1e-2;
    let (_, turned) = tip(&free, at(1.0), Vec3::zeros(), torque, DEAD);
    let (_, held) = tip(&stiff, at(1.0), Vec3::zeros(), torque, DEAD);
    assert!((turned / held / 1e4 - 1.0).abs() < 1e-6);
}

/// Whatever the strain and the twist inside the elements: a strip bent in both directions does not twist, and all of
/// them agree but for the size of the strain, 1e-3, and for the stiffness that is there instead, 1e-4 of its twist.
#[test]
fn suppressed_torsion_goes_with_every_strain_and_twist() {
    let strip = |torsion, strain, twist| BeamDesign {
        section: Section::rectangle(0.004, 0.012),
        elements: Elements::Ancf14 { strain, twist, torsion },
        ..design("beam", 8)
    };
    let force = Vec3::new(0.0, 2.0, 12.0);
    let (_, free) = tip(&strip(Torsion::Free, Strain::Small, Twist::Linear), at(1.0), force, Vec3::zeros(), DEAD);
    let held = |strain, twist| tip(&strip(Torsion::Suppressed, strain, twist), at(1.0), force, Vec3::zeros(), DEAD);
    let (place, _) = held(Strain::Small, Twist::Linear);
    assert!(free.abs() > 5e-3, "the strip must twist if it may: {free}");
    for strain in [Strain::Small, Strain::Large, Strain::LargeTruncated] {
        for twist in [Twist::Linear, Twist::Quadratic] {
            let (own, turned) = held(strain, twist);
            assert!(turned.abs() < 2e-4 * free.abs(), "{strain:?} {twist:?}: {turned} {free}");
            assert!((own - place).norm() < 1e-3 * place.norm(), "{strain:?} {twist:?}: {own} {place}");
        }
    }
}

/// The truncated energy has no lower bound above tau_c: beyond half of it the beam is named once asked, beyond all of
/// it the step is refused (MECHANICS 3.7). tau_c is 153 rad/m for the Princeton beam.
#[test]
fn truncated_strain_has_its_limit() {
    let beam = crate::references::princeton::beam(4, Strain::LargeTruncated, Twist::Linear);
    let check = |rate: f64| {
        let mut builder = SystemBuilder::default();
        builder.add_beam(&beam);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let limit = system.beams[0].twist_limit;
        let length = beam.line.spans[0].length;
        for (node, q) in state.q.chunks_exact_mut(7).enumerate() {
            q[THETA] = rate * limit * length * node as f64;
        }
        let mut snapshot = FrameCache::default();
        let warned = system.twist_near_limit(&state, &mut snapshot).map(|(name, ..)| name.to_owned());
        let outcome = system.check(&snapshot.of(&system, &state), &state, 1.0, 0.0).map_err(|error| error.to_string());
        (limit, warned, outcome)
    };
    let (limit, warned, outcome) = check(0.4);
    assert!((limit - 153.0).abs() < 1.0, "{limit}");
    assert_eq!((warned, outcome.map(drop)), (None, Ok(())));
    let (_, warned, outcome) = check(0.6);
    assert_eq!((warned.as_deref(), outcome.map(drop)), (Some("beam"), Ok(())));
    let (_, warned, outcome) = check(-1.1);
    assert_eq!(warned.as_deref(), Some("beam"));
    assert!(outcome.unwrap_err().contains("element 0 of beam is twisted by -168"));
}
