//! The stack of the main thread: Windows takes its size from the program, and gives 1 or 2 MiB by default. It is that of
//! Linux here.
#![allow(clippy::print_stdout, reason = "cargo reads what is printed")]

use std::env::var;

const STACK: u32 = 8 << 20;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of_target = |key: &str| var(format!("CARGO_CFG_TARGET_{key}")).unwrap_or_default();
    match (of_target("OS").as_str(), of_target("ENV").as_str()) {
        ("windows", "msvc") => println!("cargo::rustc-link-arg-bins=/STACK:{STACK}"),
        ("windows", _) => println!("cargo::rustc-link-arg-bins=-Wl,--stack,{STACK}"),
        _ => {}
    }
}
