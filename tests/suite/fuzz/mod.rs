//! Random inputs of two kinds, model files and sequences of calls: whatever they are, the library must answer with
//! results or with sentences. A test tries a few seeds in every run of the suite.
//! `ANCF14_FUZZ_SECONDS=600 cargo test --release --test suite fuzz` tries as many as fit into that time for each kind;
//! `ANCF14_FUZZ_SEED=N` begins with seed N. docs/fuzzing.md tells more.

mod models;
mod mutations;
pub mod requirements;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// A long round ends after this many failures: they have few causes.
const MOST_FAILURES: usize = 20;

/// What a round has seen.
#[derive(Default)]
struct Tally {
    inputs: u64,
    failures: Vec<String>,
    slowest: (Duration, u64),
}

/// Tries inputs by their seeds, `count` of them or as many as the time in `ANCF14_FUZZ_SECONDS` allows, and fails if
/// any of them did. Returns the number of inputs.
pub fn round(name: &str, count: u64, mut attempt: impl FnMut(u64) -> Result<(), String>) -> u64 {
    let limit = variable("ANCF14_FUZZ_SECONDS").map(Duration::from_secs);
    let first = variable("ANCF14_FUZZ_SEED").unwrap_or(1);
    let (mut tally, begin) = (Tally::default(), Instant::now());
    for seed in first.. {
        let is_over = limit.map_or(tally.inputs >= count, |limit| begin.elapsed() >= limit);
        if is_over || tally.failures.len() >= MOST_FAILURES {
            break;
        }
        let start = Instant::now();
        if let Err(problem) = caught(|| attempt(seed)) {
            tally.failures.push(format!("{name}, seed {seed}: {problem}"));
        }
        tally.slowest = tally.slowest.max((start.elapsed(), seed));
        tally.inputs += 1;
    }
    let Tally { inputs, failures, slowest: (time, seed) } = tally;
    println!("{name}: {inputs} inputs in {:.0?}; the slowest, seed {seed}, took {time:.1?}", begin.elapsed());
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
    inputs
}

/// A panic as an error.
fn caught<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| {
        let words = payload.downcast_ref::<String>().map(String::as_str);
        Err(format!("a panic: {}", words.or(payload.downcast_ref::<&str>().copied()).unwrap_or("without a message")))
    })
}

/// A whole number in the environment.
fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name} is not a whole number: {text}")))
}
