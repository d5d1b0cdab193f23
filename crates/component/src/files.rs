//! Files of the unit, in the folders that the host has opened.

use wasip2::filesystem::preopens::get_directories;
use wasip2::filesystem::types::{Descriptor, DescriptorFlags, ErrorCode, OpenFlags, PathFlags};

/// Bytes that are read at once.
const PIECE: u64 = 1 << 16;

/// The text of a file by its path.
///
/// # Errors
/// No open folder has it, or it is not text.
pub fn text(path: &str) -> Result<String, String> {
    String::from_utf8(read(path)?).map_err(|_| String::from("it is not UTF-8"))
}

/// The bytes of a file by its path.
///
/// # Errors
/// No open folder has it.
pub fn read(path: &str) -> Result<Vec<u8>, String> {
    let mut reason = String::from("the host has not opened a folder that contains it");
    for (folder, name) in get_directories() {
        // `/res` does not contain `/resources/model.toml`.
        let rest = path.strip_prefix(name.trim_end_matches('/'));
        let Some(inside) = rest.and_then(|rest| rest.strip_prefix('/')) else { continue };
        match read_in(&folder, inside.trim_start_matches('/')) {
            Ok(bytes) => return Ok(bytes),
            Err(code) => reason = code.message().to_owned(),
        }
    }
    Err(reason)
}

fn read_in(folder: &Descriptor, path: &str) -> Result<Vec<u8>, ErrorCode> {
    let file = folder.open_at(PathFlags::SYMLINK_FOLLOW, path, OpenFlags::empty(), DescriptorFlags::READ)?;
    let mut bytes = Vec::new();
    loop {
        let (piece, ended) = file.read(PIECE, bytes.len() as u64)?;
        bytes.extend(piece);
        if ended {
            return Ok(bytes);
        }
    }
}
