//! The run beside a motion that tells its mesh error, on a thread of its own.

use ancf14::model::run::accuracy::Differences;
use ancf14::model::simulation::{Beside, Companion, Row};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{Builder, JoinHandle};

/// The stack of the thread, bytes: that of a main thread on Linux.
const STACK: usize = 8 << 20;

/// A thread that follows a run.
#[derive(Debug)]
struct Thread {
    /// None: no more rows come.
    rows: Option<Sender<Row>>,
    /// Nobody waits for it any more.
    is_over: Arc<AtomicBool>,
    /// None: there is no thread to be had.
    handle: Option<JoinHandle<Result<Differences, String>>>,
}

/// Starts the thread that `companion` runs on.
pub fn start(companion: Companion) -> Box<dyn Beside> {
    let (rows, received) = channel();
    let is_over = Arc::new(AtomicBool::new(false));
    let ends = Arc::clone(&is_over);
    let thread = Builder::new().name(String::from("ancf14 mesh")).stack_size(STACK);
    let handle = thread.spawn(move || follow(companion, &received, &ends)).ok();
    Box::new(Thread { rows: Some(rows), is_over, handle })
}

fn follow(mut companion: Companion, rows: &Receiver<Row>, is_over: &AtomicBool) -> Result<Differences, String> {
    while let Ok(row) = rows.recv() {
        if is_over.load(Ordering::Relaxed) {
            break;
        }
        companion.go_on(row);
    }
    Box::new(companion).finish()
}

impl Beside for Thread {
    fn go_on(&mut self, row: Row) {
        if let Some(rows) = &self.rows {
            // A thread that has panicked says so in the end.
            let _ = rows.send(row);
        }
    }

    fn finish(mut self: Box<Self>) -> Result<Differences, String> {
        self.rows = None;
        let outcome = self.handle.take().and_then(|handle| handle.join().ok());
        outcome.unwrap_or_else(|| Err(String::from("its thread ended")))
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}
