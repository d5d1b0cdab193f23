//! The Princeton beam against the exact rod.

use super::{Section, dots, line, plot, study};
use ancf14_testing::curves::Curves;

pub const MODEL: &str = include_str!("../../../../models/princeton_beam.toml");
pub const REFERENCE: &str = include_str!("../../../../tests/references/princeton_beam.csv");

/// Where the tip is.
pub struct Tip {
    /// In the weak direction, m.
    pub weak: f64,
    /// In the stiff direction, m.
    pub stiff: f64,
    /// Its twist, rad.
    pub twist: f64,
}

/// Rows of the reference: load, angle in degrees, tip.
pub fn reference() -> Vec<(f64, f64, Tip)> {
    let table = Curves::read(REFERENCE);
    let [loads, angles, weak, stiff, twist] =
        ["load", "angle_deg", "y_weak", "z_stiff", "twist_bishop"].map(|name| table.column(name));
    let tip = |k: usize| Tip { weak: weak[k], stiff: stiff[k], twist: twist[k] };
    (0..loads.len()).map(|k| (loads[k], angles[k], tip(k))).collect()
}

/// The keys of a load, in one step.
pub fn weight(load: f64, angle: f64) -> [(&'static str, String); 4] {
    let one = || String::from("1");
    [
        ("P", load.to_string()),
        ("angle_deg", angle.to_string()),
        ("simulation.step", one()),
        ("simulation.output_step", one()),
    ]
}

impl Tip {
    /// At the end of a run.
    pub fn of(curves: &Curves) -> Self {
        Self {
            weak: curves.last("tip.displacement[2]"),
            stiff: curves.last("tip.displacement[3]"),
            twist: curves.last("tip.twist"),
        }
    }
}

/// A component of the tip: its short name, its name, its unit, its value.
pub type Component = (&'static str, &'static str, &'static str, fn(&Tip) -> f64);

/// What is compared.
pub const COMPONENTS: [Component; 3] = [
    ("weak", "displacement in the weak direction", "m", |tip| tip.weak),
    ("stiff", "displacement in the stiff direction", "m", |tip| tip.stiff),
    ("twist", "twist", "rad", |tip| tip.twist),
];

/// Largest error of a component over all cases of the reference, relative to its largest value.
pub fn error(tips: &[Tip], value: fn(&Tip) -> f64) -> f64 {
    let reference = reference();
    let largest = reference.iter().map(|row| value(&row.2).abs()).fold(0.0, f64::max);
    let errors = reference.iter().zip(tips).map(|(row, tip)| (value(tip) - value(&row.2)).abs() / largest);
    errors.fold(0.0, f64::max)
}

fn tip(load: f64, angle: f64, elements: u32, twist: &str) -> Tip {
    let (elements, weight) = (elements.to_string(), weight(load, angle));
    let weight = weight.each_ref().map(|(key, value)| (*key, value.as_str()));
    Tip::of(&Curves::run(MODEL, &[&[("arm.elements", elements.as_str()), ("arm.twist", twist)], &weight[..]].concat()))
}

pub fn write(section: &mut Section) {
    section.say(
        "Section 5.2 of the paper. A thin aluminium strip, clamped, carries a weight at its tip at 7 angles to its stiff direction, 3 weights \
         (`models/princeton_beam.toml`). The torque changes along the strip, because it bends in both directions.\n\n\
         Reference: the Euler-Bernoulli rod by shooting, exact to nine decimals (`tests/references/princeton_beam.csv`). The paper's curves of \
         displacement and twist over the angle correspond to the pictures below, here with the material twist `theta` (quantity `twist`).",
    );
    let reference = reference();
    let mut loads: Vec<f64> = reference.iter().map(|row| row.0).collect();
    loads.dedup();
    let angles: Vec<f64> = (0..=18).map(|k| 5.0 * f64::from(k)).collect();
    let runs: Vec<Vec<Tip>> =
        loads.iter().map(|load| angles.iter().map(|angle| tip(*load, *angle, 8, "quadratic")).collect()).collect();
    for (name, label, unit, value) in COMPONENTS {
        let mut lines = Vec::new();
        for (color, (load, runs)) in loads.iter().zip(&runs).enumerate() {
            let own = reference.iter().filter(|row| row.0 == *load);
            let found = angles.iter().zip(runs).map(|(angle, tip)| (*angle, value(tip))).collect();
            lines.push(line(&format!("{load} N, 8 elements"), color, found));
            lines.push(dots(&format!("{load} N, exact"), color, own.map(|row| (row.1, value(&row.2))).collect()));
        }
        let axes = ["angle of the load (degrees)", &format!("{label} ({unit})")];
        section.picture(&format!("princeton_{name}"), plot(&format!("Princeton beam: {label}"), axes, lines));
    }
    section.say("Largest error over all 21 cases, relative to the largest value of the same component:");
    for (_, label, _, value) in COMPONENTS {
        section.say(&format!("*{label}*"));
        let error = |elements: u32, twist: &str| {
            let tips: Vec<Tip> = reference.iter().map(|(load, angle, _)| tip(*load, *angle, elements, twist)).collect();
            error(&tips, value)
        };
        section.say(&study::twists(&[2, 4, 8, 16], error));
    }
}
