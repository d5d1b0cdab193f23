//! Is the archive what hosts unpack? Fixed order, fixed dates, plain deflate, the library under the model identifier,
//! and the same bytes for the same input.

use std::{
    fs,
    io::{Cursor, Read},
    path::Path,
};

use ancf14::fmi::About;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::location::{CARGO_LIBRARY, LIBRARY};
use ancf14_pack::contents::Contents;
use ancf14_pack::libraries::{Platform, find_library, find_others, read};
use ancf14_pack::package::fmu;
use ancf14_pack::small::{Origin, Reduction};
use ancf14_testing::toy;
use zip::{CompressionMethod, ZipArchive};

const MODEL: &str = "format = 1\n";

/// A picture of nothing; what the package does not look at.
const CONTENTS: Contents<'_> = Contents {
    state: None,
    model: MODEL,
    linear: None,
    licences: "do",
    icon: b"\x89PNG",
    page: "<p class=\"x\">'&'</p>",
    drawing: "<svg></svg>\n",
    legend: "a & b",
};

fn packed() -> Vec<u8> {
    packed_for(Standard::Fmi2)
}

/// The state that a model begins with is among the resources, and the default experiment starts at its time.
#[test]
fn states_are_packed() {
    let contents = Contents { state: Some(b"bytes"), ..CONTENTS };
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let about = About { start: 0.5, ..toy::about() };
        let fmu = fmu(standard, &about, &toy::variables(), &contents, &[(Platform::Linux64, vec![7])]).unwrap();
        let mut archive = ZipArchive::new(Cursor::new(fmu)).unwrap();
        let mut content = |name: &str| {
            let mut bytes = Vec::new();
            archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
            bytes
        };
        assert_eq!(content("resources/start.state"), b"bytes");
        let description = String::from_utf8(content("modelDescription.xml")).unwrap();
        assert!(description.contains("startTime=\"0.5\""), "{description}");
    }
}

/// A linear system has a file of its own instead of a model file, and its page says where it comes from.
#[test]
fn linear_systems_are_packed() {
    let reduction = Reduction { whole: 226, kept: 2, bound: Some(1.25e-3), error: 1e-3 };
    let origin = Origin {
        model: String::from("A & B"),
        state: String::from("the state at t = 0 s"),
        order: 8,
        reduction: Some(reduction),
        poles: vec![[0.0, 0.0], [-1.0, 2.0 * std::f64::consts::PI]],
        warnings: vec!["it moves".to_owned()],
    };
    let contents = Contents { linear: Some(&origin), ..CONTENTS };
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let fmu = fmu(standard, &toy::about(), &toy::variables(), &contents, &[(Platform::Linux64, vec![7])]).unwrap();
        let mut archive = ZipArchive::new(Cursor::new(fmu)).unwrap();
        let mut content = |name: &str| {
            let mut text = String::new();
            archive.by_name(name).unwrap().read_to_string(&mut text).unwrap();
            text
        };
        assert_eq!(content("resources/linear.toml"), MODEL);
        let page = content("documentation/index.html");
        for words in [
            "The linear system of A &amp; B about the state at t = 0 s",
            "reduced from 226 states to 8, 2 of them kept exactly",
            "at most 1.3e-3 of the response to a sudden change of an input",
            "<td>0.000000</td><td></td>",
            "<td>1.012586</td><td>0.1572</td>",
            "small motions",
        ] {
            assert!(page.contains(words), "{words}\n{page}");
        }
        assert!(!page.contains("Coupling with other units"));
        assert!(archive.by_name("resources/model.toml").is_err());
    }
}

fn packed_for(standard: Standard) -> Vec<u8> {
    fmu(
        standard,
        &toy::about(),
        &toy::variables(),
        &CONTENTS,
        &[(Platform::Linux64, vec![7; 5000]), (Platform::Win64, vec![8; 500]), (Platform::Wasm, vec![9; 50])],
    )
    .unwrap()
}

#[test]
fn same_input_same_bytes() {
    assert_eq!(packed(), packed());
}

/// The names of all entries; each is deflated, with a fixed date.
fn names(fmu: Vec<u8>) -> Vec<String> {
    let mut archive = ZipArchive::new(Cursor::new(fmu)).unwrap();
    let mut names = Vec::new();
    for place in 0..archive.len() {
        let file = archive.by_index(place).unwrap();
        assert_eq!(file.compression(), CompressionMethod::Deflated);
        assert_eq!(file.last_modified().map(|date| date.year()), Some(1980));
        names.push(file.name().unwrap().into_owned());
    }
    names
}

/// FMI 3.0 has other folders (section 2.5).
#[test]
fn entries_of_fmi_3_in_order() {
    assert_eq!(
        names(packed_for(Standard::Fmi3)),
        [
            "modelDescription.xml",
            "terminalsAndIcons/terminalsAndIcons.xml",
            "terminalsAndIcons/icon.png",
            "terminalsAndIcons/icon.svg",
            "binaries/x86_64-linux/Toy.so",
            "binaries/x86_64-windows/Toy.dll",
            "extra/org.modelica.fmi-ls-wasm/manifest.xml",
            "binaries/wasm32-wasip2/Toy.wasm",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "resources/model.toml"
        ]
    );
    assert_eq!(packed_for(Standard::Fmi3), packed_for(Standard::Fmi3));
}

/// The page of a unit speaks of its own version.
#[test]
fn the_page_names_the_functions_of_its_version() {
    for (standard, own, other) in [(Standard::Fmi2, "fmi2", "fmi3"), (Standard::Fmi3, "fmi3", "fmi2")] {
        let mut archive = ZipArchive::new(Cursor::new(packed_for(standard))).unwrap();
        let mut page = String::new();
        archive.by_name("documentation/index.html").unwrap().read_to_string(&mut page).unwrap();
        assert!(page.contains(&format!("{own}DoStep")) && !page.contains(other), "{page}");
    }
}

#[test]
fn entries_in_order() {
    assert_eq!(
        names(packed()),
        [
            "modelDescription.xml",
            "terminalsAndIcons/terminalsAndIcons.xml",
            "model.png",
            "binaries/linux64/Toy.so",
            "binaries/win64/Toy.dll",
            "documentation/index.html",
            "documentation/licenses/license.txt",
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
    assert!(page.contains("srcdoc='<p class=\"x\">&#39;&amp;&#39;</p>'"));
    assert!(
        page.contains("<svg></svg>") && page.contains("a &amp; b") && page.contains("href=\"licenses/license.txt\"")
    );
    assert_eq!(read("documentation/licenses/license.txt"), b"do");
    assert_eq!(read("model.png"), b"\x89PNG");
    assert!(page.contains("Toy &amp; &quot;friends&quot;") && page.contains("a &lt; b"));
}

/// Given, just built, beside the executable, in ../lib: in this order; otherwise an error that says how to make one.
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
    let built = place(&format!("bin/{CARGO_LIBRARY}"));
    assert_eq!(find_library(None, &executable).unwrap(), built);
    let given = place("else/where.so");
    assert_eq!(find_library(Some(&given), &executable).unwrap(), given);
    assert!(find_library(Some(Path::new("/nowhere.so")), &executable).is_err());
}

/// Libraries for other platforms are found by their folders beside the library; a folder without its file brings none,
/// and neither does this platform's own.
#[test]
fn libraries_for_others_are_found() {
    let directory = tempfile::tempdir().unwrap();
    let root = directory.path();
    let library = root.join(LIBRARY);
    let place = |path: &str| {
        let path = root.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "").unwrap();
        path
    };
    assert_eq!(find_others(&library), []);
    place(&format!("{}/{LIBRARY}", Platform::NATIVE.tuple()));
    place("x86-windows/libancf14.so");
    let mut expected = vec![
        (Platform::Win64, place("x86_64-windows/ancf14.dll")),
        (Platform::Darwin64, place("x86_64-darwin/libancf14.dylib")),
        (Platform::LinuxArm64, place("aarch64-linux/libancf14.so")),
        (Platform::Wasm, place("wasm32-wasip2/ancf14.wasm")),
    ];
    expected.retain(|(platform, _)| *platform != Platform::NATIVE);
    assert_eq!(find_others(&library), expected);
}

/// The first bytes of a shared library of each platform, as linkers write them.
fn heads() -> [(Platform, Vec<u8>); 7] {
    let elf = |class: u8, machine: u8| {
        let mut bytes = vec![0; 64];
        bytes[..6].copy_from_slice(&[0x7f, b'E', b'L', b'F', class, 1]);
        (bytes[16], bytes[18]) = (3, machine);
        bytes
    };
    let pe = |machine: u16| {
        let mut bytes = vec![0; 256];
        bytes[..2].copy_from_slice(b"MZ");
        bytes[60] = 128;
        bytes[128..132].copy_from_slice(b"PE\0\0");
        bytes[132..134].copy_from_slice(&machine.to_le_bytes());
        bytes[150..152].copy_from_slice(&0x2022_u16.to_le_bytes());
        bytes
    };
    let mach_o = vec![0xcf, 0xfa, 0xed, 0xfe, 7, 0, 0, 1, 3, 0, 0, 0, 6, 0, 0, 0];
    [
        (Platform::Linux32, elf(1, 3)),
        (Platform::Linux64, elf(2, 0x3e)),
        (Platform::Win32, pe(0x014c)),
        (Platform::Win64, pe(0x8664)),
        (Platform::Darwin64, mach_o),
        (Platform::LinuxArm64, elf(2, 0xb7)),
        (Platform::Wasm, b"\0asm\x0d\0\x01\0and twelve more".to_vec()),
    ]
}

/// A file is packed for the platform that it is for, once, or refused by its name.
#[test]
fn libraries_are_for_their_platform() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("library");
    for (platform, bytes) in heads() {
        fs::write(&path, &bytes).unwrap();
        for wanted in Platform::ALL {
            let outcome = read(&[(wanted, path.clone())]);
            if wanted == platform {
                assert_eq!(outcome.unwrap(), [(platform, bytes.clone())]);
            } else {
                let error = outcome.unwrap_err().to_string();
                assert!(error.contains(platform.name()) && error.contains(wanted.name()), "{error}");
            }
        }
        let error = read(&[(platform, path.clone()), (platform, path.clone())]).unwrap_err().to_string();
        assert!(error.contains("another one"), "{error}");
        for end in 0..bytes.len().min(140) {
            let enough = if platform == Platform::Wasm { 7 } else { 18 };
            assert!(end > enough || Platform::of_library(&bytes[..end]).is_none(), "{end} bytes");
        }
    }
    let [.., (_, mut program), _, _, _] = heads();
    program[151] = 0; // no DLL
    let module = b"\0asm\x01\0\0\0".to_vec(); // no component
    for bytes in [program, module, b"<html>".to_vec(), vec![0xff; 300], Vec::new()] {
        fs::write(&path, bytes).unwrap();
        let error = read(&[(Platform::Win64, path.clone())]).unwrap_err().to_string();
        assert!(error.contains("neither a shared library") && error.contains("library for win64"), "{error}");
    }
    fs::remove_file(&path).unwrap();
    let error = read(&[(Platform::Win64, path)]).unwrap_err().to_string();
    assert!(error.contains("cannot read"), "{error}");
}

/// The names of `--binary` are the standard's.
#[test]
fn platforms_by_name() {
    assert_eq!(Platform::from_name("win64"), Some(Platform::Win64));
    assert_eq!(Platform::from_name("amiga"), None);
    assert_eq!(Platform::from_name(Platform::NATIVE.name()), Some(Platform::NATIVE));
}
