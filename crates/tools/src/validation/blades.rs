//! Blades against published frequencies.

use super::Section;
use ancf14_testing::blades::{REPORT, TABLE, at_standstill, flapping};
use std::fmt::Write;

pub fn write(section: &mut Section) {
    section.say(
        "*A blade that turns and tapers.* Its mass per length falls by half towards the tip, its bending stiffness with the third power of its height, without a hub; 6 elements, steps of 1 ms. Frequencies of \
         flapping from the spectrum of a run, times sqrt(m0 L^4/(E I0)). Reference: D. H. Hodges and M. J. Rutkowski, Free-vibration analysis of rotating beams by a variable-order finite-element method, AIAA \
         Journal 19 (1981). What is left in the second mode is the period error of the steps. `tests/suite/references/rotating_blade.rs` finds the same numbers by Ritz's method.",
    );
    let mut table =
        String::from("| speed | first | found | error | second | found | error |\n|---|---|---|---|---|---|---|\n");
    for row in TABLE {
        let [speed, first, second] = row;
        let [one, two] = flapping(row);
        let [error, other] = [one / first - 1.0, two / second - 1.0];
        let _ =
            writeln!(table, "| {speed} | {first:.4} | {one:.4} | {error:.1e} | {second:.4} | {two:.4} | {other:.1e} |");
    }
    section.say(&table);
    section.say(
        "*The blade of a 5 MW turbine* (`models/blade.toml`: a table of 49 stations with mass, stiffness and twist) at standstill, without weight. Reference: J. Jonkman, S. Butterfield, W. Musial and G. Scott, \
         Definition of a 5-MW reference wind turbine for offshore system development, NREL/TP-500-38060, 2009, table 9-1: FAST and ADAMS. In the reference tower and shaft move with the blades, \
         which the single blade does not know.",
    );
    let mut table = String::from(
        "| mode | FAST, Hz | ADAMS, Hz | found, Hz | from FAST | from ADAMS |\n|---|---|---|---|---|---|\n",
    );
    let names = ["first flapwise", "first edgewise", "second flapwise"];
    for ((name, [fast, adams]), found) in names.into_iter().zip(REPORT).zip(at_standstill()) {
        let [from_fast, from_adams] = [fast, adams].map(|other| 100.0 * (found / other - 1.0));
        let _ =
            writeln!(table, "| {name} | {fast:.4} | {adams:.4} | {found:.4} | {from_fast:.1} % | {from_adams:.1} % |");
    }
    section.say(&table);
}
