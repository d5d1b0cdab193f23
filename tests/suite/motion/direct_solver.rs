//! The solver that goes front by front gives the solutions of the general sparse LU, on every model and at random
//! states of it.

use crate::random::Random;
use ancf14::math::blocks::{Block, Blocks};
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::builder::{self, Built};
use ancf14::model::document::Document;
use ancf14::solve::linear::Regularity;
use ancf14::solve::linear::direct::DirectSolver;
use ancf14::solve::linear::elimination_tree::{Fronts, Unknowns};
use ancf14::solve::linear::sparse_lu::SparseLu;
use ancf14::solve::linear::units::Units;
use ancf14::solve::newton::kkt::{self, Kkt};

/// Every model, and beams of the other element.
pub fn machines() -> Vec<(String, Built)> {
    let folder = std::fs::read_dir("models").unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = folder.filter(|path| path.extension().is_some_and(|own| own == "toml")).collect();
    files.sort();
    assert!(files.len() > 10);
    let mut machines = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        machines.push((name, built(&text, &[])));
    }
    let arm = [(String::from("arm.element"), String::from("ancf24"))];
    machines.push((String::from("cantilever of ancf24"), built(include_str!("../../../models/cantilever.toml"), &arm)));
    machines
}

fn built(text: &str, overrides: &[(String, String)]) -> Built {
    let document = Document::parse("m.toml", text, overrides).unwrap_or_else(|error| panic!("{error}"));
    builder::build(&document, 0.0).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Sets the matrix of a step of `step` s (0: of an equilibrium) at `state`, with the forces `multipliers` in the
/// joints.
pub fn set_matrix(kkt: &mut Kkt, system: &System, state: &State, step: f64, multipliers: &[f64]) {
    let mut snapshot = FrameCache::default();
    let configuration = snapshot.of(system, state);
    let (mut forces, mut excitation) = (vec![0.0; system.coordinates()], Excitation::default());
    system.excite(0.0, &state.targets, &mut excitation);
    kkt.blocks.clear();
    let factor = if step > 0.0 { 0.25 * step * step } else { 1.0 };
    system.forces_and_tangent(&configuration, &Passage::Rest, &excitation, factor, &mut forces, &mut kkt.blocks);
    if step > 0.0 {
        system.add_mass(MassAt::CONSTANT, 1.0, &mut kkt.blocks);
    }
    let mut gradients = Vec::new();
    kkt.set_curvatures_and_gradients(system, &configuration, multipliers, factor, &mut gradients);
    kkt.set_constraints(system, &gradients, &gradients, if step > 0.0 { step } else { 1.0 });
}

/// The largest difference of two vectors, each unknown in what it is measured in, over the largest unknown.
pub fn difference(a: &[f64], b: &[f64], scale: impl Fn(usize) -> f64) -> f64 {
    let size = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
    let largest = size(&mut b.iter().enumerate().map(|(index, value)| value / scale(index)));
    size(&mut a.iter().zip(b).enumerate().map(|(index, (a, b))| (a - b) / scale(index))) / largest
}

#[test]
fn solutions_are_those_of_the_general_solver() {
    let mut random = Random(7);
    for (name, Built { system, state }) in machines() {
        let mut kkt = Kkt::for_steps(&system);
        let size = system.coordinates() + system.constraints();
        let mut general = SparseLu::new(&kkt::units(&system), &kkt.blocks).unwrap();
        let mut worst = 0.0_f64;
        for number in 0..5 {
            // As drawn, then bent by some hundredths; steps from 1e-4 to 1e-2 s.
            let mut moved = state.clone();
            let reach = if number == 0 { 0.0 } else { 0.02 * system.size };
            moved.q.iter_mut().for_each(|value| *value += reach * random.signed());
            let multipliers: Vec<f64> = (0..system.constraints()).map(|_| 10.0 * random.signed()).collect();
            let step = 10_f64.powf(-3.0 + random.signed());
            set_matrix(&mut kkt, &system, &moved, step, &multipliers);
            let right: Vec<f64> = (0..size).map(|_| random.signed()).collect();
            let (mut own, mut expected) = (right.clone(), right);
            kkt.factorize(&system, 0.0).unwrap_or_else(|error| panic!("{name}: {error}"));
            kkt.solve_again(&mut own).unwrap_or_else(|_| panic!("{name}"));
            assert!(general.factorize(&kkt.blocks).and_then(|()| general.solve(&mut expected)).is_ok(), "{name}");
            worst = worst.max(difference(&own, &expected, |index| general.scale(index)));
            assert!(kkt.check_unique(&system, 0.0).is_ok() && general.regularity() == Regularity::Regular, "{name}");
        }
        println!("{name}: {worst:.1e}");
        assert_eq!(kkt.fallbacks(), 0, "{name}");
        // Both solve to a backward error of 1e-12; the scaled matrices have conditions of some 1e4 (MECHANICS 7.3).
        assert!(worst < 1e-8, "{name}: {worst:.1e}");
    }
}

/// A step of 1 ms from `state` is solved front by front, and as the general solver does.
fn assert_own_solution(random: &mut Random, system: &System, state: &State, kkt: &mut Kkt) {
    let multipliers: Vec<f64> = (0..system.constraints()).map(|_| 10.0 * random.signed()).collect();
    set_matrix(kkt, system, state, 1e-3, &multipliers);
    let size = system.coordinates() + system.constraints();
    let right: Vec<f64> = (0..size).map(|_| random.signed()).collect();
    let (mut own, mut expected) = (right.clone(), right);
    kkt.solve(system, &mut own, 0.0).unwrap_or_else(|error| panic!("{error}"));
    let mut general = SparseLu::new(&kkt::units(system), &kkt.blocks).unwrap();
    assert!(general.factorize(&kkt.blocks).and_then(|()| general.solve(&mut expected)).is_ok());
    assert_eq!(kkt.fallbacks(), 0);
    // As above.
    let worst = difference(&own, &expected, |index| general.scale(index));
    assert!(worst < 1e-8, "{worst:.1e}");
}

/// Rods with a ball joint at each end turn about themselves: all their conditions together, twelve on twelve
/// coordinates, have no pivot, so that one of the joints has to go with what is at its other side. In a ring of them
/// too.
#[test]
fn rods_between_ball_joints() {
    let mut random = Random(4);
    let body = |name: &str, position: [f64; 3]| {
        format!("[body.{name}]\nmass = 0.1\nposition = {position:?}\ninertia = [1e-4, 1e-3, 1e-3]\n")
    };
    let ball = |name: &str, a: &str, b: &str, at: [f64; 3]| {
        format!("[joint.{name}]\ntype = \"spherical\"\na = \"{a}\"\nb = \"{b}\"\nat = {at:?}\n")
    };
    let mut struts = String::from(include_str!("../../../models/cantilever.toml"));
    let mut ring = String::from("format = 1\n[model]\nname = \"Ring\"\n");
    for number in 0..8 {
        let place = |share: f64| {
            let (sin, cos) = (std::f64::consts::FRAC_PI_4 * (f64::from(number) + share)).sin_cos();
            [1.0 + sin * cos, cos, sin]
        };
        let [x, y, z] = place(0.0);
        // More would hold the tip twice.
        if number < 3 {
            let strut = format!("strut{number}");
            struts += &body(&strut, [0.5 * (1.0 + x), 0.5 * y, 0.5 * z]);
            struts += &ball(&format!("in{number}"), "arm.end", &strut, [1.0, 0.0, 0.0]);
            struts += &ball(&format!("out{number}"), &strut, "ground", [x, y, z]);
        }
        ring += &body(&format!("link{number}"), place(0.5));
        ring +=
            &ball(&format!("ball{number}"), &format!("link{}", (number + 7) % 8), &format!("link{number}"), [x, y, z]);
    }
    for text in [struts, ring + "[simulation]\nstop = 1\nstep = 1e-3\n"] {
        let Built { system, state } = built(&text, &[]);
        let mut kkt = Kkt::for_steps(&system);
        assert_own_solution(&mut random, &system, &state, &mut kkt);
    }
}

/// A hundred weights at the tip of a beam: each is eliminated with its joint, and a front stays as small as for one of
/// them. After the tip, all would be one dense matrix.
#[test]
fn many_bodies_on_one_node() {
    let mut random = Random(3);
    for kind in ["spherical", "weld"] {
        let mut text = String::from(include_str!("../../../models/cantilever.toml"));
        for number in 0..100 {
            text += &format!(
                "[body.weight{number}]\nmass = 0.1\nposition = [1, 0, {}]\ninertia = [1e-3, 1e-3, 1e-3]\n\
                 [joint.on{number}]\ntype = \"{kind}\"\na = \"arm.end\"\nb = \"weight{number}\"\nat = [1, 0, 0]\n",
                0.01 * f64::from(number)
            );
        }
        let Built { system, state } = built(&text, &[]);
        let mut kkt = Kkt::for_steps(&system);
        let fronts = |inertia| Fronts::new(kkt::unknowns(&system, inertia), &kkt.blocks);
        // A body, its rigidity, the joint to the tip, the tip, and what is left for whole lanes.
        for inertia in [true, false] {
            let longest = fronts(inertia).unwrap().longest;
            assert!(longest <= 12 + 6 + 6 + 7 + 7, "{longest}");
        }
        assert_own_solution(&mut random, &system, &state, &mut kkt);
    }
}

/// Without masses a machine that can move has no solution, and one whose conditions hold twice has too many: the
/// general solver says which.
#[test]
fn what_is_singular_falls_back() {
    let Built { system, state } = built(include_str!("../../../models/pendulum.toml"), &[]);
    let mut kkt = Kkt::for_steps(&system);
    set_matrix(&mut kkt, &system, &state, 0.0, &vec![0.0; system.constraints()]);
    let mut right: Vec<f64> = (0..system.coordinates() + system.constraints()).map(|k| k as f64).collect();
    // To round-off a solution may be found all the same: it is not the only one.
    assert!(kkt.solve(&system, &mut right, 0.0).and_then(|()| kkt.check_unique(&system, 0.0)).is_err());
    assert!(kkt.fallbacks() > 0);
}

/// A condition more that says what others say already makes any machine singular, to the last bit or to round-off.
/// Pivots are not exchanged across fronts, so that this is hard to see for them: a solver that trusts them accepts
/// machines that are held twice, with reactions of any size. Each machine has random numbers of its own, which do not
/// depend on the other models. Of 9,360 such matrices, one is taken for regular: the null vector that was found leaves
/// 1.1e-15 of its terms, where the limit is 1e-15 (`ROUND_OFF`); the softest cantilever that can still be solved leaves
/// 3.2e-15.
#[test]
fn what_holds_twice_is_never_regular() {
    let (mut asked, mut solved) = (0, 0);
    for (name, Built { system, state }) in machines() {
        let mut random = Random(5);
        let mut kkt = Kkt::for_steps(&system);
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        for number in 0..conditions.min(12) {
            let mut moved = state.clone();
            moved.q.iter_mut().for_each(|value| *value += 0.02 * system.size * random.signed());
            let multipliers: Vec<f64> = (0..conditions).map(|_| 10.0 * random.signed()).collect();
            // At rest and in steps; the mass is in the latter.
            let step = if number % 2 == 0 { 0.0 } else { 10_f64.powf(-3.0 + random.signed()) };
            set_matrix(&mut kkt, &system, &moved, step, &multipliers);
            // A sum of other conditions, whose round-off is that of a machine with joints of many shapes.
            let shares: Vec<f64> =
                (0..conditions).map(|own| if own == number || step > 0.0 { random.signed() } else { 0.0 }).collect();
            let mut blocks = kkt.blocks.clone();
            let below = kkt.blocks.layout().iter().enumerate().filter(|(_, block)| block.row >= coordinates);
            for (place, block) in below {
                let values = kkt.blocks.block(place);
                let sums: Vec<f64> = (0..block.columns)
                    .map(|column| {
                        let own = block.row - coordinates..block.row - coordinates + block.rows;
                        own.clone().zip(&values[column * block.rows..]).map(|(row, value)| shares[row] * value).sum()
                    })
                    .collect();
                let last = coordinates + conditions;
                for (row, column, rows, columns) in
                    [(last, block.column, 1, block.columns), (block.column, last, block.columns, 1)]
                {
                    let pushed = blocks.push(Block { row, column, rows, columns });
                    blocks.block_mut(pushed).copy_from_slice(&sums);
                }
            }
            let own = kkt::unknowns(&system, step > 0.0);
            let unknowns = Unknowns { multipliers: own.multipliers + 1, ..own };
            let mut solver = DirectSolver::new(unknowns, Units::new(1.0, vec![false; unknowns.count()]), &blocks);
            asked += 1;
            if solver.factorize(&blocks).is_ok() {
                solved += 1;
                assert_ne!(solver.regularity(&blocks), Regularity::Regular, "{name}, condition {number}");
            }
        }
    }
    println!("{asked} asked, {solved} factorized");
    assert!(asked > 50 && solved > 20, "{asked} asked, {solved} factorized");
}

/// Blocks that are zero most of the time: a chain whose ends a spring ties together once. It is solved with and without
/// the spring, and the second time to the bits of the first, whatever was solved between.
#[test]
fn occasional_blocks() {
    let count = 40;
    let mut blocks = Blocks::default();
    for place in 0..count - 1 {
        let number = blocks.push(Block { row: place, column: place, rows: 2, columns: 2 });
        blocks.block_mut(number).copy_from_slice(&[2.0, -1.0, -1.0, 1.5]);
    }
    for row in 0..count {
        for column in (0..count).filter(|column| *column != row) {
            blocks.push_occasional(Block { row, column, rows: 1, columns: 1 });
        }
    }
    let unknowns = Unknowns { nodes: count, bodies: 0, multipliers: 0, inertia: true };
    let mut solver = DirectSolver::new(unknowns, Units::new(1.0, vec![false; count]), &blocks);
    let first = count - 1;
    // Row 0, the last column, and the last row, column 0.
    let ties = [first + count - 2, first + (count - 1) * (count - 1)];
    let mut found = Vec::new();
    for tie in [0.0, -0.5, 0.0, -0.5] {
        ties.iter().for_each(|number| blocks.block_mut(*number)[0] = tie);
        assert_eq!(blocks.awake().collect::<Vec<_>>(), if tie == 0.0 { &[][..] } else { &ties[..] });
        assert!(solver.factorize(&blocks).is_ok());
        let expected: Vec<f64> = (0..count).map(|k| (k as f64 * 0.7).sin()).collect();
        let mut vector = vec![0.0; count];
        blocks.multiply_add(&expected, &mut vector);
        assert!(solver.solve(&blocks, &mut vector).is_ok());
        assert!(vector.iter().zip(&expected).all(|(own, expected)| (own - expected).abs() < 1e-12), "{vector:?}");
        found.push(vector.iter().map(|own| own.to_bits()).collect::<Vec<_>>());
    }
    assert_eq!((&found[0], &found[1], solver.fallbacks()), (&found[2], &found[3], 0));
}

/// A chain of masses in closed form: springs of 1 between neighbors and to the ground, the first and last tied together
/// by a condition of its own.
#[test]
fn a_ring_of_blocks() {
    let (count, width) = (9, 2);
    let coordinates = count * width;
    let mut blocks = Blocks::default();
    for place in 0..count {
        let start = place * width;
        let rows = if place + 1 < count { 2 * width } else { width };
        let number = blocks.push(Block { row: start, column: start, rows, columns: rows });
        let values = blocks.block_mut(number);
        for index in 0..rows {
            values[index * rows + index] = if index < width { 4.0 } else { 1.0 };
            if rows > width {
                values[index * rows + (index + width) % rows] = -1.0;
            }
        }
    }
    for (row, column) in
        [(coordinates, 0), (0, coordinates), (coordinates, coordinates - 1), (coordinates - 1, coordinates)]
    {
        let number = blocks.push(Block { row, column, rows: 1, columns: 1 });
        blocks.block_mut(number)[0] = if row.min(column) == 0 { 1.0 } else { -1.0 };
    }
    let unknowns = Unknowns { nodes: coordinates, bodies: 0, multipliers: 1, inertia: false };
    let mut solver = DirectSolver::new(unknowns, Units::new(1.0, vec![false; unknowns.count()]), &blocks);
    assert!(solver.factorize(&blocks).is_ok());
    let expected: Vec<f64> = (0..=coordinates).map(|k| (k as f64 * 0.7).sin()).collect();
    let mut vector = vec![0.0; coordinates + 1];
    blocks.multiply_add(&expected, &mut vector);
    assert!(solver.solve(&blocks, &mut vector).is_ok());
    assert!(vector.iter().zip(&expected).all(|(own, expected)| (own - expected).abs() < 1e-13), "{vector:?}");
    assert_eq!((solver.regularity(&blocks), solver.fallbacks()), (Regularity::Regular, 0));
    // Of nothing at all there is no solution.
    let mut zero = blocks.clone();
    zero.clear();
    let outcome = solver.factorize(&zero).and_then(|()| solver.solve(&zero, &mut vector));
    assert!(outcome.is_err() && solver.fallbacks() == 1);
    // Nor of what is not finite, also where its failure is not heeded.
    zero.block_mut(0)[0] = f64::NAN;
    assert!(solver.factorize(&zero).is_err());
    assert!(solver.solve(&zero, &mut vector).is_err());
}

/// `A` as `blocks` with every block transposed in its place: the pattern is symmetric.
fn transposed(blocks: &Blocks) -> Blocks {
    let mut turned = Blocks::default();
    for (number, block) in blocks.layout().iter().enumerate() {
        let Block { row, column, rows, columns } = *block;
        let own = turned.push(Block { row: column, column: row, rows: columns, columns: rows });
        for i in 0..rows {
            for j in 0..columns {
                turned.block_mut(own)[i * columns + j] = blocks.block(number)[j * rows + i];
            }
        }
    }
    turned
}

/// Solutions with the transposed matrix, on every model: the product of `Aᵀ` with them is the right side, front by
/// front as by the general solver. Follower loads, dampers and gears make the matrices unsymmetric, and where they are
/// not, the multipliers' rows are still exchanged.
#[test]
fn transposed_matrices_are_solved_with() {
    let mut random = Random(11);
    for (name, Built { system, state }) in machines() {
        let mut kkt = Kkt::for_steps(&system);
        let mut moved = state.clone();
        moved.q.iter_mut().for_each(|value| *value += 0.02 * system.size * random.signed());
        let multipliers: Vec<f64> = (0..system.constraints()).map(|_| 10.0 * random.signed()).collect();
        set_matrix(&mut kkt, &system, &moved, 1e-3, &multipliers);
        // Unsymmetric, whatever the model has.
        for number in 0..kkt.blocks.layout().len() {
            kkt.blocks.block_mut(number).iter_mut().for_each(|value| *value *= 1.0 + 0.05 * random.signed());
        }
        let turned = transposed(&kkt.blocks);
        let right: Vec<f64> = (0..system.coordinates() + system.constraints()).map(|_| random.signed()).collect();
        let (mut own, mut expected) = (right.clone(), right);
        let unknowns = kkt::unknowns(&system, true);
        let mut solver = DirectSolver::new(unknowns, kkt::units(&system), &kkt.blocks);
        assert!(solver.factorize(&kkt.blocks).is_ok(), "{name}");
        assert!(solver.solve_transposed(&kkt.blocks, &mut own).is_ok() && solver.fallbacks() == 0, "{name}");
        let mut general = SparseLu::new(&kkt::units(&system), &turned).unwrap();
        assert!(general.factorize(&turned).and_then(|()| general.solve(&mut expected)).is_ok(), "{name}");
        let worst = difference(&own, &expected, |index| general.scale(index));
        // As above.
        assert!(worst < 1e-8, "{name}: {worst:.1e}");
    }
}
