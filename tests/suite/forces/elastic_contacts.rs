//! Stops, ropes and bumpers take and give energy as springs do: a step takes the mean of their force over the way,
//! which works exactly as much as their energy changes. Numerical dissipation holds energy of the rate over the last
//! step, in proportion to the stiffness. It must not act where the stiffness depends on the elongation: a block left an
//! elastic stop at 1.048 of the speed at which it came, and between two stops 0.5 J became 28 kJ within 20 s.

use ancf14_testing::curves::Curves;

/// A block of 1 kg on a rail, which comes at 1 m/s, with `parts` in its way.
fn block(parts: &str, stop: f64) -> String {
    format!(
        "format = 1\n[model]\nname = \"Block\"\ngravity = [0, 0, 0]\n\
         [body.block]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"block\"\naxis = [1, 0, 0]\n{parts}\
         [output.seen]\nat = \"rail\"\nquantities = [\"distance\", \"distance_rate\"]\n\
         [simulation]\nstop = {stop}\ntotals = [\"energy\"]\n"
    )
}

const BUFFER: &str = "[stop.buffer]\njoint = \"rail\"\ncoordinate = \"distance\"\nupper = 0.2\nstiffness = 1e6\n";
const BUFFERS: &str =
    "[stop.buffer]\njoint = \"rail\"\ncoordinate = \"distance\"\nlower = -0.2\nupper = 0.2\nstiffness = 1e6\n";
const ROPES: &str = "[frame.hook]\nposition = [-1, 0, 0]\n\
     [spring.rope]\na = \"hook\"\nb = \"block\"\nstiffness = 1e5\nlength = 1.1\nonly = \"tension\"\n\
     [spring.bumper]\na = \"hook\"\nb = \"block\"\nstiffness = 1e5\nlength = 0.9\nonly = \"compression\"\n";

const LAWS: &str = "[spring.wall]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"1e6*max(x - 0.2, 0)\"\n\
     [spring.other]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"if(x < -0.2, 1e6*(x + 0.2), 0)\"\n";
/// A spring that stiffens everywhere.
const CUBIC: &str = "[spring.cubic]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"100*x + 1e5*x^3\"\n";

/// The block leaves the stop as fast as it came, with steps that the solver chooses and with steps of the length of the
/// whole contact. Round-off of 500 steps.
#[test]
fn a_block_leaves_an_elastic_stop_as_fast_as_it_came() {
    for overrides in [&[][..], &[("simulation.step", "1e-3")], &[("simulation.step", "5e-3")]] {
        let run = Curves::run(&block(BUFFER, 1.0), overrides);
        let speed = run.last("seen.distance_rate");
        assert!((speed + 1.0).abs() < 1e-9, "{overrides:?}: {speed} m/s");
    }
}

/// Between two stops, between a rope and a bumper, between walls that expressions give, and on a spring that stiffens,
/// the energy stays. Newton may leave 1e-5 of the first correction of a step, which a force of 1e3 N turns into energy:
/// corrections of steps of the solver's own choice are 1e-6 m, which is 1e-8 J in each of some hundred contacts; those
/// of steps of 5 ms are 5e-3 m, which is 5e-5 J in each of fifty.
#[test]
fn energy_stays_between_contacts() {
    for parts in [BUFFERS, ROPES, LAWS, CUBIC] {
        for (overrides, tolerance) in [(&[][..], 1e-6), (&[("simulation.step", "5e-3")], 2.5e-3)] {
            let run = Curves::run(&block(parts, 20.0), overrides);
            for (time, energy) in run.time.iter().zip(run.column("energy.total")) {
                assert!((energy - 0.5).abs() < tolerance, "{overrides:?}, {time} s: {energy} J");
            }
        }
    }
}

const EFFORTS: &str = "[actuator.walls]\njoint = \"rail\"\ncoordinate = \"distance\"\n\
     effort = \"-1e6*max(rail.distance - 0.2, 0) + 1e6*max(-0.2 - rail.distance, 0)\"\n";

/// Walls that are written as the effort of an actuator are walls too: between them the block keeps its energy, with the
/// tolerances of above. The effort in the middle of each step turned 0.5 J into 2 MJ within 20 s.
#[test]
fn walls_that_are_efforts_give_back_what_they_take() {
    for (overrides, tolerance) in [(&[][..], 1e-6), (&[("simulation.step", "5e-3")], 2.5e-3)] {
        let run = Curves::run(&block(EFFORTS, 20.0), overrides);
        let (mut turns, mut last) = (0, 1.0);
        let rows = run.time.iter().zip(run.column("seen.distance")).zip(run.column("seen.distance_rate"));
        for ((time, distance), rate) in rows {
            turns += i32::from(rate * last < 0.0);
            last = rate;
            if distance.abs() < 0.2 {
                let energy = 0.5 * rate * rate;
                assert!((energy - 0.5).abs() < tolerance, "{overrides:?}, {time} s: {energy} J");
            }
        }
        assert!(turns > 40, "{overrides:?}: the block comes to a wall every 0.4 s, and turned {turns} times");
    }
}
