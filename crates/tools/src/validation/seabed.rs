//! Lines on the seabed: chains in three depths of water, and a bar that friction holds.

use super::Section;
use ancf14_testing::curves::Curves;
use std::fmt::Write;

const CHAIN: &str = include_str!("seabed.toml");
const BAR: &str = include_str!("seabed_bar.toml");

/// Depth, distance and length, m; horizontal force and tension at the fairlead, N, and laid length, m: the elastic
/// catenary on a rigid bed without friction, in closed form.
const CHAINS: [([&str; 3], [f64; 3]); 3] = [
    (["50", "400", "410"], [835_593.793, 1_001_665.153, 243.785]),
    (["200", "700", "760"], [1_406_150.292, 2_070_110.868, 302.844]),
    (["600", "1500", "1700"], [3_247_254.948, 5_236_165.214, 463.967]),
];
/// Force on the bar, N.
const PULL: f64 = 3000.0;

pub fn write(section: &mut Section) {
    section.say(
        "*A chain in three depths of water* (`crates/tools/src/validation/seabed.toml`), without bending stiffness, on a seabed of 1e7 Pa/m that its axis touches. Reference: the elastic catenary on a rigid bed, in closed form.",
    );
    let mut table = String::from(
        "| depth | elements | horizontal force, N | error | tension, N | error | touchdown from the anchor, m | exact |\n|---|---|---|---|---|---|---|---|\n",
    );
    for ([depth, distance, length], [horizontal, tension, laid]) in CHAINS {
        for elements in ["10", "20", "40", "80"] {
            let found = Curves::run(
                CHAIN,
                &[("depth", depth), ("distance", distance), ("length", length), ("line.elements", elements)],
            );
            let [x, z] = [1, 3].map(|axis| found.last(&format!("fairlead.reaction_force[{axis}]")));
            let (own, all) = (x.abs(), x.hypot(z));
            let _ = writeln!(
                table,
                "| {depth} m | {elements} | {own:.0} | {:.3} % | {all:.0} | {:.3} % | {:.2} | {laid} |",
                100.0 * (own / horizontal - 1.0),
                100.0 * (all / tension - 1.0),
                found.last("line.touchdown")
            );
        }
    }
    section.say(&table);

    section.say(
        "*An elastic bar on the seabed* (`crates/tools/src/validation/seabed_bar.toml`) is pulled by its end, 90 mm in 20 steps, and slides up to where friction holds it. Reference: `sqrt(2 EA friction weight u)`.",
    );
    let mut table = String::from("| elements | exact, N | found, N | error |\n|---|---|---|---|\n");
    for elements in ["10", "20", "40"] {
        let found = Curves::run(BAR, &[("bar.elements", elements)]).last("pull.reaction_force[1]");
        let _ = writeln!(table, "| {elements} | {PULL} | {found:.1} | {:.2} % |", 100.0 * (found / PULL - 1.0));
    }
    section.say(&table);
}
