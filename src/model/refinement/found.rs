//! The numbers that the runs of a model have found: what its file must say for the finest of them, and the text of the
//! file with that.

use super::Refinement;
use crate::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use crate::mechanics::beam::design::Elements;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::simulation::{FINEST_ACCURACY, Steps};
use crate::model::run::levels::{self, Override};
use crate::model::run::simulation::Simulation;
use crate::model::text::source::Place;
use std::collections::BTreeMap;
use std::ops::Range;

/// The section of the steps.
const SIMULATION: &str = "[simulation]";

/// What a model file must say for the last run of its model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Beams whose elements the program has chosen.
    meshes: Vec<Mesh>,
    /// Keys of the steps, each with its value; none: they stay as they are.
    steps: Vec<(&'static str, f64)>,
}

/// The mesh of a beam.
#[derive(Clone, Debug, PartialEq)]
struct Mesh {
    beam: usize,
    name: String,
    elements: usize,
    is_quadratic: bool,
}

impl Refinement {
    /// What the file must say for `simulation`, the last run that counts.
    pub fn found(&self, simulation: &Simulation) -> Found {
        let document = simulation.document();
        let chosen = document.beams.iter().enumerate().filter(|(number, _)| self.chosen.get(*number) == Some(&true));
        let mesh = |(beam, spec): (usize, &BeamSpec)| Mesh {
            beam,
            name: spec.name.clone(),
            elements: levels::elements(document, spec),
            is_quadratic: matches!(spec.formulation, Elements::Ancf14 { twist: Twist::Quadratic, .. }),
        };
        Found { meshes: chosen.map(mesh).collect(), steps: self.steps_found(simulation) }
    }

    /// The settings for steps as short as those of `simulation`; none: they follow from the file. A finer accuracy
    /// divides the steps that errors bound, and the longest step of the run divides those that rows bound.
    fn steps_found(&self, simulation: &Simulation) -> Vec<(&'static str, f64)> {
        let document = simulation.document();
        let Steps::ForAccuracy(accuracy) = document.simulation.steps else { return Vec::new() };
        if self.divided <= 1.0 {
            return Vec::new();
        }
        // Errors are of second order.
        let accuracy = (document.value(accuracy) / self.divided.powi(2)).max(FINEST_ACCURACY);
        let longest = simulation.longest_step().map(|longest| ("longest_step", longest));
        std::iter::once(("accuracy", accuracy)).chain(longest).collect()
    }
}

impl Found {
    /// The settings, as `--set` takes them.
    pub fn settings(&self) -> Vec<String> {
        let mesh = |mesh: &Mesh| format!("{}.elements = {}", mesh.name, mesh.elements);
        let steps = self.steps.iter().map(|(key, value)| format!("simulation.{key} = {}", short(*value)));
        self.meshes.iter().map(mesh).chain(steps).collect()
    }

    /// The settings as overrides, each a key and its value. A beam with a number of elements has linear twist, unless
    /// its file says otherwise.
    pub fn overrides(&self) -> Vec<Override> {
        let own = |mesh: &Mesh| {
            let elements = (format!("{}.elements", mesh.name), mesh.elements.to_string());
            let twist = (format!("{}.twist", mesh.name), String::from("quadratic"));
            std::iter::once(elements).chain(mesh.is_quadratic.then_some(twist))
        };
        let steps = self.steps.iter().map(|(key, value)| (format!("simulation.{key}"), short(*value)));
        self.meshes.iter().flat_map(own).chain(steps).collect()
    }

    /// The `text` of the file that `document` was read from, with these numbers; all else stays as it is written.
    /// Copies of a beam get one number, the largest.
    ///
    /// # Errors
    /// A section stands elsewhere, as a sentence that says what to write there.
    pub fn written(&self, document: &Document, text: &str) -> Result<String, String> {
        self.inserted(text, |beam| document.origin_place(document.beams[beam].place))
    }

    /// [`Self::written`] for the text of the model without copies and includes.
    ///
    /// # Errors
    /// As [`Self::written`].
    pub fn written_flat(&self, document: &Document) -> Result<String, String> {
        self.inserted(document.text(), |beam| document.beams[beam].place)
    }

    fn inserted(&self, text: &str, header_of: impl Fn(usize) -> Place) -> Result<String, String> {
        let mut sections: BTreeMap<usize, Mesh> = BTreeMap::new();
        for mesh in &self.meshes {
            let header = header_of(mesh.beam);
            let start = text.get(..header.start).map_or(0, |before| before.rfind('\n').map_or(0, |at| at + 1));
            let is_section = header.source == 0 && text[start..].trim_start().starts_with('[');
            if !is_section {
                let Mesh { name, elements, .. } = mesh;
                let section = format!("beam {name} has no section of its own in this file");
                return Err(format!("{section}: give it elements = {elements} where it is written"));
            }
            let own = sections.entry(start).or_insert_with(|| mesh.clone());
            own.elements = own.elements.max(mesh.elements);
        }
        // Pieces of the text, each with its replacement.
        let mut changes: Vec<(Range<usize>, String)> = Vec::new();
        for (start, Mesh { elements, is_quadratic, .. }) in sections {
            let has_twist = keys(&text[start..]).any(|(key, _)| key == "twist");
            let twist = if is_quadratic && !has_twist { "twist = \"quadratic\"\n" } else { "" };
            let at = line_end(text, start);
            changes.push((at..at, format!("elements = {elements}\n{twist}")));
        }
        for (key, value) in &self.steps {
            let value = short(*value);
            let Some(start) = header(text, SIMULATION) else {
                return Err(format!("{SIMULATION} is not in this file: give {key} = {value} where it is written"));
            };
            changes.push(match keys(&text[start..]).find(|(own, _)| own == key) {
                Some((_, span)) => (start + span.start..start + span.end, value),
                None => {
                    let at = line_end(text, start);
                    (at..at, format!("{key} = {value}\n"))
                }
            });
        }
        changes.sort_by_key(|(piece, _)| piece.start);
        let mut written = text.to_owned();
        for (piece, replacement) in changes.iter().rev() {
            written.replace_range(piece.clone(), replacement);
        }
        Ok(written)
    }
}

/// Where the line of the section `header` begins.
fn header(text: &str, header: &str) -> Option<usize> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with(header) {
            return Some(start);
        }
        start += line.len();
    }
    None
}

/// A number in as few digits as tell it.
fn short(value: f64) -> String {
    let value: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    format!("{value:e}")
}

/// Where the line after that of `start` begins.
fn line_end(text: &str, start: usize) -> usize {
    text[start..].find('\n').map_or(text.len(), |at| start + at + 1)
}

/// The keys of the section that `text` begins with, each with the bytes of its value.
fn keys(text: &str) -> impl Iterator<Item = (&str, Range<usize>)> {
    let first = line_end(text, 0);
    let lines = text[first..].split_inclusive('\n').scan(first, |at, line| {
        let start = *at;
        *at += line.len();
        Some((start, line))
    });
    lines.take_while(|(_, line)| !line.trim_start().starts_with('[')).filter_map(|(start, line)| {
        let (key, value) = line.split_once('=')?;
        let begin = start + key.len() + 1 + (value.len() - value.trim_start().len());
        let value = value.split('#').next().unwrap_or("").trim();
        Some((key.trim(), begin..begin + value.len()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[copy.all]\ncount = 2\n\n[copy.all.beam.arm] # both\nto = [1, 0, 0]\n\n\
                        [simulation]\nstop = 1\naccuracy = 1e-3 # fine\n\n[beam.tip]\ntwist = \"linear\"\n";

    fn found(steps: &[(&'static str, f64)]) -> String {
        let mesh =
            |beam, name: &str, elements, is_quadratic| Mesh { beam, name: name.to_owned(), elements, is_quadratic };
        let meshes = vec![mesh(0, "arm_1", 8, true), mesh(1, "arm_2", 12, true), mesh(2, "tip", 9, false)];
        let header_of = |beam: usize| {
            let start = TEXT.find(if beam == 2 { "tip]" } else { "arm]" }).unwrap();
            Place { source: 0, start, end: start + 3 }
        };
        Found { meshes, steps: steps.to_vec() }.inserted(TEXT, header_of).unwrap()
    }

    /// Numbers go below the headers, copies get the largest, and remarks and layout stay.
    #[test]
    fn numbers_are_written_into_the_text() {
        let wanted = "[copy.all]\ncount = 2\n\n[copy.all.beam.arm] # both\nelements = 12\ntwist = \"quadratic\"\n\
                      to = [1, 0, 0]\n\n[simulation]\nstop = 1\naccuracy = 6.25e-5 # fine\n\n[beam.tip]\nelements = 9\n\
                      twist = \"linear\"\n";
        assert_eq!(found(&[("accuracy", 6.25e-5)]), wanted);
        let steps = found(&[("accuracy", 1e-5), ("longest_step", 1e-3)]);
        let wanted = "[simulation]\nlongest_step = 1e-3\nstop = 1\naccuracy = 1e-5 # fine\n";
        assert!(steps.contains(wanted), "{steps}");
    }
}
