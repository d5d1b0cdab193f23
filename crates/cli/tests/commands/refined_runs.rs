//! Does `run` repeat itself until it is accurate, and does the folder have the rows of one whole run at every moment? A
//! program that is killed in a repetition must leave those of the run before.

use super::command_line::{ancf14, text};
use std::fs;
use std::path::Path;

/// A mass on a spring, coarse enough that its first run is not accurate.
const MOUNT: &str = "format = 1\n[model]\nname = \"Mount\"\ngravity = [0, 0, -9.81]\n\
    [body.mass]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
    [joint.mount]\ntype = \"bushing\"\na = \"ground\"\nb = \"mass\"\nstiffness = [1e2, 1e2, 1e2]\n\
    rotational_stiffness = [1e2, 1e2, 1e2]\n\
    [output.motion]\nat = \"mass\"\nquantities = [\"position\"]\n\
    [simulation]\nstop = 5\noutput_step = 0.25\naccuracy = 0.03\n";

fn run(directory: &Path, more: &[&str]) -> (String, String) {
    fs::write(directory.join("mount.toml"), MOUNT).unwrap();
    let ran = ancf14(directory, &[&["run", "mount.toml", "-o", "out"], more].concat());
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    (text(&ran.stdout).to_owned(), text(&ran.stderr).to_owned())
}

/// The largest error of the rows, m: `z = -g/ω² (1 - cos ωt)` with `ω = 10 rad/s`.
fn error(directory: &Path) -> f64 {
    let table = fs::read_to_string(directory.join("out/results.csv")).unwrap();
    let error = |row: &str| {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        (cells[3] + 0.0981 * (1.0 - (10.0 * cells[0]).cos())).abs()
    };
    table.lines().skip(1).map(error).fold(0.0, f64::max)
}

/// The results are those of the last run, right to 0.5 % of 0.196 m, and without a warning; a run that
/// is not asked for it warns of those of the first one.
#[test]
fn runs_are_repeated_until_they_are_accurate() {
    let directory = tempfile::tempdir().unwrap();
    let (once, warned) = run(directory.path(), &[]);
    let first = error(directory.path());
    assert!(!once.contains("runs, ") && warned.contains("because of the length of the steps"), "{once}{warned}");
    let (told, warned) = run(directory.path(), &["--refine"]);
    let last = error(directory.path());
    println!("{first:e} m, {last:e} m");
    assert!(told.contains(" runs, accuracy of the steps reached: 0.") && warned.is_empty(), "{told}{warned}");
    assert!(first > 2e-3 && last < 0.005 * 0.196, "{first} {last}");
    for file in ["results.next.csv", "results.part.csv"] {
        assert!(!directory.path().join("out").join(file).exists(), "{file}");
    }
}

/// A file that has neither steps nor an accuracy asks for it, too: 95 vibrations, whose phase the first run loses.
#[test]
fn free_steps_are_refined() {
    let directory = tempfile::tempdir().unwrap();
    let free = MOUNT.replace("accuracy = 0.03\n", "").replace("stop = 5\n", "stop = 60\n");
    fs::write(directory.path().join("mount.toml"), free).unwrap();
    let told = |more: &[&str]| {
        let ran = ancf14(directory.path(), &[&["run", "mount.toml", "-o", "out"], more].concat());
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        (text(&ran.stdout), text(&ran.stderr))
    };
    let (once, warned) = told(&["--no-refine"]);
    assert!(!once.contains(" runs, ") && warned.contains("because of the length of the steps"), "{once}{warned}");
    let (told, warned) = told(&[]);
    assert!(told.contains("2 runs, accuracy of the steps reached: 0.") && warned.is_empty(), "{told}{warned}");
    assert!(error(directory.path()) < 0.005 * 0.196);
}

/// A budget that no repetition fits leaves the first run with its own warnings; the page and the summary have them.
#[test]
fn a_budget_is_kept() {
    let directory = tempfile::tempdir().unwrap();
    let (told, warned) = run(directory.path(), &["--refine", "--budget=1"]);
    assert!(told.contains("1 run, ") && warned.contains("because of the length of the steps"), "{told}{warned}");
    let summary = fs::read_to_string(directory.path().join("out/summary.json")).unwrap();
    assert!(summary.contains("because of the length of the steps"), "{summary}");
    let refused = ancf14(directory.path(), &["run", "mount.toml", "--budget=0"]);
    assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains("like 20"), "{}", text(&refused.stderr));
}

/// A beam without `elements` asks for it: its run is repeated without an option, and `--no-refine` runs once.
#[test]
fn free_meshes_are_refined() {
    let directory = tempfile::tempdir().unwrap();
    let made = ancf14(directory.path(), &["new", "free"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let run = |more: &[&str]| {
        let ran = ancf14(directory.path(), &[&["run", "free.toml", "--set", "simulation.stop=0.2"], more].concat());
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        text(&ran.stdout)
    };
    let told = run(&[]);
    assert!(told.contains(" elements, accuracy reached: 0."), "{told}");
    assert!(!run(&["--no-refine"]).contains("accuracy reached"));
}

/// The next run clears the rows that a killed repetition has left.
#[test]
fn rows_of_a_killed_repetition_are_cleared() {
    let directory = tempfile::tempdir().unwrap();
    run(directory.path(), &["--refine"]);
    let next = directory.path().join("out/results.next.csv");
    fs::write(&next, "time\n0\n").unwrap();
    run(directory.path(), &[]);
    assert!(!next.exists());
}

/// The ranges along a beam are those of the run that is kept, between its rows too, also where the run is repeated with
/// finer meshes; they have a chart on the page and no columns, and the next run without them removes them.
#[test]
fn ranges_are_those_of_the_last_run() {
    let directory = tempfile::tempdir().unwrap();
    let model = |summary: &str| {
        format!(
            "format = 1\n[model]\nname = \"Hit\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
             [section.rod]\nshape = \"circle\"\nradius = 0.01\n\
             [beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
             [load.hit]\nat = \"arm.end\"\nforce = [0, 0, \"20*sin(200*t)\"]\n\
             [output.all]\non = \"arm\"\nstations = 3\nquantities = [\"velocity\"]\n\
             [output.graph]\non = \"arm\"\nstations = 3\nquantities = [\"velocity\"]\n{summary}\n\
             [simulation]\nstop = 0.2\noutput_step = 0.01\ntotals = []\naccuracy = 0.05\n"
        )
    };
    let run = |summary: &str| {
        fs::write(directory.path().join("m.toml"), model(summary)).unwrap();
        let ran = ancf14(directory.path(), &["run", "m.toml", "-o", "out"]);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        text(&ran.stdout).to_owned()
    };
    let read = |name: &str| fs::read_to_string(directory.path().join("out").join(name)).unwrap();
    let told = run("summary = \"range\"");
    assert!(told.contains(" runs, "), "the run is repeated: {told}");
    let (table, ranges) = (read("results.csv"), read("ranges.csv"));
    assert!(!table.contains("graph."), "{table}");
    let summary: serde_json::Value = serde_json::from_str(&read("summary.json")).unwrap();
    let columns = &summary["columns"];
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    for (k, line) in ranges.lines().skip(1).enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[..3], ["graph.velocity", &*format!("{}", k % 3 + 1), ["0", "0.5", "1"][k / 3]]);
        let column = rows.iter().map(|row| row[k + 1]);
        let [low, high] = [column.clone().fold(f64::INFINITY, f64::min), column.fold(f64::NEG_INFINITY, f64::max)];
        let [lowest, highest] = [cells[3], cells[5]].map(|cell| cell.parse::<f64>().unwrap());
        assert!(lowest <= low && high <= highest, "{line}");
        // The summary leaves out what lies beyond the rows by less than 0.1 % of the range.
        let told = ["minimum", "maximum"].map(|key| columns[k][key]["value"].as_f64().unwrap());
        let margin = 1e-3 * (highest - lowest) + 1e-12;
        assert!((lowest - told[0]).abs() <= margin && (highest - told[1]).abs() <= margin, "{line} {told:?}");
    }
    assert_eq!(ranges.lines().count(), 10);
    let page = read("index.html");
    assert!(page.contains("href=\"ranges.csv\"") && page.contains(&read("graph.velocity.3.svg")));
    run("");
    assert!(!directory.path().join("out/ranges.csv").exists());
}

/// A rod on the sharp edge of a box, which eight elements cannot bend around. `run` says that it begins anew, and leaves
/// the rows of the whole run; `tune` and `export` find the same way.
#[test]
fn runs_that_fail_on_a_mesh_of_the_program_begin_anew() {
    const ROD: &str = "format = 1\n[model]\nname = \"Rod\"\ngravity = [0, 0, 0]\n\
        [section.rod]\nshape = \"rigidities\"\nEA = 5.9e6\nEI_y = 13.4\nEI_z = 13.4\nGJ = 10\nline_density = 0.22\n\
        outer_diameter = 0.006\n[beam.rod]\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [0.5, 0, 0]\n\
        [surface.block]\nshape = \"box\"\nsize = [0.2, 0.2, 0.1]\noffset = [0.5, 0, -0.053]\n\
        [contact.edge]\nof = \"rod\"\nwith = \"block\"\n\
        [frame.slide]\nposition = [\"0.15*max(t - 1, 0)\", 0, \"-0.02*min(t, 1)\"]\n\
        [joint.clamp]\ntype = \"weld\"\na = \"slide\"\nb = \"rod.start\"\n\
        [output.root]\nat = \"clamp\"\nquantities = [\"reaction_force\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 2\noutput_step = 0.02\n";
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("rod.toml"), ROD).unwrap();
    let ran = ancf14(path, &["run", "rod.toml", "-o", "out"]);
    let (out, err) = (text(&ran.stdout), text(&ran.stderr));
    assert!(ran.status.success() && out.contains("the run failed with fewer elements (") && out.contains("began anew"));
    assert!(!err.contains("error:"), "{err}");
    let rows = fs::read_to_string(path.join("out/results.csv")).unwrap().lines().count();
    assert_eq!(rows, 102);
    assert!(!path.join("out/results.next.csv").exists());
    for command in [&["tune", "rod.toml"][..], &["export", "rod.toml", "--vtk", "vtk"]] {
        let ran = ancf14(path, command);
        assert!(ran.status.success(), "{command:?}: {}", text(&ran.stderr));
    }
    let given = ancf14(path, &["run", "rod.toml", "-o", "given", "--set", "rod.elements=8"]);
    assert!(!given.status.success(), "{}", text(&given.stdout));
}
