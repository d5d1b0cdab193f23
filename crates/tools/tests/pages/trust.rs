//! Does docs/trust.md have every claim of the README, with commands that exist and figures that its pages show?

use ancf14_testing::root;
use std::fs;
use std::path::Path;

fn page() -> String {
    fs::read_to_string(root().join("docs/trust.md")).unwrap()
}

/// The cells of the rows of all tables, headings left out.
fn rows(page: &str) -> Vec<[String; 3]> {
    let rows = page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| claim"));
    let cells = rows.map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect());
    cells.map(|cells: Vec<String>| cells.try_into().unwrap()).collect()
}

/// The parts of a text between two marks.
fn between<'a>(text: &'a str, mark: &'a str) -> impl Iterator<Item = &'a str> {
    text.split(mark).skip(1).step_by(2)
}

/// The bold words of the section of the README, each a claim.
#[test]
fn every_claim_has_a_row() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let section = readme.split("## What it does").nth(1).unwrap().split("The beam element").next().unwrap();
    let claims: Vec<&str> = between(section, "**").collect();
    assert!(claims.len() > 10, "{claims:?}");
    let page = page();
    for claim in claims {
        assert!(page.contains(&format!("**{claim}**")), "no row of docs/trust.md shows **{claim}**");
    }
}

/// Figures are code on the page, and stand on one of the pages that their cell links.
#[test]
fn figures_are_those_of_their_pages() {
    let mut count = 0;
    for [claim, _, figures] in rows(&page()) {
        let links = figures.split("](").skip(1).map(|rest| rest.split([')', '#']).next().unwrap());
        let pages: Vec<String> =
            links.map(|link| fs::read_to_string(root().join("docs").join(link)).unwrap()).collect();
        for figure in between(&figures, "`") {
            count += 1;
            let number = figure.trim_end_matches(" %");
            let shows = |page: &String| {
                page.split(|own: char| own.is_whitespace() || "|;(:".contains(own))
                    .any(|own| own.trim_end_matches([',', '.', '%']) == number)
            };
            assert!(pages.iter().any(shows), "{claim}: no linked page shows {figure}");
        }
    }
    assert!(count > 20, "{count}");
}

/// Scripts and programs exist, and filters of tests name a folder or a function of tests.
#[test]
fn commands_exist() {
    let mut count = 0;
    for [claim, commands, _] in rows(&page()) {
        for command in between(&commands, "`") {
            count += 1;
            let words: Vec<&str> = command.split(' ').collect();
            let last = *words.last().unwrap();
            let paths = match words[0] {
                "sh" | "python" => vec![last.to_owned()],
                "cargo" if words.contains(&"--bin") => vec![format!("crates/tools/src/bin/{last}.rs")],
                "cargo" if words.contains(&"--bench") => vec![format!("crates/tools/benches/{last}/main.rs")],
                "cargo" if words.contains(&"pages") => vec![format!("crates/tools/tests/pages/{last}.rs")],
                "cargo" => vec![
                    format!("tests/suite/{last}"),
                    format!("tests/suite/{last}.rs"),
                    format!("tests/suite/fmi/{last}"),
                ],
                _ => panic!("{claim}: {command}"),
            };
            assert!(
                paths.iter().any(|path| root().join(Path::new(path)).exists()),
                "{claim}: {command}: none of {paths:?}"
            );
        }
    }
    assert!(count > 10, "{count}");
}
