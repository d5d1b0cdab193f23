//! The FMU: a zip archive of description, picture, libraries, model file, documentation and licences (FMI 2.0, section 2.3).
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

use super::{
    About, description, documentation,
    error::Error,
    location::{LIBRARY, MODEL_FILE},
    variable::Variable,
};

/// Where the licences are inside `documentation` (FMI 2.0.1 and later, section 2.3).
pub const LICENCES_FILE: &str = "licenses/license.txt";

/// A machine that an FMU can bring a library for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {
    /// Linux on x86.
    Linux32,
    /// Linux on x86-64.
    Linux64,
    /// Windows on x86.
    Win32,
    /// Windows on x86-64.
    Win64,
    /// macOS on x86-64.
    Darwin64,
}

impl Platform {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Linux32, Self::Linux64, Self::Win32, Self::Win64, Self::Darwin64];

    /// The one this was built for.
    pub const NATIVE: Self = match () {
        () if cfg!(windows) => Self::Win64,
        () if cfg!(target_os = "macos") => Self::Darwin64,
        () => Self::Linux64,
    };

    /// FMI's name of it (section 2.3), as in `--binary win64=PATH`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linux32 => "linux32",
            Self::Linux64 => "linux64",
            Self::Win32 => "win32",
            Self::Win64 => "win64",
            Self::Darwin64 => "darwin64",
        }
    }

    /// The platform of FMI's name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|platform| platform.name() == name)
    }

    fn suffix(self) -> &'static str {
        match self {
            Self::Linux32 | Self::Linux64 => "so",
            Self::Win32 | Self::Win64 => "dll",
            Self::Darwin64 => "dylib",
        }
    }

    /// What the bytes of a library are for; nothing, if they are no library or for another machine.
    pub fn of_library(bytes: &[u8]) -> Option<Self> {
        let at = |place: usize, wanted: &[u8]| bytes.get(place..place + wanted.len()) == Some(wanted);
        // ELF: magic, class, byte order; type 3 is a shared object, then the machine.
        if at(0, b"\x7fELF\x02\x01") && at(16, &[3, 0, 0x3e, 0]) {
            return Some(Self::Linux64);
        }
        if at(0, b"\x7fELF\x01\x01") && at(16, &[3, 0, 3, 0]) {
            return Some(Self::Linux32);
        }
        // Mach-O of 64 bits, processor x86-64, file type 6 is a dynamic library.
        if at(0, &[0xcf, 0xfa, 0xed, 0xfe, 7, 0, 0, 1]) && at(12, &[6, 0, 0, 0]) {
            return Some(Self::Darwin64);
        }
        // PE: the place of its header stands at 60; bit 13 of the characteristics is a DLL's.
        let header = u32::from_le_bytes(bytes.get(60..64)?.try_into().ok()?) as usize;
        let library = bytes.get(header.checked_add(23)?)? & 0x20 != 0;
        match () {
            () if !library || !at(0, b"MZ") || !at(header, b"PE\0\0") => None,
            () if at(header + 4, &[0x64, 0x86]) => Some(Self::Win64),
            () if at(header + 4, &[0x4c, 0x01]) => Some(Self::Win32),
            () => None,
        }
    }
}

/// What an FMU shows and says beside its variables.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a> {
    /// The model file.
    pub model: &'a str,
    /// Licences of all that is in the libraries.
    pub licences: &'a str,
    /// PNG picture that stands for the unit.
    pub icon: &'a [u8],
    /// SVG drawing for the documentation.
    pub drawing: &'a str,
    /// What is in the drawing.
    pub legend: &'a str,
}

/// The bytes of the FMU, with shared libraries, one per platform.
///
/// # Errors
/// The variable table cannot be described, or the archive would need zip64.
pub fn fmu(
    about: &About,
    variables: &[Variable],
    contents: &Contents<'_>,
    libraries: &[(Platform, Vec<u8>)],
) -> Result<Vec<u8>, Error> {
    let xml = description::xml(&dated(about, std::env::var("SOURCE_DATE_EPOCH").ok().as_deref()), variables)?;
    let page = documentation::html(about, variables, contents);
    let mut entries =
        vec![("modelDescription.xml".to_owned(), xml.as_bytes()), ("model.png".to_owned(), contents.icon)];
    for (platform, library) in libraries {
        let name = format!("binaries/{}/{}.{}", platform.name(), about.identifier, platform.suffix());
        entries.push((name, library));
    }
    entries.push(("documentation/index.html".to_owned(), page.as_bytes()));
    entries.push((format!("documentation/{LICENCES_FILE}"), contents.licences.as_bytes()));
    entries.push((format!("resources/{MODEL_FILE}"), contents.model.as_bytes()));
    archive(&entries).map_err(|reason| io("cannot make the archive", reason))
}

/// The model with a date: its own, or that of the sources that a build is of, s since 1970 (reproducible-builds.org); else none.
fn dated(about: &About, epoch: Option<&str>) -> About {
    let mut about = about.clone();
    about.credits.date = about.credits.date.or_else(|| epoch?.parse().ok().map(date));
    about
}

/// The date of an instant, s since 1970, as FMI writes dates.
fn date(epoch: u32) -> String {
    let (day, time) = (epoch / 86_400, epoch % 86_400);
    let is_leap = |year: u32| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let length = |year: u32| if is_leap(year) { 366 } else { 365 };
    let (mut year, mut day) = (1970, day);
    while day >= length(year) {
        day -= length(year);
        year += 1;
    }
    let mut month = 0;
    let months = [31, length(year) - 337, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    while day >= months[month] {
        day -= months[month];
        month += 1;
    }
    let (hour, minute, second) = (time / 3600, time / 60 % 60, time % 60);
    format!("{year:04}-{:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z", month + 1, day + 1)
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

/// Reads libraries from their files.
///
/// # Errors
/// One cannot be read, is no library for its platform, or is the second one for it.
pub fn read(libraries: &[(Platform, PathBuf)]) -> Result<Vec<(Platform, Vec<u8>)>, Error> {
    let mut read: Vec<(Platform, Vec<u8>)> = Vec::new();
    for (platform, file) in libraries {
        let bytes = fs::read(file).map_err(|reason| io(&format!("cannot read {}", file.display()), reason))?;
        let problem = match Platform::of_library(&bytes) {
            Some(found) if found != *platform => format!("it is a shared library for {}", found.name()),
            None => "it is no shared library for x86 or x86-64".to_owned(),
            Some(_) if read.iter().any(|(earlier, _)| earlier == platform) => "there is another one already".to_owned(),
            Some(_) => {
                read.push((*platform, bytes));
                continue;
            }
        };
        return Err(io(&format!("cannot pack {} for {}", file.display(), platform.name()), problem));
    }
    Ok(read)
}

fn io(what: &str, reason: impl std::fmt::Display) -> Error {
    Error::Io { what: what.to_owned(), reason: reason.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dates as `date -u -d @N` tells them: leap years, ends of months and of the range.
    #[test]
    fn dates_of_instants() {
        for (epoch, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_199, "2024-02-29T23:59:59Z"),
            (1_774_958_400, "2026-03-31T12:00:00Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (u32::MAX, "2106-02-07T06:28:15Z"),
        ] {
            assert_eq!(date(epoch), expected);
        }
    }
}
