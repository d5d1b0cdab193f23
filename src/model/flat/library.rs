//! The files that a model includes, each read once, and those with the tables of its functions.

use super::Files;
use super::data::{file_of, rows};
use super::scope::entries_of;
use super::tables::{COPY, FUNCTION, INCLUDE, table};
use crate::model::text::diagnostic::{Diagnostics, Place, Report, Source};
use crate::model::text::folder::{Refusal, normalized};
use crate::model::text::tree::{self, Entry, Item, Node};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// More files than this are a mistake.
const MOST_FILES: usize = 100;

/// The included files.
#[derive(Debug, Default)]
pub(super) struct Library {
    files: Vec<File>,
    /// Which file an include names, by the place of the name.
    named: BTreeMap<Place, usize>,
    /// The tables of functions, by the place of the name of their file.
    tables: BTreeMap<Place, Item>,
    /// The files with tables: the path, and the number of the text.
    data: Vec<(PathBuf, usize)>,
}

#[derive(Debug)]
struct File {
    path: PathBuf,
    shown: String,
    tree: Vec<Entry>,
    /// The files that it includes.
    includes: Vec<usize>,
}

impl Library {
    /// Reads all files that `tree` includes, and those that they include; their texts are added to `source`.
    ///
    /// # Errors
    /// A file cannot be read, is not TOML, or includes itself.
    pub fn load(tree: &[Entry], source: &mut Source, files: Option<Files<'_>>) -> Result<Self, Diagnostics> {
        let mut library = Self::default();
        let folder = files.map(|files| files.folder);
        library.add(tree, None, source, folder, files)?;
        library.add_tables(tree, source, folder, files)?;
        let mut next = 0;
        while next < library.files.len() {
            let tree = library.files[next].tree.clone();
            let folder = library.files[next].path.parent().map(Path::to_owned);
            library.add(&tree, Some(next), source, folder.as_deref(), files)?;
            library.add_tables(&tree, source, folder.as_deref(), files)?;
            next += 1;
        }
        Ok(library)
    }

    /// The file that an include names at `place`, with its name for messages.
    pub fn file(&self, place: Place) -> Option<(&str, &[Entry])> {
        let file = self.named.get(&place).map(|number| &self.files[*number])?;
        Some((&file.shown, &file.tree))
    }

    /// The rows of the table that a function names at `place`.
    pub fn table(&self, place: Place) -> Option<&Item> {
        self.tables.get(&place)
    }

    /// Adds the tables of the functions of a file.
    fn add_tables(
        &mut self,
        tree: &[Entry],
        source: &mut Source,
        folder: Option<&Path>,
        files: Option<Files<'_>>,
    ) -> Result<(), Diagnostics> {
        for (name, place, column) in functions_with_files(tree) {
            let refused = |source: &Source, place: Place, message: &str, label: &str, help: &str| {
                let mut report = Report::new(source);
                report.error(place, message, label, help);
                Err(report.finish())
            };
            let (Some(folder), Some(files)) = (folder, files) else {
                let message = format!("`{name}` cannot be read: this model is a text without a folder");
                let help = "load the model from its file, or load the text that `ancf14 check --resolved` prints";
                return refused(source, place, &message, "", help);
            };
            let path = normalized(&folder.join(name));
            let number = match self.data.iter().find(|(known, _)| *known == path) {
                Some((_, number)) => *number,
                None if self.data.len() == MOST_FILES => {
                    let message = format!("the model has tables in more than {MOST_FILES} files");
                    return refused(source, place, &message, "one too many", "");
                }
                None => match (files.read)(name, &path) {
                    Ok(text) => source.include(&path.display().to_string(), &text),
                    Err(Refusal { message, help }) => return refused(source, place, &message, "", help),
                },
            };
            if self.data.iter().all(|(known, _)| *known != path) {
                self.data.push((path, number));
            }
            match rows(source.text(number), number, place, column) {
                Ok(rows) => drop(self.tables.insert(place, rows)),
                Err((place, mistake)) => {
                    return refused(source, place, &mistake.message, &mistake.label, mistake.help);
                }
            }
        }
        Ok(())
    }

    /// Adds the files that the file `from` includes.
    fn add(
        &mut self,
        tree: &[Entry],
        from: Option<usize>,
        source: &mut Source,
        folder: Option<&Path>,
        files: Option<Files<'_>>,
    ) -> Result<(), Diagnostics> {
        for (place, name) in names(tree) {
            let refused = |source: &Source, message: &str, label: &str, help: &str| {
                let mut report = Report::new(source);
                report.error(place, message, label, help);
                Err(report.finish())
            };
            let (Some(folder), Some(files)) = (folder, files) else {
                let message = format!("`{name}` cannot be included: this model is a text without a folder");
                let help = "load the model from its file, or load the text that `ancf14 check --resolved` prints";
                return refused(source, &message, "", help);
            };
            let path = normalized(&folder.join(&name));
            if let Some(known) = self.files.iter().position(|file| file.path == path) {
                self.named.insert(place, known);
                if let Some(from) = from {
                    self.files[from].includes.push(known);
                    if self.reaches(known, from) {
                        let label = "this include closes a circle";
                        return refused(source, &format!("{name} includes itself"), label, "");
                    }
                }
                continue;
            }
            if self.files.len() == MOST_FILES {
                return refused(
                    source,
                    &format!("the model includes more than {MOST_FILES} files"),
                    "one too many",
                    "",
                );
            }
            let text = match (files.read)(&name, &path) {
                Ok(text) => text,
                Err(Refusal { message, help }) => return refused(source, &message, "", help),
            };
            let shown = path.display().to_string();
            let number = source.include(&shown, &text);
            let mut report = Report::new(source);
            let tree = tree::parse(&text, number, &mut report);
            let Some(tree) = tree.filter(|_| report.is_empty()) else { return Err(report.finish()) };
            let own = self.files.len();
            self.files.push(File { path, shown, tree, includes: Vec::new() });
            self.named.insert(place, own);
            if let Some(from) = from {
                self.files[from].includes.push(own);
            }
        }
        Ok(())
    }

    /// Whether file `from` includes file `to`, at once or by others.
    fn reaches(&self, from: usize, to: usize) -> bool {
        let mut seen = vec![false; self.files.len()];
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            if file == to {
                return true;
            }
            if !std::mem::replace(&mut seen[file], true) {
                open.extend(&self.files[file].includes);
            }
        }
        false
    }
}

/// The functions of a file that have their tables in files, those in copies too: the name of the file with its place,
/// and the column.
fn functions_with_files(body: &[Entry]) -> Vec<(&str, Place, Option<&Item>)> {
    let own = table(body, FUNCTION).unwrap_or_default().iter();
    let mut list: Vec<_> = own.filter_map(file_of).collect();
    for copy in table(body, COPY).unwrap_or_default() {
        list.extend(entries_of(&copy.item).map(functions_with_files).unwrap_or_default());
    }
    list
}

/// The names of the files that a file includes, with their places, those in copies too.
fn names(body: &[Entry]) -> Vec<(Place, String)> {
    let mut list = Vec::new();
    for include in table(body, INCLUDE).unwrap_or_default() {
        let file = entries_of(&include.item).and_then(|keys| keys.iter().find(|entry| entry.key == "file"));
        if let Some(Entry { item, .. }) = file
            && let Node::Text(name) = &item.node
        {
            list.push((item.place, name.clone()));
        }
    }
    for copy in table(body, COPY).unwrap_or_default() {
        list.extend(entries_of(&copy.item).map(names).unwrap_or_default());
    }
    list
}
