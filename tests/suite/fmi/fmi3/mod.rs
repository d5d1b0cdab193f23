//! A unit in a host of FMI 3.0, through the C ABI.

mod absent;
mod arrays;
mod derivatives;
mod host;
mod modes;
mod panics;
mod storm;
mod updates;
mod values;
