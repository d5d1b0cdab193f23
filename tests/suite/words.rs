//! Words that the glossary of STYLE.md replaces: their number in comments and names of the library may only fall. Whoever makes it smaller writes the new number here.

use std::fs;
use std::path::{Path, PathBuf};

/// What is counted, a line at a time, and how many lines there may be.
const COUNTS: [(&str, fn(&str) -> bool, usize); 5] = [
    ("comments that begin with \"What\"", |line| comment(line).is_some_and(|text| text.starts_with("What ")), 516),
    ("comments that begin with a preposition", |line| comment(line).is_some_and(begins_with_preposition), 319),
    ("lines with the word \"place\"", |line| has_word(line, &["place", "places"]), 1707),
    ("lines with the word \"machine\"", |line| has_word(line, &["machine", "machines"]), 3),
    ("lines beyond 120 columns", |line| line.chars().count() > 120, 1444),
];

const PREPOSITIONS: [&str; 9] = ["Of ", "By ", "From ", "In ", "On ", "At ", "With ", "To ", "For "];

/// The text of a comment that has a line of its own.
fn comment(line: &str) -> Option<&str> {
    let line = line.trim_start();
    ["/// ", "//! ", "// "].iter().find_map(|mark| line.strip_prefix(mark))
}

fn begins_with_preposition(text: &str) -> bool {
    PREPOSITIONS.iter().any(|word| text.starts_with(word))
}

fn has_word(line: &str, words: &[&str]) -> bool {
    line.split(|letter: char| !letter.is_alphabetic()).any(|word| words.contains(&word))
}

fn lines(folder: &Path, list: &mut Vec<String>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            lines(&path, list);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            list.extend(fs::read_to_string(&path).unwrap().lines().map(str::to_owned));
        }
    }
}

#[test]
fn old_words_only_go() {
    let mut all = Vec::new();
    lines(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut all);
    assert!(all.len() > 50_000);
    for (what, is_meant, most) in COUNTS {
        let found = all.iter().filter(|line| is_meant(line)).count();
        assert!(found <= most, "{what}: {found}, at most {most}. See the glossary of STYLE.md");
        assert!(found == most, "{what}: {found} are left. Write this number in tests/suite/words.rs");
    }
}
