//! The validation page: every benchmark of the paper and every other reference, compared with runs of model files. No number of a
//! result is typed by hand: what the page says about sizes stands in tables that come from the runs.

#[path = "../src/cli/chart.rs"]
pub mod chart;

mod bend;
mod buckling;
mod critical;
mod elastica;
mod frames;
mod frequencies;
mod princeton;
mod ring;
mod roll_up;
mod shaft;
mod spring;
mod static_buckling;
mod study;

use chart::{Chart, Line, Stroke};
use std::fmt::Write;

/// A section of the page.
pub struct Section {
    /// Markdown, title included.
    pub text: String,
    /// Pictures with the names of their files.
    pub charts: Vec<(String, Chart)>,
}

/// How a section comes about.
pub struct Case {
    /// Its title.
    pub title: &'static str,
    /// Whether its runs are short: those are repeated by a test.
    #[allow(dead_code, reason = "a test asks")]
    pub short: bool,
    write: fn(&mut Section),
}

/// All sections in the order of the page.
pub const CASES: [Case; 11] = [
    Case { title: "Frames along a curve", short: true, write: frames::write },
    Case { title: "Helical spring", short: true, write: spring::write },
    Case { title: "Princeton beam", short: true, write: princeton::write },
    Case { title: "Unbalanced rotating shaft", short: false, write: shaft::write },
    Case { title: "Lateral torsional buckling", short: false, write: buckling::write },
    Case { title: "45-degree bend", short: true, write: bend::write },
    Case { title: "Elastica", short: true, write: elastica::write },
    Case { title: "Rolling up to a circle", short: true, write: roll_up::write },
    Case { title: "Critical torque and force", short: true, write: static_buckling::write },
    Case { title: "Twisted ring", short: true, write: ring::write },
    Case { title: "Natural frequencies", short: true, write: frequencies::write },
];

impl Case {
    /// The section, from runs.
    pub fn section(&self) -> Section {
        let mut section = Section { text: format!("## {}\n\n", self.title), charts: Vec::new() };
        (self.write)(&mut section);
        section
    }
}

impl Section {
    /// Adds a paragraph.
    fn say(&mut self, paragraph: &str) {
        // Writing into a String cannot fail.
        let _ = writeln!(self.text, "{}\n", paragraph.trim());
    }

    /// Adds a picture.
    fn picture(&mut self, name: &str, chart: Chart) {
        let _ = writeln!(self.text, "![{}](validation/{name}.svg)\n", chart.title);
        self.charts.push((name.to_owned(), chart));
    }
}

/// A line from point to point.
fn line(name: &str, colour: usize, points: Vec<(f64, f64)>) -> Line {
    Line { name: name.to_owned(), stroke: Stroke::Solid, colour, points }
}

/// Dots.
fn dots(name: &str, colour: usize, points: Vec<(f64, f64)>) -> Line {
    Line { name: name.to_owned(), stroke: Stroke::Dots, colour, points }
}

/// A chart of curves.
fn plot(title: &str, axes: [&str; 2], lines: Vec<Line>) -> Chart {
    Chart { title: title.to_owned(), axes: axes.map(str::to_owned), shape: false, lines }
}

/// A chart of shapes: a length is the same along both axes.
fn shapes(title: &str, axes: [&str; 2], lines: Vec<Line>) -> Chart {
    Chart { shape: true, ..plot(title, axes, lines) }
}

/// Pairs of a column over another, every `every`-th.
fn points(across: &[f64], along: &[f64], every: usize) -> Vec<(f64, f64)> {
    across.iter().copied().zip(along.iter().copied()).step_by(every).collect()
}

/// The page of the texts of all sections.
pub fn page(sections: &[String]) -> String {
    format!("{HEAD}\n{}", sections.concat().trim_end().to_owned() + "\n")
}

/// What stands before the sections.
const HEAD: &str = include_str!("head.md");
