//! The shared library that goes into FMUs and that C programs link. It exports the functions of `ancf14::ffi`;
//! scripts/build.sh names it after `ancf14`.

// Nothing is called, but its C functions are exported.
extern crate ancf14 as _;
