//! The file name that the shared library records: programs that link it look for a file of that name. It is delivered
//! as `libancf14.so` and `ancf14.dll`, not by the name of this package, which rustc from 1.96 on and GNU ld record. The
//! library for x86-64 Linux records none: a program may link the one inside an FMU, which has the name of the model, by
//! its path.
#![allow(clippy::print_stdout, reason = "cargo reads what is printed")]

use std::env::var;

fn main() {
    println!("cargo::rerun-if-changed=ancf14.def");
    let of_target = |key: &str| var(format!("CARGO_CFG_TARGET_{key}")).unwrap_or_default();
    match (of_target("OS").as_str(), of_target("ENV").as_str()) {
        ("linux", _) if of_target("ARCH") != "x86_64" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libancf14.so")
        }
        ("windows", "gnu") => {
            let folder = var("CARGO_MANIFEST_DIR").unwrap_or_default();
            println!("cargo::rustc-cdylib-link-arg={folder}/ancf14.def");
        }
        _ => {}
    }
}
