//! The campaign against silently wrong answers, in the manner of SQLite's testing: many machines, each run as its
//! author would, with steps and meshes that are too coarse, and beside a reference by refinement. A run may be right,
//! may refuse, may warn; it must not be wrong without a word.

pub mod catalogue;
mod edit;
mod family;
mod generators;
pub mod machine;
pub mod page;
mod reference;
mod run;
pub mod verdict;
pub mod warning;
