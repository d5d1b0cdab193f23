//! Is index.html the whole of a run on one page? A missing chart, a dead link, or a failed run that looks complete
//! would mislead whoever opens it.

use super::command_line::{ancf14, model, text};
use std::path::Path;

fn run(directory: &Path, file: &str, more: &[&str]) -> std::process::Output {
    ancf14(directory, &[&["run", file, "-o", "out"], more].concat())
}

fn page(directory: &Path) -> String {
    std::fs::read_to_string(directory.join("out/index.html")).unwrap()
}

/// What stands between `before` and the next quotation mark, everywhere.
fn quoted<'a>(page: &'a str, before: &str) -> Vec<&'a str> {
    page.split(before).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

/// The page has every plot of the folder, in itself; its links lead to files that are there; and it needs nothing from
/// elsewhere.
#[test]
fn the_page_is_whole() {
    let directory = tempfile::tempdir().unwrap();
    let ran = run(directory.path(), &model("ring"), &["--set", "simulation.stop=0.4", "--view"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    assert!(text(&ran.stdout).contains("out/index.html"), "{}", text(&ran.stdout));
    let page = page(directory.path());
    let mut plots: Vec<String> = std::fs::read_dir(directory.path().join("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    plots.retain(|name| name.ends_with(".svg"));
    assert!(plots.len() > 5);
    for plot in &plots {
        let svg = std::fs::read_to_string(directory.path().join("out").join(plot)).unwrap();
        assert!(page.contains(&svg), "{plot} is not in the page");
    }
    let (anchors, files): (Vec<&str>, Vec<&str>) =
        quoted(&page, "href=\"").into_iter().partition(|link| link.starts_with('#'));
    for file in ["results.csv", "summary.json", "view.html"] {
        assert!(files.contains(&file), "{files:?}");
    }
    for file in files {
        assert!(directory.path().join("out").join(file).is_file(), "{file}");
    }
    let names = quoted(&page, "id=\"");
    assert!(
        anchors.len() == plots.len() && anchors.iter().all(|anchor| names.contains(&&anchor[1..])),
        "{anchors:?} {names:?}"
    );
    for loading in ["<script", "<link", "url(", "@import", "src="] {
        assert!(!page.contains(loading), "{loading}");
    }
    // Five views of the mechanism.
    assert_eq!(page.matches("type=\"radio\"").count(), 5);
}

/// Warnings of the run are on the page, and so are the errors that further runs have estimated.
#[test]
fn warnings_and_errors_are_on_the_page() {
    let directory = tempfile::tempdir().unwrap();
    let ran = run(directory.path(), &model("pendulum"), &["--set", "simulation.stop=0.2", "--verify=1e-9"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let page = page(directory.path());
    let warnings: Vec<String> =
        text(&ran.stderr).lines().filter_map(|line| line.strip_prefix("warning: ")).map(str::to_owned).collect();
    assert!(!warnings.is_empty() && warnings.iter().all(|warning| page.contains(warning)), "{warnings:?}");
    assert!(page.contains("href=\"errors.csv\"") && page.contains("Estimated errors"));
    assert!(page.contains("simulation.stop = 0.2"));
    // The next run without them takes them off.
    assert!(run(directory.path(), &model("pendulum"), &["--set", "simulation.stop=0.2"]).status.success());
    assert!(!std::fs::read_to_string(directory.path().join("out/index.html")).unwrap().contains("Estimated errors"));
}

/// The page of a run that ended early says so, why, and links to the rows that there are.
#[test]
fn an_incomplete_run_has_an_incomplete_page() {
    let directory = tempfile::tempdir().unwrap();
    let load = "\n[load.push]\nat = \"arm.end\"\nforce = [0, 0, \"sqrt(0.005 - t)\"]\n";
    let file = std::fs::read_to_string(model("cantilever")).unwrap() + load;
    std::fs::write(directory.path().join("m.toml"), file).unwrap();
    let ran = run(directory.path(), "m.toml", &["--set", "simulation.output_step=1e-3"]);
    assert_eq!(ran.status.code(), Some(1));
    let page = page(directory.path());
    assert!(page.contains("(incomplete)</title>") && page.contains("ended early, at t = 0.005 s"));
    assert!(page.contains("href=\"results.part.csv\"") && !page.contains("href=\"results.csv\""));
    let reason = text(&ran.stderr).lines().next().unwrap().trim_start_matches("error: ").to_owned();
    assert!(page.contains(&reason), "{reason}");
}
