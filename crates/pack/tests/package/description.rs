//! Does modelDescription.xml say what the instance does? The whole text of the toy is golden; beyond that, rules that
//! no checker looks at.

use ancf14::fmi::{Value, variable::Causality};
use ancf14_pack::{description::xml, error::Error};
use ancf14_testing::{golden, toy};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The XML of the toy, as reviewed.
#[test]
fn golden_description_of_the_toy() {
    let text = xml(&toy::about(), &toy::variables()).unwrap();
    golden::assert_current("tests/golden/toy.xml", &text);
}

/// Indices in an element of ModelStructure.
fn indices(text: &str, element: &str) -> Vec<usize> {
    let (open, close) = (format!("<{element}>"), format!("</{element}>"));
    let inside = text.split(&open).nth(1).and_then(|rest| rest.split(&close).next()).unwrap_or("");
    inside.split("index=\"").skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect()
}

/// Outputs are exactly the outputs, initial unknowns exactly outputs and calculated parameters, in their order.
#[test]
fn model_structure_is_exact() {
    let variables = toy::variables();
    let text = xml(&toy::about(), &variables).unwrap();
    let places = |wanted: &[Causality]| -> Vec<usize> {
        (1..=variables.len()).filter(|index| wanted.contains(&variables[index - 1].causality)).collect()
    };
    assert_eq!(indices(&text, "Outputs"), places(&[Causality::Output]));
    assert_eq!(indices(&text, "InitialUnknowns"), places(&[Causality::Output, Causality::CalculatedParameter]));
    assert_eq!(text.matches("dependencies=\"\"").count(), places(&[Causality::Output]).len());
}

/// Nothing feeds through: no output may name an input it depends on.
#[test]
fn outputs_depend_on_nothing() {
    let text = xml(&toy::about(), &toy::variables()).unwrap();
    let outputs = text.split("<Outputs>").nth(1).unwrap().split("</Outputs>").next().unwrap();
    assert_eq!(outputs.matches("<Unknown ").count(), outputs.matches("dependencies=\"\"").count());
}

/// `initial` and `start` where the standard wants them, and only there.
#[test]
fn start_values_where_they_belong() {
    let text = xml(&toy::about(), &toy::variables()).unwrap();
    for variable in text.split("<ScalarVariable ").skip(1) {
        let variable = variable.split("</ScalarVariable>").next().unwrap();
        let has = |piece: &str| variable.contains(piece);
        assert_eq!(has("start="), has("causality=\"parameter\"") || has("causality=\"input\""), "{variable}");
        assert_eq!(has("initial="), !has("causality=\"input\"") && !has("causality=\"independent\""), "{variable}");
        assert_eq!(has("initial=\"exact\""), has("causality=\"parameter\""), "{variable}");
    }
}

/// Same model, same bytes, and no date in them.
#[test]
fn reproducible() {
    let text = xml(&toy::about(), &toy::variables()).unwrap();
    assert_eq!(text, xml(&toy::about(), &toy::variables()).unwrap());
    assert!(!text.contains("generationDateAndTime"));
}

/// What cannot be described is an error that names the variable.
#[test]
fn wrong_tables_are_refused() {
    let refused = |change: fn(&mut Vec<ancf14::fmi::variable::Variable>)| {
        let mut variables = toy::variables();
        change(&mut variables);
        xml(&toy::about(), &variables).unwrap_err().to_string()
    };
    assert!(refused(|v| v[1].name = "gain".into()).contains("variable gain: value references 0 and 1 share"));
    assert!(refused(|v| v[0].start = Value::Real(11.0)).contains("start value 11 is not between 0 and 10"));
    assert!(refused(|v| v[0].start = Value::Real(f64::NAN)).contains("NaN"));
    assert!(refused(|v| v[0].min = Some(20.0)).contains("smallest value 20 is above its largest value 10"));
    assert!(refused(|v| v[4].display_unit = Some("kN".into())).contains("`kN` does not convert to its unit `m`"));
    assert!(refused(|v| v[5].variability = v[4].variability).contains("Integer cannot be continuous"));
}

/// A model identifier names a C function prefix and a file.
#[test]
fn identifiers_are_c_identifiers() {
    for (identifier, good) in [
        ("Toy", true),
        ("_a1", true),
        ("1a", false),
        ("a-b", false),
        ("a b", false),
        ("", false),
        ("Ü", false),
        ("int", false),
    ] {
        let about = ancf14::fmi::About { identifier: identifier.to_owned(), ..toy::about() };
        let outcome = xml(&about, &toy::variables());
        assert_eq!(outcome.is_ok(), good, "{identifier}");
        assert!(good || outcome == Err(Error::Identifier(identifier.to_owned())));
    }
}

// A fixed seed: the same cases in every run.
proptest! {
    #![proptest_config(ProptestConfig { cases: 256, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    /// Any text in names and descriptions gives XML that a parser reads, and a start value that reads back exactly.
    #[test]
    fn any_text_is_escaped(text in "\\PC{0,20}[\u{0}-\u{1f}<>&\"']{0,3}", start in 0.0..10.0f64) {
        let about = ancf14::fmi::About { name: text.clone(), description: text.clone(), ..toy::about() };
        let mut variables = toy::variables();
        variables[0].description = text;
        variables[0].start = Value::Real(start);
        let xml = xml(&about, &variables).unwrap();
        let mut reader = quick_xml::Reader::from_str(&xml);
        let mut read = None;
        loop {
            match reader.read_event().unwrap() {
                quick_xml::events::Event::Eof => break,
                quick_xml::events::Event::Empty(element) => {
                    let value = element.try_get_attribute("start").unwrap();
                    read = read.or(value.map(|value| value.value.parse::<f64>().unwrap()));
                }
                _ => (),
            }
        }
        prop_assert_eq!(read, Some(start));
        prop_assert!(xml.chars().all(|c| !c.is_control() || c == '\n'));
    }
}
