//! Sections, the ANCF14 element and its comparator ANCF24, bodies, joints, drives, springs and loads: no FMI, no files, no clock, no solver.
//!
//! Numbers behind "MECHANICS" and in parentheses refer to docs/mechanics.md. NOTATION of the code, SI throughout:
//!
//! | name | meaning |
//! |---|---|
//! | `q`, `v` | coordinates (node: `r`, `p`, `theta`) and their velocities |
//! | `r`, `p = r'` | position of a node, m, and its slope: derivative by undeformed arc length, 1 |
//! | `theta` | angle of the section against the frame carried along the beam's tangent, rad |
//! | `xi` | place in an element, 0 to 1; `h` a step in time, s |
//! | `t`, `u`, `v` | tangent and normals of a carried frame; `section = [t y z]` the section's axes |
//! | `kappa` | curvature of the carried frame, `gamma` of the section, 1/m |
//! | `omega`, `tau` | twist rate of the carried frame, torsion of the section, rad/m |
//! | `alpha`, `beta` | angle of the section inside the element; holonomy of its two nodes' frames, rad |
//! | `lambda`, `phi` | multipliers and conditions of joints |
//! | `_x`, `_q`, `_qq`, `_p` | derivative by length, coordinates (twice), slope |

pub mod ancf14;
pub mod ancf24;
pub mod assembly;
pub mod beam_design;
pub mod centreline;
pub mod configuration;
pub mod division;
pub mod energy_balance;
pub mod formulation;
pub mod gauge;
pub mod host_path;
pub mod joint;
pub mod load;
pub mod marker;
pub mod material;
pub mod mesh;
pub mod node;
pub mod pace;
pub mod pair;
pub mod pose;
pub mod pose_gradient;
pub mod prescribed;
pub mod resultants;
pub mod rigid_body;
pub mod section;
pub mod sensor;
pub mod spring;
pub mod state;
pub mod system;
pub mod time_error;
pub mod transmission;
pub mod triad;
pub mod variation;
