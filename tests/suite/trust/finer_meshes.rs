//! Does a static analysis tell its mesh error? It is compared with runs on meshes four times as fine, where the energy
//! that the mesh leaves out is far too small to tell.

use super::mesh_truth::{fine, true_error};
use crate::curves::{Curves, load};
use crate::paths::Arch;
use crate::planar_rod::Load;
use ancf14::fmi::{Model, Value};
use ancf14::model::run::accuracy::Inexact;
use ancf14::model::simulation::Simulation;

const PRINCETON: &str = include_str!("../../../models/princeton_beam.toml");
const ELASTICA: &str = include_str!("../../../models/elastica.toml");
const ROLL_UP: &str = include_str!("../../../models/roll_up.toml");
const SPRING: &str = include_str!("../../../models/helical_spring.toml");
const WHEEL: &str = include_str!("../../../models/bicycle_wheel.toml");
const RAIL: &str = include_str!("../../../models/hot_rail.toml");
const CANTILEVER: &str = include_str!("../../../models/cantilever.toml");

/// A portal that its weight, a force in its plane and a small one across bend and twist.
const PORTAL: &str = r#"
format = 1
[model]
name = "Portal"
gravity = [0, 0, -9.81]
[material.matter]
young = 1.73e9
poisson = 0.3
density = 7850
[section.bar]
shape = "rectangle"
width = 0.03
height = 0.02
[beam.left]
material = "matter"
section = "bar"
from = [0, 0, 0]
to = [0, 0, 1.88]
elements = 6
[beam.top]
material = "matter"
section = "bar"
from = [0, 0, 1.88]
to = [0.756, 0, 1.88]
elements = 6
[beam.right]
material = "matter"
section = "bar"
from = [0.756, 0, 1.88]
to = [0.756, 0, 0]
elements = 6
[joint.foot]
type = "weld"
a = "ground"
b = "left.start"
[joint.knee]
type = "weld"
a = "left.end"
b = "top.start"
[joint.corner]
type = "weld"
a = "top.end"
b = "right.start"
[joint.heel]
type = "weld"
a = "ground"
b = "right.end"
[load.sway]
at = "top.start"
force = ["28.7*t", "2.87*t", 0]
[output.knee]
at = "top.node[0]"
quantities = ["position", "rotation"]
[simulation]
output_step = 0.1
analysis = "static"
stop = 1
"#;

/// Quantities whose errors are compared here: their scales are their ranges.
const COMPARED: [&str; 5] = ["displacement", "position", "rotation", "twist", "section_moment"];
/// Errors below this share are what Newton leaves in both runs.
const LEAST: f64 = 1e-7;

/// A run to its end, with its rows.
fn concluded(text: &str, overrides: &[(&str, &str)]) -> (Simulation, Curves) {
    let mut simulation = load(text, overrides);
    let rows = Curves::record(&mut simulation);
    simulation.conclude();
    (simulation, rows)
}

fn error<'a>(simulation: &'a Simulation, name: &str) -> &'a Inexact {
    simulation.mesh_errors().iter().find(|own| own.name == name).unwrap_or_else(|| panic!("no error of {name}"))
}

fn warns(simulation: &mut Simulation) -> bool {
    simulation.take_warnings().iter().any(|warning| warning.contains("because of the mesh, as estimated"))
}

/// Loads grow: the largest errors are those of the last equilibrium. All that are not round-off are told within a
/// factor of 2.
#[test]
fn errors_are_told_within_a_factor_of_two() {
    let mut compared = 0;
    for (model, text) in [
        ("princeton beam", PRINCETON),
        ("elastica", ELASTICA),
        ("roll-up", ROLL_UP),
        ("spring", SPRING),
        ("wheel", WHEEL),
        ("rail", RAIL),
        ("portal", PORTAL),
    ] {
        let (simulation, rows) = concluded(text, &[]);
        let fine = fine(text);
        for Inexact { name, error, .. } in simulation.mesh_errors() {
            if !COMPARED.iter().any(|quantity| name.ends_with(quantity)) {
                continue;
            }
            let truth = true_error(&rows, &fine, name);
            println!("{model}: {name} told {error:.2e}, true {truth:.2e}");
            if truth > LEAST {
                assert!((0.5..2.0).contains(&(error / truth)), "{model}: {name} told {error:e}, true {truth:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 12, "{compared} errors compared");
}

/// A rotation that follows from torsion alone is off though little energy is left out; quadratic twist mends it.
#[test]
fn a_coarse_twist_is_told() {
    let (mut simulation, _) = concluded(PORTAL, &[]);
    assert!(warns(&mut simulation));
    let quadratic = [("left.twist", "quadratic"), ("top.twist", "quadratic"), ("right.twist", "quadratic")];
    let (mut simulation, _) = concluded(PORTAL, &quadratic);
    assert!(!warns(&mut simulation));
    assert!(error(&simulation, "knee.rotation").error < 1e-3);
}

/// A load that is gone at the end: the equilibrium of the most energy is looked at too, and that is the one of the same
/// load.
#[test]
fn an_equilibrium_before_the_end_counts() {
    let there_and_back = PORTAL.replace("*t\"", "*sin(pi*t)\"");
    let [(gone, _), (loaded, _)] = [&there_and_back, PORTAL].map(|text| concluded(text, &[]));
    let [gone, loaded] = [gone, loaded].map(|simulation| error(&simulation, "knee.rotation").error);
    assert!((gone / loaded - 1.0).abs() < 1e-6, "{gone} {loaded}");
}

/// A mesh so coarse that the run might warn of all that the energy and the readings tell at its start, under the weight
/// alone. The energy of the load, later, is looked at all the same, and is what they are judged by.
#[test]
fn regression_an_equilibrium_after_a_coarse_one_counts() {
    let text =
        PORTAL.replace("\"rotation\"]", "\"rotation\", \"section_moment\"]").replace("elements = 6", "elements = 2");
    let there_and_back = text.replace("*t\"", "*sin(pi*t)\"");
    let [(gone, told), (loaded, _)] = [&there_and_back, &text].map(|text| {
        let (mut simulation, _) = concluded(text, &[]);
        let told = simulation.take_warnings();
        (simulation, told)
    });
    assert!(matches!(&told[..], [one] if one.starts_with("knee.rotation is off by about 13 %")), "{told:?}");
    let [gone, loaded] = [gone, loaded].map(|simulation| error(&simulation, "knee.rotation").error);
    assert!((gone / loaded - 1.0).abs() < 1e-6, "{gone} {loaded}");
}

/// Numbers that a host sets count as those of the file do.
#[test]
fn numbers_of_a_host_count() {
    let set =
        [("left.elements", Value::Integer(4)), ("bar.width", Value::Real(0.02)), ("matter.young", Value::Real(2e9))];
    let mut simulation = Simulation::load("model.toml", PORTAL, &[]).unwrap();
    for (name, value) in set {
        let place = simulation.variables().iter().position(|variable| variable.name == name).unwrap();
        simulation.set_value(place, value).unwrap();
    }
    simulation.initialize(0.0).unwrap();
    Curves::record(&mut simulation);
    simulation.conclude();
    let (other, _) = concluded(PORTAL, &[("left.elements", "4"), ("bar.width", "0.02"), ("matter.young", "2e9")]);
    assert!(!other.mesh_errors().is_empty());
    assert_eq!(simulation.mesh_errors(), other.mesh_errors());
}

/// A deep arch just below the limit load of its mesh, which is above that of the finer one: there is no equilibrium
/// nearby to compare with, and the user hears of it.
#[test]
fn a_limit_load_that_the_mesh_puts_too_high_is_told() {
    let (_, arch) = Arch::all().into_iter().find(|(_, arch)| arch.load == Load::At(1)).unwrap();
    let text = arch
        .text(16)
        .replace("follow = \"arc_length\"\n", "")
        .replace("stop = 3\nstep = 0.02", "stop = 0.999\nstep = 0.0333");
    let (mut simulation, _) = concluded(&text, &[]);
    let told = simulation.take_warnings();
    assert!(told.iter().any(|warning| warning.contains("the mesh error is not known")), "{told:?}");
    assert!(simulation.mesh_errors().is_empty());
}

/// Where there is no finer mesh to compare with, nothing is told.
#[test]
fn motions_and_other_elements_have_no_estimate() {
    assert_eq!(concluded(CANTILEVER, &[]).0.mesh_errors(), []);
    let mut other = PORTAL.to_owned();
    for beam in ["left", "top", "right"] {
        other = other.replace(&format!("[beam.{beam}]"), &format!("[beam.{beam}]\nelement = \"ancf24\""));
    }
    assert_eq!(concluded(&other, &[]).0.mesh_errors(), []);
}
