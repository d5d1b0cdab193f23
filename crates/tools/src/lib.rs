//! The pages of docs/ that are written from runs: the validation pages, and the campaign that counts silently wrong
//! answers; and the measurement of runs that choose their steps and meshes.
#![allow(missing_docs, reason = "only the programs and tests of this package use it")]
#![allow(clippy::unwrap_used, reason = "a run that fails must stop the page")]

pub mod campaign;
pub mod promise;
pub mod validation;
