//! Does `ancf14 view` put two runs into one page, wherever they come from: model files, pages, folders of results? A
//! wrong code would lose a run, mix their names or data, or overwrite a page that it reads.
//! viewer/test/browser/comparison.mjs looks at the page in a browser.

use ancf14_testing::root;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(directory).args(arguments).output().unwrap()
}

fn succeeds(directory: &Path, arguments: &[&str]) -> String {
    let output = ancf14(directory, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A folder with two short models: arm.toml, and soft.toml with half the stiffness, which ends later.
fn models() -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    let source = std::fs::read_to_string(root().join("models/cantilever.toml")).unwrap();
    let changed = |old: &str, new: &str, text: &str| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    };
    let arm = changed("stop = 1.0", "stop = 0.05", &source);
    let soft = changed("stop = 0.05", "stop = 0.1", &changed("young = 2.1e11", "young = 1.05e11", &arm));
    for (name, text) in [("arm.toml", arm), ("soft.toml", soft)] {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    directory
}

/// The content of a script of a page.
fn script(page: &str, id: &str) -> Option<Value> {
    let (_, rest) = page.split_once(&format!("<script type=\"application/json\" id=\"{id}\">"))?;
    Some(serde_json::from_str(rest.split_once("</script>")?.0).unwrap())
}

/// Two models: the first one is the run of the page, the second one stands beside it with the names of both; settings
/// change both.
#[test]
fn two_models_share_a_page() {
    let directory = models();
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    let setting = ["--set", "arm.elements=2"];
    let told = succeeds(directory.path(), &[&["view", "arm.toml", "soft.toml"], &setting[..]].concat());
    assert!(told.starts_with("11 instants, ") && told.contains("open arm-and-soft.html in a browser"), "{told}");
    let page = read("arm-and-soft.html");
    for name in ["arm", "soft"] {
        succeeds(directory.path(), &[&["view", &format!("{name}.toml")], &setting[..]].concat());
    }
    assert_eq!(script(&page, "data"), script(&read("arm.html"), "data"));
    let second = script(&page, "second").unwrap();
    assert_eq!(second["names"], json!(["arm.toml, arm.elements = 2", "soft.toml, arm.elements = 2"]));
    assert_eq!(Some(&second["data"]), script(&read("soft.html"), "data").as_ref());
    assert_eq!(second["data"]["instants"], 21);
    assert_eq!(script(&read("arm.html"), "second"), None, "a page of one run has a second one");
}

/// Pages and folders of results give the same page as the models that they were made of, but for names; a page can be
/// written anew.
#[test]
fn finished_runs_are_shown() {
    let directory = models();
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    succeeds(directory.path(), &["view", "arm.toml"]);
    succeeds(directory.path(), &["run", "soft.toml", "--view", "-o", "out"]);
    succeeds(directory.path(), &["view", "arm.html", "out"]);
    let page = read("arm-and-out.html");
    let second = script(&page, "second").unwrap();
    assert_eq!(second["names"], json!(["arm.html", "out"]));
    assert_eq!(script(&page, "data"), script(&read("arm.html"), "data"));
    assert_eq!(Some(&second["data"]), script(&read("out/view.html"), "data").as_ref());
    succeeds(directory.path(), &["view", "arm.html", "-o", "again.html"]);
    assert!(read("again.html") == read("arm.html"), "the same run makes another page");
    succeeds(directory.path(), &["view", "out"]);
    assert!(read("out.html") == read("out/view.html"), "the same run makes another page");
    // Of a page with two runs the first one is taken.
    succeeds(directory.path(), &["view", "arm-and-out.html", "-o", "first.html"]);
    assert!(read("first.html") == read("arm.html"), "the first run is another one");
}

/// A second run that fails is shown as far as it came, and the command fails.
#[test]
fn a_second_run_may_fail() {
    let directory = models();
    let ring = root().join("models/ring.toml");
    std::fs::write(directory.path().join("ring.toml"), std::fs::read(&ring).unwrap()).unwrap();
    let settings = ["--set", "rod.element=ancf24"];
    let output = ancf14(directory.path(), &[&["view", "ring.toml", "-o", "first.html"], &settings[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    succeeds(directory.path(), &["view", "arm.toml"]);
    let output =
        ancf14(directory.path(), &[&["view", "arm.html", "ring.toml", "-o", "both.html"], &settings[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    let second = script(&std::fs::read_to_string(directory.path().join("both.html")).unwrap(), "second").unwrap();
    assert!(
        second["data"]["notes"][0].as_str().unwrap().starts_with("The run ended early, at t = "),
        "{}",
        second["data"]["notes"]
    );
    // If both fail, both reasons are told.
    std::fs::copy(directory.path().join("ring.toml"), directory.path().join("wheel.toml")).unwrap();
    let words = [&["view", "ring.toml", "wheel.toml", "-o", "both.html"], &settings[..]].concat();
    let told = String::from_utf8(ancf14(directory.path(), &words).stderr).unwrap();
    assert_eq!(told.matches("error: ").count(), 2, "{told}");
}

/// Wrong files and options are refused with a remedy, and nothing is written.
#[test]
fn mistakes_are_told() {
    let directory = models();
    succeeds(directory.path(), &["view", "arm.toml"]);
    std::fs::create_dir(directory.path().join("empty")).unwrap();
    std::fs::write(directory.path().join("other.html"), "<!DOCTYPE html><title>other</title>").unwrap();
    let cases: [(&[&str], &str); 9] = [
        (&["arm.toml", "empty"], "ancf14 run --view writes it into a folder of results"),
        (&["other.html"], "error: other.html is not a page with a run that ancf14 "),
        (&["arm.toml", "other.html"], "write it anew with ancf14 view"),
        (&["arm.toml", "nowhere.toml"], "error: cannot read nowhere.toml: "),
        (
            &["arm.html", "-o", "x.html", "--set", "arm.elements=2"],
            "--set changes a model file, and arm.html has results",
        ),
        (&["arm.html", "soft.toml", "--modes"], "--modes needs a model file, and arm.html has results"),
        (&["arm.html", "soft.toml", "--live"], "give the model file first"),
        (
            &["soft.toml", "arm.html", "-o", "arm.html"],
            "error: arm.html is a page that is to be shown; choose another name",
        ),
        (&["arm.toml", "soft.toml", "--watch"], "cannot be used with"),
    ];
    for (arguments, reason) in cases {
        let output = ancf14(directory.path(), &[&["view"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(told.contains(reason), "{arguments:?}: {told}");
    }
    let mut names: Vec<String> = std::fs::read_dir(directory.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["arm.html", "arm.toml", "empty", "other.html", "soft.toml"]);
}
