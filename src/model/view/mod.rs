//! What a picture that moves shows of a simulation, as plain data: what never changes ([`Scene`]), and numbers at
//! instants ([`Track`]s).
//!
//! A [`Recording`] is made of a simulation as drawn, before its initial state is found, and looks at it whenever it is
//! told to.

pub mod drawing;
pub mod modes;
mod profile;
mod recorder;
mod rope_line;
mod scene;
mod shapes;
mod stations;
mod zeros;

pub use crate::mechanics::fluid::waves::Component as Wave;
pub use profile::{Profile, Solid};
pub use recorder::{Recording, Track};
pub use scene::{BeamLook, BodyLook, BottomLook, JointLook, LoadLook, RopeLook, Scene, SurfaceLook, WaterLook};
pub use shapes::Swing;
pub use stations::{RESULTS, StationResult};
