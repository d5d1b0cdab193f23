//! The folder of results. One program at a time writes into it, and it replaces only files that this program wrote.
//!
//! The file `.ancf14` in the folder is the lock, and the list of those files: a row for each, with the command that
//! wrote it and the GUID of the model. A killed program takes its lock with it.

use super::output::{self, Input};
use super::{Stop, complain};
use ancf14::model::notes::listed;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// The lock and the list.
const LIST: &str = ".ancf14";
const HEAD: &str = "# Files that ancf14 wrote into this folder: command, model, name. It replaces these and leaves all others alone.\n";

/// A folder that is locked until this is dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    list: File,
    /// What `run` and `modes` wrote.
    rows: Vec<Row>,
}

/// Whether a file has a name that other programs give, too: a page or a document.
fn is_page(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "html" || extension == "json")
}

/// A file that a command wrote.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    command: String,
    guid: String,
    name: String,
}

impl Folder {
    /// Makes the folder if it is not there, and locks it.
    pub fn open(path: &Path) -> Result<Self, Stop> {
        if fs::metadata(path).is_ok_and(|there| !there.is_dir()) {
            let shown = path.display();
            return Err(Stop::Bad(format!("error: {shown} is a file; give the name of a folder")));
        }
        let trouble = |reason: &dyn std::fmt::Display| output::trouble(path, reason);
        fs::create_dir_all(path).map_err(|reason| trouble(&reason))?;
        let file = path.join(LIST);
        let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&file);
        let mut list = opened.map_err(|reason| output::trouble(&file, &reason))?;
        match list.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let shown = path.display();
                return Err(Stop::Failed(format!(
                    "error: another ancf14 is writing into {shown}; wait for its end, or choose another folder"
                )));
            }
            // Some file systems have no locks.
            Err(TryLockError::Error(reason)) if reason.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(reason)) => return Err(output::trouble(&file, &reason)),
        }
        let mut text = Vec::new();
        list.read_to_end(&mut text).map_err(|reason| trouble(&reason))?;
        let rows = String::from_utf8_lossy(&text).lines().filter_map(Row::read).collect();
        Ok(Self { path: path.to_owned(), list, rows })
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Makes room for the files that `command` will write for the model of `guid`: those of its last call are removed,
    /// so that nothing old passes for new. Fails before anything is touched if one of them is an input or cannot be
    /// replaced.
    pub fn claim(&mut self, command: &str, guid: &str, names: &[String], inputs: &[Input<'_>]) -> Result<(), Stop> {
        let paths: Vec<PathBuf> = names.iter().map(|name| self.file(name)).collect();
        output::spare(inputs, &paths)?;
        output::spare(inputs, &[self.file(LIST)])?;
        for path in paths.iter().filter(|path| is_page(path) && path.symlink_metadata().is_ok()) {
            if !self.rows.iter().any(|row| self.path.join(&row.name) == *path) {
                return Err(output::trouble(
                    path,
                    &"ancf14 did not write the file that is there; choose another folder",
                ));
            }
        }
        let (own, others): (Vec<Row>, Vec<Row>) = self.rows.drain(..).partition(|row| row.command == command);
        let stale = own.iter().map(|row| self.path.join(&row.name));
        let mut stale: Vec<PathBuf> = stale.chain(paths).filter(|path| path.symlink_metadata().is_ok()).collect();
        stale.sort();
        stale.dedup();
        for path in &stale {
            let there = path.symlink_metadata().map_err(|reason| output::trouble(path, &reason))?;
            if there.is_dir() {
                return Err(output::trouble(path, &"it is a folder"));
            }
            if there.is_file() && there.permissions().readonly() {
                return Err(output::trouble(path, &"it is read-only"));
            }
        }
        let foreign = others.iter().filter(|row| row.guid != guid && self.file(&row.name).exists());
        let foreign: Vec<&str> = foreign.map(|row| row.name.as_str()).collect();
        if !foreign.is_empty() {
            let (names, shown) = (listed(&foreign), self.path.display());
            complain(&format!("warning: these files in {shown} come from another model or other settings: {names}"));
        }
        for path in &stale {
            fs::remove_file(path).map_err(|reason| output::trouble(path, &reason))?;
        }
        self.rows = others;
        self.rows.extend(names.iter().map(|name| Row {
            command: command.to_owned(),
            guid: guid.to_owned(),
            name: name.clone(),
        }));
        self.save().map_err(|reason| output::trouble(&self.file(LIST), &reason))
    }

    /// Refuses an output of the command that would be one of the files `names` of this folder, or its list.
    pub fn keep_apart(&self, output: &Path, names: &[String]) -> Result<(), Stop> {
        let real = |path: &Path| {
            let path = output::followed(path).ok()?;
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            Some(folder.canonicalize().ok()?.join(path.file_name()?))
        };
        let mut own = names.iter().map(String::as_str).chain([LIST]).map(|name| self.file(name));
        let place = real(output);
        match place.is_some() && own.any(|path| real(&path) == place) {
            true => {
                let shown = output.display();
                Err(Stop::Bad(format!("error: {shown} is a file of the results; choose another name to write to")))
            }
            false => Ok(()),
        }
    }

    /// Writes a file that has been claimed, whole or not at all.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Stop> {
        output::write(&self.file(name), bytes.as_ref())
    }

    /// The list is rewritten in place: its file is the lock.
    fn save(&mut self) -> io::Result<()> {
        let rows = self.rows.iter().map(|row| format!("{} {} {}\n", row.command, row.guid, row.name));
        let text: String = std::iter::once(HEAD.to_owned()).chain(rows).collect();
        self.list.rewind()?;
        self.list.write_all(text.as_bytes())?;
        self.list.set_len(text.len() as u64)
    }
}

impl Row {
    /// A row of the list; none if it does not name a file of this very folder.
    fn read(line: &str) -> Option<Self> {
        let mut words = line.splitn(3, ' ').map(str::to_owned);
        let row = Self { command: words.next()?, guid: words.next()?, name: words.next()? };
        let is_plain = Path::new(&row.name).file_name().is_some_and(|name| name == row.name.as_str());
        (is_plain && row.command != "#").then_some(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &[&str]) -> Vec<String> {
        list.iter().map(|name| (*name).to_owned()).collect()
    }

    /// A command removes what it wrote the last time, and nothing else: no file of another command, none of the user.
    #[test]
    fn only_own_files_are_removed() {
        let there = tempfile::tempdir().unwrap();
        let write = |name: &str| fs::write(there.path().join(name), name).unwrap();
        write("mine.svg");
        for (command, list) in
            [("run", &["results.csv", "old.svg"][..]), ("modes", &["modes.csv"]), ("run", &["results.csv", "new.svg"])]
        {
            let mut folder = Folder::open(there.path()).unwrap();
            folder.claim(command, "{1}", &names(list), &[]).unwrap();
            assert!(!folder.file(list[0]).exists());
            list.iter().for_each(|name| folder.write(name, name).unwrap());
        }
        let mut found: Vec<_> = fs::read_dir(there.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        found.sort();
        assert_eq!(found, [LIST, "mine.svg", "modes.csv", "new.svg", "results.csv"]);
    }

    /// A page of the user stays, and so does everything else in the folder: the command fails before it touches
    /// anything.
    #[test]
    fn pages_of_the_user_are_spared() {
        let there = tempfile::tempdir().unwrap();
        for name in ["index.html", "results.csv"] {
            fs::write(there.path().join(name), "mine").unwrap();
        }
        let mut folder = Folder::open(there.path()).unwrap();
        let list = names(&["results.csv", "index.html"]);
        assert!(folder.claim("run", "{1}", &list, &[]).is_err());
        assert!(list.iter().all(|name| fs::read_to_string(folder.file(name)).unwrap() == "mine"));
        fs::remove_file(folder.file("index.html")).unwrap();
        folder.claim("run", "{1}", &list, &[]).unwrap();
        folder.write("index.html", "own").unwrap();
        folder.claim("run", "{1}", &list, &[]).unwrap();
        assert!(!folder.file("index.html").exists());
    }

    /// A folder has one writer; what a list names outside of its folder is not touched.
    #[test]
    fn a_folder_has_one_writer() {
        let there = tempfile::tempdir().unwrap();
        fs::create_dir(there.path().join("inner")).unwrap();
        fs::write(there.path().join("results.csv"), "kept").unwrap();
        let inner = there.path().join("inner");
        fs::write(inner.join(LIST), format!("{HEAD}run {{1}} ../results.csv\nrun {{1}} ..\n")).unwrap();
        let mut first = Folder::open(&inner).unwrap();
        assert!(matches!(Folder::open(&inner), Err(Stop::Failed(_))));
        first.claim("run", "{1}", &names(&["results.csv"]), &[]).unwrap();
        drop(first);
        assert!(Folder::open(&inner).is_ok());
        assert!(there.path().join("results.csv").exists());
    }
}
