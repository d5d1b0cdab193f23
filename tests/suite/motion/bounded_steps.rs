//! Steps with a bound on their work, for real time.

use crate::curves::{Curves, load};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

const PENDULUM: &str = include_str!("../../../models/pendulum.toml");
const BUCKLING: &str = include_str!("../../../models/lateral_buckling.toml");

fn bounded(text: &str, most: usize) -> String {
    let end = text.trim_end();
    assert!(end.lines().rev().find(|line| line.starts_with('[')) == Some("[simulation]"));
    format!("{end}\ntotals = [\"energy\", \"statistics\"]\niterations = {most}\n")
}

fn curves(text: &str) -> (Curves, Vec<String>) {
    let mut simulation = load(text, &[]);
    let curves = Curves::record(&mut simulation);
    simulation.conclude();
    (curves, simulation.take_warnings())
}

/// With one iteration a step, steps take one each. A pendulum moves as it does with as many as it needs, to less than
/// the error of its steps.
#[test]
fn steps_take_no_more_iterations_than_allowed() {
    let (free, _) = curves(&bounded(PENDULUM, 15));
    let (one, told) = curves(&bounded(PENDULUM, 1));
    assert_eq!(one.last("statistics.iterations"), one.last("statistics.steps"));
    assert_eq!(one.last("statistics.rejected"), 0.0);
    assert!(free.last("statistics.iterations") > 1.1 * free.last("statistics.steps"));
    let [own, other] = [&one, &free].map(|run| run.column("tip.position[3]"));
    let apart = own.iter().zip(&other).fold(0.0, |most: f64, (own, other)| most.max((own - other).abs()));
    println!("{apart:e} m apart; {told:?}");
    // The step itself is off by 1e-4 of the range.
    assert!(apart < 1e-4, "{apart}");
    assert!(told.iter().any(|text| text.contains("simulation.iterations = 1")), "{told:?}");
}

/// A beam that snaps needs more than one iteration a step: the run goes on all the same, and says how much it has left.
/// As many as it needs are not told.
#[test]
fn what_is_cut_off_is_told() {
    let told = |most: usize| {
        let (curves, told) = curves(&bounded(BUCKLING, most));
        let of_bound = told.into_iter().find(|text| text.contains("simulation.iterations"));
        (curves.last("statistics.iterations") / curves.last("statistics.steps"), of_bound)
    };
    let ((few, cut), (many, none)) = (told(1), told(15));
    println!("{few} and {many} iterations a step; {cut:?}");
    assert!(few == 1.0 && many > 1.2 && cut.is_some_and(|text| text.contains("simulation.iterations = 1 ")));
    assert!(none.is_none(), "{none:?}");
}

/// Rolled back, such steps go on with the same bits.
#[test]
fn bounded_steps_are_taken_back_to_the_bit() {
    let mut simulation = load(&bounded(PENDULUM, 1), &[]);
    let bits = |simulation: &Simulation| -> Vec<u64> {
        (0..simulation.variables().len()).map(|reference| simulation.value(reference).number().to_bits()).collect()
    };
    simulation.advance(0.5).unwrap_or_else(|failure| panic!("{}", failure.message));
    let snapshot = simulation.snapshot();
    let mut ahead = || {
        simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let found = bits(&simulation);
        simulation.restore(&snapshot);
        found
    };
    assert_eq!(ahead(), ahead());
}

/// The bound belongs to steps of a given length.
#[test]
fn steps_of_their_own_choice_have_no_bound() {
    let chosen = bounded(PENDULUM, 2).replace("step = 2e-3\n", "").replace("output_\n", "output_step = 1e-2\n");
    for (text, reason) in [
        (chosen, "the solver chooses those of this motion"),
        (bounded(PENDULUM, 16), "at most 15"),
        (bounded(PENDULUM, 2).replace("step = 2e-3", "step = 2e-3\nintegrator = \"generalized_alpha\""), "conserving"),
    ] {
        let Err(failure) = Simulation::load("model.toml", &text, &[]) else { panic!("{reason}: it is taken") };
        assert!(failure.message.contains(reason), "{}", failure.message);
    }
}
