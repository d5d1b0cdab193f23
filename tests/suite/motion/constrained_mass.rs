//! Velocities that the constraints allow come from what conditions see of the mass matrix: the solutions are those of
//! the whole linear system, on every model and at random states of it. Where conditions depend on each other there is
//! none, and the solver must say so instead of giving one of many.

use crate::motion::direct_solver::machines;
use crate::random::Random;
use crate::support::machines::{clamp, design};
use ancf14::math::Vec3;
use ancf14::mechanics::constraint::joint::{Joint, JointGradient};
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::builder::Built;
use ancf14::solve::linear::mass_factor::MassFactor;
use ancf14::solve::linear::sparse_lu::SparseLu;
use ancf14::solve::newton::kkt;
use ancf14::solve::newton::kkt::Kkt;
use ancf14::solve::step::constrained_mass::{ConstrainedMass, MOST_ROWS};

/// The masses alone.
fn masses(system: &System) -> Kkt {
    let mut kkt = Kkt::for_projections(system);
    system.add_mass(MassAt::CONSTANT, 1.0, &mut kkt.blocks);
    kkt
}

fn gradients(system: &System, state: &State) -> Vec<JointGradient> {
    let (mut snapshot, mut gradients) = (FrameCache::default(), Vec::new());
    system.constraint_gradients(&snapshot.of(system, state), &mut gradients);
    gradients
}

#[test]
fn solutions_are_those_of_the_whole_system() {
    for (name, Built { system, state }) in machines() {
        // Another machine changes nothing here.
        let mut random = Random(11);
        let mut kkt = masses(&system);
        let Some(mut fast) = ConstrainedMass::new(&system, &kkt.blocks) else {
            // A disk is as flat as can be: one of its directors has no mass.
            let is_flat = system.bodies.iter().any(|body| body.director_inertia.contains(&0.0));
            assert!(is_flat || system.constraints() > MOST_ROWS, "{name} has none");
            continue;
        };
        let mut general = SparseLu::new(&kkt::units(&system), &kkt.blocks).unwrap();
        let size = system.coordinates() + system.constraints();
        let (mut worst, mut rough) = (0.0_f64, 0.0_f64);
        for number in 0..5 {
            let mut moved = state.clone();
            let reach = if number == 0 { 0.0 } else { 0.02 * system.size };
            moved.q.iter_mut().for_each(|value| *value += reach * random.signed());
            let gradients = gradients(&system, &moved);
            // Momenta of velocities of the size of the conditions: multipliers of any size would hide errors.
            let velocity: Vec<f64> = (0..system.coordinates()).map(|_| random.signed()).collect();
            let mut right = vec![0.1; size];
            let (forces, conditions) = right.split_at_mut(system.coordinates());
            system.mass_times(MassAt::CONSTANT, &velocity, forces);
            conditions.iter_mut().for_each(|value| *value *= random.signed());
            let mut expected = right.clone();
            fast.solve(&system, &gradients, &mut right, &mut vec![0.0; system.coordinates()])
                .unwrap_or_else(|_| panic!("{name} has no solution"));
            let (mut change, rates) = (velocity.clone(), expected[system.coordinates()..].to_vec());
            fast.correct_velocity(&system, &gradients, &rates, &velocity, &mut change)
                .unwrap_or_else(|_| panic!("{name} has no correction"));
            let corrected: Vec<f64> =
                velocity.iter().zip(&change).map(|(velocity, change)| velocity + change).collect();
            kkt.set_constraints(&system, &gradients, &gradients, 1.0);
            assert!(general.factorize(&kkt.blocks).and_then(|()| general.solve(&mut expected)).is_ok(), "{name}");
            let scaled = |index: usize, value: f64| (value / general.scale(index)).abs();
            let largest = expected.iter().enumerate().map(|(index, value)| scaled(index, *value)).fold(0.0, f64::max);
            for (index, (own, expected)) in right.iter().zip(&expected).enumerate() {
                worst = worst.max(scaled(index, own - expected) / largest);
            }
            for (index, (own, expected)) in corrected.iter().zip(&expected).enumerate() {
                rough = rough.max(scaled(index, own - expected) / largest);
            }
        }
        println!("{name}: {worst:.1e}, corrected once {rough:.1e}");
        // As for the solver that goes front by front: a backward error of 1e-12, conditions of some 1e4.
        assert!(worst < 1e-8 && rough < 1e-8, "{name}: {worst:.1e}, {rough:.1e}");
    }
}

/// The frames that joints depend on are all that gradients and rates of conditions see: at nodes, and inside elements,
/// where a section turns with the nodes of both ends.
#[test]
fn conditions_depend_on_the_frames_of_their_nodes_alone() {
    let mut builder = SystemBuilder::new(0.0);
    let beam = builder.add_beam(&design("beam", 5));
    clamp(&mut builder, beam);
    let section = builder.section_at(beam, 0.7);
    let pose = builder.drawn(&section);
    builder.add_joint(Joint {
        name: String::from("joint inside"),
        a: Marker::Ground(pose),
        b: section,
        primitives: weld::PRIMITIVES,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    });
    let (system, state) = builder.finish(Vec3::zeros());
    // The clamped node, and both ends of the fourth element.
    assert_eq!(system.joint_frames(), [0, 3, 4]);
    let mut random = Random(12);
    let mut all = machines();
    all.push((String::from("joint inside an element"), Built { system, state }));
    for (name, Built { system, mut state }) in all {
        let frames = system.joint_frames();
        state.q.iter_mut().for_each(|value| *value += 0.02 * system.size * random.signed());
        let (mut snapshot, mut found, mut rates) = (FrameCache::default(), Vec::new(), vec![0.0; system.constraints()]);
        let c = snapshot.at_frames(&system, &frames, &state.q, &state, &state.prescribed);
        system.constraint_gradients(&c, &mut found);
        system.constraint_rates(&c, &mut rates);
        let (mut whole, mut expected) = (FrameCache::default(), vec![0.0; system.constraints()]);
        system.constraint_rates(&whole.of(&system, &state), &mut expected);
        assert!(found == gradients(&system, &state) && rates == expected, "{name}");
    }
}

/// Along a beam x, y, z and the angles are four chains, of which three are one; a body has four of three alike.
#[test]
fn axes_share_a_factor() {
    let shaft = machines().into_iter().find(|(name, _)| name == "rotating_shaft");
    let (_, Built { system, .. }) = shaft.unwrap_or_else(|| panic!("there is no rotating shaft"));
    let factor = MassFactor::new(system.coordinates(), &masses(&system).blocks).unwrap();
    let chains: Vec<_> = factor.chains.iter().map(|chain| (chain.width, chain.unknowns.len())).collect();
    // Seven nodes.
    assert_eq!(chains, [(3, 14), (1, 7), (3, 1), (3, 1), (3, 1), (3, 1)]);
}

#[test]
fn dependent_conditions_are_refused() {
    let mut builder = SystemBuilder::new(0.0);
    let beam = builder.add_beam(&design("beam", 3));
    clamp(&mut builder, beam);
    let once = builder.clone();
    clamp(&mut builder, beam);
    for (builder, held) in [(once, 1), (builder, 2)] {
        let (system, state) = builder.finish(Vec3::zeros());
        let mut fast = ConstrainedMass::new(&system, &masses(&system).blocks).unwrap();
        let mut right = vec![1.0; system.coordinates() + system.constraints()];
        let solved = fast.solve(&system, &gradients(&system, &state), &mut right, &mut vec![0.0; system.coordinates()]);
        assert_eq!(solved.is_ok(), held == 1, "held {held} times");
    }
}
