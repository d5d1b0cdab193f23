//! How the program speaks: lines on the standard output, complaints on the standard error, or with `--json` one
//! document at the end.
//!
//! One process runs one command, so that the style is one of the whole process.

use super::Stop;
use serde::Serialize;
use serde_json::{Value, json};
use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The style of this process, as a number of [`Style`].
static STYLE: AtomicU8 = AtomicU8::new(Style::Text as u8);
/// The document of `--json` so far.
static DOCUMENT: Mutex<Document> = Mutex::new(Document { product: Value::Null, warnings: Vec::new() });

/// How the program speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Style {
    /// Lines for people.
    Text,
    /// Only what was asked for, warnings and errors.
    Quiet,
    /// One document for programs.
    Json,
}

/// Version of the documents of `--json`: fields may join, none changes or goes.
const FORMAT: u32 = 1;

struct Document {
    product: Value,
    warnings: Vec<String>,
}

/// An error in a document.
#[derive(Debug, Serialize)]
pub struct Complaint {
    pub message: String,
    /// The file with line and column, or that the mistake is in the changes to the file; none: it is about no place.
    pub location: Option<String>,
    pub line: Option<usize>,
    pub column: Option<usize>,
    /// The line of the file.
    pub excerpt: Option<String>,
    /// The text behind the underlining.
    pub label: Option<String>,
    /// What to try.
    pub help: Option<String>,
}

impl Complaint {
    /// About no place of a file.
    pub fn new(message: &str) -> Self {
        let message = message.strip_prefix("error: ").unwrap_or(message).to_owned();
        Self { message, location: None, line: None, column: None, excerpt: None, label: None, help: None }
    }

    /// In lines, with its place.
    pub fn text(self) -> String {
        let place = self.location.map(|location| format!("in {location}"));
        [Some(self.message), place, self.help].into_iter().flatten().collect::<Vec<_>>().join("\n")
    }
}

/// Sets the style of this process.
pub fn set(style: Style) {
    STYLE.store(style as u8, Ordering::Relaxed);
    *document() = Document { product: Value::Null, warnings: Vec::new() };
}

/// Whether the answer is one document.
pub fn is_json() -> bool {
    STYLE.load(Ordering::Relaxed) == Style::Json as u8
}

/// Whether the program says what it does.
pub fn is_talkative() -> bool {
    STYLE.load(Ordering::Relaxed) == Style::Text as u8
}

/// Says what the program does or has done, in a line.
pub fn say(text: &str) -> Result<(), Stop> {
    match is_talkative() {
        true => print(text),
        false => Ok(()),
    }
}

/// Prints what was asked for. A reader who has gone, as `head` does, is no reason to fail.
pub fn print(text: &str) -> Result<(), Stop> {
    match writeln!(io::stdout(), "{text}") {
        Err(reason) if reason.kind() != ErrorKind::BrokenPipe => {
            Err(Stop::Failed(format!("error: cannot write to the standard output: {reason}")))
        }
        _ => Ok(()),
    }
}

/// Tells an error or a warning.
pub fn complain(text: &str) {
    let warning = text.strip_prefix("warning: ");
    document().warnings.extend(warning.map(str::to_owned));
    if warning.is_none() || !is_json() {
        let _ = writeln!(io::stderr(), "{text}");
    }
}

/// Keeps what was asked for, an object, for the document.
pub fn deliver(product: Value) {
    document().product = product;
}

/// The warnings so far.
pub fn warnings() -> Vec<String> {
    document().warnings.clone()
}

/// The warnings since the last call.
pub fn take_warnings() -> Vec<String> {
    std::mem::take(&mut document().warnings)
}

/// The document so far: what was asked for, warnings and errors.
pub fn whole(errors: &[Complaint]) -> Value {
    let Document { product, warnings } = &*document();
    let mut whole = json!({ "format": FORMAT, "errors": errors, "warnings": warnings });
    if let (Value::Object(whole), Value::Object(product)) = (&mut whole, product) {
        whole.extend(product.clone());
    }
    whole
}

/// Prints the document of `--json`.
pub fn conclude(errors: &[Complaint]) -> Result<(), Stop> {
    print(&format!("{:#}", whole(errors)))
}

fn document() -> MutexGuard<'static, Document> {
    DOCUMENT.lock().unwrap_or_else(PoisonError::into_inner)
}
