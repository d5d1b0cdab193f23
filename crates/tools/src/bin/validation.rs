//! Writes docs/validation/, its pictures, and docs/accuracy/truth.md from runs: `cargo run --release --bin validation`.
#![allow(clippy::unwrap_used, reason = "a run that fails must stop the page")]
#![allow(clippy::print_stdout, reason = "says what it is doing: the runs take minutes")]

use ancf14_testing::root;
use ancf14_tools::validation::{self, Case, Page, Runs};

fn main() {
    // Sections named on the command line, or all but those that must be asked for; the others stay as the pages have
    // them.
    let named: Vec<String> = std::env::args().skip(1).collect();
    for title in &named {
        assert!(validation::cases().any(|case| case.title == title), "no section is called {title}");
    }
    let wanted = |case: &Case| match named.is_empty() {
        true => case.runs != Runs::Asked,
        false => named.iter().any(|title| title == case.title),
    };
    for page in &validation::PAGES {
        write(page, wanted);
    }
    println!("docs/validation/ and docs/accuracy/truth.md are written");
}

/// Writes a page with the wanted sections anew, and their pictures.
fn write(page: &Page, wanted: impl Fn(&Case) -> bool) {
    let docs = root().join("docs");
    let file = docs.join(page.path);
    let present = std::fs::read_to_string(&file).unwrap_or_default();
    let mut sections = Vec::new();
    for case in page.cases {
        let kept = validation::part(&present, case.title).filter(|_| !wanted(case));
        if let Some(text) = kept {
            sections.push(text.to_owned());
            continue;
        }
        println!("{} ...", case.title);
        let section = case.section();
        for (name, chart) in &section.charts {
            std::fs::write(docs.join(format!("validation/{name}.svg")), chart.svg().unwrap()).unwrap();
        }
        sections.push(section.text);
    }
    std::fs::write(&file, page.text(&sections)).unwrap();
}
