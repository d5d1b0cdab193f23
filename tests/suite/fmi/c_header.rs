//! Is include/ancf14.h what src/ffi exports, and do C and C++ compilers accept it alone? A stale header would make a C
//! program call functions with the wrong arguments.

use std::{path::Path, process::Command};

use crate::golden;

const SOURCES: [&str; 6] = [
    "src/ffi/front_types.rs",
    "src/ffi/front.rs",
    "src/ffi/types.rs",
    "src/ffi/fmi2.rs",
    "src/ffi/fmi2_values.rs",
    "src/ffi/fmi2_exchange.rs",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The header as cbindgen makes it from the exported functions.
#[test]
fn c_header_is_current() {
    let mut builder =
        cbindgen::Builder::new().with_config(cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap());
    for source in SOURCES {
        builder = builder.with_src(root().join(source));
    }
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    golden::assert_current("include/ancf14.h", &String::from_utf8(text).unwrap());
}

/// Alone, as C99 and as C++17, without a warning.
#[test]
fn c_header_compiles_alone() {
    let directory = tempfile::tempdir().unwrap();
    for (language, standard) in [("c", "-std=c99"), ("c++", "-std=c++17")] {
        let built = Command::new("cc")
            .current_dir(directory.path())
            .args(["-x", language, standard, "-Wall", "-Wextra", "-Werror", "-pedantic", "-c", "-o", "header.o"])
            .arg(root().join("include/ancf14.h"))
            .output()
            .unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    }
}
