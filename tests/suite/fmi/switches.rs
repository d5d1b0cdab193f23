//! Does a host of an FMU see a switch as an input, and do saved states know whether it is engaged?

use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Call;
use ancf14::fmi::variable::Causality;
use ancf14::model::simulation::Simulation;

const TEXT: &str = r#"format = 1
[model]
name = "Latch"
gravity = [0, 0, -9.81]
[body.bob]
mass = 1
position = [0.5, 0, 0]
inertia = [0.01, 0.02, 0.02]
[joint.latch]
type = "weld"
a = "ground"
b = "bob"
input = true
[output.B]
at = "bob"
quantities = ["velocity"]
[simulation]
stop = 1
step = 1e-3
output_step = 0.1
"#;

/// A latch is opened at 0.2 s: from there on the body falls. A state saved while it was closed keeps it closed until
/// the host opens it again.
#[test]
fn a_latch_is_an_input() {
    let simulation = Simulation::load("latch.toml", TEXT, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut instance = Instance::new(simulation, false);
    let variables = ancf14::fmi::Model::variables(instance.model());
    let reference = |name: &str| variables.iter().position(|own| own.name == name).expect("a variable") as u32;
    let [active, speed] = ["latch.active", "B.velocity[3]"].map(reference);
    let own = &variables[active as usize];
    assert_eq!((own.causality, own.start.number(), own.min, own.max), (Causality::Input, 1.0, Some(0.0), Some(1.0)));
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    let mut value = [7.0];
    for number in 0..2 {
        instance.do_step(0.1 * f64::from(number), 0.1).unwrap();
    }
    let bytes = instance.serialize(Call::SerializeFMUstate, &instance.state().unwrap()).unwrap();
    for _ in 0..2 {
        instance.set_state(&instance.deserialize(&bytes).unwrap()).unwrap();
        instance.do_step(0.2, 0.1).unwrap();
        instance.get_real(&[speed], &mut value).unwrap();
        assert!(value[0].abs() < 1e-12, "held: {value:?}");
        instance.set_real(&[active], &[0.0]).unwrap();
        instance.do_step(0.3, 0.1).unwrap();
        instance.get_real(&[speed], &mut value).unwrap();
        assert!((value[0] + 0.981).abs() < 1e-9, "falling: {value:?}");
        instance.set_real(&[active], &[0.4]).unwrap();
        instance.do_step(0.4, 0.1).unwrap();
        instance.set_real(&[active], &[1.0]).unwrap();
        instance.do_step(0.5, 0.1).unwrap();
        instance.get_real(&[speed], &mut value).unwrap();
        assert!(value[0].abs() < 1e-9, "caught: {value:?}");
    }
    assert!(instance.set_real(&[active], &[2.0]).is_err(), "beyond its range");
}
