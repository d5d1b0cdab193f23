//! Do waves push as Morison's law and Airy's theory say? Totals on a fixed pile have closed forms.

use super::{section, water};
use crate::running::{run, start, value};

/// Force along x and moment about y at the bed on a fixed pile of 1 m in 20 m of water, in a wave of 2 m and 10 s: as
/// the crest passes, and a quarter of a period later.
fn pile(keys: &str) -> [[f64; 2]; 2] {
    let text = water(9.81, 1025.0, 0.0, "depth = 20\nstretching = \"none\"\nramp = 5")
        + "[wave.swell]\ntype = \"airy\"\nheight = 2\nperiod = 10\n"
        + &section([1e12, 1e11], 1000.0, 1.0, &format!("{keys}\ndamping = 0.002"))
        + "[beam.pile]\nsection = \"round\"\nfrom = [0, 0, -20]\nto = [0, 0, 0]\nelements = 12\n\
           [joint.bed]\ntype = \"weld\"\na = \"ground\"\nb = \"pile.start\"\n\
           [output.bed]\nat = \"bed\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
           [simulation]\ninitial = \"equilibrium\"\nstop = 12.5\nstep = 0.0125\n";
    let mut simulation = start(&text);
    let loads =
        |simulation: &_| ["bed.reaction_force[1]", "bed.reaction_moment[2]"].map(|name| value(simulation, name).abs());
    let mut found = [[0.0; 2]; 2];
    run(&mut simulation, 2.5, 12.5, |simulation| found = [found[1], loads(simulation)]);
    found
}

/// The inertia of the wave is largest where its surface is at still water: 12,264.743 N, and 132,564.01 N m about the
/// bed. It has the force of Froude and Krylov and that of the added mass; the pile is so stiff that its own
/// motion is a millionth of it.
#[test]
fn inertia_of_a_pile() {
    let [crest, later] = pile("added_mass = [1, 0]");
    println!("{later:?}");
    assert!(crest[0].abs() < 1e-4 * later[0]);
    assert!((later[0] / 12_264.743 - 1.0).abs() < 2e-4 && (later[1] / 132_564.01 - 1.0).abs() < 2e-4);
}

/// The drag of the wave is largest as its crest passes: 3,846.082 N up to still water.
#[test]
fn drag_of_a_pile() {
    let [crest, _] = pile("drag = [1, 0]");
    println!("{crest:?}");
    assert!((crest[0] / 3_846.082 - 1.0).abs() < 2e-4);
}

/// Waves are what their formulas say, behind their ramp, along their direction and at Wheeler's height.
#[test]
fn elevation_and_ramp() {
    let text = water(9.81, 1025.0, 0.0, "ramp = 5")
        + "[wave.swell]\ntype = \"airy\"\nheight = 2\nperiod = 10\ndirection = \"pi/2\"\nphase = 0.5\n"
        + &section([1e12, 1e12], 10.0, 0.2, "")
        + "[beam.rod]\nsection = \"round\"\nfrom = [0, 3, -10]\nto = [0, 3, -5]\nelements = 2\n\
           [joint.a]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
           [output.rod]\nat = \"rod.end\"\nquantities = [\"elevation\", \"fluid_velocity\", \"submergence\"]\n\
           [simulation]\nstop = 8\nstep = 0.1\n";
    let mut simulation = start(&text);
    run(&mut simulation, 0.5, 8.0, |simulation| {
        let time = ancf14::fmi::Model::time(simulation);
        let s = (time / 5.0).min(1.0);
        let share = s * s * s * (6.0 * s * s - 15.0 * s + 10.0);
        let w = std::f64::consts::TAU / 10.0;
        let k = w * w / 9.81;
        let angle = k * 3.0 - w * time + 0.5;
        let elevation = share * angle.cos();
        assert!((value(simulation, "rod.elevation") - elevation).abs() < 1e-6);
        // Wheeler's place is below the surface as far as this one is.
        let speed = share * w * (k * (-5.0 - elevation)).exp();
        let own = [0.0, speed * angle.cos(), speed * angle.sin()];
        for (axis, own) in own.into_iter().enumerate() {
            let found = value(simulation, &format!("rod.fluid_velocity[{}]", axis + 1));
            assert!((found - own).abs() < 1e-3, "{found} and {own} at {time}");
        }
        assert!((value(simulation, "rod.submergence") - 5.0 - elevation).abs() < 1e-3);
    });
}

/// A sea is the same for the same seed, and has the wanted height: four times the standard deviation, which half an
/// hour of one sea has to 10 %.
#[test]
fn a_sea_has_its_height() {
    let text = water(9.81, 1025.0, 0.0, "")
        + "[wave.sea]\ntype = \"jonswap\"\nsignificant_height = 3\npeak_period = 8\nseed = 7\ncomponents = 100\n"
        + &section([1e8, 1e6], 10.0, 0.2, "")
        + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, -50]\nto = [0, 0, -45]\nelements = 1\n\
           [joint.a]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
           [output.rod]\nat = \"rod.end\"\nquantities = [\"elevation\"]\n\
           [simulation]\nanalysis = \"static\"\nstop = 1800\nstep = 1\n";
    let heights = || {
        let (mut simulation, mut list) = (start(&text), Vec::new());
        run(&mut simulation, 1.0, 1800.0, |simulation| list.push(value(simulation, "rod.elevation")));
        list
    };
    let first = heights();
    let variance = first.iter().map(|own| own * own).sum::<f64>() / first.len() as f64;
    println!("significant height {}", 4.0 * variance.sqrt());
    assert!((4.0 * variance.sqrt() / 3.0 - 1.0).abs() < 0.1);
    assert_eq!(first, heights());
}
