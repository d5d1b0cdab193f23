//! A unit tells its host the mesh error of a motion where the model file asks for it: a coarse mesh is warned of at the
//! end, a fine one is not, and no result changes. A host that goes back to a saved state, or sets a parameter on the
//! way, learns that the error is not known.

use super::motion_meshes::SHAFT;
use ancf14::fmi::Model;
use ancf14::fmi::instance::Instance;
use ancf14::model::simulation::Simulation;

/// What a unit with a coarse mesh tells.
const COARSE: &str = "because of the mesh, as estimated from a run with twice the elements";
/// What one tells whose comparison run has ended.
const LOST: &str = "the mesh error is not known: the comparison run ended at t = ";
/// Communication steps, and the length of each, s.
const STEPS: u32 = 50;
const STEP: f64 = 2e-4;

/// The shaft with so many elements, an even number, as a unit that is initialized.
fn unit(elements: u32, asks: bool) -> Instance<Simulation> {
    let text = SHAFT
        .replace("elements = 10", &format!("elements = {elements}"))
        .replace("node[5]", &format!("node[{}]", elements / 2))
        .replace("[simulation]", &format!("[simulation]\nmesh_error = {asks}"));
    let mut model = Simulation::load("model.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    model.heed_mesh_error();
    let mut unit = Instance::new(model, false);
    unit.setup_experiment(None, 0.0, None).unwrap();
    unit.enter_initialization_mode().unwrap();
    unit.exit_initialization_mode().unwrap();
    unit
}

/// Steps from number `first` to `last`; returns all values of the rows as bits.
fn run(unit: &mut Instance<Simulation>, [first, last]: [u32; 2]) -> Vec<u64> {
    let mut bits = Vec::new();
    for number in first..last {
        unit.do_step(f64::from(number) * STEP, STEP).unwrap();
        let model = unit.model();
        bits.extend((0..model.variables().len()).map(|place| model.value(place).number().to_bits()));
    }
    bits
}

/// The messages of a run that is terminated here.
fn told(unit: &mut Instance<Simulation>) -> Vec<String> {
    unit.terminate().unwrap();
    unit.take_entries().into_iter().map(|entry| entry.message).collect()
}

#[test]
fn a_coarse_mesh_is_told_of_and_results_stay() {
    let runs = [false, true].map(|asks| {
        let mut unit = unit(2, asks);
        (run(&mut unit, [0, STEPS]), told(&mut unit))
    });
    let [(alone, silent), (compared, told)] = runs;
    assert!(alone == compared, "the comparison run changes results");
    assert!(told.iter().any(|message| message.contains(COARSE)), "{told:?}");
    assert!(!silent.iter().any(|message| message.contains("mesh")), "{silent:?}");
}

#[test]
fn a_fine_mesh_is_not_told_of() {
    let mut unit = unit(20, true);
    run(&mut unit, [0, STEPS]);
    let told = told(&mut unit);
    assert!(!told.iter().any(|message| message.contains("mesh")), "{told:?}");
    assert!(!unit.model().mesh_errors().is_empty(), "it compares");
}

/// After a reset the comparison begins anew.
#[test]
fn what_ends_the_comparison_is_told() {
    let mut unit = unit(2, true);
    run(&mut unit, [0, 10]);
    let state = unit.state().unwrap();
    run(&mut unit, [10, 12]);
    unit.set_state(&state).unwrap();
    run(&mut unit, [10, STEPS]);
    let messages = told(&mut unit);
    assert_eq!(messages.iter().filter(|message| message.starts_with(LOST)).count(), 1, "{messages:?}");
    assert!(messages.iter().any(|message| message.ends_with("since a saved state was restored")), "{messages:?}");

    unit.reset().unwrap();
    unit.setup_experiment(None, 0.0, None).unwrap();
    unit.enter_initialization_mode().unwrap();
    unit.exit_initialization_mode().unwrap();
    run(&mut unit, [0, STEPS]);
    let messages = told(&mut unit);
    assert!(messages.iter().any(|message| message.contains(COARSE)), "{messages:?}");

    let mut model = unit.model().variables().iter();
    let push = model.position(|variable| variable.name == "push").unwrap();
    unit.reset().unwrap();
    unit.setup_experiment(None, 0.0, None).unwrap();
    unit.enter_initialization_mode().unwrap();
    unit.exit_initialization_mode().unwrap();
    run(&mut unit, [0, 10]);
    unit.set_real(&[push as u32], &[1.0]).unwrap();
    run(&mut unit, [10, STEPS]);
    let messages = told(&mut unit);
    assert!(messages.iter().any(|message| message.ends_with("since a parameter was set")), "{messages:?}");
}
