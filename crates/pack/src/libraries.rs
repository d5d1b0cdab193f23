//! The shared libraries that an FMU brings: for which machine each is, and where they are found.

use crate::error::Error;
use ancf14::fmi::location::{CARGO_LIBRARY, LIBRARY};
use std::fs;
use std::path::{Path, PathBuf};

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
    /// Linux on 64-bit ARM.
    LinuxArm64,
    /// WebAssembly with WASI 0.2, a component as the draft of FMI-LS-WASM describes it: in FMUs of FMI 3.0 only.
    Wasm,
}

impl Platform {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Linux32, Self::Linux64, Self::Win32, Self::Win64, Self::Darwin64, Self::LinuxArm64, Self::Wasm];

    /// The one this was built for.
    pub const NATIVE: Self = match () {
        () if cfg!(windows) => Self::Win64,
        () if cfg!(target_os = "macos") => Self::Darwin64,
        () if cfg!(target_arch = "aarch64") => Self::LinuxArm64,
        () => Self::Linux64,
    };

    /// FMI 2.0's name of it, as in `--binary win64=PATH`. Where FMI 2.0 has none, it takes that of FMI 3.0 (FMI 2.0.5,
    /// section 2.3).
    pub fn name(self) -> &'static str {
        match self {
            Self::Linux32 => "linux32",
            Self::Linux64 => "linux64",
            Self::Win32 => "win32",
            Self::Win64 => "win64",
            Self::Darwin64 => "darwin64",
            Self::LinuxArm64 | Self::Wasm => self.tuple(),
        }
    }

    /// FMI 3.0's name of it (section 2.5.2), or that of the draft.
    pub fn tuple(self) -> &'static str {
        match self {
            Self::Linux32 => "x86-linux",
            Self::Linux64 => "x86_64-linux",
            Self::Win32 => "x86-windows",
            Self::Win64 => "x86_64-windows",
            Self::Darwin64 => "x86_64-darwin",
            Self::LinuxArm64 => "aarch64-linux",
            Self::Wasm => "wasm32-wasip2",
        }
    }

    /// The platform of FMI's name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|platform| platform.name() == name)
    }

    pub(crate) fn suffix(self) -> &'static str {
        match self {
            Self::Linux32 | Self::Linux64 | Self::LinuxArm64 => "so",
            Self::Win32 | Self::Win64 => "dll",
            Self::Darwin64 => "dylib",
            Self::Wasm => "wasm",
        }
    }

    /// The file name of the library, as cargo gives it.
    fn file_name(self) -> String {
        let prefix = if matches!(self, Self::Win32 | Self::Win64 | Self::Wasm) { "" } else { "lib" };
        format!("{prefix}ancf14.{}", self.suffix())
    }

    /// What the bytes of a library are for; nothing, if they are no library or for another machine.
    pub fn of_library(bytes: &[u8]) -> Option<Self> {
        let at = |place: usize, wanted: &[u8]| bytes.get(place..place + wanted.len()) == Some(wanted);
        // ELF: magic, class, byte order; type 3 is a shared object, then the machine.
        if at(0, b"\x7fELF\x02\x01") && at(16, &[3, 0, 0x3e, 0]) {
            return Some(Self::Linux64);
        }
        if at(0, b"\x7fELF\x02\x01") && at(16, &[3, 0, 0xb7, 0]) {
            return Some(Self::LinuxArm64);
        }
        if at(0, b"\x7fELF\x01\x01") && at(16, &[3, 0, 3, 0]) {
            return Some(Self::Linux32);
        }
        // WebAssembly: magic, version; layer 1 is a component.
        if at(0, b"\0asm") && at(6, &[1, 0]) {
            return Some(Self::Wasm);
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

/// The library that goes into an FMU: `given` by the user, else beside the executable, as cargo has just built it or as
/// it is installed, else in `../lib`.
///
/// # Errors
/// It is in none of these places; the message says how to build it.
pub fn find_library(given: Option<&Path>, executable: &Path) -> Result<PathBuf, Error> {
    let beside = executable.parent().unwrap_or(Path::new("."));
    let places = match given {
        Some(path) => vec![path.to_owned()],
        None => vec![beside.join(CARGO_LIBRARY), beside.join(LIBRARY), beside.join("../lib").join(LIBRARY)],
    };
    match places.iter().find(|place| place.is_file()) {
        Some(place) => Ok(place.clone()),
        None => {
            let looked: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
            Err(Error::NoLibrary { name: LIBRARY.to_owned(), looked: looked.join(", ") })
        }
    }
}

/// The libraries for other platforms that lie beside `library`, in folders named as FMI 3.0 names the platforms:
/// `x86_64-windows/ancf14.dll`.
pub fn find_others(library: &Path) -> Vec<(Platform, PathBuf)> {
    let folder = library.parent().unwrap_or(Path::new(""));
    let place = |platform: Platform| (platform, folder.join(platform.tuple()).join(platform.file_name()));
    let others = Platform::ALL.into_iter().filter(|platform| *platform != Platform::NATIVE).map(place);
    others.filter(|(_, file)| file.is_file()).collect()
}

/// Reads libraries from their files.
///
/// # Errors
/// One cannot be read, is not a library for its platform, or is the second one for it.
pub fn read(libraries: &[(Platform, PathBuf)]) -> Result<Vec<(Platform, Vec<u8>)>, Error> {
    let mut read: Vec<(Platform, Vec<u8>)> = Vec::new();
    for (platform, file) in libraries {
        let bytes = fs::read(file).map_err(|reason| io(&format!("cannot read {}", file.display()), reason))?;
        let problem = match Platform::of_library(&bytes) {
            Some(found) if found != *platform => format!("it is a shared library for {}", found.name()),
            None => {
                "it is neither a shared library for x86, x86-64 or 64-bit ARM nor a component of WebAssembly".to_owned()
            }
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
