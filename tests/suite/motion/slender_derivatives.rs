//! Are derivatives of a step right for thin strips? Differences along straight lines of coordinates stretch what turns,
//! and the axial force of that hides the bending: with steps of 1e-3 of the size a strip of 0.1 mm was off by 1e-3.

use crate::curves::load;
use ancf14::fmi::{Model, Value};

/// A strip of 1 m whose root is held; `FORCE` N bend its tip by a quarter of its length.
const STRIP: &str = r#"
format = 1
[model]
name = "Strip"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.flat]
shape = "rectangle"
width = "THICK"
height = 0.02
[beam.strip]
material = "steel"
section = "flat"
from = [0, 0, 0]
to = [1, 0, 0]
y_axis = [0, 1, 0]
elements = 16
strain = "small"
[joint.root]
type = "weld"
a = "ground"
b = "strip.start"
[load.pull]
at = "strip.end"
force = [0, FORCE, 0]
input = true
[output.tip]
at = "strip.end"
quantities = ["displacement"]
[simulation]
analysis = "KIND"
stop = 1
step = 0.1
tolerance = 1e-12
"#;

/// The derivatives of the tip by the force over a step, against those of repeated steps, of which each is an
/// equilibrium or a motion to 1e-12. The differences of repeated steps are right to 1e-10 among themselves.
#[test]
fn thin_strips_have_right_derivatives() {
    let section = "width = \"THICK\"";
    for (kind, thickness, width) in [
        ("static", 1e-3, section),
        ("static", 3e-4, section),
        ("static", 1e-4, section),
        ("dynamic", 3e-4, section),
        // A strip that is thin in its middle is as slender as there.
        ("static", 3e-4, "width = \"THICK*(1 + 36*(s - 0.5)^2)\""),
    ] {
        // EI/L² = 0.35 N at 1 mm.
        let force = 0.35 * (thickness / 1e-3_f64).powi(3);
        // The round-off of a strain against bending: EA L²/EI = 12 (L/h)².
        let tolerance = 1e-8 + 2e-16 * 12.0 / (thickness * thickness);
        let text = STRIP.replace(section, width).replace("THICK", &thickness.to_string()).replace("KIND", kind);
        let mut simulation = load(&text.replace("FORCE", &force.to_string()), &[]);
        let place = |name: &str| simulation.variables().iter().position(|own| own.name == name).unwrap();
        let (push, outputs) = (place("pull.force[2]"), [1, 2].map(|axis| place(&format!("tip.displacement[{axis}]"))));
        simulation.initialize(0.0).unwrap();
        simulation.advance(0.1).unwrap();
        let start = simulation.snapshot();
        let mut at = |force: f64| {
            simulation.restore(&start);
            simulation.set_value(push, Value::Real(force)).unwrap();
            simulation.advance(0.2).unwrap();
            outputs.map(|output| simulation.value(output).number())
        };
        let change = 1e-2 * force;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|times| at(force + times * change));
        at(force);
        let found = outputs.map(|output| simulation.partial_derivative(output, push).unwrap());
        let size = (0..2).map(|k| (c[k] - b[k]).abs()).fold(0.0, f64::max) / (2.0 * change);
        for k in 0..2 {
            let expected = (a[k] / 12.0 - b[k] * 2.0 / 3.0 + c[k] * 2.0 / 3.0 - d[k] / 12.0) / change;
            println!("{kind} {thickness}: {:.1e}", (found[k] - expected).abs() / size);
            assert!((found[k] - expected).abs() < tolerance * size, "{kind} {thickness}: {} {expected}", found[k]);
        }
    }
}
