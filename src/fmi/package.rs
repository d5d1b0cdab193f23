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
pub const LIBRARY: &str = match Platform::NATIVE {
    Platform::Linux64 => "libancf14.so",
    Platform::Win64 => "ancf14.dll",
    Platform::Darwin64 => "libancf14.dylib",
};

/// A machine that an FMU can bring a library for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {
    /// Linux on x86-64.
    Linux64,
    /// Windows on x86-64.
    Win64,
    /// macOS on x86-64.
    Darwin64,
}

impl Platform {
    /// The one this was built for.
    pub const NATIVE: Self = match () {
        () if cfg!(windows) => Self::Win64,
        () if cfg!(target_os = "macos") => Self::Darwin64,
        () => Self::Linux64,
    };

    /// FMI's name of it (section 2.3), as in `--binary win64=PATH`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linux64 => "linux64",
            Self::Win64 => "win64",
            Self::Darwin64 => "darwin64",
        }
    }

    /// The platform of FMI's name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Linux64, Self::Win64, Self::Darwin64].into_iter().find(|platform| platform.name() == name)
    }

    fn suffix(self) -> &'static str {
        match self {
            Self::Linux64 => "so",
            Self::Win64 => "dll",
            Self::Darwin64 => "dylib",
        }
    }
}

/// The bytes of the FMU.
///
/// `model_text` becomes the model file, `libraries` the shared libraries, one per platform.
///
/// # Errors
/// The variable table cannot be described, or the archive would need zip64.
pub fn fmu(
    about: &About,
    variables: &[Variable],
    model_text: &str,
    libraries: &[(Platform, Vec<u8>)],
) -> Result<Vec<u8>, Error> {
    let xml = description::xml(about, variables)?;
    let page = documentation::html(about, variables);
    let mut entries = vec![("modelDescription.xml".to_owned(), xml.as_bytes())];
    for (platform, library) in libraries {
        let name = format!("binaries/{}/{}.{}", platform.name(), about.identifier, platform.suffix());
        entries.push((name, library));
    }
    entries.push(("documentation/index.html".to_owned(), page.as_bytes()));
    entries.push((format!("resources/{MODEL_FILE}"), model_text.as_bytes()));
    archive(&entries).map_err(|reason| io("cannot make the archive", reason))
}

/// Packs entries in their order, all with the zip format's first date.
fn archive(entries: &[(String, &[u8])]) -> ZipResult<Vec<u8>> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        zip.start_file(name.as_str(), options)?;
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

/// Makes the FMU and writes it to `path`, with the libraries read from their files.
///
/// # Errors
/// As [`fmu`], or a file cannot be read or written.
pub fn write(
    path: &Path,
    about: &About,
    variables: &[Variable],
    model_text: &str,
    libraries: &[(Platform, PathBuf)],
) -> Result<(), Error> {
    let read = |(platform, file): &(Platform, PathBuf)| match fs::read(file) {
        Ok(bytes) => Ok((*platform, bytes)),
        Err(reason) => Err(io(&format!("cannot read {}", file.display()), reason)),
    };
    let libraries = libraries.iter().map(read).collect::<Result<Vec<_>, Error>>()?;
    let bytes = fmu(about, variables, model_text, &libraries)?;
    fs::write(path, bytes).map_err(|reason| io(&format!("cannot write {}", path.display()), reason))
}

fn io(what: &str, reason: impl std::fmt::Display) -> Error {
    Error::Io { what: what.to_owned(), reason: reason.to_string() }
}
