//! Counts silently wrong answers and writes docs/campaign.md: `cargo run --release --bin campaign`.
#![allow(clippy::print_stdout, reason = "says what it is doing: the runs take minutes")]

use ancf14_testing::root;
use ancf14_tools::campaign::machine::{Machine, SETTINGS, Setting};
use ancf14_tools::campaign::verdict::{Judged, Verdict, judged};
use ancf14_tools::campaign::{catalogue, page};
use clap::Parser;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs the machines of the campaign and writes docs/campaign.md.
#[derive(Debug, Parser)]
struct Arguments {
    /// Run only machines, or groups, whose names hold this; the page is left alone
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Run only these machines, and put their verdicts into the page
    #[arg(long, value_name = "NAME", num_args = 1.., conflicts_with = "only")]
    update: Vec<String>,
    /// Write the model files of the machines, for every setting, instead of running them
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    /// Threads
    #[arg(long, default_value_t = 2)]
    jobs: usize,
}

fn main() -> ExitCode {
    let Arguments { only, update, write, jobs } = Arguments::parse();
    let known = catalogue::machines();
    if let Some(name) = update.iter().find(|name| known.iter().all(|machine| machine.name != **name)) {
        println!("error: no machine is called {name}");
        return ExitCode::FAILURE;
    }
    let machines: Vec<Machine> = known
        .into_iter()
        .filter(|machine| only.as_ref().is_none_or(|only| machine.name.contains(only) || machine.group.contains(only)))
        .filter(|machine| update.is_empty() || update.contains(&machine.name))
        .collect();
    let outcome = match write {
        Some(folder) => machines.iter().try_for_each(|machine| write_texts(machine, &folder)),
        None => {
            let judged = judge_all(&machines, jobs);
            match update.is_empty() {
                false => renewed(judged).and_then(|judged| report(&judged, true)),
                true => report(&judged, only.is_none()),
            }
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            println!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Judges on several threads; the order is that of the machines.
fn judge_all(machines: &[Machine], jobs: usize) -> Vec<Judged> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<Judged>>> = Mutex::new(vec![None; machines.len()]);
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                while let Some(machine) = machines.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let judged = judged(machine);
                    print!("{}", page::line(&judged));
                    let place = machines.iter().position(|other| other.name == machine.name).unwrap_or(0);
                    results.lock().expect("no thread panics with the lock")[place] = Some(judged);
                }
            });
        }
    });
    results.into_inner().expect("all threads have ended").into_iter().flatten().collect()
}

/// The verdicts of the page, with those that are new.
fn renewed(judged: Vec<Judged>) -> io::Result<Vec<Judged>> {
    let text = std::fs::read_to_string(root().join("docs/campaign.md"))?;
    let mut all = page::read(&text, &catalogue::machines())
        .ok_or_else(|| io::Error::other("docs/campaign.md lacks a machine: run the whole campaign"))?;
    for own in judged {
        if let Some(before) = all.iter_mut().find(|before| before.name == own.name) {
            *before = own;
        }
    }
    Ok(all)
}

/// Tells why machines were refused or warned of, and writes the page of a whole campaign.
fn report(judged: &[Judged], is_whole: bool) -> io::Result<()> {
    for machine in judged {
        for (setting, verdict) in SETTINGS.iter().zip(&machine.verdicts) {
            let reason = match verdict {
                Verdict::Refused(reason) | Verdict::Panicked(reason) => reason,
                Verdict::Warned(_, reason) | Verdict::NoReference(reason) => reason,
                _ => continue,
            };
            println!("{}, {}: {}", machine.name, setting.title(), reason.lines().next().unwrap_or(reason));
        }
    }
    let text = page::page(judged);
    if is_whole {
        std::fs::write(root().join("docs/campaign.md"), text)?;
        println!("docs/campaign.md is written");
    } else {
        println!("{text}");
    }
    Ok(())
}

/// Writes the model files of a machine.
fn write_texts(machine: &Machine, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for setting in SETTINGS.into_iter().chain([Setting::Finer(4), Setting::Finer(8)]) {
        if let Some(text) = machine.text(setting) {
            let file = folder.join(format!("{}-{}.toml", machine.name, setting.file_stem()));
            std::fs::write(&file, text)?;
            println!("{}", file.display());
        }
    }
    Ok(())
}
