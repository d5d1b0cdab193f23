//! Do functions of the file have the values and derivatives that mathematics gives them, do steps end at the corners of
//! tables, and is a table in a file the same as its rows in the model? A wrong derivative would spoil the velocities of
//! a drive; a step across a corner would lose accuracy; rows that change on their way into the flat text would change
//! the results of an FMU.

use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::expression::function::Function;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::simulation::Simulation;
use ancf14_testing::running;
use std::fs;
use std::path::{Path, PathBuf};

/// A body on a slide that a function drives.
fn driven(functions: &str, value: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Driven"
[parameters]
gain = 2
{functions}
[body.block]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.slide]
type = "prismatic"
a = "ground"
b = "block"
axis = [1, 0, 0]
[load.push]
at = "block"
force = ["{value}", 0, 0]
[output.motion]
at = "block"
quantities = ["position", "velocity"]
[simulation]
stop = 2
step = 0.1
"#
    )
}

/// The force as a function of time.
fn force(text: &str) -> Function {
    let document = Document::parse("m.toml", text, &[]).unwrap_or_else(|message| panic!("{message}"));
    document.function(document.loads[0].force[0])
}

fn message(text: &str) -> String {
    Document::parse("m.toml", text, &[]).map(|_| ()).expect_err("a mistake").to_string()
}

fn assert_near(actual: f64, expected: f64, error: f64, what: &str) {
    assert!((actual - expected).abs() <= error, "{what}: {actual} is not {expected}");
}

/// A function of a function of t, with a parameter: its value by hand.
#[test]
fn functions_call_functions() {
    let functions =
        "[function.ramp]\nargument = \"t\"\nvalue = \"gain*square(t - 1)\"\n[function.square]\nvalue = \"x^2\"";
    let function = force(&driven(functions, "ramp(2*t) + square(3)"));
    // 2 (2t - 1)^2 + 9
    for t in [0.0, 0.3, 1.7] {
        let jet = function.jet(t);
        let u = 2.0 * t - 1.0;
        for (actual, expected) in [(jet.value, 2.0 * u * u + 9.0), (jet.first, 8.0 * u), (jet.second, 16.0)] {
            // Rounding of some ten operations on numbers up to 30.
            assert_near(actual, expected, 1e-13, &format!("at {t}"));
        }
    }
    let overridden = Document::parse("m.toml", &driven(functions, "ramp(t)"), &[("gain".into(), "4".into())]).unwrap();
    assert_eq!(overridden.function(overridden.loads[0].force[0]).value(0.0), 4.0);
}

const ROWS: &str = "table = [[0, 1], [0.5, 2], [0.75, 2], [1.5, -1], [2.5, 0.5]]";

/// First and second derivatives of both interpolations, through a curved argument, by central differences of the value
/// and the first derivative.
#[test]
fn derivatives_are_those_of_the_values() {
    for interpolation in ["linear", "monotone"] {
        for outside in ["hold", "repeat", "error"] {
            let functions = format!(
                "[function.wind]\n{ROWS}\ninterpolation = \"{interpolation}\"\noutside = \"{outside}\"\n[function.again]\nvalue = \"wind(x)^2\""
            );
            let function = force(&driven(&functions, "gain*again(1.2 + sin(t))"));
            for t in [0.1, 0.4, 0.9, 1.3, 1.9] {
                // Central differences of h = 1e-5 miss h^2 f''' (up to 1e3 here) and divide round-off of 1e-15 by h.
                let h = 1e-5;
                let (before, after, jet) = (function.jet(t - h), function.jet(t + h), function.jet(t));
                assert_near(
                    jet.first,
                    (after.value - before.value) / (2.0 * h),
                    1e-7,
                    &format!("{interpolation} f'({t})"),
                );
                assert_near(
                    jet.second,
                    (after.first - before.first) / (2.0 * h),
                    1e-7,
                    &format!("{interpolation} f''({t})"),
                );
            }
        }
    }
}

/// Rows are reproduced exactly; between two rows a monotone table stays between their values and rises where they rise.
#[test]
fn tables_reproduce_their_rows_and_keep_monotone() {
    // A steep interval next to flat ones: any other mean of the slopes overshoots.
    let rows = [(0.0, 1.0), (0.5, 2.0), (0.75, 2.0), (0.8, 8.0), (1.5, 9.0), (2.5, 0.5)];
    let table = format!("[function.wind]\ntable = {:?}", rows.map(|(x, y)| [x, y]));
    for interpolation in ["linear", "monotone"] {
        let function = force(&driven(&format!("{table}\ninterpolation = \"{interpolation}\""), "wind(t)"));
        for (x, y) in rows {
            assert_eq!(function.value(x), y, "{interpolation}");
        }
        for pair in rows.windows(2) {
            let [(x0, y0), (x1, y1)] = pair else { unreachable!() };
            for k in 1..40 {
                let jet = function.jet(x0 + (x1 - x0) * f64::from(k) / 40.0);
                let (low, high) = (y0.min(*y1), y0.max(*y1));
                assert!((low..=high).contains(&jet.value), "{interpolation}: {} leaves [{low}, {high}]", jet.value);
                assert!(jet.first * (y1 - y0) >= 0.0, "{interpolation} is not monotone");
            }
        }
        // Outside: held.
        for (x, y) in [(-3.0, 1.0), (7.0, 0.5)] {
            let jet = function.jet(x);
            assert_eq!((jet.value, jet.first, jet.second), (y, 0.0, 0.0));
        }
    }
    let between = force(&driven(&table, "wind(t)")).jet(0.25);
    assert_eq!((between.value, between.first, between.second), (1.5, 2.0, 0.0));
}

/// A table of one period is the same in every other one, also before its first row; joined ends of a monotone one have
/// one derivative.
#[test]
fn tables_repeat() {
    let text = |interpolation: &str| {
        let table = "table = [[1, 0], [1.25, 2], [1.75, -2], [2, 0]]\noutside = \"repeat\"";
        driven(&format!("[function.wave]\n{table}\ninterpolation = \"{interpolation}\""), "wave(t)")
    };
    for interpolation in ["linear", "monotone"] {
        let wave = force(&text(interpolation));
        for x in [1.0, 1.125, 1.25, 1.6, 1.9] {
            for period in [-3.0, 1.0, 40.0] {
                // Rounding of x + 40, times the slope of 8.
                assert_near(wave.value(x + period), wave.value(x), 1e-12, &format!("{interpolation} {x} + {period}"));
            }
        }
        let jumps = (wave.jet(2.0).first - wave.jet(2.0_f64.next_down()).first).abs();
        // The second derivative is some hundreds, the step to the next number below 2 is 2e-16.
        assert!(jumps < 1e-12, "{interpolation}: {jumps}");
    }
    assert!(force(&text("monotone")).breaks([0.0, 2.0]).is_empty());
    // Both ends have the slope 8: no corner of the values, but steps may end there.
    assert_eq!(force(&text("linear")).breaks([0.0, 2.0]), [0.0, 0.25, 0.75, 1.0, 1.25, 1.75, 2.0]);
}

/// Corners in time are where the argument reaches a row, through expressions and functions; a piece has only those of
/// its own time.
#[test]
fn corners_of_tables_are_breaks() {
    let functions = format!("[function.wind]\n{ROWS}\n[function.later]\nvalue = \"wind(2*x - gain) + 1\"");
    let breaks = |value: &str| force(&driven(&functions, value)).breaks([0.0, 2.0]);
    assert_eq!(breaks("wind(t)"), [0.0, 0.5, 0.75, 1.5, 2.5]);
    assert_eq!(breaks("3*later(t)"), [1.0, 1.25, 1.375, 1.75, 2.25]);
    assert_eq!(breaks("wind(1 - t)"), [-1.5, -0.5, 0.25, 0.5, 1.0]);
    assert_eq!(breaks("wind(t^2)"), [0.0; 0]);
    let smooth = force(&driven(&format!("[function.wind]\n{ROWS}\ninterpolation = \"monotone\""), "wind(t)"));
    assert_eq!(smooth.breaks([0.0, 2.0]), [0.0, 2.5], "the ends only");
    let pieces = driven(&functions, "0").replace("\"0\"", "[{ until = 0.6, is = \"wind(t)\" }, { is = 0 }]");
    assert_eq!(force(&pieces).breaks([0.0, 2.0]), [0.0, 0.5, 0.6]);
}

/// The momentum after a pulse given by rows is its area, although no step of 0.1 s hits the rows.
#[test]
fn steps_end_at_rows() {
    let functions = "[function.pulse]\ntable = [[0.13, 0], [0.17, 8], [0.21, 0]]";
    let mut simulation = running::start(&driven(functions, "pulse(t)"));
    running::run(&mut simulation, 0.5, 1.0, |_| {});
    // The midpoint rule integrates straight lines exactly: round-off of the steps is left, on numbers of 1.
    assert_near(running::value(&simulation, "motion.velocity[1]"), 0.5 * 0.08 * 8.0, 1e-12, "momentum");
}

/// A table that ends is told when the file is read, if a constant or an end of the run asks for more; else the step
/// fails with the reason.
#[test]
fn a_table_may_end() {
    let functions = "[function.wind]\ntable = [[0, 1], [1, 5]]\noutside = \"error\"";
    assert!(message(&driven(functions, "wind(t)")).contains("wind(2) is outside of its table, which runs from 0 to 1"));
    assert!(message(&driven(functions, "wind(-1)")).contains("wind(-1) is outside of its table"));
    let told = |value: &str| {
        let mut simulation = running::start(&driven(functions, value));
        simulation.advance(2.0).expect_err("the table ends").message
    };
    let failure = told("wind(2.5*sin(t*pi/2)^2)");
    assert!(failure.contains("the force or moment of load push, where wind(1."), "{failure}");
    assert!(failure.contains("is outside of its table, which runs from 0 to 1, is not a finite number"), "{failure}");
    // A condition may keep away from the end.
    running::run(&mut running::start(&driven(functions, "if(t < 1, wind(min(t, 1)), 0)")), 1.0, 2.0, |_| {});
}

/// Circles are refused with their names, whatever else is called.
#[test]
fn circles_are_refused() {
    let functions = "[function.a]\nvalue = \"1 + b(x)\"\n[function.b]\nvalue = \"c(x)\"\n[function.c]\nvalue = \"b(x) + d(x)\"\n[function.d]\nvalue = \"x\"";
    let text = message(&driven(functions, "a(t)"));
    assert!(text.contains("the functions b -> c -> b need each other"), "{text}");
    assert_eq!(text.matches("error:").count(), 1, "{text}");
    assert!(
        message(&driven("[function.a]\nvalue = \"a(x)\"", "a(t)")).contains("the functions a -> a need each other")
    );
}

/// Functions that call one another twice would take 2^30 operations: they are refused, and so are chains without end.
#[test]
fn work_is_bounded() {
    let chain = |times: &str, length: usize| {
        let link =
            |k: usize| format!("[function.f{k}]\nvalue = \"{}\"\n", times.replace('#', &format!("f{}(x)", k + 1)));
        let functions: String = (0..length).map(link).chain([format!("[function.f{length}]\nvalue = \"x\"")]).collect();
        driven(&functions, "f0(t)")
    };
    assert!(message(&chain("# + #", 25)).contains("too long or call one another too deeply"));
    assert!(message(&chain("#", 40)).contains("too long or call one another too deeply"));
    assert_eq!(force(&chain("# + #", 10)).value(3.0), 3.0 * 1024.0);
}

fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("functions-{test}"));
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn parse(folder: &Path, overrides: &[(&str, &str)]) -> Result<Document, String> {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let text = fs::read_to_string(folder.join("m.toml")).unwrap();
    Document::parse_in(Some(Folder::new(folder, Reach::Inside)), "m.toml", &text, &overrides)
        .map_err(|mistakes| mistakes.to_string())
}

const GUST: &str = "time [s],speed [m/s],gust [m/s]\n0,1,0\n0.3,2.5,1e-1\n1.1,0.125,0.7\n";

/// The results of a model with a table in a file are, byte for byte, those of its flat text, which needs no file.
#[test]
fn tables_in_files_are_those_of_the_flat_text() {
    let text = driven("[function.wind]\nfile = \"data/wind.csv\"\ncolumn = \"gust\"", "wind(t)");
    let folder = folder("file", &[("m.toml", &text), ("data/wind.csv", GUST), ("calm.csv", "x,gust\n0,0\n1,0.5\n")]);
    let flat = parse(&folder, &[]).unwrap_or_else(|message| panic!("{message}")).text().to_owned();
    assert!(flat.contains("table = [[0.0, 0.0], [0.3, 0.1], [1.1, 0.7]]"), "{flat}");
    assert_eq!(Document::parse("m.toml", &flat, &[]).unwrap_or_else(|message| panic!("{message}")).text(), flat);
    let positions = |mut simulation: Simulation| {
        simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let mut positions = Vec::new();
        running::run(&mut simulation, 0.1, 2.0, |now| {
            positions.push(running::value(now, "motion.position[1]").to_bits())
        });
        positions
    };
    let load = |folder: Option<&Path>, text: &str| {
        Simulation::load_in(folder.map(|path| Folder::new(path, Reach::Inside)), "m.toml", text, &[])
            .unwrap_or_else(|failure| panic!("{}", failure.message))
    };
    let from_file = positions(load(Some(&folder), &text));
    assert!(from_file.iter().any(|bits| f64::from_bits(*bits) > 0.1));
    assert_eq!(from_file, positions(load(None, &flat)));
    // The second column is the default, and the file can be set.
    let text = text.replace("column = \"gust\"", "");
    fs::write(folder.join("m.toml"), &text).unwrap();
    assert!(parse(&folder, &[]).unwrap().text().contains("[0.3, 2.5]"));
    assert!(parse(&folder, &[("wind.file", "calm.csv")]).unwrap().text().contains("table = [[0.0, 0.0], [1.0, 0.5]]"));
}

/// Mistakes in a file are told there, with line and column.
#[test]
fn mistakes_in_files_are_told_there() {
    let text = driven("[function.wind]\nfile = \"wind.csv\"\ncolumn = \"gust\"", "wind(t)");
    for (test, data, expected) in [
        (
            "column",
            "time,speed\n0,1\n1,2\n",
            &["the file has no column `gust`", "m.toml:8:10", "known: time, speed"][..],
        ),
        ("number", "time,gust\n0,1\n1,2 m\n", &["`2 m` is not a finite number", "wind.csv:3:3"]),
        ("descent", "time,gust\n0,1\n2,2\n1,2\n", &["do not ascend", "wind.csv:4:1", "1 comes after 2"]),
        ("short", "time,gust\n0,1\n", &["has 1 row(s)", "at least 2 rows"]),
        ("cells", "time,gust\n0,1\n1,2,3\n", &["this row has 3 cell(s)", "wind.csv:3:1"]),
        ("header", "0,1\n1,2\n", &["the table has no header", "wind.csv:1:1"]),
    ] {
        let folder = folder(test, &[("m.toml", &text), ("wind.csv", data)]);
        let message = parse(&folder, &[]).err().unwrap_or_else(|| panic!("{test} was taken"));
        for expected in expected {
            assert!(message.contains(expected), "{test}: {expected} is not in\n{message}");
        }
    }
    let long: String = (0..=100_000).map(|k| format!("{k},0\n")).collect();
    let folder = folder("long", &[("m.toml", &text), ("wind.csv", &format!("time,gust\n{long}"))]);
    let message = parse(&folder, &[]).expect_err("too long");
    assert!(message.contains("the table has 100001 rows") && message.contains("wind.csv:100002:1"), "{message}");
    assert!(message.contains("the limit is 100000"), "{message}");
    fs::remove_file(folder.join("wind.csv")).unwrap();
    let message = parse(&folder, &[]).expect_err("missing");
    assert!(message.contains("cannot read") && message.contains("m.toml:7:8"), "{message}");
}

/// Functions of an included file keep to themselves: their names begin with that of the include, and their expressions
/// use its parameters.
#[test]
fn functions_of_included_files_are_their_own() {
    let part =
        "format = 1\n[parameters]\ngain = 5\n[function.f]\nvalue = \"gain*g(x)\"\n[function.g]\nfile = \"g.csv\"\n";
    let own = "[function.f]\nvalue = \"gain*x\"\n[include.part]\nfile = \"parts/part.toml\"";
    let text = driven(own, "f(1) + 10*part_f(1)");
    let files = [("m.toml", text.as_str()), ("parts/part.toml", part), ("parts/g.csv", "x,y\n0,0\n1,3\n")];
    let document = parse(&folder("include", &files), &[]).unwrap_or_else(|message| panic!("{message}"));
    assert_eq!(document.value(document.loads[0].force[0]), 2.0 + 10.0 * 15.0);
    let hidden = part.replace("gain*g(x)", "gain*x").replace("gain = 5", "gain = 5\nx = 1");
    let files = [("m.toml", text.as_str()), ("parts/part.toml", hidden.as_str()), ("parts/g.csv", "x,y\n0,0\n1,3\n")];
    let message = parse(&folder("hidden", &files), &[]).expect_err("x is a parameter of the part");
    assert!(message.contains("`x` is both the argument of the function f and a number"), "{message}");
}

/// In copies each function knows the index.
#[test]
fn functions_in_copies_know_the_index() {
    let own = "[copy.pushes]\ncount = 2\n[copy.pushes.function.f]\nvalue = \"k*gain*x\"\n[copy.pushes.load.more]\nat = \"block\"\nforce = [\"f(t)\", 0, 0]\n";
    let document = Document::parse("m.toml", &driven(own, "0"), &[]).unwrap_or_else(|message| panic!("{message}"));
    let forces: Vec<f64> = document.loads.iter().map(|load| document.function(load.force[0]).value(1.5)).collect();
    assert!(forces.contains(&3.0) && forces.contains(&6.0), "{forces:?}");
}

/// The example of docs/language/expressions.md: the mast bends under the gust, in the direction of the wind.
#[test]
fn the_page_has_an_example_that_runs() {
    let page = include_str!("../../../docs/language/expressions.md");
    let rest = page.split("## Functions and tables").nth(1).expect("the section");
    let example = rest.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the example");
    let mut simulation = running::start(example);
    running::run(&mut simulation, 0.5, 0.5, |_| {});
    // 12 * 6.1^2 = 450 N at 0.55 s bend 5 m of EI = 3.5e5 N m2 by 5 cm, were the force constant: half of that after the
    // first half of the gust.
    let top = running::value(&simulation, "top.displacement[1]");
    assert!((0.005..0.1).contains(&top), "{top}");
}
