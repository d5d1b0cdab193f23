//! The ANCF24 beam (Yakoub and Shabana 2001): each node has its place and the three gradients `r_x`, `r_y`, `r_z`;
//! cubic along the axis, linear across; the continuum's strains. The paper measures ANCF14 against it.

mod balance;
mod beam_element;
pub mod coordinates;
pub mod damping;
pub mod element;
pub mod frame;
pub mod inertia;
pub mod law;
mod section;
pub mod station;
pub mod strain;
