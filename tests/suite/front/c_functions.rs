//! Are the functions `ancf14_...` safe in the hands of a C programmer? A program makes every mistake, under valgrind
//! too: wrong memory would be touched, or lost, where a check is missing. And simulations in several threads do not
//! meet.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::ffi::CString;
use std::fs;
use std::process::Command;
use std::ptr::null;

use ancf14::ffi::front::*;
use ancf14::ffi::front_types::ancf14_status::ANCF14_OK;

use super::printed;
use ancf14_testing::library_path;
use ancf14_testing::root;

/// A clamped arm whose end can be pushed.
const ARM: &str = include_str!("../../../c-examples/arm.toml");

#[test]
fn mistakes_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::copy(library_path(), here.join(ancf14::fmi::location::LIBRARY)).unwrap();
    fs::write(here.join("arm.toml"), ARM).unwrap();
    fs::write(here.join("bad.toml"), ARM.replace("radius", "diameter")).unwrap();
    fs::create_dir(here.join("inner")).unwrap();
    fs::write(here.join("inner/outside.toml"), format!("{ARM}\n[include.more]\nfile = \"../part.toml\"\n")).unwrap();
    fs::write(here.join("part.toml"), "format = 1\n[point.far]\noffset = [1, 0, 0]\n").unwrap();
    let built = Command::new("cc")
        .current_dir(here)
        .args(["-std=c99", "-g", "-Wall", "-Wextra", "-Werror", "-pedantic", "-L.", "-o", "front_mistakes"])
        .arg(format!("-I{}", root().join("include").display()))
        .arg(root().join("tests/c/front_mistakes.c"))
        .args(["-lancf14", &format!("-Wl,-rpath,{}", here.display())])
        .output()
        .unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let run = |mut command: Command| {
        let ran = command.env_remove("LD_LIBRARY_PATH").current_dir(here).args([
            "arm.toml",
            "bad.toml",
            "inner/outside.toml",
        ]);
        let ran = ran.output();
        let ran = ran.unwrap();
        assert_eq!(printed(&ran), "all mistakes are errors\n");
        assert_eq!(String::from_utf8_lossy(&ran.stderr), "", "nothing is printed by the library");
    };
    run(Command::new(here.join("front_mistakes")));
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--show-leak-kinds=all"]);
    valgrind.args(["--errors-for-leak-kinds=all"]).arg(here.join("front_mistakes"));
    run(valgrind);
}

/// The last value of a run with a force.
fn tip(force: f64) -> f64 {
    let (name, text) = (c"arm.toml", CString::new(ARM).unwrap());
    let mut error = [0; 1000];
    let mut value = f64::NAN;
    // SAFETY: the texts end with a zero byte and live during the calls, the simulation is used by this thread only.
    unsafe {
        let arm = ancf14_load_text(name.as_ptr(), text.as_ptr(), null(), error.as_mut_ptr(), error.len());
        assert_eq!(ancf14_initialize(arm), ANCF14_OK);
        let (push, height) =
            (ancf14_find(arm, c"push.force[3]".as_ptr()), ancf14_find(arm, c"tip.position[3]".as_ptr()));
        for step in 1..=20 {
            assert_eq!(ancf14_set(arm, push, force), ANCF14_OK);
            assert_eq!(ancf14_advance(arm, f64::from(step) * 2e-3), ANCF14_OK);
        }
        assert_eq!(ancf14_get(arm, height, &raw mut value), ANCF14_OK);
        ancf14_free(arm);
    }
    value
}

/// Eight threads, each with simulations of its own: the bits of one after the other.
#[test]
fn simulations_in_threads_do_not_meet() {
    let forces: Vec<f64> = (0..8).map(f64::from).collect();
    let alone: Vec<f64> = forces.iter().map(|force| tip(*force)).collect();
    assert!(alone.is_sorted_by(|a, b| a < b), "the force acts: {alone:?}");
    let threads: Vec<_> = forces.iter().copied().map(|force| std::thread::spawn(move || tip(force))).collect();
    let together: Vec<f64> = threads.into_iter().map(|thread| thread.join().unwrap()).collect();
    assert_eq!(together, alone);
}
