//! The sentences that describe variables, in the models of models/ and in one that has every key.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// A list of variables in a host shows descriptions beside names, or instead: each says whose number it is.
#[test]
fn regression_descriptions_are_unique() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/models");
    let models = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let models = models.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let texts = models.map(|path| std::fs::read_to_string(path).unwrap());
    for text in texts
        .chain([include_str!("../../everything.toml"), include_str!("../fmi/both_elements.toml")].map(String::from))
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
