//! A mesh that is too coarse for what the machine does is told, by an estimate that closed forms check: the strain energy
//! that the elements leave out. An estimate from jumps alone would miss it: under a uniform load nothing jumps at the
//! nodes of a uniform mesh. Meshes that are fine enough are not warned of.

use crate::running::{run, start, value};
use ancf14::fmi::Model;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::simulation::Simulation;

/// A steel rod of 1 m, radius 5 mm, that is clamped at its start, with what `more` says of the beam and beside it.
fn rod(beam: &str, more: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rod\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.round]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\n{beam}\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n{more}\n"
    )
}

const STATIC: &str = "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\ntolerance = 1e-12\n";
/// `EI` and `GJ` of the rod, N m².
const BENDING: f64 = 2.1e11 * std::f64::consts::PI * 0.005 * 0.005 * 0.005 * 0.005 / 4.0;
const TORSION: f64 = BENDING / 1.3;
/// So small that the rod stays straight to 1e-6, N/m and N.
const LOAD: f64 = 1e-3;

/// Strain energy, and the estimate of what the mesh leaves out of it, J.
fn energies(simulation: &Simulation) -> [f64; 2] {
    let mut snapshot = FrameCache::default();
    let c = snapshot.of(simulation.system(), simulation.state());
    let error = simulation.system().mesh_error(&c);
    assert!((error.energy / value(simulation, "energy.elastic") - 1.0).abs() < 1e-9);
    [error.energy, error.left_out]
}

/// Exact energies: `q² L⁵/(40 EI)` under a load across the rod, `m² L³/(6 GJ)` under a torque, both uniform. The
/// estimate is what the run lacks, to the 1e-6 of the largest slope.
#[test]
fn the_energy_left_out_is_what_a_run_lacks() {
    for elements in [2, 3, 6] {
        for (load, exact) in [
            (format!("force = [0, 0, {LOAD}]"), LOAD * LOAD / (40.0 * BENDING)),
            (format!("moment = [{LOAD}, 0, 0]"), LOAD * LOAD / (6.0 * TORSION)),
        ] {
            let text = rod(&format!("elements = {elements}"), &format!("[load.all]\non = \"rod\"\n{load}\n{STATIC}"));
            let [energy, left_out] = energies(&start(&text));
            let lacking = exact - energy;
            assert!((left_out / lacking - 1.0).abs() < 1e-2, "{elements} {load}: {left_out:e} for {lacking:e}");
        }
    }
}

/// Under a uniform load the curvature is off by `q l²/(12 EI)` at all nodes: the moment that is told is not, at the
/// clamp `q L²/2`, nor are the strains.
#[test]
fn moments_and_strains_are_right_where_curvatures_are_off() {
    let outputs = "[output.foot]\nat = \"rod.start\"\nquantities = [\"section_moment\", \"curvature\"]\n\
                   [output.mid]\nat = \"rod@0.5\"\nquantities = [\"section_moment\", \"curvature\"]\n\
                   [output.inside]\nat = \"rod@0.6\"\nquantities = [\"section_moment\", \"curvature\"]\n";
    let load = format!("[load.all]\non = \"rod\"\nforce = [0, 0, {LOAD}]\n");
    let simulation = start(&rod("elements = 4", &format!("{load}{outputs}{STATIC}")));
    for (name, exact) in [("foot", 0.5 * LOAD), ("mid", 0.125 * LOAD), ("inside", 0.08 * LOAD)] {
        let moment = value(&simulation, &format!("{name}.section_moment[2]")).abs();
        let curvature = value(&simulation, &format!("{name}.curvature[1]")).abs();
        // The rod bends by 1e-6.
        assert!((moment / exact - 1.0).abs() < 1e-6, "{name}: {moment} for {exact}");
        assert!((curvature * BENDING / exact - 1.0).abs() < 1e-6, "{name}: {curvature} for {exact}");
    }
}

/// What a run with rows each `every` s is told of its mesh.
fn warnings(text: &str, every: f64, stop: f64) -> Vec<String> {
    let mut simulation = start(text);
    run(&mut simulation, every, stop, |_| ());
    simulation.conclude();
    of_the_mesh(&mut simulation)
}

fn of_the_mesh(simulation: &mut Simulation) -> Vec<String> {
    simulation.take_warnings().into_iter().filter(|warning| warning.contains("the mesh is too coarse")).collect()
}

/// A flat cantilever under forces along both axes of its section: the torque changes along it.
fn strip(beam: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Strip\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.flat]\nshape = \"rectangle\"\nwidth = 0.002\nheight = 0.04\n\
         [beam.arm]\nmaterial = \"steel\"\nsection = \"flat\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\n{beam}\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
         [load.tip]\nat = \"arm.end\"\nforce = [0, \"t\", \"-14*t\"]\n\
         [output.motion]\nat = \"arm.end\"\nquantities = [\"displacement\"]\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n"
    )
}

/// Three elements with linear twist move the tip of the strip by 2 % too little; the remedies of the warning cure it.
#[test]
fn torsion_that_elements_cannot_follow_is_told() {
    let found = warnings(&strip("elements = 3"), 0.1, 1.0);
    let told = [
        "at t = 1 s its elements miss about 1.1 %",
        "torsion of beam arm between 0.00 and 0.33",
        "twist = \"quadratic\"",
    ];
    assert!(matches!(&found[..], [one] if told.iter().all(|words| one.contains(words))), "{found:?}");
    for remedy in ["elements = 10", "elements = 3\ntwist = \"quadratic\""] {
        assert_eq!(warnings(&strip(remedy), 0.1, 1.0), Vec::<String>::new(), "{remedy}");
    }
}

/// A blow shorter than elements resolve makes waves that are shorter than two elements. Thirty times as fine a mesh
/// follows them.
#[test]
fn waves_shorter_than_elements_are_told() {
    let blow = "[load.blow]\nat = \"rod.end\"\nforce = [0, 0, [{ until = 1e-4, is = \"100\" }, { is = \"0\" }]]\n\
                [simulation]\nstop = 0.01\nstep = 2e-5\n";
    let found = warnings(&rod("elements = 4", blow), 1e-4, 0.01);
    assert!(matches!(&found[..], [one] if one.contains("most of it bending of beam rod")), "{found:?}");
    assert_eq!(warnings(&rod("elements = 120", blow), 1e-4, 0.01), Vec::<String>::new());
}

/// A load that is there at once bends the last element first, which leaves out much of the energy there is. It does not
/// stay like that.
#[test]
fn sudden_loads_on_a_good_mesh_are_not_warned_of() {
    for every in [2e-5, 1e-4, 1e-3] {
        let load = "[load.tip]\nat = \"rod.end\"\nforce = [0, 0, 5]\n[simulation]\nstop = 0.05\nstep = 2e-5\n";
        assert_eq!(warnings(&rod("elements = 16", load), every, 0.05), Vec::<String>::new(), "{every}");
    }
}

/// Moments jump where a moment acts, forces where a force does: there neighbors are not compared.
#[test]
fn jumps_that_loads_make_are_not_warned_of() {
    for (at, load) in [("rod@0.5", "moment = [1, 2, 3]"), ("rod@0.25", "force = [0, 10, 5]")] {
        let text = rod("elements = 8", &format!("[load.one]\nat = \"{at}\"\n{load}\n{STATIC}"));
        assert_eq!(warnings(&text, 1.0, 1.0), Vec::<String>::new(), "{load}");
        let [energy, left_out] = energies(&start(&text));
        assert!(left_out < 1e-3 * energy, "{load}: {left_out:e} of {energy:e}");
    }
}

/// Once is enough, at the end, and a host that goes back to before the warning is warned again.
#[test]
fn a_coarse_mesh_is_told_once() {
    let mut simulation = start(&strip("elements = 3"));
    let before = simulation.snapshot();
    run(&mut simulation, 0.1, 1.0, |_| ());
    assert_eq!(of_the_mesh(&mut simulation), Vec::<String>::new());
    simulation.conclude();
    assert_eq!(of_the_mesh(&mut simulation).len(), 1);
    let bytes = simulation.write(&simulation.snapshot(), Vec::new());
    let after = simulation.read(&bytes).unwrap();
    for (snapshot, warnings) in [(before, 1), (after, 0)] {
        simulation.restore(&snapshot);
        let from = simulation.time();
        (1..=5).for_each(|k| simulation.advance(from + 0.2 * f64::from(k)).unwrap());
        simulation.conclude();
        assert_eq!(of_the_mesh(&mut simulation).len(), warnings);
    }
}

/// The rod under a uniform load across it, clamped at one end and pinned at the other: `n` elements miss `4/(9 n⁴)` of
/// its energy, 0.55 % for 3.
#[test]
fn half_a_percent_of_energy_is_told_in_equilibrium() {
    let pin = "[joint.pin]\ntype = \"spherical\"\na = \"ground\"\nb = \"rod.end\"\n";
    let load = "[load.all]\non = \"rod\"\nforce = [0, 0, 0.1]\n";
    let propped = |elements| warnings(&rod(elements, &format!("{pin}{load}{STATIC}")), 1.0, 1.0);
    let found = propped("elements = 3");
    assert!(matches!(&found[..], [one] if one.contains("its elements miss about 0.6 %")), "{found:?}");
    assert_eq!(propped("elements = 4"), Vec::<String>::new());
}
