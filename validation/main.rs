//! Writes docs/validation.md and its pictures from runs: `cargo run --release --example validation`.
#![allow(clippy::unwrap_used, reason = "a run that fails must stop the page")]
#![allow(clippy::print_stdout, reason = "says what it is doing: the runs take minutes")]

#[path = "../tests/suite/curves.rs"]
mod curves;
#[path = "page.rs"]
mod page;

use std::path::Path;

fn main() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let pictures = docs.join("validation");
    std::fs::create_dir_all(&pictures).unwrap();
    // Sections named on the command line are printed, and the page is left alone.
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let mut sections = Vec::new();
    for case in page::CASES.iter().filter(|case| wanted.is_empty() || wanted.iter().any(|title| title == case.title)) {
        println!("{} ...", case.title);
        let section = case.section();
        for (name, chart) in &section.charts {
            chart.draw(&pictures.join(format!("{name}.svg"))).unwrap();
        }
        sections.push(section.text);
    }
    if wanted.is_empty() {
        std::fs::write(docs.join("validation.md"), page::page(&sections)).unwrap();
        println!("docs/validation.md and docs/validation/*.svg are written");
    } else {
        println!("{}", sections.concat());
    }
}
