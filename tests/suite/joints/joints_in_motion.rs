//! Two beams hung on each other by every kind of joint, at random pose, offset and axis: the joints hold to round-off,
//! what a joint leaves free stays free, and a conservative machine keeps its energy.

use crate::random::Random;
use crate::support::machines::{design, energies, integrate};
use ancf14::math::Vec3;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::constraint::joint::{Joint, JointGradient};
use ancf14::mechanics::constraint::primitive::Primitive;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;

const KINDS: [(&str, &[Primitive], usize); 3] =
    [("weld", weld::PRIMITIVES, 6), ("spherical", spherical::PRIMITIVES, 3), ("revolute", revolute::PRIMITIVES, 5)];

/// A beam hung on the ground by a spherical joint, and a second one on it by `primitives`, all at random.
pub fn machine(random: &mut Random, primitives: &'static [Primitive]) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let soft = Material { young: 2e9, shear: 8e8, density: 1000.0, damping: 0.0 };
    let mut beam = |name: &str, random: &mut Random| {
        let from = random.vector();
        let to = from + random.direction() * 0.8;
        let y_axis = random.direction();
        builder.add_beam(&BeamDesign {
            line: Centerline::straight(from, to, 3),
            y_axis,
            material: soft,
            ..design(name, 3)
        })
    };
    let (first, second) = (beam("first", random), beam("second", random));
    let axes = random.rotation();
    let hook = builder.drawn(&builder.section_at(first, 0.0)).place + random.vector() * 0.1;
    let node = |beam, fraction| builder.node(builder.node_at(beam, fraction).unwrap());
    let [start, end, next] = [node(first, 0.0), node(first, 1.0), node(second, 0.0)];
    let joints = [
        Joint {
            name: "hook".into(),
            a: Marker::Ground(Pose { place: hook, axes }),
            b: builder.tied(&start, &Pose { place: hook, axes }),
            primitives: spherical::PRIMITIVES,
            drive: None,
            gear: None,
            slide: None,
            holding: None,
        },
        {
            // A rigid arm on both sides: the joint sits somewhere between the beams.
            let place = random.vector();
            Joint {
                name: "elbow".into(),
                a: builder.tied(&end, &Pose { place, axes }),
                b: builder.tied(&next, &Pose { place, axes }),
                primitives,
                drive: None,
                gear: None,
                slide: None,
                holding: None,
            }
        },
    ];
    for joint in joints {
        builder.add_joint(joint);
    }
    builder.finish(Vec3::new(1.0, -2.0, -9.0))
}

/// Rows of the joint's gradient that are independent.
fn rank(system: &System, state: &State, joint: usize) -> usize {
    let mut snapshot = FrameCache::default();
    let mut gradient = JointGradient::default();
    system.joints[joint].phi_q(&snapshot.of(system, state), &mut gradient);
    let rows = system.joints[joint].rows();
    let both = nalgebra::DMatrix::from_fn(rows, 28, |row, column| {
        if column < 14 { gradient.a[(row, column)] } else { gradient.b[(row, column - 14)] }
    });
    both.rank(1e-9)
}

#[test]
fn joints_hold_and_energy_stays() {
    let mut random = Random(11);
    for (name, primitives, conditions) in KINDS {
        for _ in 0..3 {
            let (system, mut state) = machine(&mut random, primitives);
            assert_eq!(rank(&system, &state, 1), conditions, "{name}");
            let (mut gap, mut moved) = (0.0_f64, 0.0_f64);
            let (mut low, mut high, mut swing) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
            let drawn = state.q.clone();
            integrate(&system, &mut state, 1.0, (1e-3, 400), |state| {
                let mut snapshot = FrameCache::default();
                let configuration = snapshot.of(&system, state);
                let mut g = vec![0.0; system.constraints()];
                system.constraint_conditions(&configuration, &mut g);
                gap = g.iter().fold(gap, |gap, value| gap.max(value.abs()));
                moved = state.q.iter().zip(&drawn).fold(moved, |moved, (a, b)| moved.max((a - b).abs()));
                let parts = energies(&system, state);
                let total: f64 = parts.iter().sum();
                (low, high, swing) = (low.min(total), high.max(total), swing.max(parts[0]));
            })
            .unwrap();
            println!("{name}: conditions {gap:.1e}, energy band {:.1e} of the kinetic energy", (high - low) / swing);
            assert!(moved > 0.2, "nothing moves");
            assert!(gap < 1e-10, "{name}: {gap:e}");
            // Order 2 in the step: 1e-3 s against the fastest bending modes of some 100 rad/s.
            assert!((high - low) / swing < 1e-2, "{name}: {:e}", (high - low) / swing);
        }
    }
}
