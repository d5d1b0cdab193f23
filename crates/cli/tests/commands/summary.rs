//! Does summary.json say what is in results.csv, and does the terminal show its extremes? A wrong column, a wrong time
//! or an old run would mislead a program that reads nothing else.

use super::command_line::{ancf14, model, text};
use serde_json::Value;
use std::path::Path;

/// A short run of the crane, which warns of nothing and has vectors, scalars and inputs that drives set.
const SHORT: [&str; 4] = ["--set", "simulation.stop=0.5", "--set", "simulation.output_step=0.05"];

fn run(directory: &Path, file: &str, more: &[&str]) -> std::process::Output {
    ancf14(directory, &[&["run", file, "-o", "out"], more].concat())
}

fn summary(directory: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(directory.join("out/summary.json")).unwrap()).unwrap()
}

/// Whether a number of a document is this one: serde_json reads numbers to the last bit but one.
fn is_read(number: &Value, value: f64) -> bool {
    (number.as_f64().unwrap() - value).abs() <= 2.0 * f64::EPSILON * value.abs()
}

/// A run of many steps says what keeps them short, on the terminal and for programs; one of few steps does not.
#[test]
fn long_runs_say_what_keeps_their_steps_short() {
    let slider = |stop: f64| {
        format!(
            "format = 1\nmodel = {{ name = \"Fast\", gravity = [0, 0, 0] }}\n\
             body.slider = {{ mass = 1, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1], velocity = [1, 0, 0] }}\n\
             joint.rail = {{ type = \"prismatic\", a = \"ground\", b = \"slider\", axis = [1, 0, 0], stiffness = 4e5 }}\n\
             output.way = {{ at = \"rail\", quantities = [\"distance\"] }}\n\
             simulation = {{ stop = {stop}, output_step = 0.1 }}\n"
        )
    };
    for (stop, is_long) in [(0.4, false), (4.0, true)] {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(directory.path().join("fast.toml"), slider(stop)).unwrap();
        let ran = run(directory.path(), "fast.toml", &["--no-refine"]);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        let summary = summary(directory.path());
        let (steps, limits) = (summary["steps"].as_u64().unwrap(), summary["step_limits"].as_str());
        assert!((steps >= 20_000) == is_long && limits.is_some() == is_long, "{steps} {limits:?}");
        assert!(limits.is_none_or(|limits| limits.contains("mostly because of slider (along x)")), "{limits:?}");
        let line = text(&ran.stdout).lines().find_map(|line| line.strip_prefix("steps: ").map(str::to_owned));
        assert_eq!(line.as_deref(), limits, "{}", text(&ran.stdout));
    }
}

/// Every column has the extremes, their first times and the last value that its numbers in results.csv have; `--json`
/// prints the file.
#[test]
fn the_summary_is_that_of_the_table() {
    // A row for each step: no extreme lies between rows.
    const SHORT: [&str; 4] = ["--set", "simulation.stop=0.5", "--set", "simulation.output_step=5e-3"];
    let directory = tempfile::tempdir().unwrap();
    let ran = run(directory.path(), &model("crane"), &[&SHORT[..], &["--json"]].concat());
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let summary = summary(directory.path());
    assert_eq!(summary, serde_json::from_slice::<Value>(&ran.stdout).unwrap());
    assert!(summary["format"] == 1 && summary["model"] == "Crane" && summary["complete"] == true);
    assert_eq!(summary["errors"].as_array().unwrap().len(), 0);
    assert!(summary["settings"]["simulation.stop"] == "0.5" && summary["stop"] == 0.5 && summary["reached"] == 0.5);
    assert!(summary["wall_time"].as_f64().unwrap() > 0.0);
    for key in ["time_step_errors", "mesh_errors"] {
        let errors = summary[key].as_array().unwrap();
        let shares: Vec<f64> = errors.iter().map(|error| error["of_range"].as_f64().unwrap()).collect();
        let is_named = errors.iter().all(|error| error["quantity"].is_string());
        assert!(shares.len() > 2 && shares.is_sorted_by(|a, b| a >= b) && is_named, "{key}: {errors:?}");
    }

    let table = std::fs::read_to_string(directory.path().join("out/results.csv")).unwrap();
    let alone = run(directory.path(), &model("crane"), &[&SHORT[..], &["--json", "--no-mesh-error"]].concat());
    let summary_alone = serde_json::from_slice::<Value>(&alone.stdout).unwrap();
    assert!(
        summary_alone["mesh_errors"].as_array().unwrap().is_empty() && summary_alone["columns"] == summary["columns"]
    );

    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(summary["rows"], rows.len());
    let columns = summary["columns"].as_array().unwrap();
    assert_eq!(columns.len(), header.len() - 1);
    let mut moving = 0;
    for (place, column) in columns.iter().enumerate() {
        assert_eq!(column["name"], header[place + 1]);
        let values = || rows.iter().map(|row| (row[0], row[place + 1]));
        // Of equal values the first one.
        let low = values().reduce(|low, own| if own.1 < low.1 { own } else { low }).unwrap();
        let high = values().reduce(|high, own| if own.1 > high.1 { own } else { high }).unwrap();
        for (key, (time, value)) in [("minimum", low), ("maximum", high)] {
            assert!(is_read(&column[key]["value"], value), "{column}");
            assert_eq!(column[key]["time"].as_f64(), Some(time), "{column}");
        }
        assert!(is_read(&column["last"], values().next_back().unwrap().1), "{column}");
        moving += usize::from(low.0 > 0.0 && low.0 < 0.5);
    }
    assert!(moving > 2, "extremes between the ends");
    let of = |name: &str| &columns[header.iter().position(|column| *column == name).unwrap() - 1];
    for (key, column) in
        [("steps", "statistics.steps"), ("iterations", "statistics.iterations"), ("rejected", "statistics.rejected")]
    {
        assert_eq!(summary[key].as_f64(), of(column)["last"].as_f64());
    }
    assert_eq!(of("energy.total")["unit"], "J");
}

/// The terminal has a table of a dozen lines at most, whose numbers are those of the summary; `--quiet` prints nothing.
#[test]
fn the_terminal_shows_some_extremes() {
    let directory = tempfile::tempdir().unwrap();
    for name in ["crane", "ring", "cantilever"] {
        let ran = run(directory.path(), &model(name), &SHORT);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        let said = text(&ran.stdout);
        let table: Vec<&str> = said.lines().filter(|line| line.starts_with("  ")).collect();
        assert!((3..=12).contains(&table.len()), "{said}");
        let columns = summary(directory.path())["columns"].as_array().unwrap().clone();
        for line in &table[1..table.len() - 1] {
            let cells: Vec<&str> = line.split_whitespace().collect();
            let column = columns.iter().find(|column| column["name"] == cells[0]).unwrap();
            let highest: f64 = cells[cells.len() - 3].parse().unwrap();
            let exact = column["maximum"]["value"].as_f64().unwrap();
            // Four digits are shown.
            assert!((highest - exact).abs() <= 5e-4 * exact.abs(), "{line}: {exact}");
        }
        let shown = table.len() - 2;
        assert!(table[shown + 1].starts_with(&format!("  {} more column", columns.len() - shown)), "{said}");
    }
    let quiet = run(directory.path(), &model("crane"), &[&SHORT[..], &["--quiet"]].concat());
    assert!(quiet.status.success() && quiet.stdout.is_empty());
}

/// A mass that begins to hang on a spring falls by 2 m g/k, half a period later. Rows that are a period apart show
/// nothing of it: the summary, the table and ranges over time tell it, and a line says that the plots miss it. A table of
/// inputs, whose rows end steps between, changes nothing.
#[test]
fn extremes_between_rows_are_told() {
    let directory = tempfile::tempdir().unwrap();
    // 1 kg on (2 pi)^2 N/m: the period is 1 s.
    let file = "format = 1\n[model]\nname = \"Drop\"\ngravity = [0, 0, -9.81]\n\
        [section.bar]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 1e4\nEI_z = 1e4\nGJ = 1e4\nline_density = 0.001\n\
        [beam.bar]\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
        [body.mass]\nmass = 0.999\nposition = [0.5, 0, 0]\ninertia = [1, 1, 1]\n\
        [joint.hook]\ntype = \"weld\"\na = \"bar@0.5\"\nb = \"mass\"\n\
        [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"bar@0.5\"\naxis = [0, 0, 1]\n\
        [spring.coil]\njoint = \"guide\"\ncoordinate = \"distance\"\nstiffness = 39.47841760435743\n\
        [load.push]\nat = \"mass\"\ninput = true\nforce = [0, 0, 0]\n\
        [output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\", \"velocity\"]\n\
        [output.all]\non = \"bar\"\nstations = 3\nquantities = [\"position\"]\nsummary = \"range\"\n\
        [simulation]\nstop = 3\nstep = 0.01\noutput_step = 1\n";
    std::fs::write(directory.path().join("m.toml"), file).unwrap();
    std::fs::write(directory.path().join("push.csv"), "time,push.force[3]\n0,0\n0.25,0\n0.75,0\n3,0\n").unwrap();
    for inputs in [&[][..], &["--inputs", "push.csv"]] {
        let ran = run(directory.path(), "m.toml", inputs);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        let summary = summary(directory.path());
        let columns = summary["columns"].as_array().unwrap();
        let lowest = &columns.iter().find(|column| column["name"] == "middle.position[3]").unwrap()["minimum"];
        let fall = 2.0 * 9.81 / (2.0 * std::f64::consts::PI).powi(2);
        // The period is longer by (omega h)^2/24 of itself, 1.6e-4; the lowest point is nearer to a step than half of one,
        // within (pi/100)^2/4 of the fall.
        let close = |value: f64| (value + fall).abs() < 5e-4 * fall;
        assert!(close(lowest["value"].as_f64().unwrap()), "{lowest} {fall}");
        assert!((lowest["time"].as_f64().unwrap().fract() - 0.5).abs() < 0.02, "{lowest}");
        let said = text(&ran.stdout);
        assert!(
            said.contains("position[3] has an extreme between its rows")
                && said.contains("set simulation.output_step = 1e-2"),
            "{said}"
        );
        let ranges = std::fs::read_to_string(directory.path().join("out/ranges.csv")).unwrap();
        let header: Vec<&str> = ranges.lines().next().unwrap().split(',').collect();
        let minimum = header.iter().position(|column| *column == "minimum").unwrap();
        let heights: Vec<&str> = ranges.lines().filter(|line| line.split(',').nth(1) == Some("3")).collect();
        assert_eq!(heights.len(), 3, "{ranges}");
        for line in heights {
            assert!(close(line.split(',').nth(minimum).unwrap().parse().unwrap()), "{line}");
        }
    }
}

/// A run that ends early says so in its summary, with the reason, and up to when its extremes reach.
#[test]
fn an_incomplete_run_has_an_incomplete_summary() {
    let directory = tempfile::tempdir().unwrap();
    let load = "\n[load.push]\nat = \"arm.end\"\nforce = [0, 0, \"sqrt(0.005 - t)\"]\n";
    let file = std::fs::read_to_string(model("cantilever")).unwrap() + load;
    std::fs::write(directory.path().join("m.toml"), file).unwrap();
    let ran = run(directory.path(), "m.toml", &["--set", "simulation.output_step=1e-3"]);
    assert_eq!(ran.status.code(), Some(1));
    let summary = summary(directory.path());
    assert!(summary["complete"] == false && summary["reached"] == 0.005, "{summary:#}");
    let reason = summary["errors"][0]["message"].as_str().unwrap();
    assert!(text(&ran.stderr).contains(reason), "{reason}");
}

/// Warnings are in it, also those about errors that further runs have found.
#[test]
fn warnings_are_in_the_summary() {
    let directory = tempfile::tempdir().unwrap();
    let ran = run(directory.path(), &model("pendulum"), &["--set", "simulation.stop=0.2", "--verify=1e-9"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let told: Vec<String> =
        text(&ran.stderr).lines().filter_map(|line| line.strip_prefix("warning: ")).map(str::to_owned).collect();
    assert!(told.iter().any(|warning| warning.contains("miss")), "{told:?}");
    assert_eq!(summary(directory.path())["warnings"], serde_json::json!(told));
}

/// Without totals the table has the columns of the outputs only, the same bytes in each; the summary and the terminal
/// still count the steps.
#[test]
fn tables_without_totals_are_the_rest() {
    let directory = tempfile::tempdir().unwrap();
    let text_of = std::fs::read_to_string(model("pendulum")).unwrap();
    let columns = |file: &str, line: &str| -> Vec<Vec<String>> {
        std::fs::write(directory.path().join(file), format!("{text_of}\n{line}\n")).unwrap();
        let ran = run(directory.path(), file, &["--set", "simulation.stop=0.1", "--verify"]);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        let table = std::fs::read_to_string(directory.path().join("out/results.csv")).unwrap();
        let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split(',').collect()).collect();
        (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column].to_owned()).collect()).collect()
    };
    let all = columns("all.toml", "");
    let steps = summary(directory.path())["steps"].as_u64().unwrap();
    let some = columns("some.toml", "totals = []");
    assert_eq!(all.len() - some.len(), 13);
    assert_eq!(all[..some.len()], some);
    assert_eq!(summary(directory.path())["steps"].as_u64(), Some(steps));
    assert!(steps > 0 && !directory.path().join("out/energy.svg").exists());
}
