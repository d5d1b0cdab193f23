//! Do the resources of an FMU tell which kind of model it has, and is a wrong file named?

use super::oscillator;
use ancf14::ffi::component::load;
use ancf14::fmi::Model;
use ancf14::linear::Unit;
use ancf14::packed::Packed;
use std::fs;

#[test]
fn the_file_of_a_linear_system_is_found() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("linear.toml");
    let resources = format!("file://{}", directory.path().display());
    let text = oscillator().text();
    let guid = Unit::load("linear.toml", &text).unwrap().about().guid.clone();
    fs::write(directory.path().join("model.toml"), crate::fmi::ffi::MODEL).unwrap();
    let model = load("{0}", &resources).unwrap_err().to_string();
    assert!(model.contains("model.toml"), "{model}");
    fs::write(&path, &text).unwrap();
    assert!(matches!(load(&guid, &resources), Ok(Packed::Linear(_))), "it counts, also beside a model file");
    fs::write(&path, text.replace("0.3", "0.4")).unwrap();
    let changed = load(&guid, &resources).unwrap_err().to_string();
    assert!(changed.contains("linear.toml") && changed.contains("belong to different models"), "{changed}");
    fs::write(&path, "format = 1\na = [").unwrap();
    let damaged = load(&guid, &resources).unwrap_err().to_string();
    assert!(damaged.contains("linear.toml is not the file of a linear system"), "{damaged}");
}
