//! Thick rods that are given by their rigidities, whose moments are in proportion to curvatures however far fibers
//! would strain.

use super::{Section, study};
use ancf14_testing::curves::Curves;
use ancf14_testing::thick_rods::{ROUND, SHORT, WINDING, elastica, helix, rod};

/// Loads of the helix at which its reference is found.
const LOADS: u32 = 50;

pub fn write(section: &mut Section) {
    section.say(
        "Rods with `shape = \"rigidities\"` that would be thick as rectangles with these: rolled up by M = 2 pi EI / L, their outermost fibers would strain by 11 %. `M = EI kappa`, `T = GJ tau` and \
         `N = EA epsilon` hold exactly, per undeformed length (mechanics.md, section 3.1), and the errors are those of the mesh. With `strain = \"large\"` the circle stays open by 1.4 % of its length, the \
         tip of the cantilever is 4 % too far with 8 elements, and the helix breaks off at a third of its loads.\n\n\
         - A full turn: L = 10 m, EA = 1e4 N, EI = GJ = 100 N m2. The end must meet the start.\n\
         - A cantilever with P L^2 / EI = 3: L = 4 m, P = 300 N, EA = 1e4 N, EI = 1600 N m2. Its reference is the elastica with stretching, by shooting.\n\
         - A helix of ten turns: the first rod under a dead moment of 200 pi N m and a dead force of 50 N, both along z. With EI = GJ its reference has one unknown, which shooting finds (`crates/testing/src/thick_rods.rs`).",
    );
    let tip = |section: &str, size: (f64, usize, &str), load: &str| {
        let curves = Curves::run(&rod(section, size, load), &[]);
        [1, 2, 3].map(|axis| curves.last(&format!("tip.displacement[{axis}]")))
    };
    let twist = |name: &str| format!("twist = \"{name}\"");
    section.say("Distance of the end from the start at a full turn, relative to the length:");
    section.say(&study::twists(&[8, 16, 32], |elements, name| {
        let [x, y, z] = tip(ROUND, (10.0, elements as usize, &twist(name)), "moment = [0, 0, \"20*pi*t\"]");
        (x + 10.0).hypot(y).hypot(z) / 10.0
    }));
    let [along, across] = elastica([300.0, 1600.0, 1e4, 4.0]);
    section.say(&format!(
        "The cantilever: distance of the tip from where it should be, {across:.6} m across and {:.6} m back, relative to the length:",
        4.0 - along
    ));
    section.say(&study::twists(&[4, 8, 16], |elements, name| {
        let [x, y, _] = tip(SHORT, (4.0, elements as usize, &twist(name)), "force = [0, \"300*t\", 0]");
        (x + 4.0 - along).hypot(y - across) / 4.0
    }));
    let heights = helix(LOADS);
    let [part, whole] = [heights[LOADS as usize / 5 - 1], heights[LOADS as usize - 1]];
    section.say(&format!(
        "The helix: the tip is at z = {part:.6} m under a fifth of the loads and at {whole:.6} m under all of them. Error of its z under all of them, relative to the length:"
    ));
    section.say(&study::twists(&[100, 200], |elements, name| {
        let [_, _, z] = tip(ROUND, (10.0, elements as usize, &twist(name)), WINDING);
        (z - whole).abs() / 10.0
    }));
}
