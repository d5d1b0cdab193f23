//! The arguments that say which model a command is about.

use super::loading::load;
use super::{Stop, arguments, output};
use ancf14::model::file::Reach;
use ancf14::model::simulation::Simulation;
use clap::Args;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A model file with changes.
#[derive(Args, Debug)]
pub struct ModelArguments {
    /// Model file; - reads it from the standard input
    #[arg(value_name = "MODEL.toml")]
    pub file: PathBuf,
    /// Change a number or a word of the model: --set steel.young=2.1e11 --set arm.strain=small
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = arguments::key_and_value)]
    pub overrides: Vec<(String, String)>,
    #[command(flatten)]
    pub files: FileArguments,
}

/// Which files a model may name.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct FileArguments {
    /// Let the model include files and read tables from outside of its folder; only for a model that you trust
    #[arg(long)]
    pub allow_outside: bool,
}

impl FileArguments {
    /// Which files the model may name.
    pub fn reach(self) -> Reach {
        if self.allow_outside { Reach::Anywhere } else { Reach::Inside }
    }
}

impl ModelArguments {
    pub fn load(&self) -> Result<(Simulation, String), Stop> {
        load(&self.file, &self.overrides, self.files.reach())
    }

    /// [`Self::load`] with further changes of the model, by key.
    pub fn load_with(&self, changes: &[(&str, &str)]) -> Result<Simulation, Stop> {
        let mut overrides = self.overrides.clone();
        overrides.retain(|(own, _)| changes.iter().all(|(key, _)| own != key));
        overrides.extend(changes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())));
        load(&self.file, &overrides, self.files.reach()).map(|(simulation, _)| simulation)
    }

    /// The model as messages call it.
    pub fn name(&self) -> String {
        name(&self.file)
    }

    pub fn input(&self) -> output::Input<'_> {
        (MODEL_FILE, &self.file)
    }

    /// The folder of the results: `m.toml` to `m-results` in the current folder, unless another one is given.
    pub fn directory(&self, given: Option<PathBuf>) -> PathBuf {
        given.unwrap_or_else(|| self.beside("-results"))
    }

    /// The name of the model file without its ending, and `ending`: in the current folder.
    pub fn beside(&self, ending: impl AsRef<OsStr>) -> PathBuf {
        let mut name = stem(&self.file).to_owned();
        name.push(ending);
        PathBuf::from(name)
    }
}

/// The model file as messages call it.
pub const MODEL_FILE: &str = "the model file";
/// The table of inputs as messages call it.
pub const INPUTS: &str = "the table of inputs";

/// Whether the model comes from the standard input.
pub fn is_piped(path: &Path) -> bool {
    path == Path::new("-")
}

/// What files that are named after a model file begin with.
pub fn stem(path: &Path) -> &OsStr {
    path.file_stem().filter(|_| !is_piped(path)).unwrap_or(OsStr::new("model"))
}

/// The model file as messages call it.
pub fn name(path: &Path) -> String {
    if is_piped(path) { "standard input".to_owned() } else { path.display().to_string() }
}
