//! Words that the glossary of STYLE.md replaces: their number in the library may only fall. Whoever makes it smaller
//! writes the new number here.

use std::fs;
use std::path::{Path, PathBuf};

/// Numbers of each, at most.
const COMMENTS_WITH_WHAT: usize = 510;
const COMMENTS_WITH_PREPOSITION: usize = 314;
const PLACES: usize = 2064;
const LONG_LINES: usize = 125;
/// How many fewer there may be before the number must be written anew.
const SLACK: usize = 20;

const PREPOSITIONS: [&str; 9] = ["Of ", "By ", "From ", "In ", "On ", "At ", "With ", "To ", "For "];

/// The text of a comment that has a line of its own.
fn comment(line: &str) -> Option<&str> {
    let line = line.trim_start();
    ["/// ", "//! ", "// "].iter().find_map(|mark| line.strip_prefix(mark))
}

fn collect(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, list);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            list.push(path);
        }
    }
}

#[test]
fn old_words_only_go() {
    let mut files = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    assert!(files.len() > 300);
    let [mut with_what, mut with_preposition, mut places, mut long] = [0; 4];
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let mut within = false;
        for line in text.lines() {
            let own = comment(line);
            if let (Some(own), false) = (own, within) {
                with_what += usize::from(own.starts_with("What "));
                with_preposition += usize::from(PREPOSITIONS.iter().any(|word| own.starts_with(word)));
            }
            within = own.is_some();
            places +=
                line.split(|c: char| !c.is_alphabetic()).filter(|word| ["place", "places"].contains(word)).count();
            long += usize::from(line.chars().count() > 120);
        }
    }
    for (what, found, most) in [
        ("comments that begin with \"What\"", with_what, COMMENTS_WITH_WHAT),
        ("comments that begin with a preposition", with_preposition, COMMENTS_WITH_PREPOSITION),
        ("the word \"place\"", places, PLACES),
        ("lines beyond 120 columns", long, LONG_LINES),
    ] {
        assert!(found <= most, "{what}: {found}, at most {most}. See the glossary of STYLE.md");
        assert!(found + SLACK >= most, "{what}: {found} are left. Write this number in tests/suite/words.rs");
    }
}
