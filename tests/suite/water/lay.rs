//! Does `lay` draw lines as they hang? Statics then begin near the equilibrium, also of chains without bending
//! stiffness, and of lines between two ball joints, whose spin nothing holds.

use super::{section, water};
use crate::running::{run, start, try_start, value, vector};

/// The jumper of Lowe and Langley, of 170 m, with `elements` elements, its top at `top`, and the end of its model file.
pub fn jumper(elements: usize, top: &str, waves: &str, simulation: &str) -> String {
    water(9.807, 1000.0, 0.0, &format!("depth = 100\n{waves}"))
        + &section([500e6, 120.8e3], 165.0, 0.396, "drag = [1, 0]\nadded_mass = [1, 0]")
        + &format!(
            "[beam.jumper]\nsection = \"round\"\nfrom = [-100, 0, -55]\nto = [0, 0, -5]\nlay = {{ length = 170 }}\n\
             elements = {elements}\n[frame.vessel]\nposition = {top}\n\
             [joint.bottom]\ntype = \"spherical\"\na = \"ground\"\nb = \"jumper.start\"\n\
             [joint.top]\ntype = \"spherical\"\na = \"vessel\"\nb = \"jumper.end\"\n\
             [output.top]\nat = \"top\"\nquantities = [\"reaction_force\"]\n\
             [output.end]\nat = \"jumper.end\"\nquantities = [\"effective_tension\", \"declination\"]\n{simulation}"
        )
}

/// The equilibrium of the jumper: 80 elements of another code give 11,398.263 N and 45,713.363 N at its top. Between
/// two ball joints nothing holds its spin, which takes no load: the run holds it, and says so.
#[test]
fn statics_of_a_jumper() {
    let text = jumper(10, "[0, 0, -5]", "", "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n");
    let simulation = start(&text);
    let force = vector(&simulation, "top.reaction_force");
    println!("{force}");
    assert!((force.x - 11_398.263).abs() < 5.0 && (force.z - 45_713.363).abs() < 5.0);
    // The section transmits the force, of which its tension is the part along the tangent.
    let (sin, cos) = value(&simulation, "end.declination").sin_cos();
    let tension = force.x * sin + force.z * cos;
    assert!((value(&simulation, "end.effective_tension") - tension).abs() < 1e-9 * tension);
}

/// A chain without bending and torsion stiffness hangs as the elastic catenary, `H` and `V` of the closed form, and
/// swings without a rejected run.
#[test]
fn a_chain_without_bending() {
    let text = "format = 1\n[model]\nname = \"Chain\"\ngravity = [0, 0, -9.81]\n\
                [section.chain]\nshape = \"rigidities\"\nEA = 1e8\nEI_y = 0\nEI_z = 0\nGJ = 0\nline_density = 20\n\
                [beam.chain]\nsection = \"chain\"\nfrom = [0, 0, 0]\nto = [80, 0, 10]\nlay = { length = 100 }\n\
                elements = 16\n\
                [joint.a]\ntype = \"spherical\"\na = \"ground\"\nb = \"chain.start\"\n\
                [joint.b]\ntype = \"spherical\"\na = \"ground\"\nb = \"chain.end\"\n\
                [output.b]\nat = \"b\"\nquantities = [\"reaction_force\"]\n\
                [simulation]\ninitial = \"equilibrium\"\nstop = 2\nstep = 0.05\n";
    let mut simulation = start(text);
    let force = vector(&simulation, "b.reaction_force");
    // √(L² − z²) = 2 a sinh(x/2a): a = 36.38 m, and tanh(m) = z/L. The stretch changes both by 1e-4.
    let (weight, length, distance, rise) = (20.0 * 9.81, 100.0_f64, 80.0, 10.0);
    let ratio = (length * length - rise * rise).sqrt() / distance;
    let u = (0..200).fold(1.0, |u: f64, _| u - (u.sinh() - ratio * u) / (u.cosh() - ratio));
    let a = distance / (2.0 * u);
    let vertical = weight * a * ((rise / length).atanh() + u).sinh();
    println!("{force} {} {vertical}", weight * a);
    assert!((force.x / (weight * a) - 1.0).abs() < 1e-3 && (force.z / vertical - 1.0).abs() < 1e-3);
    run(&mut simulation, 2.0, 2.0, |_| {});
    let after = vector(&simulation, "b.reaction_force");
    assert!((after - force).norm() < 1e-4 * force.norm());
}

/// Impossible lays are told with their numbers.
#[test]
fn impossible_lays() {
    let model = |to: &str, length: f64| {
        format!(
            "format = 1\n[model]\nname = \"Chain\"\ngravity = [0, 0, -9.81]\n[water]\ndensity = 1025\ndepth = 50\n\
             [section.chain]\nshape = \"rigidities\"\nEA = 1e8\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 20\n\
             outer_diameter = 0.1\n\
             [beam.chain]\nsection = \"chain\"\nfrom = [0, 0, -50]\nto = {to}\nlay = {{ length = {length} }}\n\
             [simulation]\nstop = 1\nstep = 0.05\n"
        )
    };
    for (to, length, words) in [
        ("[30, 0, -10]", 50.0, "its ends are 50 m apart"),
        ("[0, 0, -10]", 60.0, "its ends are above each other"),
        ("[30, 0, -60]", 60.0, "below the bottom of the water"),
        ("[30, 0, -10]", 80.0, "it would lie in a heap from 70 m on"),
    ] {
        let message = try_start(&model(to, length)).err().unwrap();
        assert!(message.contains(words), "{message}");
    }
}
