//! modelDescription/ holds the XML of every model in models/: a change of names, units or flags shows in review.
//! `ANCF14_BLESS=1 cargo test` writes the files anew.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_pack::description;
use ancf14_testing::{golden, root};

#[test]
fn descriptions_are_current() {
    let mut count = 0;
    for entry in std::fs::read_dir(root().join("models")).unwrap() {
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
