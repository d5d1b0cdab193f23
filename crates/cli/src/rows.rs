//! The file of rows while a run goes on: it holds whole rows only, and each is there within about a second.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Bytes that wait at most.
const ROOM: usize = 1 << 16;

/// A file that grows by whole rows. It is made when the first of them are written.
#[derive(Debug)]
pub struct Rows {
    /// Where it is.
    pub path: PathBuf,
    /// Time of the last row, s.
    pub reached: Option<f64>,
    file: Option<File>,
    /// Whole rows that are not in the file yet.
    waiting: Vec<u8>,
    /// Bytes of the file.
    written: u64,
}

/// A file of rows that the run fills and the keeper writes.
pub type Shared = Arc<Mutex<Rows>>;

/// The rows, whatever happened to the thread that held them last.
pub fn locked(rows: &Mutex<Rows>) -> MutexGuard<'_, Rows> {
    rows.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Rows {
    /// No row yet, and no file; for the run and its keeper.
    pub fn shared(path: PathBuf) -> Shared {
        Arc::new(Mutex::new(Self::new(path)))
    }

    /// No row yet, and no file.
    fn new(path: PathBuf) -> Self {
        Self { path, reached: None, file: None, waiting: Vec::new(), written: 0 }
    }

    /// Adds the row of `time`, s, with the header before the first one.
    pub fn push(&mut self, time: f64, row: &str) -> io::Result<()> {
        self.waiting.extend(row.as_bytes());
        self.reached = Some(time);
        if self.waiting.len() < ROOM { Ok(()) } else { self.flush() }
    }

    /// Writes the rows that wait. Of a disk that is full the file keeps its whole rows, and the others wait on.
    pub fn flush(&mut self) -> io::Result<()> {
        if self.waiting.is_empty() {
            return Ok(());
        }
        let mut file = match self.file.take() {
            Some(file) => file,
            None => OpenOptions::new().append(true).create_new(true).open(&self.path)?,
        };
        let outcome = file.write_all(&self.waiting);
        let taken = match &outcome {
            Ok(()) => self.waiting.len(),
            Err(_) => {
                let length = file.metadata().map_or(0, |there| there.len());
                let taken = usize::try_from(length.saturating_sub(self.written)).unwrap_or(0).min(self.waiting.len());
                let end = self.waiting[..taken].iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
                // The file was open for writing a moment ago; if it cannot be cut, its last row is torn.
                let _ = file.set_len(self.written + end as u64);
                end
            }
        };
        self.written += taken as u64;
        self.waiting.drain(..taken);
        self.file = Some(file);
        outcome
    }

    /// Writes the rows that wait, to the disk itself, and closes the file.
    pub fn finish(&mut self) -> io::Result<()> {
        self.flush()?;
        self.file.take().map_or(Ok(()), |file| file.sync_all())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows come into the file whole and in order; before the first one there is no file.
    #[test]
    fn rows_are_whole() {
        let folder = tempfile::tempdir().unwrap();
        let mut rows = Rows::new(folder.path().join("rows"));
        assert!(rows.flush().is_ok() && rows.finish().is_ok() && !rows.path.exists());
        let mut expected = String::new();
        for k in 0..20_000 {
            let row = format!("{k},{}\n", 0.5 * f64::from(k));
            rows.push(f64::from(k), &row).unwrap();
            expected.push_str(&row);
            if k % 7000 == 0 {
                rows.flush().unwrap();
                assert_eq!(std::fs::read_to_string(&rows.path).unwrap(), expected);
            }
        }
        assert!(std::fs::read_to_string(&rows.path).unwrap().ends_with('\n'));
        rows.finish().unwrap();
        assert_eq!(std::fs::read_to_string(&rows.path).unwrap(), expected);
    }

    /// A device that is always full takes nothing; the rows wait.
    #[cfg(target_os = "linux")]
    #[test]
    fn rows_wait_for_a_full_disk() {
        let mut rows = Rows::new(PathBuf::from("/dev/full"));
        rows.file = Some(OpenOptions::new().append(true).open("/dev/full").unwrap());
        rows.push(0.0, "0\n").unwrap();
        assert!(rows.flush().is_err() && rows.flush().is_err());
        assert_eq!(rows.waiting, b"0\n");
    }
}
