//! Files that a command writes: whole or not at all, and never over a file that it reads.
//!
//! The bytes go to a temporary file in the folder of the target, which takes the target's name when all of them are
//! written. A full disk or a killed process leaves the target as it was.

use super::Stop;
use std::fs::{self, OpenOptions, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A link that leads to a link is followed this often, as Linux does.
const MOST_LINKS: usize = 40;

/// A file that a command reads: what it is, for messages, and where it is.
pub type Input<'a> = (&'a str, &'a Path);

/// Refuses outputs that are an input of the same command, also by another path, through a link or as a hard link.
pub fn spare(inputs: &[Input<'_>], outputs: &[PathBuf]) -> Result<(), Stop> {
    for output in outputs {
        for (what, input) in inputs {
            // Two files of which one does not exist are not the same.
            if !is_stream(output) && same_file::is_same_file(input, output).unwrap_or(false) {
                let output = output.display();
                return Err(Stop::Bad(format!("error: {output} is {what}; choose another name to write to")));
            }
        }
    }
    Ok(())
}

/// Writes a file whole or not at all.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Stop> {
    replace(path, bytes).map_err(|reason| trouble(path, &reason))
}

/// Fails where a file cannot be written, before there is anything to write: its folder is missing or read-only, or
/// another thing has its name.
pub fn try_out(path: &Path) -> Result<(), Stop> {
    match temporary(path) {
        Ok(_) => Ok(()),
        Err(reason) => Err(trouble(path, &reason)),
    }
}

/// The message about a file that cannot be written.
pub fn trouble(path: &Path, reason: &dyn std::fmt::Display) -> Stop {
    Stop::Failed(format!("error: cannot write {}: {reason}", path.display()))
}

/// Whether a path leads to something that is no file and no folder: a pipe, a terminal. It can only be written into.
fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir())
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A device or a pipe takes the bytes as they come.
    let Some((mut file, target)) = temporary(path)? else { return fs::write(path, bytes) };
    file.as_file_mut().write_all(bytes)?;
    file.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

/// A temporary file in the folder of the file that `path` leads to, which it is to replace; none of a device or a pipe.
fn temporary(path: &Path) -> io::Result<Option<(NamedTempFile, PathBuf)>> {
    if is_stream(path) {
        return Ok(None);
    }
    let target = followed(path)?;
    let there = fs::metadata(&target).ok();
    if there.as_ref().is_some_and(|there| !there.is_file()) {
        // Of a folder the system says what is wrong.
        return OpenOptions::new().write(true).open(&target).map(|_| None);
    }
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".ancf14-");
    let permissions = match there {
        Some(there) => Some(there.permissions()),
        None => fresh(),
    };
    if let Some(permissions) = permissions {
        if permissions.readonly() {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
        }
        builder.permissions(permissions);
    }
    let file = builder.tempfile_in(folder).map_err(plain)?;
    Ok(Some((file, target)))
}

/// An error without the name of the temporary file, which stands at the end of its text.
fn plain(reason: io::Error) -> io::Error {
    match reason.to_string().split_once(" at path ") {
        Some((text, _)) => io::Error::new(reason.kind(), text),
        None => reason,
    }
}

/// The file that a chain of links leads to; it need not exist.
pub fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = path.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// The permissions of a new file; the system takes off those of the process's mask.
#[cfg(unix)]
fn fresh() -> Option<Permissions> {
    Some(std::os::unix::fs::PermissionsExt::from_mode(0o666))
}

/// The permissions of a new file: the system's.
#[cfg(not(unix))]
fn fresh() -> Option<Permissions> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file is replaced in one move: whoever has opened it before reads on in the old one.
    #[cfg(unix)]
    #[test]
    fn files_are_replaced_through_links() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("file"), "before").unwrap();
        fs::hard_link(at("file"), at("other")).unwrap();
        std::os::unix::fs::symlink("file", at("link")).unwrap();
        std::os::unix::fs::symlink("new", at("dangling")).unwrap();
        write(&at("link"), b"after").unwrap();
        write(&at("dangling"), b"new").unwrap();
        let text = |name: &str| fs::read_to_string(at(name)).unwrap();
        assert_eq!([text("file"), text("other"), text("new")], ["after", "before", "new"]);
        assert!(fs::symlink_metadata(at("link")).unwrap().is_symlink());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5, "a temporary file is left");
    }

    /// What cannot be written is left as it was, and nothing is left beside it.
    #[cfg(unix)]
    #[test]
    fn failures_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("kept"), "kept").unwrap();
        let mut permissions = fs::metadata(at("kept")).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(at("kept"), permissions).unwrap();
        fs::create_dir(at("folder")).unwrap();
        for path in [at("kept"), at("folder"), at("nowhere/file"), PathBuf::from("/dev/full")] {
            let Err(Stop::Failed(message)) = write(&path, b"new") else { panic!("{}", path.display()) };
            assert!(!message.contains(".ancf14-"), "{message}");
        }
        assert_eq!(fs::read_to_string(at("kept")).unwrap(), "kept");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    /// Every way to name an input is found.
    #[cfg(unix)]
    #[test]
    fn inputs_are_spared() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("model"), "").unwrap();
        fs::write(at("else"), "").unwrap();
        fs::hard_link(at("model"), at("hard")).unwrap();
        std::os::unix::fs::symlink("model", at("soft")).unwrap();
        let model = at("model");
        let inputs = [("the model file", model.as_path())];
        for name in ["model", "./model", "hard", "soft"] {
            assert!(matches!(spare(&inputs, &[at(name)]), Err(Stop::Bad(_))), "{name}");
        }
        assert!(spare(&inputs, &[at("else"), at("nothing")]).is_ok());
    }
}
