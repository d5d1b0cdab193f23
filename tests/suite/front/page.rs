//! Is every program of docs/programming.md the file that the tests run? A program that was only printed would rot.
//!
//! The line before each listing names its file: `ANCF14_BLESS=1 cargo test programming` writes the listings from the files.

use std::fs;

use super::root;
use crate::golden;

pub const PAGE: &str = "docs/programming.md";
const FILES: [&str; 6] = [
    "c-examples/simulate.c",
    "c-examples/simulate.cpp",
    "examples/cantilever.rs",
    "examples/parameter_study.rs",
    "examples/controller.rs",
    "examples/modes.rs",
];

#[test]
fn the_page_on_programming_has_the_files() {
    let mut page = fs::read_to_string(root().join(PAGE)).unwrap();
    for file in FILES {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let language = file.rsplit('.').next().unwrap().replace("rs", "rust");
        let opening = format!("[{file}](../{file}):\n\n```{language}\n");
        let begin = page.find(&opening).unwrap_or_else(|| panic!("{PAGE} has no listing of {file}")) + opening.len();
        let end = begin + page[begin..].find("```").unwrap();
        page.replace_range(begin..end, &text);
    }
    golden::assert_current(PAGE, &page);
}

/// The commands of the page's shell listings, in order.
pub fn commands() -> Vec<String> {
    let page = fs::read_to_string(root().join(PAGE)).unwrap();
    let listings = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap_or_default());
    listings.flat_map(str::lines).map(str::to_owned).collect()
}

/// What the page says that the command `line` prints: the listing behind that of the command.
pub fn printed_by(line: &str) -> String {
    let page = fs::read_to_string(root().join(PAGE)).unwrap();
    let rest = page.split(&format!("\n{line}\n")).nth(1).unwrap_or_else(|| panic!("{PAGE} has no command {line}"));
    let listing = rest.split("```text\n").nth(1).unwrap();
    listing.split("```").next().unwrap().to_owned()
}
