//! The run beside a motion that tells its mesh error, on a thread of its own.

use ancf14::model::run::accuracy::Differences;
use ancf14::model::simulation::{Beside, Companion, Halt, Lost, Row};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

/// The stack of the thread, bytes: that of a main thread on Linux.
const STACK: usize = 8 << 20;
/// Rows that may wait for the thread: beyond, the run waits for it.
const ROWS: usize = 4096;

/// A thread that follows a run.
#[derive(Debug)]
struct Thread {
    /// None: no more rows come.
    rows: Option<SyncSender<Row>>,
    /// Halts it where the run that it follows has ended without asking for the result.
    halt: Halt,
    /// None: the system gives no thread.
    handle: Option<JoinHandle<Result<Differences, Lost>>>,
}

/// Starts the thread that `companion` runs on.
pub fn start(companion: Companion) -> Box<dyn Beside> {
    let (rows, received) = sync_channel(ROWS);
    let halt = companion.halt();
    let thread = Builder::new().name(String::from("ancf14 mesh")).stack_size(STACK);
    let handle = thread.spawn(move || follow(companion, &received)).ok();
    Box::new(Thread { rows: Some(rows), halt, handle })
}

fn follow(mut companion: Companion, rows: &Receiver<Row>) -> Result<Differences, Lost> {
    // Once it is halted it takes the rows that wait, and computes none.
    while let Ok(row) = rows.recv() {
        companion.go_on(row);
    }
    Box::new(companion).finish()
}

impl Beside for Thread {
    fn go_on(&mut self, row: Row) {
        if let Some(rows) = &self.rows {
            // A thread that has panicked is reported by `finish`.
            let _ = rows.send(row);
        }
    }

    fn finish(mut self: Box<Self>) -> Result<Differences, Lost> {
        self.rows = None;
        let Some(handle) = self.handle.take() else {
            return Err(Lost::Start(String::from("the system gives no further thread")));
        };
        handle.join().unwrap_or_else(|_| Err(Lost::Start(String::from("its thread has panicked"))))
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.halt.set();
    }
}
