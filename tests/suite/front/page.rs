//! Is every program of docs/programming.md and docs/first-steps.md the file that the tests run? A program that was only printed
//! would rot.
//!
//! The line before each listing names its file: `ANCF14_BLESS=1 cargo test front::page` writes the listings from the
//! files.

use std::fs;

use ancf14_testing::pages::{FIRST_STEPS, PROGRAMMING};
use ancf14_testing::root;

use crate::golden;

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
    assert_has_files(PROGRAMMING, "../", &FILES);
}

#[test]
fn the_first_steps_have_their_program() {
    assert_has_files(FIRST_STEPS, "../", &["examples/first.rs"]);
}

/// The listings of `page`, which names files by links that begin with `up`, are the files.
fn assert_has_files(page: &str, up: &str, files: &[&str]) {
    let mut text = fs::read_to_string(root().join(page)).unwrap();
    for file in files {
        let program = fs::read_to_string(root().join(file)).unwrap();
        let language = file.rsplit('.').next().unwrap().replace("rs", "rust");
        let opening = format!("[{file}]({up}{file}):\n\n```{language}\n");
        let begin = text.find(&opening).unwrap_or_else(|| panic!("{page} has no listing of {file}")) + opening.len();
        let end = begin + text[begin..].find("```").unwrap();
        text.replace_range(begin..end, &program);
    }
    golden::assert_current(page, &text);
}
