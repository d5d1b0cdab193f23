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
    let name = path.display();
    let bytes = bytes(path).map_err(|reason| format!("cannot read {name}: {reason}"))?;
    String::from_utf8(bytes).map_err(|error| {
        let (good, _) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
        let line = good.iter().filter(|byte| **byte == b'\n').count() + 1;
        let wrong = good.len() + 1;
        format!("{name} is not UTF-8 text: byte {wrong}, in line {line}, is wrong; save the file as UTF-8")
    })
}

fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > LARGEST {
        true => Err(io::Error::other(format!("it is larger than {} MB", LARGEST >> 20))),
        false => Ok(bytes),
    }
}
