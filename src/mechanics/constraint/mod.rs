//! What holds a mechanism together: joints as lists of primitive conditions, a file a kind, the rigidity of bodies,
//! drives, gears.

pub mod cylindrical;
pub mod driven;
pub mod gear;
pub mod inline;
pub mod inplane;
pub mod joint;
pub mod primitive;
pub mod prismatic;
pub mod revolute;
pub mod rigidity;
pub mod slide;
pub mod spherical;
pub mod universal;
pub mod weld;
