//! The commands that pages print, and what the pages say that these print.

use crate::root;
use std::fs;

/// The page on programs, with its listings.
pub const PROGRAMMING: &str = "docs/programming.md";
pub const FIRST_STEPS: &str = "docs/first-steps.md";

/// The commands of the shell listings of `page`, in order.
pub fn commands(page: &str) -> Vec<String> {
    let page = fs::read_to_string(root().join(page)).unwrap();
    let listings = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap_or_default());
    listings.flat_map(str::lines).map(str::to_owned).collect()
}

/// What `page` says that the command `line` prints: the listing after that of the command.
pub fn printed_by(page: &str, line: &str) -> String {
    let text = fs::read_to_string(root().join(page)).unwrap();
    let rest = text.split(&format!("\n{line}\n")).nth(1).unwrap_or_else(|| panic!("{page} has no command {line}"));
    let listing = rest.split("```text\n").nth(1).unwrap();
    listing.split("```").next().unwrap().to_owned()
}

/// The listings of `page` in a language, as `toml`.
pub fn listings<'page>(page: &'page str, language: &str) -> impl Iterator<Item = &'page str> {
    let opening = format!("\n```{language}\n");
    page.split_inclusive("\n```\n").filter_map(move |part| {
        let (_, listing) = part.split_once(&opening)?;
        Some(listing.strip_suffix("```\n").unwrap_or(listing))
    })
}

/// The Markdown pages of a folder: their paths from the root, and their texts.
pub fn pages_in(folder: &str) -> Vec<(String, String)> {
    let names = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> =
        names.map(|name| name.into_string().unwrap()).filter(|name| name.ends_with(".md")).collect();
    names.sort();
    let path = |name: &String| format!("{folder}/{name}");
    names.iter().map(|name| (path(name), fs::read_to_string(root().join(path(name))).unwrap())).collect()
}
