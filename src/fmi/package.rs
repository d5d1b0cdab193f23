//! The FMU: a zip archive of description, library, model file and documentation (FMI 2.0, section 2.3).
//!
//! The library is the same for every model; it reads `resources/model.toml` when it is instantiated. It is found by
//! `--library PATH`, else beside the executable, else in `../lib`. The same input gives the same bytes: fixed order,
//! fixed dates, fixed compression.

use std::{
    fs,
    io::{Cursor, Write},
    path::{Path, PathBuf},
};

use zip::{CompressionMethod, DateTime, ZipWriter, result::ZipResult, write::SimpleFileOptions};

use super::{About, description, documentation, error::Error, variable::Variable};

/// The model file inside `resources`.
pub const MODEL_FILE: &str = "model.toml";

/// The shared library for the machine this was built for, as cargo names it.
pub const LIBRARY: &str = if cfg!(windows) { "ancf14.dll" } else { "libancf14.so" };

/// FMI's name of that machine, and the suffix of libraries there.
const PLATFORM: (&str, &str) = if cfg!(windows) { ("win64", "dll") } else { ("linux64", "so") };

/// The bytes of the FMU.
///
/// `model_text` becomes the model file, `library` the shared library of this platform.
///
/// # Errors
/// The variable table cannot be described, or the archive would need zip64.
pub fn fmu(about: &About, variables: &[Variable], model_text: &str, library: &[u8]) -> Result<Vec<u8>, Error> {
    let (platform, suffix) = PLATFORM;
    let binary = format!("binaries/{platform}/{}.{suffix}", about.identifier);
    let model = format!("resources/{MODEL_FILE}");
    let xml = description::xml(about, variables)?;
    let page = documentation::html(about, variables);
    let entries: [(&str, &[u8]); 4] = [
        ("modelDescription.xml", xml.as_bytes()),
        (&binary, library),
        ("documentation/index.html", page.as_bytes()),
        (&model, model_text.as_bytes()),
    ];
    archive(&entries).map_err(|reason| io("cannot make the archive", reason))
}

/// Packs entries in their order, all with the zip format's first date.
fn archive(entries: &[(&str, &[u8])]) -> ZipResult<Vec<u8>> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        zip.start_file(*name, options)?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

/// The library that goes into an FMU: `given` by the user, else beside the executable, else in `../lib`.
///
/// # Errors
/// It is in none of these places; the message says how to build it.
pub fn find_library(given: Option<&Path>, executable: &Path) -> Result<PathBuf, Error> {
    let beside = executable.parent().unwrap_or(Path::new("."));
    let places = match given {
        Some(path) => vec![path.to_owned()],
        None => vec![beside.join(LIBRARY), beside.join("../lib").join(LIBRARY)],
    };
    match places.iter().find(|place| place.is_file()) {
        Some(place) => Ok(place.clone()),
        None => {
            let looked: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
            Err(Error::NoLibrary { name: LIBRARY.to_owned(), looked: looked.join(", ") })
        }
    }
}

/// Makes the FMU and writes it to `path`, with the library read from `library`.
///
/// # Errors
/// As [`fmu`], or a file cannot be read or written.
pub fn write(
    path: &Path,
    about: &About,
    variables: &[Variable],
    model_text: &str,
    library: &Path,
) -> Result<(), Error> {
    let binary = fs::read(library).map_err(|reason| io(&format!("cannot read {}", library.display()), reason))?;
    let bytes = fmu(about, variables, model_text, &binary)?;
    fs::write(path, bytes).map_err(|reason| io(&format!("cannot write {}", path.display()), reason))
}

fn io(what: &str, reason: impl std::fmt::Display) -> Error {
    Error::Io { what: what.to_owned(), reason: reason.to_string() }
}
