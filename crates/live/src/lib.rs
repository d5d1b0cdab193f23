//! The solver in the page of `ancf14 view --live`, compiled to WebAssembly (docs/viewer.md): a request with a model
//! comes in as JSON, the data of the page go out.
//!
//! The module imports nothing, so that any host of WebAssembly runs it. The page calls it in a worker, a few rows of
//! results at a time.

mod exports;
mod grips;
mod request;
mod run;
mod session;
