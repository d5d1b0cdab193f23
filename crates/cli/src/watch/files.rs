//! The files of a model, and whether one of them has been saved since.
//!
//! The watch polls modification times and lengths, which needs no support of the file system. It misses a save of equal
//! length within the resolution of these times. An editor that replaces a file, writes it in pieces, or makes a missing
//! one is no special case.

use super::super::ModelArguments;
use ancf14::model::document::Document;
use ancf14::model::file::{self, Folder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// How often files are looked at, and how long they must have stayed alike.
const PACE: Duration = Duration::from_millis(100);

/// Time of the last change and length; none: there is no such file.
type Stamp = Option<(SystemTime, u64)>;

/// The files with their stamps.
#[derive(Debug, Default, PartialEq)]
pub struct Files(BTreeMap<PathBuf, Stamp>);

fn stamp(path: &Path) -> Stamp {
    let there = fs::metadata(path).ok()?;
    Some((there.modified().ok()?, there.len()))
}

/// The files that a model reads, itself left out, as far as its text can be read.
fn listed(model: &ModelArguments) -> Vec<PathBuf> {
    let folder = model.file.parent().unwrap_or(Path::new(""));
    let text = file::text(&model.file).unwrap_or_default();
    Document::files_in(Folder::new(folder, model.files.reach()), &model.name(), &text, &model.overrides)
}

impl Files {
    /// Lists the files of a model before it is loaded, and the files `before`: a mistake may hide some of them, such as
    /// an include below it.
    pub fn of(model: &ModelArguments, before: &Self) -> Self {
        let own = stamp(&model.file);
        let paths = listed(model).into_iter().chain(before.0.keys().cloned());
        let mut stamps: BTreeMap<_, _> = paths.map(|path| (path.clone(), stamp(&path))).collect();
        stamps.insert(model.file.clone(), own);
        Self(stamps)
    }

    /// Forgets the files that the model, which has just been loaded without a mistake, does not list any more.
    pub fn forget_unlisted(&mut self, model: &ModelArguments) {
        let listed = listed(model);
        self.0.retain(|path, _| *path == model.file || listed.contains(path));
    }

    /// Whether one of them has been saved, made or removed.
    pub fn have_changed(&self) -> bool {
        self.0.iter().any(|(path, before)| stamp(path) != *before)
    }

    /// Waits until one of them has changed, and then until no more changes come: an editor may write in pieces.
    pub fn wait(&self) {
        while !self.have_changed() {
            sleep(PACE);
        }
        let now = || Self(self.0.keys().map(|path| (path.clone(), stamp(path))).collect());
        let mut before = now();
        loop {
            sleep(PACE);
            let after = now();
            if after == before {
                return;
            }
            before = after;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::FileArguments;
    use super::*;

    fn model(file: PathBuf) -> ModelArguments {
        ModelArguments { file, overrides: Vec::new(), files: FileArguments::default() }
    }

    /// A model has the files that it includes and their tables, missing ones too, and those that a mistake hides now;
    /// each change of one of them is seen, and nothing else.
    #[test]
    fn changes_are_seen() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let write = |name: &str, text: &str| fs::write(at(name), text).unwrap();
        write("m.toml", "[include.part]\nfile = \"part.toml\"\n");
        write("part.toml", "format = 1\n[function.f]\nfile = \"f.csv\"\n");
        write("other.toml", "");
        let model = model(at("m.toml"));
        let files = Files::of(&model, &Files::default());
        let names = |files: &Files| files.0.keys().map(|path| path.file_name().unwrap().to_owned()).collect::<Vec<_>>();
        assert_eq!(names(&files), ["f.csv", "m.toml", "part.toml"]);
        assert!(!files.have_changed());
        write("other.toml", "changed");
        assert!(!files.have_changed());
        // A missing file is made.
        write("f.csv", "0,0\n1,1\n");
        assert!(files.have_changed());
        let files = Files::of(&model, &files);
        assert!(!files.have_changed());
        write("part.toml", "[[");
        assert!(files.have_changed());
        // The table is hidden by the mistake, but not forgotten.
        let files = Files::of(&model, &files);
        assert_eq!(names(&files), ["f.csv", "m.toml", "part.toml"]);
        fs::remove_file(at("f.csv")).unwrap();
        assert!(files.have_changed());
        // A mistake in the model itself hides all others; without it, those that are left out are forgotten.
        write("m.toml", "[[");
        let mut files = Files::of(&model, &files);
        assert_eq!(names(&files), ["f.csv", "m.toml", "part.toml"]);
        write("m.toml", "[include.part]\nfile = \"other.toml\"\n");
        files = Files::of(&model, &files);
        assert_eq!(names(&files), ["f.csv", "m.toml", "other.toml", "part.toml"]);
        files.forget_unlisted(&model);
        assert_eq!(names(&files), ["m.toml", "other.toml"]);
    }
}
