//! The folder of a model file, in which the files lie that it names.
//!
//! The lines of these files come back in messages and in packed FMUs. A model file from elsewhere must not reach the
//! other files of the computer, so that files outside of the folder are refused unless the user allows them.

use super::disk;
use std::path::{Component, Path, PathBuf};

/// The way out, for messages.
const WAY_OUT: &str = "move the file into that folder or below; for a model that you trust, allow files elsewhere: `--allow-outside` of the program, `allow_outside=True` in Python, `Reach::Anywhere` in Rust, `ancf14_load_trusted_file` in C";

/// Where the files lie that a model names.
#[derive(Clone, Copy, Debug)]
pub struct Folder<'p> {
    path: &'p Path,
    reach: Reach,
}

/// Which files a model may name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Those of its folder and of the folders in it.
    #[default]
    Inside,
    /// All files.
    Anywhere,
}

/// Why a file is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// As a sentence.
    pub message: String,
    /// What to do about it.
    pub help: &'static str,
}

impl<'p> Folder<'p> {
    /// The folder at `path`; an empty path is the current folder.
    pub fn new(path: &'p Path, reach: Reach) -> Self {
        Self { path, reach }
    }

    /// Its path.
    pub fn path(self) -> &'p Path {
        self.path
    }

    /// The text of the file at `path`, which the model calls `name`.
    ///
    /// # Errors
    /// It is outside of the folder, or cannot be read.
    pub fn text(self, name: &str, path: &Path) -> Result<String, Refusal> {
        self.check(name, path)?;
        let relative = "paths are relative to the folder of this file";
        disk::regular(path).and_then(|()| disk::text(path)).map_err(|message| Refusal { message, help: relative })
    }

    /// Checks that the file at `path` is one that the model may read. Links count as the file that they lead to.
    fn check(self, name: &str, path: &Path) -> Result<(), Refusal> {
        if self.reach == Reach::Anywhere {
            return Ok(());
        }
        let own = if self.path.as_os_str().is_empty() { Path::new(".") } else { self.path };
        // A folder that is not there has no files that could be read.
        let Ok(own) = own.canonicalize() else { return Ok(()) };
        let whole = std::path::absolute(path).map_or_else(|_| path.to_owned(), |path| normalized(&path));
        // A file that is not there is judged by its path alone: reading it will tell.
        let real = path.canonicalize().unwrap_or_else(|_| {
            let folder = whole.parent().and_then(|folder| folder.canonicalize().ok());
            folder.zip(whole.file_name()).map_or_else(|| whole.clone(), |(folder, name)| folder.join(name))
        });
        if real.starts_with(&own) {
            return Ok(());
        }
        let message = format!("`{name}` is {}, outside of the folder of the model file, {}", shown(&real), shown(&own));
        Err(Refusal { message, help: WAY_OUT })
    }
}

/// A whole path without the prefix `\\?\` that Windows gives it, which no reader writes.
fn shown(path: &Path) -> String {
    let text = path.display().to_string();
    text.strip_prefix(r"\\?\").unwrap_or(&text).to_owned()
}

/// A path without `parts/..` and `.`: two ways to write one file are one file.
pub fn normalized(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        let is_below = matches!(normal.components().next_back(), Some(Component::Normal(_)));
        match part {
            Component::CurDir => {}
            Component::ParentDir if is_below => drop(normal.pop()),
            other => normal.push(other),
        }
    }
    normal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_shown_as_readers_write_them() {
        assert_eq!(shown(Path::new(r"\\?\C:\models\m.toml")), r"C:\models\m.toml");
        assert_eq!(shown(Path::new("/models/m.toml")), "/models/m.toml");
    }
}
