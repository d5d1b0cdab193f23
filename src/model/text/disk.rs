//! Reading a model file from the disk.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

/// The largest model file, bytes: to read it takes up to fifty times as much memory.
const LARGEST: u64 = 10 << 20;

/// The text of the model file at `path`.
///
/// # Errors
/// A sentence without the word `error`: the file cannot be read, is larger than any model, or is not UTF-8 text.
pub fn text(path: &Path) -> Result<String, String> {
    let name = path.display().to_string();
    let bytes = File::open(path).and_then(bytes).map_err(|reason| format!("cannot read {name}: {reason}"))?;
    utf8(&name, bytes)
}

/// Checks that `path` leads to a file: a pipe or a device may have no end, or never begin.
///
/// # Errors
/// As a sentence: it does not, or is not there.
pub fn regular(path: &Path) -> Result<(), String> {
    let name = path.display();
    match std::fs::metadata(path) {
        Ok(there) if there.is_file() => Ok(()),
        Ok(_) => Err(format!("cannot read {name}: it is not a regular file")),
        Err(reason) => Err(format!("cannot read {name}: {reason}")),
    }
}

/// The bytes of the file at `path`.
///
/// # Errors
/// As a sentence: the file cannot be read.
pub fn content(path: &Path) -> Result<Vec<u8>, String> {
    regular(path)?;
    std::fs::read(path).map_err(|reason| format!("cannot read {}: {reason}", path.display()))
}

/// The text of a model file that comes from a pipe; messages call it `name`.
///
/// # Errors
/// Those of [`text`].
pub fn piped(name: &str, from: impl Read) -> Result<String, String> {
    let bytes = bytes(from).map_err(|reason| format!("cannot read {name}: {reason}"))?;
    utf8(name, bytes)
}

fn utf8(name: &str, bytes: Vec<u8>) -> Result<String, String> {
    String::from_utf8(bytes).map_err(|error| {
        let (good, _) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
        let line = good.iter().filter(|byte| **byte == b'\n').count() + 1;
        let wrong = good.len() + 1;
        format!("{name} is not UTF-8 text: byte {wrong}, in line {line}, is wrong; save the file as UTF-8")
    })
}

fn bytes(from: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(LARGEST + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > LARGEST {
        true => Err(io::Error::other(format!("it is larger than {} MB", LARGEST >> 20))),
        false => Ok(bytes),
    }
}
