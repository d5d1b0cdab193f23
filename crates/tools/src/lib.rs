//! The pages of docs/ that are written from runs: the validation page, and the campaign that counts silently wrong
//! answers.
#![allow(missing_docs, reason = "only the programs and tests of this package use it")]
#![allow(clippy::unwrap_used, reason = "a run that fails must stop the page")]

pub mod campaign;
pub mod validation;
