//! Do the programs of docs/programming.md run as the page says? Its commands are run as they are printed, with what
//! scripts/install.sh has installed, and must print what the page says they print. A wrong flag, a missing file or
//! another number would fail here.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

use ancf14_testing::pages::{FIRST_STEPS, PROGRAMMING, commands, printed_by};
use ancf14_testing::{library_path, root};

use super::printed;

/// A folder that looks like the repository, where what the commands write goes, and what was built for these tests.
struct Workplace(TempDir);

impl Workplace {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        for name in ["Cargo.toml", "LICENSE", "c-examples", "include", "licenses", "scripts"] {
            symlink(root().join(name), here.join(name)).unwrap();
        }
        fs::create_dir(here.join("built")).unwrap();
        fs::copy(library_path(), here.join("built").join(ancf14::fmi::location::LIBRARY)).unwrap();
        fs::copy(env!("CARGO_BIN_EXE_ancf14"), here.join("built/ancf14")).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn prefix(&self) -> PathBuf {
        self.path().join("installed")
    }

    /// Runs lines of a shell, as a reader of the page would type them.
    fn shell(&self, lines: &str) -> Output {
        let mut shell = Command::new("sh");
        // Cargo names folders there that may hold an older library.
        shell.env_remove("LD_LIBRARY_PATH").env("ANCF14_BUILD", "built").current_dir(self.path());
        shell.env("PREFIX", self.prefix()).env("PKG_CONFIG_PATH", self.prefix().join("lib/pkgconfig"));
        shell.args(["-e", "-c", lines]).output().unwrap()
    }

    fn install(&self) {
        let version = Command::new("pkg-config").arg("--version").output();
        assert!(
            version.is_ok(),
            "pkg-config is missing, which this test needs: install it with this system's package manager"
        );
        let line = commands(PROGRAMMING).into_iter().find(|line| line.contains("install.sh")).unwrap();
        assert_eq!(printed(&self.shell(&line)), "");
    }
}

/// The commands of the page for C and C++, and what the programs print; then from a folder that has been moved.
#[test]
fn programs_in_c_and_c_plus_plus_run() {
    let place = Workplace::new();
    place.install();
    let lines = commands(PROGRAMMING);
    let mut ran = 0;
    for compiler in ["cc -std", "c++ -std"] {
        let at = lines.iter().position(|line| line.starts_with(compiler)).unwrap();
        assert_eq!(printed(&place.shell(&lines[at])), "");
        assert_eq!(printed(&place.shell(&lines[at + 1])), printed_by(PROGRAMMING, &lines[at + 1]), "{}", lines[at + 1]);
        ran += 1;
    }
    assert_eq!(ran, 2);
    fs::rename(place.prefix(), place.path().join("moved")).unwrap();
    let moved = lines.iter().find(|line| line.starts_with("cc -std")).unwrap();
    let shell = format!("PKG_CONFIG_PATH=\"$PWD/moved/lib/pkgconfig\"\n{moved}\n./simulate c-examples/arm.toml");
    assert_eq!(printed(&place.shell(&shell)), printed_by(PROGRAMMING, "./simulate c-examples/arm.toml"));
}

/// Both say what is wrong and fail, with a missing file, a bad model, an unknown variable.
#[test]
fn programs_report_mistakes() {
    let place = Workplace::new();
    place.install();
    let lines = commands(PROGRAMMING);
    for line in lines.iter().filter(|line| line.starts_with("cc -std") || line.starts_with("c++ -std")) {
        printed(&place.shell(line));
    }
    fs::write(place.path().join("bad.toml"), "format = 1\n").unwrap();
    for (line, words) in [
        ("./simulate", "usage: simulate MODEL.toml"),
        ("./simulate missing.toml", "cannot read missing.toml"),
        ("./simulate bad.toml", "bad.toml"),
        ("./simulate_cpp c-examples/arm.toml", "usage: simulate_cpp"),
        ("./simulate_cpp missing.toml x", "cannot read missing.toml"),
        ("./simulate_cpp c-examples/arm.toml tip.positon[3]", "did you mean `tip.position[3]`?"),
    ] {
        let ran = place.shell(line);
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert!(ran.status.code() == Some(1) && said.contains(words), "{line}: {said}");
    }
}

/// What is installed: the program runs, and what is not built or not said is told.
#[test]
fn the_installation_is_whole() {
    let place = Workplace::new();
    fs::write(place.path().join("built/libancf14.a"), "archive").unwrap();
    place.install();
    for file in [
        "bin/ancf14",
        "include/ancf14.h",
        "lib/libancf14.a",
        "lib/libancf14.so",
        "lib/pkgconfig/ancf14.pc",
        "lib/cmake/ancf14/ancf14Config.cmake",
        "lib/cmake/ancf14/ancf14ConfigVersion.cmake",
        "share/doc/ancf14/LICENSE",
        "share/doc/ancf14/license.txt",
        "share/doc/ancf14/program.txt",
    ] {
        let text = fs::read(place.prefix().join(file)).unwrap_or_else(|reason| panic!("{file}: {reason}"));
        assert!(
            !text.windows(9).any(|bytes| bytes == b"@VERSION@" || bytes == b"@LIBRARY@"),
            "{file} is not filled in"
        );
    }
    let version = printed(&place.shell("pkg-config --modversion ancf14; \"$PREFIX/bin/ancf14\" --version"));
    assert_eq!(version, format!("{0}\nancf14 {0}\n", env!("CARGO_PKG_VERSION")));
    printed(&place.shell("sh scripts/install.sh 'a folder with blanks'"));
    assert!(place.path().join("a folder with blanks/include/ancf14.h").is_file());
    for (lines, words) in
        [("ANCF14_BUILD=nothing sh scripts/install.sh a", "build it first"), ("sh scripts/install.sh", "usage:")]
    {
        let ran = place.shell(lines);
        assert!(!ran.status.success() && String::from_utf8_lossy(&ran.stderr).contains(words), "{lines}: {ran:?}");
    }
}

/// The examples in Rust, which check their own numbers, print what the page says.
#[test]
fn programs_in_rust_run() {
    let is_release = std::env::current_exe().unwrap().components().any(|part| part.as_os_str() == "release");
    let mut ran = 0;
    for page in [PROGRAMMING, FIRST_STEPS] {
        for line in commands(page).iter().filter(|line| line.starts_with("cargo run")) {
            let (_, name) = line.split_once("--release --example ").unwrap();
            let mut cargo = Command::new(env!("CARGO"));
            cargo.current_dir(root()).args(["run", "--quiet", "--locked", "--offline", "--example", name]);
            if is_release {
                cargo.arg("--release");
            }
            assert_eq!(printed(&cargo.output().unwrap()), printed_by(page, line), "{line}");
            ran += 1;
        }
    }
    assert_eq!(ran, 5);
}
