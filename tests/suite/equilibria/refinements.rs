//! Refinements that end Newton's iteration to an equilibrium (MECHANICS 7.12): they take the place of iterations, and leave as little.

use ancf14_testing::curves::{Curves, largest, load};

/// The run of a model with a tolerance, and the iterations it takes.
fn run(model: &str, tolerance: &str) -> (Curves, u64) {
    let mut simulation = load(model, &[("simulation.tolerance", tolerance)]);
    let curves = Curves::record(&mut simulation);
    (curves, simulation.state().statistics.iterations)
}

/// Models, outputs, the length that they are compared with, m, and the iterations of all loads; without refinements there are 41, 101 and 175.
const MODELS: [(&str, &str, f64, u64); 3] = [
    (include_str!("../../../models/princeton_beam.toml"), "tip.displacement[3]", 0.508, 31),
    (include_str!("../../../models/roll_up.toml"), "tip.position[1]", 1.0, 81),
    (include_str!("../../../models/hot_rail.toml"), "middle.displacement[3]", 1.0, 120),
];

/// Refinements take the place of iterations, and places are those of a tolerance that leaves nothing, to a ten-thousandth of the default one, 1e-8.
#[test]
fn refinements_leave_as_little_as_iterations() {
    for (model, output, length, most) in MODELS {
        let (own, iterations) = run(model, "1e-8");
        let (exact, _) = run(model, "1e-13");
        let differences: Vec<f64> = own.column(output).iter().zip(exact.column(output)).map(|(a, b)| a - b).collect();
        println!("{output}: {:e} m, {iterations} iterations", largest(&differences));
        assert!(largest(&differences) < 1e-12 * length, "{output}: {:e}", largest(&differences));
        assert!(iterations <= most, "{output}: {iterations}");
    }
}

/// A weight hangs from a rod that is 1e10 times as stiff as the weight holds it down, and is pulled aside. Behind a correction the rod is stretched, and as long as its matrix has that
/// tension, corrections are small, whatever they have left.
#[test]
fn stiff_springs_are_iterated_to_the_end() {
    const MODEL: &str = r#"
format = 1
[model]
name = "StiffPendulum"
gravity = [0, 0, 0]
[frame.hook]
position = [0, 0, 0]
[body.slider]
mass = 1
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[body.bob]
mass = 1
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[joint.along]
type = "prismatic"
a = "ground"
b = "slider"
axis = [1, 0, 0]
[joint.up]
type = "prismatic"
a = "slider"
b = "bob"
axis = [0, 0, 1]
[spring.rod]
a = "hook"
b = "bob"
stiffness = 1e11
[load.weight]
at = "bob"
force = ["0.5*t", 0, -10]
[output.seen]
at = "bob"
quantities = ["position"]
[simulation]
analysis = "static"
step = 0.1
output_step = 0.1
stop = 1
"#;
    let (curves, _) = run(MODEL, "1e-8");
    let places = curves.column("seen.position[1]");
    let exact = |row: usize| (0.05 * row as f64).atan2(10.0).sin();
    let errors: Vec<f64> = places.iter().enumerate().map(|(row, place)| place - exact(row)).collect();
    // The rod grows by 1e-10 of its length and moves the weight aside by 1/20 of that; a correction of the tolerance is far more.
    assert!(places.len() == 11 && largest(&errors) < 2e-11, "{} rows, {:e}", places.len(), largest(&errors));
}
