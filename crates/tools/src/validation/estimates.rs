//! The errors that `run --verify` estimates, against true ones.

use super::{Section, study};
use ancf14::fmi::Model;
use ancf14::fmi::variable::Causality;
use ancf14::model::entries::simulation::Analysis;
use ancf14::model::run::levels;
use ancf14::model::verification::estimate::Trust;
use ancf14::model::verification::{Report, Row, Verification};
use ancf14_testing::curves::{Curves, load};
use std::f64::consts::TAU;
use std::fmt::Write;

/// A model, run as its file has it but for these overrides.
struct Case {
    title: &'static str,
    model: &'static str,
    overrides: &'static [(&'static str, &'static str)],
}

const fn case(title: &'static str, model: &'static str, overrides: &'static [(&'static str, &'static str)]) -> Case {
    Case { title, model, overrides }
}

const EQUILIBRIA: [Case; 9] = [
    case("Princeton beam", super::princeton::MODEL, &[]),
    case("Princeton beam, 2 elements", super::princeton::MODEL, &[("arm.elements", "2")]),
    case("Princeton beam, quadratic twist", super::princeton::MODEL, &[("arm.twist", "quadratic")]),
    case("helical spring", super::spring::MODEL, &[]),
    case("45-degree bend", super::bend::MODEL, &[]),
    case("twisted ring", super::ring::MODEL, &[]),
    case("elastica", super::elastica::MODEL, &[]),
    case("elastica, 2 elements", super::elastica::MODEL, &[("strip.elements", "2")]),
    case("rolled up", super::roll_up::MODEL, &[]),
];

/// The foot of the crane goes 1 m to the side and stops: as drawn it stands still.
const TRAVEL: [(&str, &str); 2] = [("foot.input", "false"), ("foot.position[1]", "0.5*(1 - cos(pi*min(t, 2)/2))")];

const MOTIONS: [Case; 8] = [
    case("rotating shaft", super::shaft::MODEL, &[]),
    case("lateral buckling", super::buckling::MODEL, &[]),
    case("lateral buckling, quadratic twist", super::buckling::MODEL, &QUADRATIC),
    case("four-bar linkage", include_str!("../../../../models/four_bar.toml"), &[]),
    case("four-bar linkage, damped", include_str!("../../../../models/four_bar.toml"), &[("steel.damping", "1e-4")]),
    case("pendulum", include_str!("../../../../models/pendulum.toml"), &[]),
    case("cantilever", include_str!("../../../../models/cantilever.toml"), &[]),
    case("crane, foot moved by 1 m", include_str!("../../../../models/crane.toml"), &TRAVEL),
];

const QUADRATIC: [(&str, &str); 3] =
    [("strip.twist", "quadratic"), ("link.twist", "quadratic"), ("crank.twist", "quadratic")];

/// The reference has so many elements in place of one, with quadratic twist, and so many steps; a second one has half
/// as many of what it is that limits it, and says how sure the first one is.
const ELEMENTS: [usize; 2] = [8, 4];
const MOVING_ELEMENTS: usize = 4;
const STEPS: [f64; 2] = [16.0, 8.0];
/// A true error is known where both references differ by this share of it at most.
const SURE: f64 = 0.25;

/// A run with its estimates.
struct Verified {
    report: Report,
    /// Row by row in the order of the report.
    columns: Vec<Vec<f64>>,
}

fn verified(case: &Case) -> Verified {
    let mut simulation = load(case.model, case.overrides);
    let overrides: Vec<_> = case.overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let mut verification = Verification::new(&simulation, "model.toml", case.model, &overrides);
    let outputs: Vec<usize> = (0..simulation.variables().len())
        .filter(|place| simulation.variables()[*place].causality == Causality::Output)
        .collect();
    let (stop, step) = (simulation.about().stop, simulation.about().output_step);
    let mut rows = Vec::new();
    for row in 0..=(stop / step).round() as u32 {
        let now = f64::from(row) * step;
        if row > 0 {
            simulation.advance(now).unwrap_or_else(|failure| panic!("{}", failure.message));
        }
        let values: Vec<f64> = outputs.iter().map(|place| simulation.value(*place).number()).collect();
        verification.compare(u64::from(row), now, &values);
        rows.push(values);
    }
    let report = verification.report(&simulation, 1e-3);
    let columns = (0..report.rows.len()).map(|place| rows.iter().map(|row| row[place]).collect()).collect();
    Verified { report, columns }
}

/// Overrides for so many elements and steps in place of one.
fn refined(case: &Case, elements: usize, steps: f64) -> Vec<(String, String)> {
    let simulation = load(case.model, case.overrides);
    let document = simulation.document();
    let mut overrides = Vec::new();
    for beam in &document.beams {
        overrides.push((format!("{}.elements", beam.name), (elements * levels::elements(document, beam)).to_string()));
        if levels::has_linear_twist(beam) {
            overrides.push((format!("{}.twist", beam.name), String::from("quadratic")));
        }
    }
    if document.simulation.analysis == Analysis::Dynamic {
        overrides.push((String::from("simulation.step"), (levels::taken_step(document) / steps).to_string()));
        overrides.push((String::from("simulation.output_step"), simulation.about().output_step.to_string()));
    }
    overrides
}

fn reference(case: &Case, elements: usize, steps: f64) -> Curves {
    let own: Vec<_> = case.overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let merged = levels::merged(&own, refined(case, elements, steps));
    let merged: Vec<_> = merged.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    Curves::run(case.model, &merged)
}

/// A column whose true error is known, and the estimate over it.
struct Judged {
    row: Row,
    truth: f64,
    ratio: f64,
}

/// Columns above round-off: those that can be judged, and the number of others.
fn judge(case: &Case) -> (Vec<Judged>, usize) {
    let Verified { report, columns } = verified(case);
    let is_static = load(case.model, case.overrides).document().simulation.analysis == Analysis::Static;
    let references = match is_static {
        true => ELEMENTS.map(|elements| reference(case, elements, 1.0)),
        false => STEPS.map(|steps| reference(case, MOVING_ELEMENTS, steps)),
    };
    let (mut judged, mut unknown) = (Vec::new(), 0);
    for (row, own) in report.rows.into_iter().zip(columns) {
        if row.estimate.trust == Trust::RoundOff {
            continue;
        }
        let [finest, other] = references.each_ref().map(|curves| curves.column(&row.name));
        let distance =
            |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let truth = distance(&own, &finest);
        if distance(&finest, &other) > SURE * truth {
            unknown += 1;
            continue;
        }
        judged.push(Judged { ratio: row.estimate.error() / truth, row, truth });
    }
    (judged, unknown)
}

/// A row a case.
fn table(cases: &[Case]) -> String {
    let mut text = String::from(
        "| run | columns | not judged | smallest | median | largest | below 1/3 | within a factor of 2 | worst column | estimated | true |\n\
         |---|---|---|---|---|---|---|---|---|---|---|",
    );
    for case in cases {
        let (mut judged, unknown) = judge(case);
        judged.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let count = judged.len();
        // Writing into a String cannot fail.
        let _ = write!(text, "\n| {} | {} | {unknown} |", case.title, count + unknown);
        let worst = judged.iter().max_by(|a, b| a.ratio.ln().abs().total_cmp(&b.ratio.ln().abs()));
        let Some(worst) = worst else {
            text += " | | | | | | | |";
            continue;
        };
        let [smallest, median, largest] = [0, count / 2, count - 1].map(|place| judged[place].ratio);
        let low = judged.iter().filter(|column| column.ratio < 1.0 / 3.0).count();
        let near = judged.iter().filter(|column| (0.5..=2.0).contains(&column.ratio)).count();
        let share = 100 * near / count;
        let _ = write!(
            text,
            " {smallest:.2} | {median:.2} | {largest:.2} | {low} | {share} % | `{}` | {} | {} |",
            worst.row.name,
            study::small(worst.row.estimate.error() / worst.row.scale),
            study::small(worst.truth / worst.row.scale),
        );
    }
    text + "\n"
}

const MEANING: &str = "A column of the results counts where its error is above round-off; it is judged where two references tell its true error to a quarter. \
     `smallest`, `median` and `largest` are of the estimate over the true error; the worst column is the one furthest from 1, with both errors \
     over its scale.";

/// The largest error of a column at the loads of a reference that is no run of this program, beside its estimate.
struct Exact {
    title: &'static str,
    column: &'static str,
    estimate: f64,
    truth: f64,
}

fn exact(
    title: &'static str,
    model: &'static str,
    overrides: &'static [(&'static str, &'static str)],
    column: &'static str,
    points: &[(f64, f64)],
) -> Exact {
    let Verified { report, columns } = verified(&case(title, model, overrides));
    let place = report.rows.iter().position(|row| row.name == column).unwrap();
    let time = Curves::run(model, overrides).time;
    let errors = points.iter().filter_map(|(at, value)| {
        let row = time.iter().position(|time| (time - at).abs() < 1e-9)?;
        Some((columns[place][row] - value).abs())
    });
    Exact { title, column, estimate: report.rows[place].estimate.error(), truth: errors.fold(0.0, f64::max) }
}

/// References by shooting, by elliptic integrals, and a circle; times are those of the model files.
fn exact_table() -> String {
    let mut rows = Vec::new();
    let table = Curves::read(super::princeton::REFERENCE);
    let columns = ["load", "angle_deg", "y_weak", "z_stiff", "twist_bishop"].map(|name| table.column(name));
    let own = (0..columns[0].len()).find(|k| columns[0][*k] == 8.896 && columns[1][*k] == 45.0).unwrap();
    for (column, values) in
        [("tip.displacement[2]", &columns[2]), ("tip.displacement[3]", &columns[3]), ("tip.twist", &columns[4])]
    {
        rows.push(exact("Princeton beam", super::princeton::MODEL, &[], column, &[(1.0, values[own])]));
    }
    let table = Curves::read(super::spring::REFERENCE);
    let points: Vec<_> = table.time.iter().map(|pull| pull / 0.04).zip(table.column("force_N")).collect();
    rows.push(exact("helical spring", super::spring::MODEL, &[], "puller_force.effort", &points));
    let table = Curves::read(super::bend::REFERENCE);
    let constants = table.column("J");
    for (column, name) in [("end.position[1]", "x"), ("end.position[2]", "y"), ("end.position[3]", "z")] {
        let points = table.column("P").into_iter().map(|load| load / 600.0).zip(table.column(name));
        let points: Vec<_> =
            points.zip(&constants).filter(|(_, own)| **own == constants[0]).map(|(point, _)| point).collect();
        rows.push(exact("45-degree bend", super::bend::MODEL, &[], column, &points));
    }
    let table = Curves::read(super::elastica::REFERENCE);
    let back = table.column("u_over_L").into_iter().map(|back| -back);
    let points: Vec<_> = table.time.iter().copied().zip(back).collect();
    rows.push(exact("elastica", super::elastica::MODEL, &[], "tip.displacement[1]", &points));
    let points: Vec<_> = table.time.iter().copied().zip(table.column("w_over_L")).collect();
    rows.push(exact("elastica", super::elastica::MODEL, &[], "tip.displacement[2]", &points));
    let turn = |k: u32| TAU * f64::from(k) / 20.0;
    let arc = |place: fn(f64) -> f64| (1..=20).map(|k| (f64::from(k) / 20.0, place(turn(k)))).collect::<Vec<_>>();
    let along = arc(|turn| turn.sin() / turn);
    let across = arc(|turn| (1.0 - turn.cos()) / turn);
    rows.push(exact("rolled up", super::roll_up::MODEL, &[], "tip.position[1]", &along));
    rows.push(exact("rolled up", super::roll_up::MODEL, &[], "tip.position[2]", &across));
    let mut text = String::from("| run | column | estimated | true | ratio |\n|---|---|---|---|---|");
    for Exact { title, column, estimate, truth } in rows {
        // Writing into a String cannot fail.
        let _ = write!(
            text,
            "\n| {title} | `{column}` | {} | {} | {:.2} |",
            study::small(estimate),
            study::small(truth),
            estimate / truth
        );
    }
    text + "\n"
}

pub fn equilibria(section: &mut Section) {
    section.say(&format!(
        "`ancf14 run --verify` ([its table](verify.md)) against the largest true error of each column, for the model files as they are. True is the difference from \
         {} times the elements with quadratic twist. {MEANING}",
        ELEMENTS[0]
    ));
    section.say(&table(&EQUILIBRIA));
    section.say(
        "Against references that are no runs of this program, those of [the benchmarks](../validation.md): rods by shooting, elliptic integrals, a circle. Errors are in the unit of the \
         column, the true ones the largest at the loads of the reference.",
    );
    section.say(&exact_table());
}

pub fn motion(section: &mut Section) {
    section.say(&format!(
        "As above, for motions: true is the difference from {MOVING_ELEMENTS} times the elements with quadratic twist and {} times the steps. {MEANING}",
        STEPS[0]
    ));
    section.say(&table(&MOTIONS));
}
