//! Does a template run as it is, under its own name? A file that is there is kept.

use crate::command_line::{ancf14, text};
use crate::printed;
use std::fs;

/// Every template: written, named after the file, without mistakes, notes or paths of this repository, and its run has
/// no warning.
#[test]
fn templates_run_as_they_are() {
    let directory = tempfile::tempdir().unwrap();
    let listed = printed(&ancf14(directory.path(), &["new", "--list"]));
    let names: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() == 9 && names.contains(&"cable"), "{listed}");
    for template in names {
        let name = format!("my_{template}");
        let said = printed(&ancf14(directory.path(), &["new", &name, "--template", template]));
        assert!(said.contains(&format!("ancf14 view {name}.toml")), "{said}");
        let file = fs::read_to_string(directory.path().join(format!("{name}.toml"))).unwrap();
        let title = format!("name = \"My{}{}\"", template[..1].to_uppercase(), &template[1..]);
        assert!(file.contains(&title) && !file.contains("models/") && !file.contains("tests/"), "{file}");
        assert!(file.starts_with("# "), "{file}");
        let checked = ancf14(directory.path(), &["check", &format!("{name}.toml")]);
        assert!(checked.status.success() && checked.stderr.is_empty(), "{template}: {}", text(&checked.stderr));
        // Nor does the run warn, of its steps or its mesh.
        let ran = ancf14(directory.path(), &["run", &format!("{name}.toml")]);
        assert!(ran.status.success() && ran.stderr.is_empty(), "{template}: {}", text(&ran.stderr));
    }
}

#[test]
fn files_are_kept_and_names_are_checked() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("here.toml"), "mine").unwrap();
    for (arguments, words) in [
        (&["new", "here"][..], "here.toml exists"),
        (&["new", "here.toml"], "here.toml exists"),
        (&["new", "there", "-t", "ship"], "the templates are beam, pendulum"),
        (&["new", "17"], "no name for a model"),
        (&["new"], "required"),
    ] {
        let ran = ancf14(directory.path(), arguments);
        assert!(
            ran.status.code() == Some(2) && text(&ran.stderr).contains(words),
            "{arguments:?}: {}",
            text(&ran.stderr)
        );
    }
    assert_eq!(fs::read_to_string(directory.path().join("here.toml")).unwrap(), "mine");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}
