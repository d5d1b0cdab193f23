//! A path of equilibria that is followed by its arc length: past limit points, through branch points and over to the
//! path that crosses, against closed forms and a rod that is integrated here.

use crate::paths::{Arch, Case, Twisted, follow, number_behind};
use crate::planar_rod::Load;
use crate::running::{start, try_start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use std::f64::consts::{PI, TAU};

const RIGHT_ANGLE: &str = include_str!("../../machines/right_angle_frame.toml");

/// Two bars that stand as a roof: `P = EA z (h² − z²)/l³` with the height `z` of the ridge, largest at `z = h/√3`.
fn roof(step: &str) -> String {
    let bar = |name: &str, x: f64| {
        format!(
            "[beam.{name}]\nmaterial = \"metal\"\nsection = \"bar\"\nfrom = [{x}, 0, 0]\nto = [0, 0, 0.2]\nelements = 2\n\
             [joint.{name}_foot]\ntype = \"revolute\"\naxis = [0, 1, 0]\na = \"ground\"\nb = \"{name}.start\"\n"
        )
    };
    format!(
        "format = 1\n[model]\nname = \"Roof\"\ngravity = [0, 0, 0]\n[material.metal]\nyoung = 1e9\npoisson = 0.3\ndensity = 1000\n\
         [section.bar]\nshape = \"rectangle\"\nwidth = 0.2\nheight = 0.2\n{}{}\
         [joint.ridge]\ntype = \"revolute\"\naxis = [0, 1, 0]\na = \"left.end\"\nb = \"right.end\"\n\
         [load.snow]\nat = \"left.end\"\nforce = [0, 0, \"-{ROOF_LOAD}*t\"]\n\
         [output.ridge_point]\nat = \"left.end\"\nquantities = [\"displacement\"]\n\
         [simulation]\nanalysis = \"static\"\nfollow = \"arc_length\"\nstop = 3\nstep = {step}\n",
        bar("left", -1.0),
        bar("right", 1.0)
    )
}

const ROOF_LOAD: f64 = 2e5;

/// The load on the roof at the height `z` of the ridge, over [`ROOF_LOAD`].
fn roof_load(z: f64) -> f64 {
    4e7 * z * (0.04 - z * z) / (1.04_f64).powf(1.5) / ROOF_LOAD
}

/// The whole path is that of the closed form, through both limit points, which are found to 1e-9 whatever the steps.
/// The bars stay straight: two elements are exact, what Newton leaves is round-off.
#[test]
fn a_roof_is_followed_through_both_limit_points() {
    for (step, every) in [("0.1", 0.1), ("0.03", 0.03)] {
        let mut simulation = start(&roof(step));
        let names = ["ridge_point.displacement[3]", "path.parameter", "path.unstable_motions"];
        let (rows, told) = follow(&mut simulation, every, 3.0, &names);
        let limit = roof_load(0.2 / 3_f64.sqrt());
        let found = [number_behind(&told, "t has a maximum of "), number_behind(&told, "t has a minimum of ")];
        assert!(
            (found[0] - limit).abs() < 1e-9 * limit && (found[1] + limit).abs() < 1e-9 * limit,
            "{found:?} {limit}"
        );
        let mut turned = 0;
        for row in &rows {
            let wanted = roof_load(0.2 + row[0]);
            assert!((row[1] - wanted).abs() < 1e-9, "{row:?} {wanted}");
            let is_between = (0.2 + row[0]).abs() < 0.2 / 3_f64.sqrt();
            assert_eq!(row[2] > 0.5, is_between, "{row:?}");
            turned += usize::from(is_between);
        }
        assert!(turned > 3 && rows.last().is_some_and(|row| 0.2 + row[0] < -0.2), "{turned} {rows:?}");
    }
}

/// A cantilever under an axial load, `t` in its critical loads.
fn column(more: &str) -> String {
    let load = PI * PI * COLUMN_STIFFNESS / 4.0;
    format!(
        "format = 1\n[model]\nname = \"Column\"\ngravity = [0, 0, 0]\n[material.metal]\nyoung = 2e11\npoisson = 0.3\ndensity = 7800\n\
         [section.strip]\nshape = \"rectangle\"\nwidth = 0.03\nheight = 0.003\n\
         [beam.bar]\nmaterial = \"metal\"\nsection = \"strip\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 16\n\
         [joint.clamp]\ntype = \"weld\"\na = \"ground\"\nb = \"bar.start\"\n\
         [load.weight]\nat = \"bar.end\"\nforce = [\"-{load}*t\", 0, 0]\n\
         [output.tip]\nat = \"bar.end\"\nquantities = [\"displacement\"]\n\
         [simulation]\nanalysis = \"static\"\nfollow = \"arc_length\"\nstop = 2.4\nstep = 0.05\n{more}\n"
    )
}

/// `E I` of the column, N m².
const COLUMN_STIFFNESS: f64 = 2e11 * 0.03 * 27e-9 / 12.0;

/// The complete elliptic integrals `K` and `E` of modulus `k`, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut c, mut sum, mut power) = (1.0, (1.0 - k * k).sqrt(), k, 0.5 * k * k, 0.5);
    while c > 1e-16 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
    }
    let first = 0.5 * PI / a;
    (first, first * (1.0 - sum))
}

/// The column branches at Euler's load, and the path that is gone over to is the elastica: `P/P_E = (2K/π)²`, tip at
/// `2E/K − 1` and `2k/K`. Compression changes loads by the strain at the critical load, 7.4e-6, and 16 elements change
/// the critical load by less; where the tip hangs below the clamp a bend of 2.4 rad leaves 1e-4 of the length.
#[test]
fn a_column_goes_over_to_the_elastica_both_ways() {
    let names = ["path.parameter", "tip.displacement[1]", "tip.displacement[3]", "path.unstable_motions"];
    let mut sideways = [0.0; 2];
    for (branch, end) in [1, -1].into_iter().zip(&mut sideways) {
        let mut simulation = start(&column(&format!("branches = [{branch}]")));
        let (rows, told) = follow(&mut simulation, 0.05, 2.4, &names);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!((number_behind(&told, "t = ") - 1.0).abs() < 3e-5, "{told:?}");
        let bent = rows.iter().filter(|row| row[2].abs() > 0.01);
        let mut count = 0;
        for row in bent {
            count += 1;
            // `P/P_E` grows with the modulus.
            let (mut low, mut high) = (0.0, 1.0 - 1e-12);
            while high - low > 1e-15 {
                let k = 0.5 * (low + high);
                if (2.0 / PI * elliptic(k).0).powi(2) < row[0] { low = k } else { high = k }
            }
            let (first, second) = elliptic(low);
            let wanted = [2.0 * second / first - 2.0, 2.0 * low / first];
            // Just behind the branch point the deflection goes with the root of the load above the critical one, which
            // errs by 1e-5.
            let allowed = 2e-4 + 1e-5 / row[2].abs();
            let off = f64::max((row[1] - wanted[0]).abs(), (row[2].abs() - wanted[1]).abs());
            assert!(off < allowed, "{row:?} {wanted:?}");
            assert!(row[3] == 0.0, "{row:?}");
        }
        assert!(count > 20, "{count}");
        *end = rows.last().unwrap()[2];
    }
    assert!(sideways[0] > 0.5 && (sideways[0] + sideways[1]).abs() < 1e-9, "{sideways:?}");
}

/// Without `branches` the run stays on the straight path, tells each critical load `(2n − 1)²` and counts the motions
/// that release energy.
#[test]
fn a_column_that_stays_straight_tells_what_it_passes() {
    let text = column("").replace("stop = 2.4", "stop = 10").replace("step = 0.05", "step = 0.4");
    let names = ["path.parameter", "tip.displacement[3]", "path.unstable_motions"];
    let (rows, told) = follow(&mut start(&text), 0.4, 10.0, &names);
    // The second load has 9 times the compression of the first, and the error of its shorter waves.
    assert!((number_behind(&told, "branch point 1 at the arc length ") - 1.0).abs() < 3e-5, "{told:?}");
    assert!((number_behind(&told, "branch point 2 at the arc length ") - 9.0).abs() < 9.0 * 3e-4, "{told:?}");
    for row in rows {
        let wanted = f64::from(u8::from(row[0] > 1.001)) + f64::from(u8::from(row[0] > 9.01));
        assert_eq!((row[1], row[2]), (0.0, wanted), "{row:?}");
    }
}

/// Lee's frame under a load that keeps its direction and under one that turns with the girder: every row is near the
/// path of the same frame as two extensible rods, which are integrated, by displacements over the side and the load
/// over the critical one. Twice as many elements are 8 times nearer at least (order 3.5 or more).
#[test]
fn lees_frame_is_followed_whole() {
    for follower in [false, true] {
        let worst = [10, 20].map(|elements| {
            let case = Case::lee(elements, follower);
            let (points, told) = case.equilibria();
            let worst = case.rod.distance_from(&points);
            let limit = number_behind(&told, "t has a maximum of ") * case.load * 1.44 / case.rod.bending;
            println!("follower {follower}, {elements} elements a leg: limit {limit:.4}, off by {worst:.2e}");
            assert_eq!(told.iter().filter(|sentence| sentence.contains("limit point")).count(), 2, "{told:?}");
            worst
        });
        assert!(worst[0] < 2e-4 && worst[1] < worst[0] / 8.0, "follower {follower}: {worst:?}");
    }
}

/// Arches under loads at the crown and along them, dead and follower: every row is near the path of the same arch as an
/// extensible rod, which is integrated. The deep arch bears `8.97 E I/R²` at its crown (DaDeppo and Schmidt 1975).
#[test]
fn arches_are_followed_whole() {
    for (name, arch) in Arch::all() {
        let worst = [16, 32].map(|elements| {
            let case = Case::arch(&arch, elements);
            let (points, told) = case.equilibria();
            let worst = case.rod.distance_from(&points);
            println!("{name}, {elements} elements: off by {worst:.2e}");
            if arch.load == Load::At(1) && elements == 32 {
                let limit = arch.size * number_behind(&told, "t has a maximum of ");
                // Three digits are known.
                assert!((limit - 8.97).abs() < 0.005 + 1e-3 * 8.97, "{limit}");
            }
            worst
        });
        assert!(worst[1] < 1e-3 && worst[1] < worst[0] / 8.0, "{name}: {worst:?}");
    }
}

/// A hinged half circle under a pressure that follows it sways at `3 E I/R³` (Timoshenko and Gere), of 32 elements
/// within 1e-4; its compression changes that by the strain, 3e-6.
#[test]
fn a_half_circle_sways_under_pressure() {
    let (_, told) = Case::half_circle(32).equilibria();
    let load = number_behind(&told, ", t = ");
    println!("branch point at {load} of the load");
    assert!((load - 1.0).abs() < 1e-4, "{told:?}");
}

/// A straight rod and a ring, twisted past their critical twists, over to the buckled paths: both leave at the torques
/// of Greenhill, `8.98682 E I/L`, and Michell, `√3 E I/R`, and every buckled row is near the path of an integrated rod,
/// displacements over the length and turns over a whole one.
#[test]
fn twisted_rods_are_followed_past_their_critical_twist() {
    for (is_ring, critical, meshes) in
        [(false, 8.98682 / 0.75, [16, 32]), (true, TAU * 3.0_f64.sqrt() / 0.75, [24, 48])]
    {
        let worst = meshes.map(|elements| {
            let case = Twisted::new(elements, is_ring);
            let (points, told) = case.equilibria();
            let leaves = 10.0 * number_behind(&told, ", t = ");
            assert!((leaves / critical - 1.0).abs() < 1e-3, "{leaves} {critical}");
            // Nearest to the branch point the way is along the buckled shape, and the plane across it holds the
            // straight rod too.
            let buckled: Vec<_> = points.into_iter().skip_while(|point| point.middle.norm() < 0.02).collect();
            let worst = case.rod.distance_from(&buckled);
            println!(
                "ring {is_ring}, {elements} elements: leaves at {:.2e}, off by {worst:.2e} in {} rows",
                leaves / critical - 1.0,
                buckled.len()
            );
            worst
        });
        assert!(worst[1] < 1e-3 && worst[1] < worst[0] / 8.0, "{worst:?}");
    }
}

/// The right-angle frame comes back flat after its ends have turned once around, under the opposite of the moment at
/// which it left, 1e-5 of it; the mesh is its own mirror image, and the path crosses others without leaving.
#[test]
fn a_right_angle_frame_comes_back_flat() {
    let names = ["path.parameter", "tip.displacement[3]", "hinge.angle"];
    let (rows, told) = follow(&mut start(RIGHT_ANGLE), 0.05, 13.95, &names);
    let left = number_behind(&told, ", t = ");
    // The last limit point is where the buckled path meets the flat one.
    let back = told.iter().rev().find(|sentence| sentence.contains("limit point")).cloned();
    let back = number_behind(back.as_slice(), "t has a maximum of ");
    let last = rows.last().unwrap();
    assert!(left > 0.6 && (back + left).abs() < 1e-5 * left, "{left} {back}");
    assert!(last[1].abs() < 0.02 && (last[2] - 2.0 * PI).abs() < 0.02, "{last:?}");
    let highest = rows.iter().map(|row| row[0]).fold(0.0, f64::max);
    let lowest = rows.iter().map(|row| row[0]).fold(0.0, f64::min);
    assert!(highest > 2.3 && lowest < -2.3, "{highest} {lowest}");
}

/// A state that is saved on the way, also as bytes that another instance reads, goes on to the same bits, past a limit
/// point and a branch point.
#[test]
fn a_saved_state_goes_on_along_the_same_path() {
    let mut simulation = start(&column("branches = [-1]"));
    simulation.advance(0.9).unwrap();
    let saved = simulation.snapshot();
    let bytes = simulation.write(&saved, Vec::new());
    let go_on = |simulation: &mut Simulation| {
        simulation.advance(1.5).unwrap();
        ["path.parameter", "tip.displacement[3]", "path.unstable_motions"].map(|name| value(simulation, name).to_bits())
    };
    let first = go_on(&mut simulation);
    simulation.restore(&saved);
    assert_eq!(go_on(&mut simulation), first);
    let mut other = start(&column("branches = [-1]"));
    let read = other.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message));
    other.restore(&read);
    assert_eq!(go_on(&mut other), first);
}

/// What changes along a path is its parameter alone: inputs and switches are refused.
#[test]
fn inputs_and_switches_are_refused() {
    let with = |more: &str| try_start(&column("").replace("[output.tip]", &format!("{more}\n[output.tip]")));
    let told = with("[load.hand]\nat = \"bar.end\"\nforce = [0, 0, 0]\ninput = true").unwrap_err();
    assert!(told.contains("a path that is followed by its arc length has no inputs"), "{told}");
    let told =
        with("[joint.stop]\ntype = \"inplane\"\naxis = [0, 0, 1]\na = \"ground\"\nb = \"bar.end\"\nactive = \"t > 1\"")
            .unwrap_err();
    assert!(told.contains("engages and releases nothing"), "{told}");
}
