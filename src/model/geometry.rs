//! The mistakes that only the geometry shows: beams without length, axes without direction, joints beside nodes.
//!
//! A number that is wrong itself is reported elsewhere: what hangs on it is passed over here.

use super::diagnostic::{Diagnostic, Place};
use super::document::Document;
use super::entries::anchor::{Along, Anchor, Spot};
use super::entries::beam::Beam;
use super::entries::joint::Joint;
use super::entries::load::Target;
use super::number::Number;
use crate::math::Vec3;
use crate::mechanics::assembly::node_at;

/// Sine of the smallest angle between a beam and its `y_axis`: one degree.
const SMALLEST_SINE: f64 = 0.017_452_4;

/// All mistakes of the geometry with the parameters of now, in file order.
pub fn mistakes(document: &Document) -> Vec<Diagnostic> {
    let mut checker = Checker { document, mistakes: Vec::new() };
    for beam in &document.beams {
        checker.check_beam(beam);
    }
    for joint in &document.joints {
        checker.check_joint(joint);
    }
    let points = document.loads.iter().filter_map(|load| match &load.target {
        Target::At(anchor) => Some(anchor),
        Target::On(_) => None,
    });
    for anchor in points.chain(document.outputs.iter().map(|output| &output.at)) {
        checker.fraction(anchor);
    }
    let mut mistakes = checker.mistakes;
    mistakes.sort_by_key(|mistake| mistake.place);
    mistakes
}

/// Three numbers; none if one of them is wrong.
fn vector(document: &Document, numbers: [Number; 3]) -> Option<Vec3> {
    let vector = Vec3::from(document.vector(numbers));
    vector.iter().all(|value| value.is_finite()).then_some(vector)
}

struct Checker<'a> {
    document: &'a Document,
    mistakes: Vec<Diagnostic>,
}

impl Checker<'_> {
    fn mistake(&mut self, place: Place, message: &str, label: &str, help: &str) {
        self.mistakes.push(self.document.diagnostic(place, message, label, help));
    }

    fn check_beam(&mut self, beam: &Beam) {
        let document = self.document;
        let (Some(from), Some(to)) = (vector(document, beam.from), vector(document, beam.to)) else { return };
        let span = to - from;
        if span.norm() == 0.0 {
            let message = format!("beam {} has no length", beam.name);
            self.mistake(document.place(beam.to[0]), &message, "`to` must differ from `from`", "");
            return;
        }
        if !span.norm().is_finite() {
            let message = format!("beam {} is too long to compute with", beam.name);
            self.mistake(document.place(beam.to[0]), &message, "this is too far away", "");
            return;
        }
        let Some(y_axis) = vector(document, beam.y_axis) else { return };
        let sine = span.cross(&y_axis).norm() / (span.norm() * y_axis.norm());
        // A y_axis of length 0 gives NaN, which is a mistake too.
        if sine.is_nan() || sine < SMALLEST_SINE {
            let message = format!("the y_axis of beam {} is along the beam", beam.name);
            let place = document.place(beam.y_axis[0]);
            let help = format!("give {} a y_axis that is more than 1 degree off its direction", beam.name);
            self.mistake(place, &message, "the section's y must be across the beam", &help);
        }
    }

    /// Beam, number of its elements and fraction of its length; none for the ground, or after a mistake.
    fn fraction(&mut self, anchor: &Anchor) -> Option<(usize, f64, f64)> {
        let Spot::Beam { beam, along } = anchor.spot else { return None };
        let document = self.document;
        let written = document.beams.get(beam)?;
        let elements = Some(document.value(written.elements)).filter(|elements| elements.is_finite())?;
        if let Along::Node(node) = along
            && node as f64 > elements
        {
            let message = format!("beam {} has no node {node}", written.name);
            let label = format!("{elements} elements have the nodes 0 to {elements}");
            self.mistake(anchor.place, &message, &label, "");
            return None;
        }
        let fraction = along.fraction(document, elements);
        fraction.is_finite().then_some((beam, elements, fraction))
    }

    /// Beam and node that an anchor names; none for the ground, or after a mistake.
    fn node(&mut self, anchor: &Anchor) -> Option<(usize, usize)> {
        let (beam, elements, fraction) = self.fraction(anchor)?;
        let node = node_at(fraction, elements as usize);
        if node.is_none() {
            let place = fraction * elements;
            let message =
                format!("there is no node of beam {} at the fraction {fraction}", self.document.beams[beam].name);
            let label =
                format!("the nearest nodes are at {} and {}", place.floor() / elements, place.ceil() / elements);
            let fits = |count: &usize| node_at(fraction, *count).is_some();
            let counts: Vec<String> = (1..=100).filter(fits).take(5).map(|count| count.to_string()).collect();
            let help = match counts.is_empty() {
                true => String::from("joints hold on to nodes: no count up to 100 has one there"),
                false => format!("joints hold on to nodes; with elements = {} there is one there", counts.join(", ")),
            };
            self.mistake(anchor.place, &message, &label, &help);
        }
        node.map(|node| (beam, node))
    }

    fn check_joint(&mut self, joint: &Joint) {
        let (a, b) = (self.node(&joint.a), self.node(&joint.b));
        if a.is_some() && a == b {
            let message = format!("joint {} joins a point to itself", joint.name);
            self.mistake(joint.b.place, &message, "another point was expected", "");
        }
        if let Some(numbers) = joint.axis
            && let Some(axis) = vector(self.document, numbers)
            && (axis.norm() == 0.0 || !axis.norm().is_finite())
        {
            let message = format!("the axis of joint {} has no direction", joint.name);
            self.mistake(self.document.place(numbers[0]), &message, "a vector other than zero was expected", "");
        }
    }
}

impl Along {
    /// Fraction of the beam's length, 0 to 1.
    pub fn fraction(self, document: &Document, elements: f64) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::End => 1.0,
            Self::Fraction(number) => document.value(number),
            Self::Node(node) => node as f64 / elements,
        }
    }
}
