//! Looks after a run from a thread of its own: writes the rows that wait once a second, and ends the run on Ctrl-C,
//! SIGTERM and SIGHUP.
//!
//! The run itself looks for a signal between two rows. Where a row takes longer than that, the keeper writes what is
//! there and ends the process.

use super::complain;
use super::rows::{Rows, Shared, locked};
use ancf14::error::decimal;
use signal_hook::consts::signal;
use signal_hook::flag::{register_conditional_shutdown, register_usize};
use std::io;
use std::process::exit;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// How often the keeper looks for a signal.
const LOOK: Duration = Duration::from_millis(100);
/// How often rows go to the disk: a person who follows the file is not faster.
const PACE: Duration = Duration::from_secs(1);
/// How long a run may take to notice a signal and to draw its plots.
const GRACE: Duration = Duration::from_secs(3);

/// The signals that end a run, as messages call them.
#[cfg(unix)]
const SIGNALS: [(i32, &str); 3] =
    [(signal::SIGINT, "Ctrl-C (SIGINT)"), (signal::SIGTERM, "SIGTERM"), (signal::SIGHUP, "SIGHUP")];
#[cfg(not(unix))]
const SIGNALS: [(i32, &str); 2] = [(signal::SIGINT, "Ctrl-C"), (signal::SIGTERM, "SIGTERM")];

/// A signal that came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal {
    number: i32,
    /// Its name, for messages.
    pub name: &'static str,
}

impl Signal {
    fn of(number: usize) -> Option<Self> {
        let found = SIGNALS.iter().find(|(known, _)| usize::try_from(*known) == Ok(number));
        found.map(|(number, name)| Self { number: *number, name })
    }

    /// The exit code that shells give to a process that the signal ended.
    pub fn exit_code(self) -> u8 {
        u8::try_from(128 + self.number).unwrap_or(1)
    }
}

/// The thread; it ends when this is dropped.
#[derive(Debug)]
pub struct Keeper {
    signal: Arc<AtomicUsize>,
    _end: Sender<()>,
}

impl Keeper {
    /// Begins to look after a run.
    pub fn start(rows: Shared) -> io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        let ignored = ignored();
        for (number, _) in SIGNALS.iter().filter(|(number, _)| ignored & (1 << (number - 1)) == 0) {
            register_usize(*number, Arc::clone(&signal), usize::try_from(*number).unwrap_or(0))?;
        }
        let (end, ended) = channel();
        let seen = Arc::clone(&signal);
        std::thread::Builder::new().spawn(move || keep(&rows, &seen, &ended))?;
        Ok(Self { signal, _end: end })
    }

    /// The signal that came, if one did.
    pub fn signal(&self) -> Option<Signal> {
        Signal::of(self.signal.load(Ordering::Relaxed))
    }
}

fn keep(rows: &Mutex<Rows>, signal: &AtomicUsize, ended: &Receiver<()>) {
    let mut flushed = Instant::now();
    let mut noticed = None;
    while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
        if flushed.elapsed() >= PACE {
            // The run meets a failure itself when it writes the next rows.
            let _ = locked(rows).flush();
            flushed = Instant::now();
        }
        let Some(signal) = Signal::of(signal.load(Ordering::Relaxed)) else { continue };
        if noticed.get_or_insert_with(Instant::now).elapsed() >= GRACE {
            let mut rows = locked(rows);
            let _ = rows.finish();
            let rest = rows.reached.map_or(String::new(), |reached| format!("\n{}", kept(reached, &rows)));
            complain(&format!("error: {}{rest}", interrupted(signal)));
            exit(i32::from(signal.exit_code()));
        }
    }
}

/// What is said of a run that a signal ended.
pub fn interrupted(signal: Signal) -> String {
    format!("the run was interrupted by {}", signal.name)
}

/// Where the rows of a run are that did not come to its end.
pub fn kept(reached: f64, rows: &Rows) -> String {
    format!("the rows up to t = {} s are in {}", decimal(reached), rows.path.display())
}

/// Ends the process on Ctrl-C with exit code 0: for what has no other end, and nothing to lose.
pub fn end_on_interrupt() -> io::Result<()> {
    if ignored() & (1 << (signal::SIGINT - 1)) == 0 {
        register_conditional_shutdown(signal::SIGINT, 0, Arc::new(AtomicBool::new(true)))?;
    }
    Ok(())
}

/// The signals that the process was started to ignore, bit by bit from SIGHUP: nohup, and a shell for what runs in the
/// background.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
