//! The C ABI, that of FMI 2.0 and 3.0 and that of the library's own functions: the only unsafe code.
//!
//! [`types`] names C types as FMI 2.0 does, [`fmi2`] and its siblings export its functions, three lines each:
//! borrow, call safe code, translate; [`fmi3_types`], [`fmi3`] and its siblings do the same for FMI 3.0; [`front`]
//! with [`front_types`] do the same for [`crate::Simulation`]. [`guard`] checks pointers, catches panics, logs and
//! makes the status; [`component`] and `front_handle` are what a program holds. Nothing here is kept outside of
//! these, except which handles are live (`live`), and the words of a panic on their way from where it happened to the
//! guard (`fault`). The traps and the rounding of a host are put aside meanwhile (`float_environment`).
#![allow(unsafe_code, reason = "C hands over pointers; every use of one states who keeps the promise")]

pub mod component;
mod fault;
mod float_environment;
pub mod fmi2;
pub mod fmi2_exchange;
pub mod fmi2_values;
pub mod fmi3;
pub mod fmi3_absent;
pub mod fmi3_exchange;
pub mod fmi3_other_types;
pub mod fmi3_types;
pub mod fmi3_values;
pub mod front;
mod front_handle;
pub mod front_types;
pub mod guard;
mod live;
pub mod types;

pub use fault::silence as silence_panics;
