//! Reads model files: from the disk, from memory, from an unpacked FMU.

use super::{ReadState, Simulation, mistaken};
use crate::fmi::Failure;
use crate::fmi::location::STATE_FILE;
use crate::model::file::document::Document;
use crate::model::file::{self, Folder};
use std::path::Path;

impl Simulation {
    /// Reads and builds a model file; `overrides` are keys and values of `--set`, `file_name` is for messages.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load(file_name: &str, text: &str, overrides: &[(String, String)]) -> Result<Self, Failure> {
        Self::load_in(None, file_name, text, overrides)
    }

    /// Reads and builds a model file as [`Self::load`] does; paths in it are relative to `folder`, without which it
    /// includes no other file.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load_in(
        folder: Option<Folder<'_>>,
        file_name: &str,
        text: &str,
        overrides: &[(String, String)],
    ) -> Result<Self, Failure> {
        Self::load_with(folder, file_name, text, overrides, &|name| match folder {
            Some(folder) => file::content(&folder.path().join(name)),
            None => Err(format!("`{name}` cannot be read: this model is a text without a folder")),
        })
    }

    /// Reads and builds a model file as [`Self::load_in`] does; `read` reads the state that it begins with.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load_with(
        folder: Option<Folder<'_>>,
        file_name: &str,
        text: &str,
        overrides: &[(String, String)],
        read: ReadState<'_>,
    ) -> Result<Self, Failure> {
        let document =
            Document::parse_in(folder, file_name, text, overrides).map_err(|mistakes| mistaken(&mistakes))?;
        let mut simulation = Self::of(document, overrides.to_vec())?;
        simulation.read_first_state(read)?;
        Ok(simulation)
    }

    /// Reads and builds the model file of an unpacked FMU, whose `resources` have the state that it begins with. Its
    /// host cannot ask for the mesh error: the file does.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load_packed(resources: &Path, file_name: &str, text: &str) -> Result<Self, Failure> {
        let read = |_: &str| file::content(&resources.join(STATE_FILE));
        let mut simulation = Self::load_with(None, file_name, text, &[], &read)?;
        simulation.heed_mesh_error();
        Ok(simulation)
    }
}
