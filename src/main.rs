//! A stand-in for the command line: `run`, `pack`, `header` with their documented arguments and nothing more.
#![allow(clippy::print_stdout, clippy::print_stderr, clippy::unwrap_used, reason = "a stand-in")]

use std::{fmt::Write, fs, path::Path};

use ancf14::{
    fmi::{Model, Value, header, package, variable::Causality},
    model::simulation::Simulation,
};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str| words.iter().position(|word| word == name).map(|place| words[place + 1].clone());
    let text = fs::read_to_string(&words[1]).unwrap();
    let mut model = Simulation::load(&words[1], &text, &[]).unwrap();
    match words[0].as_str() {
        "pack" => {
            let given = option("--library");
            let library = package::find_library(given.as_deref().map(Path::new), &std::env::current_exe().unwrap());
            let library = library.unwrap_or_else(|error| panic!("{error}"));
            let path = option("-o").unwrap();
            package::write(
                Path::new(&path),
                model.about(),
                model.variables(),
                &text,
                &[(package::Platform::NATIVE, library)],
            )
            .unwrap();
        }
        "header" => {
            let prefix = option("--prefix").unwrap_or(model.about().identifier.clone());
            fs::write(option("-o").unwrap(), header::text(model.about(), model.variables(), &prefix).unwrap()).unwrap();
        }
        "run" => {
            let out = option("--out").unwrap();
            fs::create_dir_all(&out).unwrap();
            let outputs: Vec<usize> = (0..model.variables().len())
                .filter(|place| model.variables()[*place].causality == Causality::Output)
                .collect();
            let mut csv = "time".to_owned();
            for place in &outputs {
                write!(csv, ",{}", model.variables()[*place].name).unwrap();
            }
            model.initialize(0.0).unwrap();
            let step = model.about().output_step;
            let count = (model.about().stop / step).round() as usize;
            for k in 0..=count {
                if k > 0 {
                    model.advance(k as f64 * step).unwrap();
                }
                write!(csv, "\n{:?}", model.time()).unwrap();
                for place in &outputs {
                    match model.value(*place) {
                        Value::Real(number) => write!(csv, ",{number:?}").unwrap(),
                        Value::Integer(number) => write!(csv, ",{number}").unwrap(),
                    }
                }
            }
            fs::write(Path::new(&out).join("results.csv"), csv + "\n").unwrap();
        }
        other => panic!("no command {other}"),
    }
}
