//! Does the description of a linear system offer Model Exchange, with states, their derivatives and what these follow
//! from? A mechanism must not: no host can integrate it.

use ancf14::fmi::{About, Model};
use ancf14::linear::{Amplitude, File, Matrix, Signal, Unit};
use ancf14_pack::{description, description_fmi3};
use ancf14_testing::toy;

/// `x' = v`, `v' = −4 x + u` with the output `x`, of nominal value 0.5.
fn oscillator() -> Unit {
    unit(None)
}

fn unit(amplitude: Option<Amplitude>) -> Unit {
    let column = |values: &[f64]| Matrix { rows: values.len(), columns: 1, values: values.to_vec() };
    let signal = |name: &str| Signal { name: name.to_owned(), unit: "m".to_owned(), ..Signal::default() };
    let file = File {
        amplitude,
        about: About {
            name: "Oscillator".to_owned(),
            identifier: "oscillator".to_owned(),
            stop: 1.0,
            output_step: 0.01,
            tolerance: 1e-6,
            ..About::default()
        },
        inputs: vec![signal("push.force")],
        outputs: vec![Signal { nominal: Some(0.5), ..signal("tip.position") }],
        states: vec!["x, m".to_owned(), "x.rate, m/s".to_owned()],
        a: Matrix { rows: 2, columns: 2, values: vec![0.0, -4.0, 1.0, 0.0] },
        b: column(&[0.0, 1.0]),
        c: Matrix { rows: 1, columns: 2, values: vec![1.0, 0.0] },
        d: column(&[0.0]),
    };
    Unit::load("linear.toml", &file.text()).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// Lines in their order, without what is between them.
fn has_in_order(xml: &str, lines: &[&str]) {
    let mut rest = xml;
    for line in lines {
        let at = rest.find(line).unwrap_or_else(|| panic!("{line} is missing, or not in its order, in\n{xml}"));
        rest = &rest[at + line.len()..];
    }
}

/// The share of nonlinearity is an output of both standards that follows from the states.
#[test]
fn the_share_of_nonlinearity_is_an_output() {
    let one = Matrix { rows: 1, columns: 1, values: vec![1.0] };
    let row = |values: [f64; 2]| Matrix { rows: 1, columns: 2, values: values.to_vec() };
    let (linear, even, odd) = (one.clone(), one.clone(), one);
    let unit = unit(Some(Amplitude { real: row([1.0, 0.0]), imaginary: row([0.0, 0.5]), linear, even, odd }));
    let xml = description::xml(unit.about(), unit.variables()).unwrap();
    has_in_order(
        &xml,
        &[
            r#"name="amplitude_error" valueReference="2" description="Estimated share of nonlinearity in the outputs"#,
            r#"causality="output" variability="continuous" initial="calculated">"#,
            r#"name="state[1]" valueReference="3""#,
            "<Outputs>",
            r#"<Unknown index="3" dependencies="4 5"/>"#,
            "<InitialUnknowns>",
            r#"<Unknown index="3" dependencies="4 5"/>"#,
        ],
    );
    let xml = description_fmi3::xml(unit.about(), unit.variables()).unwrap();
    has_in_order(
        &xml,
        &[
            r#"name="amplitude_error" valueReference="2""#,
            r#"<Output valueReference="2" dependencies="3"/>"#,
            r#"<InitialUnknown valueReference="2" dependencies="3"/>"#,
        ],
    );
}

#[test]
fn fmi_2_lists_states_by_index() {
    let unit = oscillator();
    let xml = description::xml(unit.about(), unit.variables()).unwrap();
    has_in_order(
        &xml,
        &[
            r#"numberOfEventIndicators="0""#,
            r#"<ModelExchange modelIdentifier="oscillator""#,
            r#"<CoSimulation modelIdentifier="oscillator""#,
            r#"name="state[1]" valueReference="2" description="State 1 of the linear system, x, m" causality="local" variability="continuous" initial="exact">"#,
            r#"<Real nominal="0.5" start="0.0"/>"#,
            r#"name="state_rate[2]" valueReference="5" description="Derivative of state 2 by time" causality="local" variability="continuous" initial="calculated">"#,
            r#"<Real derivative="4"/>"#,
            "<Outputs>",
            r#"<Unknown index="2" dependencies="3"/>"#,
            "<Derivatives>",
            r#"<Unknown index="5" dependencies="4"/>"#,
            r#"<Unknown index="6" dependencies="1 3"/>"#,
            "<InitialUnknowns>",
            r#"<Unknown index="2" dependencies="3"/>"#,
            r#"<Unknown index="5" dependencies="4"/>"#,
            r#"<Unknown index="6" dependencies="1 3"/>"#,
        ],
    );
}

#[test]
fn fmi_3_lists_arrays_of_states() {
    let unit = oscillator();
    let xml = description_fmi3::xml(unit.about(), unit.variables()).unwrap();
    has_in_order(
        &xml,
        &[
            r#"<ModelExchange modelIdentifier="oscillator""#,
            r#"<CoSimulation modelIdentifier="oscillator""#,
            r#"<Float64 name="state" valueReference="2""#,
            r#"initial="exact""#,
            r#"start="0.0 0.0""#,
            r#"<Dimension start="2"/>"#,
            r#"<Float64 name="state_rate" valueReference="4""#,
            r#"derivative="2""#,
            r#"<Output valueReference="1" dependencies="2"/>"#,
            r#"<ContinuousStateDerivative valueReference="4" dependencies="0 2"/>"#,
            r#"<InitialUnknown valueReference="1" dependencies="2"/>"#,
            r#"<InitialUnknown valueReference="4" dependencies="0 2"/>"#,
        ],
    );
}

#[test]
fn models_without_states_are_for_co_simulation() {
    let toy = toy::toy();
    for xml in [description::xml, description_fmi3::xml].map(|xml| xml(toy.about(), toy.variables()).unwrap()) {
        assert!(!xml.contains("ModelExchange") && !xml.contains("Derivatives>") && !xml.contains("Model Exchange"));
    }
}
