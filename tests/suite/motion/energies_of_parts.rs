//! Is the energy of the mechanism the sum of the energies of its parts? Every joule of the totals belongs to one beam,
//! body, spring, stop or joint. A part that is left out, counted twice, or measured from another origin opens the sum.
//!
//! Tolerance: the sums have the same terms in another order, at most some hundred, of which each rounds by 1e-16; 1e-12
//! of the sum of their sizes is far above that, and far below the smallest part.

use crate::running::{run, start, value};
use ancf14::model::simulation::Simulation;

/// A mast on a bushing carries an arm on a sprung hinge, with a bob on a rope, a spring with a law and a stop, all in
/// motion; drawn at `x`.
fn mechanism(x: f64) -> String {
    format!(
        r#"format = 1
model.name = "Parts"
model.gravity = [0.3, -0.2, -9.81]
[material.plastic]
young = 2e9
poisson = 0.4
density = 1200
[section.bar]
shape = "rectangle"
width = 0.02
height = 0.01
[beam.mast]
material = "plastic"
section = "bar"
from = [{x}, 0, 0]
to = [{x}, 0, 0.5]
elements = 3
[beam.arm]
material = "plastic"
section = "bar"
from = [{x}, 0, 0.5]
to = ["{x} + 0.4", 0, 0.5]
elements = 2
[body.bob]
mass = 0.2
position = ["{x} + 0.45", 0, 0.5]
inertia = [4e-4, 5e-4, 6e-4]
angular_velocity = [0, 0, 5]
[point.nail]
offset = ["{x} + 0.4", 0, 0.9]
[joint.foot]
type = "bushing"
a = "ground"
b = "mast.start"
stiffness = [2e3, 2e3, 2e3]
rotational_stiffness = [20, 20, 20]
[joint.hinge]
type = "revolute"
a = "mast.end"
b = "arm.start"
axis = [0, 1, 0]
stiffness = 3
[joint.wrist]
type = "revolute"
a = "arm.end"
b = "bob"
at = ["{x} + 0.4", 0, 0.5]
axis = [0, 0, 1]
[spring.law]
joint = "wrist"
coordinate = "angle"
force = "0.5*x + x^3"
[stop.end]
joint = "wrist"
coordinate = "angle"
upper = 0.1
stiffness = 5
[spring.rope]
a = "nail"
b = "bob"
stiffness = 100
only = "tension"
[output.of_mast]
of = "mast"
quantities = ["kinetic_energy", "elastic_energy", "gravity_energy"]
[output.of_arm]
of = "arm"
quantities = ["kinetic_energy", "elastic_energy", "gravity_energy"]
[output.of_bob]
of = "bob"
quantities = ["kinetic_energy", "gravity_energy"]
[output.of_foot]
at = "foot"
quantities = ["energy"]
[output.of_hinge]
at = "hinge"
quantities = ["energy"]
[output.of_wrist]
at = "wrist"
quantities = ["energy"]
[output.of_law]
at = "law"
quantities = ["energy"]
[output.of_stop]
at = "end"
quantities = ["energy"]
[output.of_rope]
at = "rope"
quantities = ["energy"]
[simulation]
stop = 0.4
step = 2e-3
"#
    )
}

/// Kinetic, elastic and gravity energy, each as the total and the parts.
const SUMS: [(&str, &[&str]); 3] = [
    ("energy.kinetic", &["of_mast.kinetic_energy", "of_arm.kinetic_energy", "of_bob.kinetic_energy"]),
    (
        "energy.elastic",
        &[
            "of_mast.elastic_energy",
            "of_arm.elastic_energy",
            "of_foot.energy",
            "of_hinge.energy",
            "of_law.energy",
            "of_stop.energy",
            "of_rope.energy",
        ],
    ),
    ("energy.gravity", &["of_mast.gravity_energy", "of_arm.gravity_energy", "of_bob.gravity_energy"]),
];

/// The largest gap of a sum, of the size of its parts; and the largest size of each part.
fn gaps(simulation: &mut Simulation) -> (f64, Vec<f64>) {
    let (mut worst, mut largest) = (0.0_f64, vec![0.0_f64; SUMS.iter().map(|(_, parts)| parts.len()).sum()]);
    run(simulation, 0.01, 0.4, |simulation| {
        assert_eq!(value(simulation, "of_wrist.energy"), 0.0, "the law and the stop have their own energies");
        let mut place = 0;
        for (total, parts) in SUMS {
            let energies: Vec<f64> = parts.iter().map(|name| value(simulation, name)).collect();
            let size: f64 = energies.iter().map(|energy| energy.abs()).sum();
            worst = worst.max((value(simulation, total) - energies.iter().sum::<f64>()).abs() / size);
            for energy in energies {
                largest[place] = largest[place].max(energy.abs());
                place += 1;
            }
        }
    });
    (worst, largest)
}

/// At the origin, and far from it, where positions are counted from the middle of the mechanism.
#[test]
fn energies_of_parts_add_up() {
    for x in [0.0, 5e4] {
        let (worst, largest) = gaps(&mut start(&mechanism(x)));
        println!("drawn at {x} m: the sums are open by {worst:.1e}; largest energies {largest:?} J");
        assert!(worst < 1e-12, "drawn at {x} m: {worst:e}");
        // Each part counts.
        assert!(largest.iter().all(|energy| *energy > 1e-6), "{largest:?}");
    }
}

/// The example of docs/language/outputs.md: the absorber takes most of the energy of the kick, and its rail stores a
/// part of it; the three parts are all that there is.
#[test]
fn the_example_of_the_page_adds_up() {
    let page = include_str!("../../../docs/language/outputs.md");
    let text = page.split("```toml\n").find(|text| text.contains("name = \"BoomWithAbsorber\"")).expect("the example");
    let mut simulation = start(text.split("```").next().expect("its end"));
    let mut largest = [0.0_f64; 3];
    run(&mut simulation, 0.01, 1.0, |simulation| {
        let energy = |name: &str| value(simulation, name);
        let [boom, absorber] = ["of_boom.kinetic_energy", "of_absorber.kinetic_energy"].map(energy);
        let [strain, rail] = ["of_boom.elastic_energy", "of_rail.energy"].map(energy);
        for (total, parts) in [("energy.kinetic", boom + absorber), ("energy.elastic", strain + rail)] {
            assert!((energy(total) - parts).abs() <= 1e-12 * parts, "{total}: {parts}");
        }
        [boom, absorber, rail].into_iter().zip(&mut largest).for_each(|(own, largest)| *largest = largest.max(own));
    });
    assert!(largest.iter().all(|energy| *energy > 1e-3), "{largest:?}");
}
