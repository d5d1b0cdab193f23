//! Large mechanisms are solved front by front: nets, whose longest columns grow with their side, and combs of bodies,
//! in motions and in equilibria. The work of a factorization is counted, so that a mechanism that falls back to the
//! general solver, or whose bodies end up in one dense matrix, is seen without a clock.

use crate::motion::direct_solver::{difference, set_matrix};
use crate::random::Random;
use ancf14::model::builder::{self, Built};
use ancf14::model::document::Document;
use ancf14::solve::linear::elimination_tree::Fronts;
use ancf14::solve::linear::sparse_lu::SparseLu;
use ancf14::solve::newton::kkt::{self, Kkt};
use ancf14_testing::large::{Search, chain, comb, net};

fn built(text: &str) -> Built {
    let document = Document::parse("m.toml", text, &[]).unwrap_or_else(|error| panic!("{error}"));
    builder::build(&document, 0.0).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Multiplications of one elimination; None without fronts.
fn work(text: &str, inertia: bool) -> Option<f64> {
    let Built { system, .. } = built(text);
    let kkt = if inertia { Kkt::for_steps(&system) } else { Kkt::for_equilibria(&system) };
    let fronts = Fronts::new(kkt::unknowns(&system, inertia), &kkt.blocks)?;
    let shapes = fronts.fronts.iter().map(|front| front.shape());
    Some(shapes.flat_map(|own| own.border..own.border + own.pivots).map(|left| (left * left) as f64).sum())
}

/// Twice as many elements take twice as many multiplications where a mechanism is as long as it has elements. A net of
/// twice the side takes some 14 times as many, since the last fronts are as long as its sides: 8 of the third power of
/// the length times what the many shorter ones add.
#[test]
fn the_work_of_a_factorization_grows_as_it_must() {
    let grown = |small: &str, large: &str, inertia| work(large, inertia).unwrap() / work(small, inertia).unwrap();
    for inertia in [true, false] {
        let chains = grown(&chain(1000, Search::Motion), &chain(2000, Search::Motion), inertia);
        let combs = grown(&comb(60, Search::Motion), &comb(120, Search::Motion), inertia);
        let nets = grown(&net(10, "spherical", Search::Motion), &net(20, "spherical", Search::Motion), inertia);
        println!("inertia {inertia}: chains {chains:.3}, combs {combs:.3}, nets {nets:.2}");
        assert!(chains < 2.1 && combs < 2.2 && nets < 18.0, "chains {chains}, combs {combs}, nets {nets}");
    }
}

/// The fronts give the solutions of the general solver where that was used before: in the net the longest front has
/// some 300 rows; the bodies of the comb, last, would make a front of more than 1,200.
#[test]
fn solutions_are_those_of_the_general_solver() {
    let mut random = Random(21);
    for text in [net(20, "weld", Search::Motion), comb(100, Search::Motion)] {
        let Built { system, state } = built(&text);
        for step in [1e-3, 0.0] {
            let mut kkt = if step > 0.0 { Kkt::for_steps(&system) } else { Kkt::for_equilibria(&system) };
            let mut moved = state.clone();
            moved.q.iter_mut().for_each(|value| *value += 1e-3 * random.signed());
            set_matrix(&mut kkt, &system, &moved, step, &vec![0.0; system.constraints()]);
            let right: Vec<f64> = (0..system.coordinates() + system.constraints()).map(|_| random.signed()).collect();
            let (mut own, mut expected) = (right.clone(), right);
            kkt.solve(&system, &mut own, 0.0).unwrap_or_else(|error| panic!("{error}"));
            let mut general = SparseLu::new(&kkt::units(&system), &kkt.blocks).unwrap();
            assert!(general.factorize(&kkt.blocks).and_then(|()| general.solve(&mut expected)).is_ok());
            assert_eq!(kkt.fallbacks(), 0);
            let worst = difference(&own, &expected, |index| general.scale(index));
            println!("step {step}: {worst:.1e}");
            // Both solve to a backward error of 1e-12. The scaled matrices have conditions of 1e4 in steps; at rest a
            // spine of a hundred elements has 1e8.
            assert!(worst < if step > 0.0 { 1e-8 } else { 1e-4 }, "{worst:.1e}");
        }
    }
}

/// No motion of a comb as drawn releases energy. Bodies have no stiffness of their own: if their rigidity was measured
/// by the stiffest coordinate of the mechanism, its round-off would hide the soft motions of the spine, and count some
/// of them.
#[test]
fn no_motion_of_a_comb_releases_energy() {
    let Built { system, state } = built(&comb(500, Search::Equilibrium));
    let mut kkt = Kkt::for_equilibria(&system);
    set_matrix(&mut kkt, &system, &state, 0.0, &vec![0.0; system.constraints()]);
    assert!(kkt.factorize(&system, 0.0).is_ok());
    assert_eq!((kkt.releasing_motions(&system), kkt.fallbacks()), (Some(0), 0));
}
