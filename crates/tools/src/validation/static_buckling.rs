//! Critical loads of the linear theory of stability: Greenhill's shaft and the strip of Prandtl and Michell.

use super::{Section, critical, study};

const SHAFT: &str = include_str!("greenhill.toml");
const STRIP: &str = include_str!("strip.toml");

pub fn write(section: &mut Section) {
    section.say(
        "A torque buckles a shaft that is clamped at both ends and free to slide at one at M = 8.98682 EI/L (Greenhill, Ziegler; `crates/tools/src/validation/greenhill.toml`). \
         What destabilizes it is the second derivative of the holonomy alone. A dead force buckles a cantilever strip sideways at 2972.3 N (Prandtl and Michell, with the \
         deflection before buckling; the beam of the lateral buckling of the paper; `crates/tools/src/validation/strip.toml`).\n\n\
         The critical load is where the lowest eigenvalue of the tangent stiffness passes zero. Error, relative, of the shaft:",
    );
    let error = |text: &'static str, beam: &'static str| {
        move |elements: u32, twist: &str| {
            let (count, kind) = (format!("{beam}.elements"), format!("{beam}.twist"));
            let elements = elements.to_string();
            // At t = 1 the load is the critical one.
            (critical::time(text, &[(&count, &elements), (&kind, twist)], [0.8, 1.2]) - 1.0).abs()
        }
    };
    section.say(&study::twists(&[4, 8, 16], error(SHAFT, "shaft")));
    section.say("Of the strip, whose critical load is known to five digits:");
    section.say(&study::twists(&[2, 4, 8], error(STRIP, "strip")));
}
