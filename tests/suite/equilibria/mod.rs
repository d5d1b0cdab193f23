//! Static analysis: equilibria, paths of loads, buckling.

pub mod far;
pub mod free_motions;
pub mod hanging;
pub mod paths;
pub mod preload;
pub mod static_buckling;
pub mod static_motions;
pub mod statics;
pub mod stiff;
