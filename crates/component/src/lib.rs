//! The unit as a component of WebAssembly: the world `co-simulation-fmu` of the working draft of FMI-LS-WASM
//! (`wit/fmi3.wit`), built by `scripts/build-component.sh`.
//!
//! It reads `resources/model.toml`, or `resources/linear.toml`, by `wasi:filesystem`, from a folder that the host opens
//! for it, and asks for nothing
//! else of WASI.
//! [`unit`] is an instance, [`exports`] what the host calls of it.
#![cfg(target_arch = "wasm32")]

mod exports;
mod files;
mod unit;

// The bindings are made from the text of the world; they are neither documented nor free of unsafe code.
#[allow(missing_docs, unsafe_code, clippy::all, clippy::pedantic, reason = "generated")]
mod bindings {
    wit_bindgen::generate!({ path: "wit", world: "co-simulation-fmu" });
    use super::exports::Fmu;
    export!(Fmu);
}
