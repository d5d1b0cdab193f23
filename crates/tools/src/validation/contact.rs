//! Beams that touch surfaces: a rope on a post, two masses on a rope over a sheave, a belt drive.

use super::{Section, line, plot};
use ancf14_testing::capstan;
use ancf14_testing::curves::Curves;
use std::f64::consts::PI;
use std::fmt::Write;

const PULLEY: &str = include_str!("../../../../examples/contact/pulley.toml");
const BELT: &str = include_str!("../../../../examples/contact/belt_drive.toml");

/// How far the heavier mass has fallen, m, 0.5 s after the brake: by the chain that moves as one, integrated.
const FALLEN: f64 = 0.152_368_3;
/// Tension of the tight and of the slack side, N, and speed of the driven pulley, rad/s: belt with creep, closed form.
const BELT_DRIVE: [f64; 3] = [663.170, 186.936, 11.308_40];
/// Means are taken from here on, s.
const STEADY: f64 = 2.4;
/// Stations of the belt, and the one, by its tension, that is within a free side, which has a quarter of them.
const STATIONS: usize = 61;
const WITHIN: usize = 8;

pub fn write(section: &mut Section) {
    section.say(
        "*A rope on a post.* One end bears 100 N, the other one is pulled until all of the rope slides, with a coefficient of friction of 0.3 and eight elements on half a turn (`crates/testing/src/capstan.rs`). A thin rope slides at `exp(0.3 angle)`. A thick one slides earlier: its axis turns about a larger \
         radius than the one at which friction acts.",
    );
    let mut table = String::from(
        "| angle | radius of the rope over that of the post | exact | found | error |\n|---|---|---|---|---|\n",
    );
    let thin = [45.0, 90.0, 180.0, 270.0].map(|angle| (angle, 0.0, (0.3 * angle * PI / 180.0).exp()));
    for (angle, radius, exact) in thin.into_iter().chain(capstan::THICK.map(|(radius, exact)| (180.0, radius, exact))) {
        let found = capstan::pulled(angle * PI / 180.0, radius).ratio;
        let (share, error) = (radius / capstan::POST, 100.0 * (found / exact - 1.0));
        let _ = writeln!(table, "| {angle} | {share:.2} | {exact:.4} | {found:.4} | {error:.2} % |");
    }
    section.say(&table);

    section.say(
        "*Two masses on a heavy rope over a sheave* (`examples/contact/pulley.toml`). Reference: masses, rope and sheave that move as one, without slip, from the equation of the fall. The way of the heavier mass 0.5 s after the brake:",
    );
    let mut table = String::from("| step | exact, m | found, m | error |\n|---|---|---|---|\n");
    for step in ["0.002", "0.001"] {
        let found = -Curves::run(PULLEY, &[("simulation.step", step)]).last("mass.displacement[3]");
        let _ = writeln!(table, "| {step} s | {FALLEN} | {found:.6} | {:.2} % |", 100.0 * (found / FALLEN - 1.0));
    }
    section.say(&table);

    section.say(
        "*A belt drive* (`examples/contact/belt_drive.toml`). The driving pulley turns at 12 rad/s, the driven one is braked and creeps behind. Reference: the belt with creep in closed form, which slides on a part of each pulley and sticks on the rest. Means of the last 50 ms at 61 stations, which run with the belt; the sides have the eighth largest and the eighth smallest tension.",
    );
    let mut table = String::from(
        "| elements | driven pulley, rad/s | error | tight side, N | error | slack side, N | error |\n|---|---|---|---|---|---|---|\n",
    );
    let mut lines = Vec::new();
    for (color, elements) in ["40", "60", "120"].into_iter().enumerate() {
        let curves = Curves::run(BELT, &[("belt.elements", elements)]);
        let mean = |name: &str| {
            let column = curves.column(name);
            let own: Vec<f64> =
                curves.time.iter().zip(column).filter(|(t, _)| **t >= STEADY - 1e-9).map(|own| own.1).collect();
            own.iter().sum::<f64>() / own.len() as f64
        };
        let tension = |station: usize| mean(&format!("along.section_force[{station},1]"));
        let all: Vec<f64> = (1..=STATIONS).map(tension).collect();
        let mut sorted = all.clone();
        sorted.sort_by(f64::total_cmp);
        let found = [sorted[STATIONS - WITHIN], sorted[WITHIN - 1], mean("speed.angle_rate")];
        let error = |number: usize| 100.0 * (found[number] / BELT_DRIVE[number] - 1.0);
        let _ = writeln!(
            table,
            "| {elements} | {:.5} | {:.4} % | {:.1} | {:.2} % | {:.1} | {:.2} % |",
            found[2],
            error(2),
            found[0],
            error(0),
            found[1],
            error(1)
        );
        let length = 2.0 * (0.1 * PI + 0.1 * PI);
        let points = all.iter().enumerate().map(|(number, own)| (length * number as f64 / (STATIONS - 1) as f64, *own));
        lines.push(line(&format!("{elements} elements"), color, points.collect()));
    }
    section.say(&table);
    section.picture("belt_drive", plot("Belt drive: tension along the belt", ["arc length (m)", "tension (N)"], lines));
}
