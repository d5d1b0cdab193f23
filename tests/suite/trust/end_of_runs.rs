//! What is judged by the largest force or energy waits for it: of the little that a mechanism has at its start, nearly
//! all may be wrong, and does not matter once it has more.

use crate::running::{run, start, value};
use ancf14::fmi::Model;

/// What a run with rows each `every` s has told before its end, and at it.
fn told(text: &str, every: f64, stop: f64) -> [Vec<String>; 2] {
    let mut simulation = start(text);
    run(&mut simulation, every, stop, |_| ());
    let before = simulation.take_warnings();
    simulation.conclude();
    [before, simulation.take_warnings()]
}

/// A chain of 850 N/m that lies on springs at its nodes and is then pulled tight. Between two nodes it hangs as a
/// string: it bends by `q/N`, not by the `q l²/12` of a beam without tension. The energy of its bending is some joules
/// of the kilojoules of its stretching.
const CHAIN: &str = r#"
format = 1
[model]
name = "Chain"
gravity = [0, 0, -9.81]
[section.chain]
shape = "rigidities"
EA = 5e8
EI_y = 500
EI_z = 500
GJ = 500
line_density = 86.6
[beam.line]
section = "chain"
from = [0, 0, 0]
to = [50, 0, 0]
elements = 20
[joint.anchor]
type = "universal"
a = "ground"
b = "line.start"
axis = [0, 1, 0]
axis2 = [0, 0, 1]
[frame.winch]
position = ["50 + 0.05*t", 0, 0]
[joint.shackle]
type = "spherical"
a = "winch"
b = "line.end"
[copy.bed]
count = 20
[copy.bed.point.below]
offset = ["2.5*k", 0, -1e4]
[copy.bed.spring.soil]
a = "below"
b = "line.node[k]"
stiffness = 5e4
length = 1e4
only = "compression"
[output.top]
at = "shackle"
quantities = ["reaction_force"]
[simulation]
analysis = "static"
stop = 1
step = 0.05
"#;

#[test]
fn taut_elements_bend_as_strings() {
    let mut simulation = start(CHAIN);
    run(&mut simulation, 0.05, 1.0, |_| ());
    // EA times the strain of 1e-3, and 1 % for the sag between the nodes.
    assert!((value(&simulation, "top.reaction_force[1]") / 5e5 - 1.0).abs() < 0.01);
    simulation.conclude();
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
}

/// A cantilever with a torque of 1 N m along it at its start, which linear twist follows badly, and a force of 1 kN at
/// its end later: the mesh is right to what the force does. Without the force the same mesh is told, at the end.
#[test]
fn a_coarse_mesh_of_a_small_beginning_is_not_told() {
    let rod = |force: &str| {
        format!(
            "format = 1\n[model]\nname = \"Rod\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
             [section.round]\nshape = \"circle\"\nradius = 0.02\n\
             [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
             [load.torque]\non = \"rod\"\nmoment = [1, 0, 0]\n\
             [load.pull]\nat = \"rod.end\"\nforce = [0, 0, \"{force}\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n"
        )
    };
    let of_the_mesh = |force: &str| {
        let [before, after] = told(&rod(force), 0.1, 1.0);
        assert_eq!(before, Vec::<String>::new());
        after.into_iter().filter(|warning| warning.contains("elements miss")).count()
    };
    assert_eq!([of_the_mesh("0"), of_the_mesh("1000*t")], [1, 0]);
}

/// A mass on a mount far too stiff for the steps, on which its weight falls: the force alternates by 10 N. Behind a
/// push of 10 kN, a tenth of a second later, that is nothing.
#[test]
fn what_alternates_at_a_start_is_measured_by_the_whole_run() {
    let mount = |push: &str| {
        format!(
            "format = 1\n[model]\nname = \"Mount\"\ngravity = [0, 0, -9.81]\n\
             [body.mass]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.01, 0.01, 0.01]\n\
             [joint.mount]\ntype = \"bushing\"\na = \"ground\"\nb = \"mass\"\nstiffness = [1e8, 1e8, 1e8]\n\
             rotational_stiffness = [1e4, 1e4, 1e4]\n\
             [load.push]\nat = \"mass\"\nforce = [0, 0, \"{push}\"]\n\
             [output.foot]\nat = \"mount\"\nquantities = [\"reaction_force\"]\n\
             [simulation]\nstop = 1\nstep = 1e-2\nspectral_radius = 1\n"
        )
    };
    let alternates = |push: &str| {
        let [before, after] = told(&mount(push), 1e-2, 1.0);
        before.iter().chain(&after).filter(|warning| warning.contains("alternates from step to step")).count()
    };
    assert_eq!([alternates("0"), alternates("-1e4*smoothstep(0.2, 0.9, t)")], [1, 0]);
}

/// A run that fails tells what has not been judged yet: the mesh may be the cause.
#[test]
fn a_run_that_fails_is_judged_where_it_ends() {
    // Three elements under a uniform load, clamped and pinned, miss 4/(9 n^4) of the energy; the push has no value from
    // 0.5 s on.
    let text = "format = 1\n[model]\nname = \"Rod\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
                [section.round]\nshape = \"circle\"\nradius = 0.005\n\
                [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 3\n\
                [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
                [joint.pin]\ntype = \"spherical\"\na = \"ground\"\nb = \"rod.end\"\n\
                [load.all]\non = \"rod\"\nforce = [0, 0, \"0.1 + 0*sqrt(0.5 - t)\"]\n\
                [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n";
    let mut simulation = start(text);
    run(&mut simulation, 0.1, 0.4, |_| ());
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
    assert!(simulation.advance(0.7).is_err());
    let found = simulation.take_warnings();
    assert!(found.iter().any(|warning| warning.contains("its elements miss about 0.6 %")), "{found:?}");
}
