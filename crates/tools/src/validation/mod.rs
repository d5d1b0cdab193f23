//! The validation pages: every benchmark of the paper and every other reference, compared with runs of model files. No
//! number of a result is typed by hand: what the pages say about sizes stands in tables that come from the runs.

mod bend;
mod blades;
mod buckling;
mod chosen_steps;
mod comparison;
mod contact;
mod critical;
mod elastica;
mod estimates;
mod frames;
mod frequencies;
mod paths;
mod princeton;
mod rigidities;
mod ring;
mod roll_up;
mod seabed;
mod shaft;
mod spring;
mod static_buckling;
mod study;
mod unstressed;

use ancf14_report::chart::{Chart, Layout, Line, Stroke};
use std::fmt::Write;

/// A section of a page.
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
    /// What becomes of its runs.
    pub runs: Runs,
    write: fn(&mut Section),
}

/// Which runs a section is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runs {
    /// Short ones: a test repeats them.
    Short,
    /// Long ones.
    Long,
    /// Only where the section is asked for by its title: timed ones, of which no two come out the same, and those of
    /// the peer, which must be installed.
    Asked,
}

/// A page of sections.
pub struct Page {
    /// Its path in docs/.
    pub path: &'static str,
    title: &'static str,
    introduction: &'static str,
    /// Its sections, in order.
    pub cases: &'static [Case],
}

/// All pages in the order of the book.
pub static PAGES: [Page; 5] = [
    Page {
        path: "validation/paper.md",
        title: "Validation: benchmarks of the paper",
        introduction: "The four benchmarks of Ebrahimi, Butscher and Cheong (2020), and the frames that their element carries along a curve.",
        cases: &[
            Case { title: "Frames along a curve", runs: Runs::Short, write: frames::write },
            Case { title: "Helical spring", runs: Runs::Short, write: spring::write },
            Case { title: "Princeton beam", runs: Runs::Short, write: princeton::write },
            Case { title: "Unbalanced rotating shaft", runs: Runs::Long, write: shaft::write },
            Case { title: "Lateral torsional buckling", runs: Runs::Long, write: buckling::write },
        ],
    },
    Page {
        path: "validation/elements.md",
        title: "Validation: ANCF14 and ANCF24",
        introduction: "The paper compares two elements. Both run in the same program here.",
        cases: &[
            Case { title: "Two elements: equilibria", runs: Runs::Short, write: comparison::equilibria::write },
            Case { title: "Two elements: motion", runs: Runs::Long, write: comparison::motion::write },
            Case { title: "Two elements: time", runs: Runs::Asked, write: comparison::time::write },
        ],
    },
    Page {
        path: "validation/equilibria.md",
        title: "Validation: equilibria",
        introduction: "Large bending, buckling, stress as drawn, and paths past limit loads.",
        cases: &[
            Case { title: "45-degree bend", runs: Runs::Short, write: bend::write },
            Case { title: "Elastica", runs: Runs::Short, write: elastica::write },
            Case { title: "Rolling up to a circle", runs: Runs::Short, write: roll_up::write },
            Case { title: "Rods given by their rigidities", runs: Runs::Short, write: rigidities::write },
            Case { title: "Critical torque and force", runs: Runs::Short, write: static_buckling::write },
            Case { title: "Twisted ring", runs: Runs::Short, write: ring::write },
            Case { title: "Stress as drawn and heat", runs: Runs::Short, write: unstressed::write },
            Case { title: "Paths past a limit load", runs: Runs::Short, write: paths::write },
            Case { title: "Paths past a limit load: the peer", runs: Runs::Asked, write: paths::peer },
        ],
    },
    Page {
        path: "validation/motion.md",
        title: "Validation: vibrations, contact, lines, chosen steps",
        introduction: "Frequencies, blades, contact, lines on the seabed, and steps chosen by an accuracy.",
        cases: &[
            Case { title: "Natural frequencies", runs: Runs::Short, write: frequencies::write },
            Case { title: "Blades", runs: Runs::Long, write: blades::write },
            Case { title: "Contact", runs: Runs::Long, write: contact::write },
            Case { title: "Lines on the seabed", runs: Runs::Short, write: seabed::write },
            Case { title: "Steps chosen by an accuracy", runs: Runs::Long, write: chosen_steps::write },
        ],
    },
    Page {
        path: "accuracy/truth.md",
        title: "Estimate against truth",
        introduction: "Estimated errors of `--verify`, compared with true errors.",
        cases: &[
            Case { title: "Estimated errors: equilibria", runs: Runs::Short, write: estimates::equilibria },
            Case { title: "Estimated errors: motion", runs: Runs::Long, write: estimates::motion },
        ],
    },
];

/// All sections.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    PAGES.iter().flat_map(|page| page.cases)
}

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
        let _ = writeln!(self.text, "![{}]({name}.svg)\n", chart.title);
        self.charts.push((name.to_owned(), chart));
    }
}

/// A line from point to point.
fn line(name: &str, color: usize, points: Vec<(f64, f64)>) -> Line {
    Line { name: name.to_owned(), stroke: Stroke::Solid, color, points }
}

/// Dots.
fn dots(name: &str, color: usize, points: Vec<(f64, f64)>) -> Line {
    Line { name: name.to_owned(), stroke: Stroke::Dots, color, points }
}

/// A chart of curves.
fn plot(title: &str, axes: [&str; 2], lines: Vec<Line>) -> Chart {
    Chart { title: title.to_owned(), axes: axes.map(str::to_owned), layout: Layout::Single, lines }
}

/// A chart of shapes: a length is the same along both axes.
fn shapes(title: &str, axes: [&str; 2], lines: Vec<Line>) -> Chart {
    Chart { layout: Layout::Shape, ..plot(title, axes, lines) }
}

/// Pairs of a column over another, every `every`-th.
fn points(across: &[f64], along: &[f64], every: usize) -> Vec<(f64, f64)> {
    across.iter().copied().zip(along.iter().copied()).step_by(every).collect()
}

/// The section of this title, as a page has it.
pub fn part<'a>(page: &'a str, title: &str) -> Option<&'a str> {
    let start = page.find(&format!("## {title}\n"))?;
    let length = page[start..].find("\n## ").map_or(page.len() - start, |end| end + 1);
    Some(&page[start..start + length])
}

impl Page {
    /// The page of the texts of its sections.
    pub fn text(&self, sections: &[String]) -> String {
        let texts: Vec<&str> = sections.iter().map(|text| text.trim_end()).collect();
        format!("# {}\n\n{MARK}\n\n{}\n\n{}\n", self.title, self.introduction, texts.join("\n\n"))
    }
}

const MARK: &str = "<!-- Written by `cargo run --release --bin validation`. -->";
