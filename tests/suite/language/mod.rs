//! The model file: keys, mistakes, notes, copies, functions, includes, names, descriptions, pictures.

mod arm_notes;
pub mod bounds;
pub mod copies;
pub mod descriptions;
pub mod force_notes;
mod functions;
pub mod includes;
pub mod model_file;
pub mod model_mistakes;
pub mod model_parts;
pub mod names;
pub mod notes;
pub mod odd_machines;
pub mod over;
mod reference;
pub mod step_notes;
mod surfaces;
pub mod totals;
pub mod turned_copies;
pub mod view;
