//! The lines that ARCHITECTURE.md draws must hold in the code: who may import whom, where unsafe, faer and printing live, how long
//! files are, and that every path the page names exists.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &Path, list: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, list);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            list.push(path);
        }
    }
}

/// Every source file below `folder` with its code, comments and doc comments taken off.
fn sources(folder: &str) -> Vec<(String, String)> {
    let mut list = Vec::new();
    files(&root().join(folder), &mut list);
    assert!(!list.is_empty());
    let code = |text: &str| {
        let lines = text.lines().map(|line| if line.trim_start().starts_with("//") { "" } else { line });
        lines.collect::<Vec<_>>().join("\n")
    };
    list.iter()
        .map(|path| {
            let name = path.strip_prefix(root()).unwrap().to_str().unwrap().to_owned();
            (name, code(&fs::read_to_string(path).unwrap()))
        })
        .collect()
}

/// `math <- mechanics <- solve <- model`, `fmi <- model <- simulation`, `ffi` on top; `error` is for all of the mechanics half.
#[test]
fn modules_import_only_what_lies_below() {
    let layers: [(&str, &[&str]); 7] = [
        ("math", &[]),
        ("mechanics", &["math", "error"]),
        ("solve", &["mechanics", "math", "error"]),
        ("fmi", &[]),
        ("model", &["solve", "mechanics", "math", "error", "fmi"]),
        ("simulation", &["model", "fmi", "error"]),
        ("ffi", &["simulation", "model", "fmi"]),
    ];
    for (layer, below) in layers {
        for (name, code) in sources(&format!("src/{layer}")) {
            for (other, _) in layers.iter().chain([&("error", &[][..])]) {
                let allowed = *other == layer || below.contains(other);
                assert!(allowed || !code.contains(&format!("crate::{other}")), "{name} must not import {other}");
            }
        }
    }
    // The command line uses the library as anyone else does: model and fmi only.
    for (name, code) in sources("src/cli") {
        for inner in ["mechanics", "solve", "math", "ffi"] {
            assert!(!code.contains(&format!("ancf14::{inner}")), "{name} must not import {inner}");
        }
    }
}

#[test]
fn unsafe_lives_in_ffi_only() {
    let word = |line: &str| line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == "unsafe");
    for (name, code) in sources("src") {
        assert!(name.starts_with("src/ffi/") || !code.lines().any(word), "{name} is unsafe");
    }
}

#[test]
fn faer_lives_in_the_linear_solver_only() {
    for (name, code) in sources("src") {
        assert!(name.starts_with("src/solve/linear/") || !code.contains("faer::"), "{name} knows faer");
    }
}

#[test]
fn printing_lives_in_the_command_line_only() {
    for (name, code) in sources("src") {
        let prints = ["println!", "eprintln!", "print!(", "dbg!", "io::stdout", "io::stderr"]
            .iter()
            .any(|word| code.contains(word));
        assert!(name.starts_with("src/cli/") || !prints, "{name} prints");
    }
}

/// A thread, a global or a thread-local with a destructor in the library would kill hosts that load it a thousand times.
#[test]
fn no_threads_and_no_globals() {
    for (name, code) in sources("src") {
        if name.starts_with("src/cli/") {
            continue;
        }
        // The place of a panic is kept without a destructor: it needs no thread key.
        let kept =
            name == "src/ffi/fault.rs" && code.contains("static PLACE: Cell<Place> = const { Cell::new(NOWHERE) };");
        assert!(kept || !code.contains("thread_local!"), "{name} has a thread-local");
        for word in ["std::thread", "static mut", "OnceLock", "LazyLock", "OnceCell"] {
            assert!(!code.contains(word), "{name} uses {word}");
        }
    }
}

#[test]
fn no_file_is_longer_than_500_lines() {
    for folder in ["src", "tests"] {
        let mut list = Vec::new();
        files(&root().join(folder), &mut list);
        for path in list {
            let count = fs::read_to_string(&path).unwrap().lines().count();
            assert!(count <= 500, "{} has {count} lines", path.display());
        }
    }
}

/// Every `path` in backquotes with a slash or a file ending is there.
#[test]
fn the_page_names_files_that_exist() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let quoted = page.split('`').skip(1).step_by(2);
    let paths: Vec<&str> = quoted
        .filter(|text| !text.contains(char::is_whitespace))
        .filter(|text| text.ends_with(".rs") || text.ends_with(".md") || text.ends_with(".toml") || text.ends_with('/'))
        .collect();
    assert!(paths.len() > 30);
    for path in paths {
        assert!(root().join(path).exists(), "ARCHITECTURE.md names {path}, which is not there");
    }
}
