//! From copies (`[copy.NAME]`), included files (`[include.NAME]`) and tables in files (`file` of `[function.NAME]`) to
//! a flat model: the text of a file without them. It is what is read, run and packed; messages about it tell the place
//! of the original and the copy.

mod copies;
mod data;
mod functions;
mod grounds;
mod instance;
mod library;
mod motion;
mod names;
mod print;
mod scalar;
mod scope;
mod tables;

use self::instance::Flattener;
use self::library::Library;
use self::scope::Scope;
use self::tables::{COPY, FUNCTION, INCLUDE, table};
use crate::model::file::overrides;
use crate::model::text::diagnostic::{Diagnostics, Report, Source};
use crate::model::text::folder::Refusal;
use crate::model::text::tree::{self, Entry};
use std::collections::BTreeMap;
use std::path::Path;

/// The files that a model names.
#[derive(Clone, Copy)]
pub struct Files<'r> {
    /// The folder that relative paths in the model file begin at.
    pub folder: &'r Path,
    /// Reads a file of this name and path.
    pub read: &'r dyn Fn(&str, &Path) -> Result<String, Refusal>,
}

impl std::fmt::Debug for Files<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Files").field("folder", &self.folder).finish_non_exhaustive()
    }
}

/// The largest flat model, bytes: that of a model file.
const LARGEST: usize = 10 << 20;

/// Turns a file into a flat one if it has copies, includes or tables in files, with the overrides that decide what
/// there is; otherwise returns it as it is. Without `files` the text comes from memory and includes nothing.
///
/// # Errors
/// Everything that is wrong with copies and includes.
pub fn flat(
    mut source: Source,
    overrides: &[(String, String)],
    files: Option<Files<'_>>,
) -> Result<Source, Diagnostics> {
    let text = source.text(0);
    if !text.contains(COPY) && !text.contains(INCLUDE) && !text.contains(FUNCTION) {
        return Ok(source);
    }
    let mut report = Report::new(&source);
    let Some(mut tree) = tree::parse(text, 0, &mut report) else { return Ok(source) };
    if !is_needed(&tree) {
        return Ok(source);
    }
    let applied = overrides::apply_early(&mut tree, [COPY, FUNCTION], overrides, &mut report);
    if !report.is_empty() {
        return Err(report.finish());
    }
    let library = Library::load(&tree, &mut source, files)?;
    // The first pass finds the parameters that decide what there is, the second one has their numbers.
    let mut known = BTreeMap::new();
    loop {
        let mut flattener = Flattener::new(Report::new(&source), &library, known);
        flattener.fill(&Scope::file(&tree));
        if flattener.decisive != flattener.known {
            known = flattener.decisive;
            continue;
        }
        let (text, spans) = flattener.print(&source);
        let Flattener { mut report, notes, remarks, .. } = flattener;
        if report.is_empty() && text.len() > LARGEST {
            let message = format!("the model without copies and includes has {} MB", text.len() >> 20);
            let label = format!("the limit is {} MB", LARGEST >> 20);
            report.error(source.end(), &message, &label, "make fewer copies");
        }
        if !report.is_empty() {
            return Err(report.finish());
        }
        let told = |(place, text): &(_, String)| format!("{}: {text}", source.line_of(*place));
        let remarks = remarks.iter().map(told).collect();
        return Ok(source.resolved(&text, spans, notes, applied).with_remarks(remarks));
    }
}

/// Whether a file has copies or includes, or functions in files.
fn is_needed(tree: &[Entry]) -> bool {
    tree.iter().any(|entry| entry.key == COPY || entry.key == INCLUDE)
        || table(tree, FUNCTION).unwrap_or_default().iter().any(|function| data::file_of(function).is_some())
}
