//! Writes docs/validation.md and its pictures from runs: `cargo run --release --bin validation`.
#![allow(clippy::unwrap_used, reason = "a run that fails must stop the page")]
#![allow(clippy::print_stdout, reason = "says what it is doing: the runs take minutes")]

use ancf14_testing::root;
use ancf14_tools::validation as page;

fn main() {
    let docs = root().join("docs");
    let pictures = docs.join("validation");
    std::fs::create_dir_all(&pictures).unwrap();
    let file = docs.join("validation.md");
    let present = std::fs::read_to_string(&file).unwrap_or_default();
    // Sections named on the command line, or all but those that must be asked for; the others stay as the page has
    // them.
    let named: Vec<String> = std::env::args().skip(1).collect();
    for title in &named {
        assert!(page::CASES.iter().any(|case| case.title == title), "no section is called {title}");
    }
    let wanted = |case: &page::Case| match named.is_empty() {
        true => case.runs != page::Runs::Asked,
        false => named.iter().any(|title| title == case.title),
    };
    let mut sections = Vec::new();
    for case in &page::CASES {
        let kept = page::part(&present, case.title).filter(|_| !wanted(case));
        if let Some(text) = kept {
            sections.push(text.to_owned());
            continue;
        }
        println!("{} ...", case.title);
        let section = case.section();
        for (name, chart) in &section.charts {
            std::fs::write(pictures.join(format!("{name}.svg")), chart.svg().unwrap()).unwrap();
        }
        sections.push(section.text);
    }
    let whole = page::page(&sections);
    let accuracy = docs.join("accuracy/truth.md");
    std::fs::write(&accuracy, page::truth(&std::fs::read_to_string(&accuracy).unwrap(), &whole)).unwrap();
    std::fs::write(&file, whole).unwrap();
    println!("docs/validation.md, docs/validation/*.svg and docs/accuracy/truth.md are written");
}
