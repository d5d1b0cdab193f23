//! Does the estimate of the time-step error see the water? Drag acts at the mean of a step, and added mass resists there.

use super::{section, water};
use crate::trust::time_error::{difference, estimate, rows};

/// A rod that sinks broadside, `v_n tanh(t/τ)`: half of its inertia is water, and drag stops it. What the estimate
/// leaves out is of the order of the step over the time constant, 0.06 to 0.3 of it.
#[test]
fn of_a_sinking_rod() {
    for (step, left_out) in [("0.1", 0.3), ("0.05", 0.2), ("0.02", 0.15)] {
        let keys = "drag = [1.2, 0]\nadded_mass = [1, 0]";
        let text = water(9.81, 1025.0, 1000.0, "")
            + &section([1e8, 1e8], 30.0, 0.1, keys)
            + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 2\n\
               [output.P]\nat = \"rod@0.5\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 1\n"
            + &format!("step = {step}\noutput_step = 0.1\n");
        let (found, simulation) = rows(&text, "P.velocity[3]", 0.1, 1.0);
        let exact: Vec<f64> =
            (1..=10).map(|row| -1.871_160_030 * (0.1 * f64::from(row) / 0.330_652_944).tanh()).collect();
        let (truth, told) = (difference(&found, &exact), estimate(&simulation, "P.velocity"));
        println!("{step} s: told {told:.2e}, true {truth:.2e}");
        assert!((told / truth - 1.0).abs() < left_out, "{step}: {told} instead of {truth}");
    }
}

/// A pinned rod with added mass across it and drag swings down in a current, as it does with an eighth of the step; the
/// tolerance is that of the next order.
#[test]
fn of_a_swinging_rod() {
    let text = |step: f64| {
        water(9.81, 1025.0, 1000.0, "current = [0.5, 0, 0]")
            + &section([1e6, 1e5], 30.0, 0.1, "drag = [1.2, 0]\nadded_mass = [1, 0]\ndamping = 0.01")
            + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 2\n\
               [joint.a]\ntype = \"revolute\"\na = \"ground\"\nb = \"rod.start\"\naxis = [0, 1, 0]\n\
               [output.P]\nat = \"rod.end\"\nquantities = [\"position\"]\n[simulation]\nstop = 2\n"
            + &format!("step = {step}\noutput_step = 0.1\n")
    };
    let (found, simulation) = rows(&text(0.05), "P.position[1]", 0.1, 2.0);
    let (exact, _) = rows(&text(0.05 / 8.0), "P.position[1]", 0.1, 2.0);
    let (truth, told) = (difference(&found, &exact), estimate(&simulation, "P.position"));
    println!("told {told:.2e}, true {truth:.2e}");
    assert!((told / truth - 1.0).abs() < 0.3, "{told} instead of {truth}");
}
