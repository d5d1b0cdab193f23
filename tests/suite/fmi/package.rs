//! Is the archive what hosts unpack? Fixed order, fixed dates, plain deflate, the library under the model identifier,
//! and the same bytes for the same input.

use std::{
    fs,
    io::{Cursor, Read},
    path::Path,
};

use ancf14::fmi::package::{LIBRARY, Platform, find_library, fmu, write};
use zip::{CompressionMethod, ZipArchive};

use super::toy;

const MODEL: &str = "format = 1\n";

fn packed() -> Vec<u8> {
    fmu(&toy::about(), &toy::variables(), MODEL, &[(Platform::Linux64, vec![7; 5000]), (Platform::Win64, vec![8; 500])])
        .unwrap()
}

#[test]
fn same_input_same_bytes() {
    assert_eq!(packed(), packed());
}

#[test]
fn entries_in_order() {
    let mut archive = ZipArchive::new(Cursor::new(packed())).unwrap();
    let mut names = Vec::new();
    for place in 0..archive.len() {
        let file = archive.by_index(place).unwrap();
        assert_eq!(file.compression(), CompressionMethod::Deflated);
        assert_eq!(file.last_modified().map(|date| date.year()), Some(1980));
        names.push(file.name().unwrap().into_owned());
    }
    assert_eq!(
        names,
        [
            "modelDescription.xml",
            "binaries/linux64/Toy.so",
            "binaries/win64/Toy.dll",
            "documentation/index.html",
            "resources/model.toml"
        ]
    );
}

#[test]
fn contents_come_back() {
    let mut archive = ZipArchive::new(Cursor::new(packed())).unwrap();
    let mut read = |name: &str| {
        let mut bytes = Vec::new();
        archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    };
    assert_eq!(read("binaries/linux64/Toy.so"), [7; 5000]);
    assert_eq!(read("resources/model.toml"), MODEL.as_bytes());
    let page = String::from_utf8(read("documentation/index.html")).unwrap();
    for variable in toy::variables() {
        assert!(page.contains(&format!("<code>{}</code>", variable.name)), "{} is not documented", variable.name);
    }
    assert!(page.contains("Toy &amp; &quot;friends&quot;") && page.contains("a &lt; b"));
}

/// Given, beside the executable, in ../lib: in this order; otherwise an error that says how to make one.
#[test]
fn the_library_is_found() {
    let directory = tempfile::tempdir().unwrap();
    let root = directory.path();
    let place = |path: &str| {
        let path = root.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "").unwrap();
        path
    };
    let executable = place("bin/ancf14");
    let missing = find_library(None, &executable).unwrap_err().to_string();
    assert!(missing.contains("scripts/build.sh"), "{missing}");
    let in_lib = place(&format!("lib/{LIBRARY}"));
    let found = find_library(None, &executable).unwrap();
    assert_eq!(found.canonicalize().unwrap(), in_lib.canonicalize().unwrap());
    let beside = place(&format!("bin/{LIBRARY}"));
    assert_eq!(find_library(None, &executable).unwrap(), beside);
    let given = place("else/where.so");
    assert_eq!(find_library(Some(&given), &executable).unwrap(), given);
    assert!(find_library(Some(Path::new("/nowhere.so")), &executable).is_err());
}

#[test]
fn written_or_an_error_with_the_path() {
    let directory = tempfile::tempdir().unwrap();
    let library = directory.path().join("library.so");
    fs::write(&library, [7; 5000]).unwrap();
    let other = directory.path().join("library.dll");
    fs::write(&other, [8; 500]).unwrap();
    let libraries = [(Platform::Linux64, library.clone()), (Platform::Win64, other)];
    let target = directory.path().join("toy.fmu");
    write(&target, &toy::about(), &toy::variables(), MODEL, &libraries).unwrap();
    assert_eq!(fs::read(&target).unwrap(), packed());
    fs::remove_file(&library).unwrap();
    let error = write(&target, &toy::about(), &toy::variables(), MODEL, &libraries).unwrap_err().to_string();
    assert!(error.contains("cannot read") && error.contains("library.so"), "{error}");
    fs::write(&library, [7; 5000]).unwrap();
    let nowhere = directory.path().join("missing/toy.fmu");
    let error = write(&nowhere, &toy::about(), &toy::variables(), MODEL, &libraries).unwrap_err().to_string();
    assert!(error.contains("missing/toy.fmu"), "{error}");
}

/// The names of `--binary` are the standard's.
#[test]
fn platforms_by_name() {
    assert_eq!(Platform::from_name("win64"), Some(Platform::Win64));
    assert_eq!(Platform::from_name("amiga"), None);
    assert_eq!(Platform::from_name(Platform::NATIVE.name()), Some(Platform::NATIVE));
}
