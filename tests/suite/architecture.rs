//! The lines that ARCHITECTURE.md draws must hold in the code: which layer may import which, that the rooms of a layer
//! are a stack, where unsafe, faer and printing live, how long files are, that the page names every room, and that
//! every path it names exists.

use std::collections::{BTreeMap, BTreeSet};
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

/// The sources of all packages.
fn everything() -> Vec<(String, String)> {
    let packages = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().file_name());
    let folders = packages.map(|package| format!("crates/{}/src", package.to_str().unwrap()));
    folders.chain(["src", "python/src"].map(str::to_owned)).flat_map(|folder| sources(&folder)).collect()
}

/// `math <- mechanics <- solve <- model`, `fmi <- model <- simulation`, `fmi <- linear` and `math <- linear`, both kinds of models below
/// `packed`, which `simulation` and `ffi` hold; `error` is for all of the mechanics half.
#[test]
fn modules_import_only_what_lies_below() {
    let layers: [(&str, &[&str]); 9] = [
        ("math", &[]),
        ("mechanics", &["math", "error"]),
        ("solve", &["mechanics", "math", "error"]),
        ("fmi", &[]),
        ("linear", &["fmi", "math"]),
        ("model", &["solve", "mechanics", "math", "error", "fmi"]),
        ("packed", &["model", "linear", "fmi"]),
        ("simulation", &["packed", "model", "fmi", "error"]),
        ("ffi", &["simulation", "packed", "model", "fmi"]),
    ];
    for (layer, below) in layers {
        for (name, code) in sources(&format!("src/{layer}")) {
            for (other, _) in layers.iter().chain([&("error", &[][..])]) {
                let allowed = *other == layer || below.contains(other);
                assert!(allowed || !code.contains(&format!("crate::{other}")), "{name} must not import {other}");
            }
        }
    }
}

/// What stands on the library uses it as anyone else does: its models and fmi only. Which package may use which is in their
/// manifests, and cargo holds it. The tools and the tests look inside.
#[test]
fn packages_import_model_and_fmi_only() {
    for package in ["crates/pack", "crates/report", "crates/view", "crates/vtk", "crates/live", "crates/cli", "python"]
    {
        for (name, code) in sources(&format!("{package}/src")) {
            for inner in ["mechanics", "solve", "math", "ffi"] {
                assert!(!code.contains(&format!("ancf14::{inner}")), "{name} must not import {inner}");
            }
        }
    }
}

/// Imports between rooms that close a circle: folder, room, the room that it imports. New ones fail; one that is gone
/// leaves this list.
const CIRCLES: &[(&str, &str, &str)] = &[
    // The list of all elements has those that implement what it asks for.
    ("mechanics/beam", "element", "ancf14"),
    ("mechanics/beam", "element", "ancf24"),
    // The instant has the frames of ANCF14's nodes.
    ("mechanics/beam", "configuration", "ancf14"),
    // The element is evaluated by its parts, which are parts of the element.
    ("mechanics/beam/ancf14", "element", "energy"),
    ("mechanics/beam/ancf14", "element", "kinematics"),
    ("mechanics/beam/ancf14", "element", "over_step"),
    ("mechanics/beam/ancf14", "strain", "energy"),
];

/// Adds the paths that begin at `text`, after a `::`, to `paths`, each behind `prefix`; returns how long they are.
/// `a::{b, c::d}` is two paths.
fn add_paths(text: &str, prefix: &[&str], paths: &mut Vec<Vec<String>>) -> usize {
    if let Some(list) = text.strip_prefix('{') {
        let mut at = 1;
        loop {
            at += list[at - 1..].len() - list[at - 1..].trim_start_matches([' ', '\n', ',']).len();
            if text[at..].starts_with('}') || text[at..].is_empty() {
                return at + 1;
            }
            // At least one byte: a star, which imports a whole module, is no name.
            at += add_paths(&text[at..], prefix, paths).max(1);
            at += text[at..].find([',', '}']).unwrap_or(0);
        }
    }
    let length = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let longer = [prefix, &[&text[..length]]].concat();
    match text[length..].strip_prefix("::") {
        Some(rest) if length > 0 => length + 2 + add_paths(rest, &longer, paths),
        _ => {
            paths.push(longer.iter().map(|word| (*word).to_owned()).collect());
            length
        }
    }
}

/// The modules that file `name` below `src/` of a package names by paths from `crate` or from above itself, tests left
/// out.
fn named(name: &str, code: &str) -> Vec<Vec<String>> {
    let code = code.split("#[cfg(test)]").next().unwrap();
    let below = name.split_once("src/").unwrap().1;
    let mut own: Vec<&str> = below.strip_suffix(".rs").unwrap().split('/').collect();
    own.pop_if(|last| ["mod", "lib", "main"].contains(last));
    let mut paths = Vec::new();
    for (at, word) in code.match_indices("crate::").chain(code.match_indices("super::")) {
        // The second of `super::super::`, and the middle of a name.
        if code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let mut rest = &code[at + word.len()..];
        let mut above = own.as_slice();
        if word == "crate::" {
            above = &[];
        } else {
            above = &above[..above.len() - 1];
            while let Some(further) = rest.strip_prefix("super::") {
                (above, rest) = (&above[..above.len() - 1], further);
            }
        }
        add_paths(rest, above, &mut paths);
    }
    paths
}

/// The rooms of a folder, files and folders, each with the rooms that it imports.
fn rooms(folder: &str) -> BTreeMap<String, BTreeSet<String>> {
    let files = sources(folder);
    let room_of = |name: &str| {
        let room = name.strip_prefix(folder).unwrap().split('/').nth(1).unwrap();
        room.trim_end_matches(".rs").to_owned()
    };
    let above: Vec<&str> = folder.split_once("src").unwrap().1.split('/').skip(1).collect();
    let mut rooms: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, _) in &files {
        rooms.insert(room_of(name), BTreeSet::new());
    }
    // The layer's own file is above and below them: it lists them, and holds what all of them share.
    for own in ["mod", "lib", "main"] {
        rooms.remove(own);
    }
    let all: BTreeSet<String> = rooms.keys().cloned().collect();
    for (name, code) in &files {
        let Some(imported) = rooms.get_mut(&room_of(name)) else { continue };
        for path in named(name, code) {
            let inside = path.iter().map(String::as_str).take(above.len()).eq(above.iter().copied());
            let Some(room) = path.get(above.len()).filter(|_| inside) else { continue };
            if all.contains(room) && *room != room_of(name) {
                imported.insert(room.clone());
            }
            // A name that mod.rs passes on would hide the room that it comes from.
            assert!(folder != "src/model" || all.contains(room), "{name} must name {room} by its room");
        }
    }
    rooms
}

/// Every folder of source files of all packages, as `src/mechanics/beam`.
fn folders() -> BTreeSet<String> {
    let folders = everything().into_iter().filter_map(|(name, _)| Some(name.rsplit_once('/')?.0.to_owned()));
    folders.filter(|folder| folder != "src").collect()
}

/// Which rooms of a folder import which: a stack, floor above floor, but for what [`CIRCLES`] lists.
#[test]
fn rooms_are_a_stack() {
    let folders = folders();
    assert!(folders.len() > 30);
    for folder in &folders {
        let mut rooms = rooms(folder);
        for (_, room, above) in CIRCLES.iter().filter(|(own, ..)| folder.strip_prefix("src/") == Some(own)) {
            let found = rooms.get_mut(*room).is_some_and(|imported| imported.remove(*above));
            assert!(found, "{folder}/{room} does not import {above} any more: take it off the list");
        }
        let mut floor = 0;
        while !rooms.is_empty() {
            floor += 1;
            let lowest: Vec<String> =
                rooms.iter().filter(|(_, imported)| imported.is_empty()).map(|(room, _)| room.clone()).collect();
            assert!(!lowest.is_empty(), "rooms of {folder} import one another in a circle: {rooms:?}");
            println!("{folder}, floor {floor}: {}", lowest.join(" "));
            for room in &lowest {
                rooms.remove(room);
            }
            for imported in rooms.values_mut() {
                imported.retain(|room| !lowest.contains(room));
            }
        }
    }
}

/// `use`, as rustfmt leaves it, and paths in the middle of code.
#[test]
fn paths_are_read() {
    let code =
        "use super::{\n    a::{self, B},\n    c,\n};\nuse crate::x::y::*;\nfn f() { super::super::d::e(crate::z::W) }";
    let read: Vec<String> =
        named("crates/report/src/x/room/file.rs", code).iter().map(|path| path.join("::")).collect();
    let wanted = ["x::y::", "z::W", "x::room::a::self", "x::room::a::B", "x::room::c", "x::d::e"];
    assert_eq!(read, wanted);
}

/// A solver, like everything above it, knows elements by what all of them answer; the model alone chooses one of a
/// kind, where it builds a mesh.
#[test]
fn solvers_name_no_element() {
    for layer in ["solve", "simulation", "ffi"] {
        for (name, code) in sources(&format!("src/{layer}")) {
            for path in ["beam::ancf14", "beam::ancf24", "NodeFrame", "AnyElement"] {
                assert!(!code.contains(path), "{name} names {path}");
            }
        }
    }
}

/// Exported names are unsafe too: the page calls those of crates/live, which follow no pointer.
#[test]
fn unsafe_lives_in_ffi_only() {
    // The policy of a page has words with hyphens, 'wasm-unsafe-eval'.
    let word = |line: &str| {
        line.split(|c: char| !c.is_alphanumeric() && !['_', '-'].contains(&c)).any(|word| word == "unsafe")
    };
    for (name, code) in everything() {
        let exported = |line: &str| name == "crates/live/src/exports.rs" && line == "#[unsafe(no_mangle)]";
        assert!(
            name.starts_with("src/ffi/") || !code.lines().any(|line| word(line) && !exported(line)),
            "{name} is unsafe"
        );
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
    for (name, code) in everything() {
        let prints = ["println!", "eprintln!", "print!(", "dbg!", "io::stdout", "io::stderr"]
            .iter()
            .any(|word| code.contains(word));
        let may_print = ["crates/cli/", "crates/tools/src/bin/"].iter().any(|folder| name.starts_with(folder));
        assert!(may_print || !prints, "{name} prints");
    }
}

/// A thread, a global or a thread-local with a destructor in the library would kill hosts that load it a thousand
/// times.
#[test]
fn no_threads_and_no_globals() {
    for (name, code) in sources("src")
        .into_iter()
        .chain(sources("crates/pack/src"))
        .chain(sources("crates/report/src"))
        .chain(sources("crates/view/src"))
        .chain(sources("crates/vtk/src"))
    {
        // The place of a panic is kept without a destructor: it needs no thread key.
        let kept =
            name == "src/ffi/fault.rs" && code.contains("static PLACE: Cell<Place> = const { Cell::new(NOWHERE) };");
        assert!(kept || !code.contains("thread_local!"), "{name} has a thread-local");
        for word in ["std::thread", "static mut", "OnceLock", "LazyLock", "once_cell"] {
            assert!(!code.contains(word), "{name} uses {word}");
        }
    }
}

#[test]
fn no_file_is_longer_than_500_lines() {
    for folder in ["src", "tests", "crates", "python"] {
        let mut list = Vec::new();
        files(&root().join(folder), &mut list);
        for path in list {
            let count = fs::read_to_string(&path).unwrap().lines().count();
            assert!(count <= 500, "{} has {count} lines", path.display());
        }
    }
}

/// A room, every folder of source files, has its sentence on the page.
#[test]
fn the_page_names_every_room() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rooms: BTreeSet<String> =
        everything().iter().map(|(name, _)| name.rsplit_once('/').unwrap().0.to_owned()).collect();
    assert!(rooms.len() > 30);
    for room in rooms {
        assert!(page.contains(&format!("`{room}/`")), "ARCHITECTURE.md does not say what {room}/ is");
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

/// A file that no `mod` names is not compiled, and its tests never run.
#[test]
fn every_file_of_the_suite_is_part_of_it() {
    let mut list = Vec::new();
    files(&root().join("tests/suite"), &mut list);
    for path in list.iter().filter(|path| !path.ends_with("main.rs")) {
        let is_folder = path.ends_with("mod.rs");
        let name = if is_folder { path.parent().unwrap() } else { path.as_path() };
        let above = name.parent().unwrap();
        let parent = [above.join("mod.rs"), above.join("main.rs")].into_iter().find(|file| file.exists()).unwrap();
        let own = format!("mod {};", name.file_stem().unwrap().to_str().unwrap());
        assert!(fs::read_to_string(&parent).unwrap().contains(&own), "{} has no `{own}`", parent.display());
    }
}
