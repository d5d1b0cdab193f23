//! Where things are in an unpacked FMU: names of files, and the resource location of `fmi2Instantiate` (FMI 2.0,
//! section 2.1.5) as a directory.
//!
//! The standard wants a URI; hosts pass `file:///p`, `file:/p`, `file://localhost/p`, four slashes or a bare path, with
//! or without a final slash. URIs are percent-decoded, once; a bare path is taken literally.

use std::path::PathBuf;

use super::error::Error;

/// The state that a model begins with, inside `resources`.
pub const STATE_FILE: &str = "start.state";

/// The model file inside `resources`.
pub const MODEL_FILE: &str = "model.toml";

/// The file of a linear system inside `resources`, which has no model file then.
pub const LINEAR_FILE: &str = "linear.toml";

/// The shared library for the machine this was built for, as `scripts/build.sh` delivers it.
pub const LIBRARY: &str = match () {
    () if cfg!(windows) => "ancf14.dll",
    () if cfg!(target_os = "macos") => "libancf14.dylib",
    () => "libancf14.so",
};

/// The same library as cargo names it, after its package.
pub const CARGO_LIBRARY: &str = match () {
    () if cfg!(windows) => "ancf14_library.dll",
    () if cfg!(target_os = "macos") => "libancf14_library.dylib",
    () => "libancf14_library.so",
};

/// The directory that a resource location means; none where it is empty, which stands for the library's own resources.
///
/// # Errors
/// Another scheme than `file`, another machine, or bytes that are not UTF-8 after decoding.
pub fn directory(location: &str) -> Result<Option<PathBuf>, Error> {
    let location = location.trim();
    if location.is_empty() {
        return Ok(None);
    }
    let path = match scheme(location) {
        None => location.to_owned(),
        Some(("file", rest)) => {
            decode(local_path(location, rest)?).ok_or_else(|| refused(location, "it is not UTF-8"))?
        }
        Some(_) => return Err(refused(location, "only `file:` is possible")),
    };
    Ok(Some(PathBuf::from(path)))
}

/// Scheme in lower case and what follows its colon; none for a bare path (a single letter is a Windows drive).
fn scheme(location: &str) -> Option<(&'static str, &str)> {
    let (scheme, rest) = location.split_once(':')?;
    let is_scheme = scheme.len() > 1
        && scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'));
    is_scheme.then(|| (if scheme.eq_ignore_ascii_case("file") { "file" } else { "other" }, rest))
}

/// The path in what follows `file:`, still encoded.
fn local_path<'a>(location: &str, rest: &'a str) -> Result<&'a str, Error> {
    let path = match rest.strip_prefix("//") {
        None => rest,
        Some(with_host) => {
            let path = with_host.find('/').map_or("", |slash| &with_host[slash..]);
            let host = &with_host[..with_host.len() - path.len()];
            if !host.is_empty() && !host.eq_ignore_ascii_case("localhost") {
                return Err(refused(location, "it names another machine"));
            }
            path
        }
    };
    if path.is_empty() {
        return Err(refused(location, "it has no path"));
    }
    let after_slashes = path.trim_start_matches('/');
    let has_drive = after_slashes.as_bytes().get(1) == Some(&b':'); // `/C:/dir`
    let leading_slashes = path.len() - after_slashes.len();
    Ok(if cfg!(windows) && has_drive { after_slashes } else { &path[leading_slashes.saturating_sub(1)..] })
}

/// Percent-decoded once; a `%` without two hexadecimal digits stands for itself. None if the result is not UTF-8.
fn decode(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, others)) = rest.split_first() {
        let encoded = match (first, others) {
            (b'%', [high, low, ..]) => hexadecimal(*high).zip(hexadecimal(*low)),
            _ => None,
        };
        match encoded {
            Some((high, low)) => {
                bytes.push(16 * high + low);
                rest = &others[2..];
            }
            None => {
                bytes.push(first);
                rest = others;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

fn hexadecimal(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).and_then(|value| u8::try_from(value).ok())
}

fn refused(location: &str, reason: &str) -> Error {
    Error::Instantiate(format!(
        "the resource location `{location}` cannot be used: {reason}; pass the URI of the unpacked `resources` \
         directory, as in file:///tmp/unit/resources"
    ))
}
