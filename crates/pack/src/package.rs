//! The FMU: a zip archive of description, picture, libraries, model file, documentation and licences (FMI 2.0, section
//! 2.3; FMI 3.0, section 2.5).
//!
//! The library is the same for every model; it reads `resources/model.toml`, or `resources/linear.toml`, when it is
//! instantiated. It is found by
//! `--library PATH`, else beside the executable, else in `../lib`. The same input gives the same bytes: fixed order,
//! fixed dates, fixed compression.

use crate::contents::{Contents, LICENCES_FILE};
use crate::elements::{empty, text};
use crate::error::Error;
use crate::libraries::Platform;
use crate::{description, description_fmi3, documentation, terminals};
use ancf14::fmi::About;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::location::{LINEAR_FILE, MODEL_FILE, STATE_FILE};
use ancf14::fmi::variable::Variable;
use quick_xml::events::{BytesDecl, Event};
use std::io::{Cursor, Write};
use zip::{CompressionMethod, DateTime, ZipWriter, result::ZipResult, write::SimpleFileOptions};

/// The bytes of the FMU of a version of the standard, with shared libraries, one per platform.
///
/// # Errors
/// The variable table cannot be described, or the archive would need zip64.
pub fn fmu(
    standard: Standard,
    about: &About,
    variables: &[Variable],
    contents: &Contents<'_>,
    libraries: &[(Platform, Vec<u8>)],
) -> Result<Vec<u8>, Error> {
    let dated = dated(about, std::env::var("SOURCE_DATE_EPOCH").ok().as_deref());
    let xml = match standard {
        Standard::Fmi2 => description::xml(&dated, variables)?,
        Standard::Fmi3 => description_fmi3::xml(&dated, variables)?,
    };
    let page = documentation::html(standard, about, variables, contents);
    let terminals = terminals::xml(standard, variables);
    let mut entries = vec![
        ("modelDescription.xml".to_owned(), xml.as_bytes()),
        ("terminalsAndIcons/terminalsAndIcons.xml".to_owned(), terminals.as_bytes()),
    ];
    match standard {
        Standard::Fmi2 => entries.push(("model.png".to_owned(), contents.icon)),
        Standard::Fmi3 => entries.extend([
            ("terminalsAndIcons/icon.png".to_owned(), contents.icon),
            ("terminalsAndIcons/icon.svg".to_owned(), contents.drawing.as_bytes()),
        ]),
    }
    let manifest = manifest();
    for (platform, library) in libraries {
        if *platform == Platform::Wasm {
            // No host of FMI 2.0 knows components.
            if standard == Standard::Fmi2 {
                continue;
            }
            entries.push((MANIFEST_FILE.to_owned(), manifest.as_bytes()));
        }
        let folder = match standard {
            Standard::Fmi2 => platform.name(),
            Standard::Fmi3 => platform.tuple(),
        };
        entries.push((format!("binaries/{folder}/{}.{}", about.identifier, platform.suffix()), library));
    }
    entries.push(("documentation/index.html".to_owned(), page.as_bytes()));
    entries.push((format!("documentation/{LICENCES_FILE}"), contents.licences.as_bytes()));
    let file = if contents.linear.is_some() { LINEAR_FILE } else { MODEL_FILE };
    entries.push((format!("resources/{file}"), contents.model.as_bytes()));
    if let Some(state) = contents.state {
        entries.push((format!("resources/{STATE_FILE}"), state));
    }
    archive(&entries)
        .map_err(|reason| Error::Io { what: "cannot make the archive".to_owned(), reason: reason.to_string() })
}

/// Where the working draft of FMI-LS-WASM (July 2026) looks for its manifest.
const MANIFEST_FILE: &str = "extra/org.modelica.fmi-ls-wasm/manifest.xml";

/// The manifest of FMI-LS-WASM.
fn manifest() -> String {
    text(|xml| {
        xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        let attributes = vec![
            ("xmlns:fmi-ls", "http://fmi-standard.org/fmi-ls-manifest".into()),
            ("fmi-ls:fmi-ls-name", "org.modelica.fmi-ls-wasm".into()),
            ("fmi-ls:fmi-ls-version", "0.1.0".into()),
            ("fmi-ls:fmi-ls-description", "FMI Layered Standard for WebAssembly".into()),
        ];
        empty(xml, "fmi-ls:fmiLayeredStandardManifest", attributes)
    })
}

/// The model with a date: its own, or that of the sources that a build is of, s since 1970 (reproducible-builds.org);
/// else none.
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
