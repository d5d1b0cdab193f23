//! Is the file of a linear system that somebody has spoilt refused with a sentence, and never a crash?

use super::oscillator;
use crate::random::Random;
use ancf14::fmi::Model;
use ancf14::fmi::continuous::Inputs;
use ancf14::linear::Unit;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Numbers at the limits of what a number can be, and what is none.
const EXTREMES: [&str; 16] = [
    "0",
    "-1",
    "5e-324",
    "1e-300",
    "1e150",
    "1e308",
    "-1.7e308",
    "nan",
    "inf",
    "1e999",
    "9223372036854775808",
    "true",
    "\"x\"",
    "[]",
    "{}",
    "[[]]",
];

fn spoilt(text: &str, random: &mut Random) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=random.below(2) {
        let number = random.below(lines.len());
        match random.below(5) {
            0 => drop(lines.remove(number)),
            1 => lines.insert(number, lines[random.below(lines.len())].clone()),
            2 => {
                let mut letters: Vec<char> = lines[number].chars().collect();
                if !letters.is_empty() {
                    let at = random.below(letters.len());
                    letters[at] = ['[', ']', '"', '.', '\u{0}', '9', '=', 'e'][random.below(8)];
                }
                lines[number] = letters.into_iter().collect();
            }
            _ => {
                let words: Vec<&str> = lines[number].split_inclusive([' ', ',', '[']).collect();
                let at = random.below(words.len().max(1));
                let extreme = EXTREMES[random.below(EXTREMES.len())];
                let words = words.iter().enumerate().map(|(index, word)| if index == at { extreme } else { *word });
                lines[number] = words.collect::<Vec<_>>().join("");
            }
        }
        if lines.is_empty() {
            break;
        }
    }
    lines.join("\n")
}

/// Runs what can be read; returns whether it could be.
fn run(text: &str) -> bool {
    match Unit::load("linear.toml", text) {
        Err(failure) => {
            let message = failure.message;
            assert!(message.contains("pack the FMU again"), "{message}");
            false
        }
        Ok(mut unit) => {
            let _ = unit.initialize(0.0);
            for (number, end) in [1e-3, 2e-3, 1.0, 1e9, 1e200].into_iter().enumerate() {
                unit.set_input_derivative(0, 1.0);
                let _ = unit.advance(end);
                let inputs = if number % 2 == 0 { Inputs::Set } else { Inputs::Last };
                let _ = unit.continuous().unwrap().evaluate(inputs);
                let count = unit.variables().len();
                for reference in 0..count {
                    let value = unit.value(reference).number();
                    assert!(value.is_finite(), "{value} after {number} steps of\n{text}");
                    let _ = unit.output_derivative(reference);
                    let _ = (0..count).map(|input| unit.partial_derivative(reference, input)).count();
                }
            }
            true
        }
    }
}

#[test]
fn spoilt_files_are_no_crash() {
    let good = oscillator().text();
    assert!(run(&good));
    let mut random = Random(7);
    let mut read = 0;
    for _ in 0..600 {
        let text = spoilt(&good, &mut random);
        let outcome = catch_unwind(AssertUnwindSafe(|| run(&text)));
        read += usize::from(outcome.unwrap_or_else(|_| panic!("a crash with\n{text}")));
    }
    println!("{read} of 600 could still be read");
    assert!((60..540).contains(&read), "{read}: most changes do nothing, or all are refused");
}

/// The sentences of plain mistakes.
#[test]
fn mistakes_are_named() {
    let good = oscillator().text();
    for (old, new, words) in [
        ("format = 1", "format = 2", "its format is 2, and this library reads format 1"),
        ("stop = ", "stopp = ", "`stop` is missing"),
        ("output_step = 0.01", "output_step = -1", "`output_step` is -1, and must be positive"),
        ("  [0.0, 1.0],\n", "", "`a` is not a list of 1 rows with 1 finite numbers each"),
        ("[0.0, 1.0]", "[0.0, inf]", "`a` is not a list of 2 rows with 2 finite numbers each"),
        ("value = 0.3", "value = \"x\"", "`value` is not a finite number"),
        ("states = [", "states = [1, ", "`states` is not a list of 2 texts"),
        ("name = \"x.velocity\"", "", "`name` is missing"),
        ("[[input]]", "[[inputs]]", "`b` is not a list of 2 rows with 0 finite numbers each"),
    ] {
        assert!(good.contains(old), "{good}");
        let failure = Unit::load("linear.toml", &good.replacen(old, new, 1)).unwrap_err();
        assert!(failure.message.contains(words), "{}", failure.message);
        assert!(failure.message.starts_with("linear.toml is not the file of a linear system: "), "{}", failure.message);
    }
    let failure =
        Unit::load("linear.toml", &good.replace("[0.0, 1.0]", &format!("[{}]", "[".repeat(100_000)))).unwrap_err();
    assert!(failure.message.len() < 500, "{}", failure.message);
}
