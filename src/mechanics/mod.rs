//! Sections, the ANCF14 element and its comparator ANCF24, bodies, joints, drives, springs and loads: no FMI, no files,
//! no clock, no solver.
//!
//! The rooms are a stack, the lowest first: `geometry`, `body`, `input` and `fluid`, `beam` and `state`, `marker`,
//! `constraint` and `force`, `system`, `output`.
//!
//! Numbers behind "MECHANICS" and in parentheses refer to docs/mechanics.md. NOTATION of the code, SI throughout:
//!
//! | name | meaning |
//! |---|---|
//! | `q`, `v` | coordinates (node: `r`, `p`, `theta`) and their velocities |
//! | `r`, `p = r'` | position of a node, m, and its slope: derivative by undeformed arc length, 1 |
//! | `theta` | angle of the section against the frame carried along the beam's tangent, rad |
//! | `xi` | position in an element, 0 to 1; `h` a step in time, s |
//! | `t`, `u`, `v` | tangent and normals of a carried frame; `section = [t y z]` the section's axes |
//! | `kappa` | curvature of the carried frame, `gamma` of the section, 1/m |
//! | `omega`, `tau` | twist rate of the carried frame, torsion of the section, rad/m |
//! | `alpha`, `beta` | angle of the section inside the element; holonomy of its two nodes' frames, rad |
//! | `lambda`, `phi` | multipliers and conditions of joints |
//! | `_x`, `_q`, `_qq`, `_p` | derivative by length, coordinates (twice), slope |

pub mod beam;
pub mod body;
pub mod constraint;
pub mod contact;
pub mod fluid;
pub mod force;
pub mod geometry;
pub mod input;
pub mod marker;
pub mod output;
pub mod state;
pub mod system;
