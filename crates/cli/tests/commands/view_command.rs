//! Does `ancf14 view` write a page that a browser opens by itself? One file, nothing loaded from elsewhere, names that
//! do no harm, no more than a bounded size, the run as far as it came, and the program that belongs to its sources.
//! What the page does in a browser, viewer/test holds.

use ancf14_testing::root;
use std::path::Path;
use std::process::{Command, Output};

fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(directory).args(arguments).output().unwrap()
}

fn model(name: &str) -> String {
    format!("{}/models/{name}.toml", root().display())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The data in a page.
fn data(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

const SHORT: [&str; 4] = ["--set", "simulation.stop=0.05", "--set", "arm.elements=2"];

/// One file beside the others; the same bytes twice; and with modes, whichever command writes it.
#[test]
fn pages_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let cantilever = model("cantilever");
    let run = |arguments: &[&str]| {
        let output = ancf14(directory.path(), arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    let arguments = [&["view", &cantilever, "--modes=3"], &SHORT[..]].concat();
    let told = run(&arguments);
    assert!(told.starts_with("11 instants, ") && told.contains("open cantilever.html in a browser"), "{told}");
    let page = read("cantilever.html");
    let found = data(&page);
    assert_eq!(found["instants"], 11);
    assert_eq!(found["modes"].as_array().unwrap().len(), 3);
    assert_eq!(found["scene"]["beams"][0]["name"], "arm");
    assert_eq!(found["notes"].as_array().unwrap().len(), 0);
    run(&arguments);
    assert!(read("cantilever.html") == page, "the same run made another page");
    run(&[&["run", &cantilever, "--view", "-o", "out"], &SHORT[..]].concat());
    assert_eq!(data(&read("out/view.html"))["tracks"], found["tracks"]);
    run(&["modes", &cantilever, "--view", "-o", "out", "--count", "3", "--set", "arm.elements=2"]);
    assert_eq!(data(&read("out/modes.html"))["modes"], found["modes"]);
}

/// The page asks for nothing: its policy forbids it, and there is no address in what is not program.
#[test]
fn a_page_loads_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let output = ancf14(directory.path(), &[&["view", &model("cantilever")], &SHORT[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(directory.path().join("cantilever.html")).unwrap();
    assert!(page.contains(
        "content=\"default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\""
    ));
    for word in [" src=", "<link", "<iframe", "url(http", "@import"] {
        assert!(!page.replace("\"/*", "").contains(word), "{word}");
    }
    assert!(page.len() < 1_000_000, "a page of little data has {} bytes", page.len());
}

/// Whatever stands in a name is text.
#[test]
fn names_are_text() {
    let directory = tempfile::tempdir().unwrap();
    let name = "</script><script>document.title='harm'</script><!-- <b>&amp;";
    let source = std::fs::read_to_string(model("cantilever")).unwrap();
    let source = source.replace("name = \"Cantilever\"", &format!("name = \"{name}\""));
    assert!(source.contains("harm"));
    std::fs::write(directory.path().join("m.toml"), source).unwrap();
    let output = ancf14(directory.path(), &[&["view", "m.toml"], &SHORT[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(directory.path().join("m.html")).unwrap();
    assert_eq!(data(&page)["scene"]["name"], name);
    assert!(!page.contains("<script>document"), "the name is a script");
    assert_eq!(page.matches("</script>").count(), 2);
}

/// Too many instants are thinned out, the last one stays, and the page says so.
#[test]
fn long_runs_are_thinned_out() {
    let directory = tempfile::tempdir().unwrap();
    let settings =
        ["--set", "simulation.stop=3.0003", "--set", "simulation.output_step=3e-4", "--set", "simulation.step=3e-4"];
    let output =
        ancf14(directory.path(), &[&["view", &model("cantilever"), "--set", "arm.elements=2"], &settings[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(directory.path().join("cantilever.html")).unwrap();
    let found = data(&page);
    // 10,002 rows from 0 to 10,001: every sixth, and the last one.
    assert_eq!(found["instants"], 1668);
    let note = "To keep the page small, the picture has one row of results in 6: 1668 of 10002.";
    assert_eq!(found["notes"][0], note);
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
}

/// A run that fails is shown as far as it came, with the reason, and the command fails.
#[test]
fn failed_runs_are_shown() {
    let directory = tempfile::tempdir().unwrap();
    let settings = ["--set", "rod.element=ancf24"];
    let output = ancf14(directory.path(), &[&["view", &model("ring")], &settings[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    let page = std::fs::read_to_string(directory.path().join("ring.html")).unwrap();
    let found = data(&page);
    assert!(found["notes"][0].as_str().unwrap().starts_with("The run ended early, at t = "), "{}", found["notes"]);
    assert!(found["instants"].as_u64().unwrap() > 1);
}

/// The page never takes the place of the model.
#[test]
fn the_model_is_spared() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::copy(model("cantilever"), directory.path().join("m.html")).unwrap();
    let output = ancf14(directory.path(), &["view", "m.html"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("m.html is the model file"), "{}", text(&output.stderr));
}

/// A stand-in for the solver: what the command looks at.
pub(super) fn solver() -> Vec<u8> {
    format!("\0asm...the solver of ancf14 {} for the page...", env!("CARGO_PKG_VERSION")).into_bytes()
}

/// With the solver a page has the model and its settings too, and its policy allows the solver and nothing else.
/// Nothing in the model ends a script.
#[test]
fn a_page_brings_the_solver() {
    let directory = tempfile::tempdir().unwrap();
    let source = std::fs::read_to_string(model("cantilever")).unwrap();
    let source = format!("# </script><script>document.title='harm'</script><!--\n{source}");
    std::fs::write(directory.path().join("m.toml"), &source).unwrap();
    std::fs::write(directory.path().join("own.wasm"), solver()).unwrap();
    let run = |live: &str| ancf14(directory.path(), &[&["view", "m.toml", live, "--modes=2"], &SHORT[..]].concat());
    let output = run("--live=own.wasm");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(directory.path().join("m.html")).unwrap();
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"live\">").unwrap();
    let found: serde_json::Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let overrides = serde_json::json!([["simulation.stop", "0.05"], ["arm.elements", "2"]]);
    let wanted = serde_json::json!({ "file": "m.toml", "text": source, "overrides": overrides, "modes": 2 });
    assert_eq!(found, wanted);
    assert_eq!(data(&page)["instants"], 11);
    assert_eq!(page.matches("</script>").count(), 5);
    let policy = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:";
    assert!(page.contains(&format!("content=\"{policy}\"")), "{}", &page[..600]);
    assert!(page.contains("Licences of the software in the solver of this page"));
}

/// Without the solver, or with one of another version, the command says how to get it.
#[test]
fn a_missing_solver_is_told() {
    let directory = tempfile::tempdir().unwrap();
    let cantilever = model("cantilever");
    let refused = |live: &str| {
        let output = ancf14(directory.path(), &["view", &cantilever, live]);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
        assert!(!directory.path().join("cantilever.html").exists());
        text(&output.stderr)
    };
    let missing = refused("--live=nowhere.wasm");
    assert!(missing.starts_with("error: the solver of the page, ancf14.wasm, is not at nowhere.wasm; "), "{missing}");
    assert!(missing.contains("sh scripts/build-wasm.sh builds it"), "{missing}");
    let others = String::from_utf8(solver()).unwrap().replace(env!("CARGO_PKG_VERSION"), "0.0.0").into_bytes();
    for bytes in [&b"\0asm"[..], b"", &others, &solver()[1..]] {
        std::fs::write(directory.path().join("other.wasm"), bytes).unwrap();
        let wrong = refused("--live=other.wasm");
        assert!(wrong.starts_with("error: other.wasm is not the solver of ancf14 "), "{wrong}");
    }
    // The page does not take the place of the solver.
    std::fs::write(directory.path().join("own.wasm"), solver()).unwrap();
    let output = ancf14(directory.path(), &["view", &cantilever, "--live=own.wasm", "-o", "own.wasm"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read(directory.path().join("own.wasm")).unwrap(), solver());
}

/// What cannot be watched is told at once. In the browser, viewer/test/browser/watch.mjs looks at it.
#[test]
fn only_files_are_watched() {
    let directory = tempfile::tempdir().unwrap();
    let cantilever = model("cantilever");
    let cases: [(&[&str], &str); 4] = [
        (&["view", "-", "--watch"], "--watch needs a file"),
        (&["view", &cantilever, "--watch", "--json"], "leave out --json"),
        (&["view", &cantilever, "--watch", "-o", "page.html"], "cannot be used with"),
        (&["view", &cantilever, "--watch", "--live"], "cannot be used with"),
    ];
    for (arguments, reason) in cases {
        let output = ancf14(directory.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let told = text(&output.stderr) + &text(&output.stdout);
        assert!(told.contains(reason), "{told}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
}

/// The program in the page is the one that viewer/build.mjs makes of the sources: its first line has their hash. Only
/// node can make it anew, so a change without `npm run build` would go unseen here otherwise.
#[test]
fn the_program_belongs_to_its_sources() {
    let viewer = root().join("viewer");
    let mut names: Vec<String> = std::fs::read_dir(viewer.join("src"))
        .unwrap()
        .map(|entry| format!("src/{}", entry.unwrap().file_name().into_string().unwrap()))
        .collect();
    names.sort();
    let paths = ["build.mjs", "package-lock.json"].map(str::to_owned).into_iter().chain(names);
    // FNV-1a, as in build.mjs.
    let hash = paths.fold(0xcbf2_9ce4_8422_2325_u64, |hash, path| {
        let content = std::fs::read(viewer.join(&path)).unwrap();
        let bytes = format!("{path}\n").into_bytes().into_iter().chain(content);
        bytes.fold(hash, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
    });
    let program = std::fs::read_to_string(viewer.join("dist/viewer.js")).unwrap();
    let first = program.lines().next().unwrap();
    assert_eq!(
        first,
        format!("// sources: {hash:016x}"),
        "run `npm ci && npm run build` in viewer/, and commit viewer/dist"
    );
}
