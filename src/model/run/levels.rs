//! The runs beside the first one: the same file and the same overrides, with another step or another mesh.

use crate::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use crate::mechanics::beam::design::{Elements, Torsion};
use crate::model::file::document::Document;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::curve::{CurveSpec, Line, Shape};
use crate::model::file::entries::output::OutputSpec;
use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::file::entries::simulation::{COARSEST_ACCURACY, FINEST_ACCURACY};
use crate::model::file::entries::{load, output};
use crate::model::file::parameter::Parameter;
use crate::model::file::reader::anchor::{Along, Anchor, Spot};
use crate::model::shape;

/// A key and a value, as `--set` takes them.
pub type Override = (String, String);

/// What is different in a run. The three meshes have quadratic twist, so that they differ in the elements alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Half the step.
    HalfStep,
    /// Twice the step: together with the other two it shows the order.
    DoubleStep,
    /// Quadratic twist in all beams that have linear twist.
    QuadraticTwist,
    /// Twice the elements.
    DoubleElements,
    /// Half the elements: together with the other two it shows the order.
    HalfElements,
}

impl Level {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::HalfStep, Self::DoubleStep, Self::QuadraticTwist, Self::DoubleElements, Self::HalfElements];

    /// What is different, in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::HalfStep => "half the step",
            Self::DoubleStep => "twice the step",
            Self::QuadraticTwist => "quadratic twist",
            Self::DoubleElements => "twice the elements",
            Self::HalfElements => "half the elements",
        }
    }

    /// Whether it serves to observe the order only: the estimate does without it.
    pub fn is_coarse(self) -> bool {
        matches!(self, Self::DoubleStep | Self::HalfElements)
    }

    /// What it takes to get it from `document`. None: there is no such run, because statics has no step error, the
    /// system has no beams, no beam has linear twist, or a number of elements is odd.
    pub fn overrides(self, document: &Document) -> Option<Vec<Override>> {
        let is_dynamic = document.simulation.analysis == Analysis::Dynamic;
        let own = match self {
            Self::HalfStep => is_dynamic.then(|| steps(document, 0.5)),
            Self::DoubleStep => is_dynamic.then(|| steps(document, 2.0)),
            Self::QuadraticTwist => Some(quadratic_twist(document)),
            Self::DoubleElements => {
                mesh(document, |_, count| Some(2 * count)).map(|own| with_quadratic_twist(document, own))
            }
            Self::HalfElements => mesh(document, |_, count| count.is_multiple_of(2).then_some(count / 2))
                .map(|own| with_quadratic_twist(document, own)),
        };
        let own = own.filter(|overrides| !overrides.is_empty())?;
        // The rows stay where they are, also where the file leaves their distance to the step.
        let output_step = document.output_step();
        Some(own.into_iter().chain([(String::from("simulation.output_step"), output_step.to_string())]).collect())
    }

    /// Every how many rows it has one to compare. Internal steps end at every row: where whole numbers of longer ones
    /// do not fill the time between two rows, they fill that between three, or the steps would not all be twice as
    /// long.
    pub fn stride(self, document: &Document) -> u64 {
        let steps = document.output_step() / (2.0 * taken_step(document));
        let is_whole = (steps - steps.round()).abs() < WHOLE;
        // Rows may bound steps that the solver chooses.
        let are_bound = matches!(document.simulation.steps, Steps::ForAccuracy(_)) || !is_whole;
        if self == Self::DoubleStep && are_bound { 2 } else { 1 }
    }
}

/// How near to a whole number of steps the time between two rows is one: the round-off of decimal fractions.
const WHOLE: f64 = 1e-6;

/// The step that a run with given steps really takes: internal steps end at every row, s.
pub fn taken_step(document: &Document) -> f64 {
    document.largest_step().min(document.output_step())
}

/// The settings for steps that are `factor` times as long: the one place that knows how fine steps are asked for. Steps
/// that the solver chooses are shortened by rows of results too, which stay: finer ones need a bound of their own.
pub fn steps(document: &Document, factor: f64) -> Vec<Override> {
    let own = match document.simulation.steps {
        Steps::Fixed(_) => (String::from("simulation.step"), shortened(factor * taken_step(document))),
        // Errors are of second order.
        Steps::ForAccuracy(accuracy) => {
            let accuracy = document.value(accuracy) * factor.powi(2);
            (String::from("simulation.accuracy"), shortened(accuracy.clamp(FINEST_ACCURACY, COARSEST_ACCURACY)))
        }
    };
    let Some(pacing) = document.pacing(0.0) else { return vec![own] };
    let row = document.output_step();
    let longest = factor * row / pacing.count(row, pacing.longest_of_all());
    let has_bound = document.simulation.longest_step.is_some() || factor < 1.0;
    let bound = has_bound.then(|| (String::from("simulation.longest_step"), shortened(longest)));
    std::iter::once(own).chain(bound).collect()
}

/// A setting in as few digits as it has: a quotient's last ones are round-off.
fn shortened(setting: f64) -> String {
    let setting: f64 = format!("{setting:.11e}").parse().unwrap_or(setting);
    format!("{setting:e}")
}

/// Whether a beam has a finer twist than it uses.
pub fn has_linear_twist(beam: &BeamSpec) -> bool {
    matches!(beam.formulation, Elements::Ancf14 { twist: Twist::Linear, torsion: Torsion::Free, .. })
}

fn quadratic_twist(document: &Document) -> Vec<Override> {
    let beams = document.beams.iter().filter(|beam| has_linear_twist(beam));
    beams.map(|beam| (format!("{}.twist", beam.name), String::from("quadratic"))).collect()
}

/// The number of elements of a beam.
pub fn elements(document: &Document, beam: &BeamSpec) -> usize {
    document.value(beam.elements) as usize
}

fn with_quadratic_twist(document: &Document, mesh: Vec<Override>) -> Vec<Override> {
    quadratic_twist(document).into_iter().chain(mesh).collect()
}

/// Other numbers of elements in all beams, each from the beam's place and its own number; none where one of them has no
/// such number. Beams that keep theirs, and what holds on to them, stay as they are written.
fn mesh(document: &Document, other: impl Fn(usize, usize) -> Option<usize>) -> Option<Vec<Override>> {
    let mut overrides = Vec::new();
    for (place, beam) in document.beams.iter().enumerate() {
        let own = elements(document, beam);
        let count = other(place, own)?;
        if count != own {
            overrides.push((format!("{}.elements", beam.name), count.to_string()));
        }
        // A beam with a number of elements has linear twist unless it says otherwise.
        let is_quadratic = matches!(beam.formulation, Elements::Ancf14 { twist: Twist::Quadratic, .. });
        if count != own && beam.is_meshed_by_program && is_quadratic {
            overrides.push((format!("{}.twist", beam.name), String::from("quadratic")));
        }
    }
    for (key, spot) in anchors(document) {
        let Spot::Beam { beam: place, along: Along::Node(node) } = spot else { continue };
        let beam = &document.beams[place];
        let own = elements(document, beam);
        let count = other(place, own)?;
        if count != own {
            overrides.push((key, same_place(document, beam, node, [own, count])?));
        }
    }
    Some(overrides).filter(|_| !document.beams.is_empty())
}

/// The mesh of a run that another one is compared with: about half the elements, or twice as many.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherMesh {
    /// Overrides for the elements of every beam, and for the nodes and rows that depend on them.
    pub overrides: Vec<Override>,
    /// Length of its elements over the length of those in the first run. Beams with fewer elements differ in this
    /// ratio: the smallest one.
    pub ratio: f64,
}

impl OtherMesh {
    /// Chooses the mesh to compare a run of `document` with; none if a beam has no such mesh.
    pub fn beside(document: &Document) -> Option<Self> {
        Self::coarser(document).or_else(|| Self::twice(document)).map(|own| own.with_rows_of(document))
    }

    /// The mesh with twice the elements; none if a beam has no such mesh.
    pub fn finer(document: &Document) -> Option<Self> {
        Self::twice(document).map(|own| own.with_rows_of(document))
    }

    fn twice(document: &Document) -> Option<Self> {
        let overrides = mesh(document, |_, count| Some(2 * count))?;
        Some(Self { overrides, ratio: 0.5 })
    }

    fn with_rows_of(mut self, document: &Document) -> Self {
        self.overrides.push((String::from("simulation.output_step"), document.output_step().to_string()));
        self
    }

    /// Takes half the elements of each beam, or the fewest beyond that with which joints find their nodes. A beam that
    /// needs more than two thirds of its elements keeps all of them; none if all beams do.
    fn coarser(document: &Document) -> Option<Self> {
        let count = |place: usize, own: usize| {
            let held = held_places(document, place, own);
            let fits = |count: &usize| {
                held.iter().all(|fraction| shape::fits(document, &document.beams[place], *count, *fraction))
            };
            (own.div_ceil(2)..=2 * own / 3).find(fits).unwrap_or(own)
        };
        let counts = document.beams.iter().map(|beam| elements(document, beam)).enumerate();
        let ratios = counts.map(|(place, own)| own as f64 / count(place, own) as f64);
        let ratio = ratios.filter(|ratio| *ratio > 1.0).reduce(f64::min)?;
        Some(Self { overrides: mesh(document, |place, own| Some(count(place, own)))?, ratio })
    }
}

/// Overrides for `finer` times the elements of the beams that are `chosen`, or the fewest beyond that with which joints
/// and forces find their nodes, but twice as many at most; none where a beam has no such mesh.
pub fn finer(document: &Document, chosen: &[bool], finer: f64) -> Option<Vec<Override>> {
    mesh(document, |number, own| {
        if chosen.get(number) != Some(&true) {
            return Some(own);
        }
        let beam = &document.beams[number];
        let pushed = at_nodes(document, number, own, document.anchors_of_forces());
        let held: Vec<f64> = held_places(document, number, own).into_iter().chain(pushed).collect();
        let fits = |count: &usize| held.iter().all(|fraction| shape::fits(document, beam, *count, *fraction));
        let least = (finer * own as f64).ceil() as usize;
        Some((least..2 * own).find(fits).unwrap_or(2 * own))
    })
}

/// Fractions of a beam of `elements` elements at which joints hold on to nodes between its ends.
fn held_places(document: &Document, beam: usize, elements: usize) -> Vec<f64> {
    let joints = document.joints.iter().flat_map(|joint| [joint.a, joint.b]);
    at_nodes(document, beam, elements, joints.chain(document.points.iter().map(|point| point.on)))
}

/// Those of the fractions of a beam of `elements` elements that `anchors` name where it has nodes between its ends.
fn at_nodes(document: &Document, beam: usize, elements: usize, anchors: impl Iterator<Item = Anchor>) -> Vec<f64> {
    let Some(division) = shape::division(document, &document.beams[beam], elements) else { return Vec::new() };
    let fractions = anchors.filter_map(|anchor| match anchor.spot {
        Spot::Beam { beam: own, along: Along::Node(node) } if own == beam => division.fraction(node),
        Spot::Beam { beam: own, along: Along::Fraction(fraction) } if own == beam => Some(document.value(fraction)),
        _ => None,
    });
    fractions.filter(|fraction| division.end_at(*fraction).is_some()).collect()
}

/// `document`, which was read with `overrides`, with `changes`, and with the parameters that a host has set; none where
/// it cannot be read.
pub fn changed(document: &Document, overrides: &[Override], changes: Vec<Override>) -> Option<Document> {
    let keys: Vec<String> = changes.iter().map(|(key, _)| key.clone()).collect();
    let overrides = merged(&document.remaining(overrides), changes);
    let mut other = Document::parse(&document.model.name, document.text(), &overrides).ok()?;
    for index in 0..other.parameters().len() {
        let parameter = &other.parameters()[index];
        let name = &parameter.variable.name;
        let is_same = |own: &Parameter| own.variable.name == *name;
        // Other anchors may shift them.
        let own = match document.parameters().get(index).is_some_and(is_same) {
            true => Some(index),
            false => document.parameters().iter().position(is_same),
        };
        let value = own.map(|own| document.parameter_value(own));
        let is_set = value.is_some_and(|value| value != other.parameter_value(index));
        if is_set && !parameter.is_calculated() && !keys.contains(name) {
            other.set_parameter(index, value?).ok()?;
        }
    }
    Some(other)
}

/// Everything that holds on to a position that it names itself, with its key.
fn anchors(document: &Document) -> impl Iterator<Item = (String, Spot)> + '_ {
    let sides = |name: &str, a: Anchor, b: Anchor| [(format!("{name}.a"), a), (format!("{name}.b"), b)];
    // With its section: a load or an output of the same name may have such a key.
    let points = document.points.iter().map(|point| (format!("point.{}.on", point.name), point.on));
    let joints = document.joints.iter().flat_map(move |joint| sides(&joint.name, joint.a, joint.b));
    let springs = document
        .springs
        .iter()
        .filter_map(move |spring| spring.ends().map(|[a, b]| sides(&spring.name, a, b)))
        .flatten();
    let actuators = document.actuators.iter().filter_map(move |actuator| match actuator.action {
        Action::Between { a, b } => Some(sides(&actuator.name, a, b)),
        Action::Joint { .. } => None,
    });
    let loads = document.loads.iter().filter_map(|load| match load.target {
        load::Target::At(anchor) => Some((at(document, "load", &load.name), anchor)),
        load::Target::On(_) | load::Target::Moving { .. } => None,
    });
    let outputs = document
        .outputs
        .iter()
        .filter_map(|output| Some((at(document, "output", &output.name), *output.target.anchor()?)));
    let observers = document.outputs.iter().filter_map(|output| {
        let observer = output.observer.as_ref()?;
        Some((format!("{}.in", output.name), observer.anchor))
    });
    let all =
        points.chain(observers).chain(joints).chain(springs).chain(actuators.flatten()).chain(loads).chain(outputs);
    all.filter(|(_, anchor)| anchor.point.is_none()).map(|(key, anchor)| (key, anchor.spot))
}

/// `tip.at`; with its section where another one with this name has such a key.
fn at(document: &Document, section: &str, name: &str) -> String {
    let joints = document.joints.iter().filter(|joint| joint.at.is_some()).map(|joint| &joint.name);
    let loads = document.loads.iter().filter(|load| matches!(load.target, load::Target::At(_))).map(|load| &load.name);
    let watched = |output: &&OutputSpec| !matches!(output.target, output::Target::On { .. });
    let outputs = document.outputs.iter().filter(watched).map(|output| &output.name);
    match joints.chain(loads).chain(outputs).filter(|other| *other == name).count() {
        1 => format!("{name}.at"),
        _ => format!("{section}.{name}.at"),
    }
}

/// The place of node `node` of a beam, as it is written for another number of elements: a node, or where there is none,
/// a fraction.
fn same_place(document: &Document, beam: &BeamSpec, node: usize, [from, to]: [usize; 2]) -> Option<String> {
    let fraction = shape::division(document, beam, from)?.fraction(node)?;
    let other = match &beam.line {
        // The pieces between the points share the elements by length: not every one gets the same multiple.
        Some(Line::Curved(CurveSpec { polyline: true, shape: Shape::Points(_), .. })) => {
            shape::division(document, beam, to).and_then(|division| division.end_at(fraction))
        }
        _ => (node * to).is_multiple_of(from).then(|| node * to / from),
    };
    let name = &beam.name;
    Some(other.map_or_else(|| format!("{name}@{fraction}"), |node| format!("{name}.node[{node}]")))
}

/// The overrides of a further run: those of the user, except the ones that `others` set anew.
pub fn merged(own: &[Override], others: Vec<Override>) -> Vec<Override> {
    let is_same = |own: &str, other: &str| own == other || own.split_once('.').is_some_and(|(_, rest)| rest == other);
    let is_kept = |(key, _): &&Override| others.iter().all(|(other, _)| !is_same(key, other));
    own.iter().filter(is_kept).cloned().chain(others.iter().cloned()).collect()
}
