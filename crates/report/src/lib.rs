//! What a simulation leaves for people to look at, as text and bytes: tables, charts and drawings.
//!
//! Nothing here prints, writes files or knows a terminal: the command line does that, and other programs may.

pub mod arrays;
pub mod bars;
pub mod bode;
pub mod campbell;
pub mod chart;
pub mod column;
pub mod draw;
pub mod errors;
pub mod extremes;
pub mod mat;
pub mod matrices;
pub mod modelica;
pub mod modes;
pub mod numbers;
pub mod overview;
mod panels;
pub mod picture;
pub mod plot;
pub mod poles;
pub mod ranges;
pub mod results;
pub mod sampled;
pub mod shapes;
pub mod summary;
pub mod trace;
