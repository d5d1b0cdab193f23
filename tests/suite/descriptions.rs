//! modelDescription/ holds the XML of every model in models/: a change of names, units or flags shows in review.
//! `ANCF14_BLESS=1 cargo test` writes the files anew.

use crate::golden;
use ancf14::fmi::{Model, description};
use ancf14::model::simulation::Simulation;

#[test]
fn descriptions_are_current() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/models");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let simulation =
            Simulation::load("model.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let xml = description::xml(simulation.about(), simulation.variables()).unwrap();
        golden::assert_current(&format!("modelDescription/{stem}.xml"), &xml);
        count += 1;
    }
    assert!(count >= 3);
}

/// A list of variables in a host shows descriptions beside names, or instead: each says whose number it is.
#[test]
fn regression_descriptions_are_unique() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/models");
    let models = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let models = models.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let texts = models.map(|path| std::fs::read_to_string(path).unwrap());
    for text in
        texts.chain([include_str!("../everything.toml"), include_str!("fmi/both_elements.toml")].map(String::from))
    {
        let simulation =
            Simulation::load("model.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
        let mut first = std::collections::BTreeMap::new();
        for variable in simulation.variables() {
            if let Some(other) = first.insert(&variable.description, &variable.name) {
                panic!("{other} and {} are both described as: {}", variable.name, variable.description);
            }
        }
    }
}
