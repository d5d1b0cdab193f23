//! What joints, loads and outputs hold on to: `ground`, `arm.start`, `arm.end`, `arm@0.5`, `arm.node[3]`.

use crate::model::diagnostic::Place;
use crate::model::expression::Variable;
use crate::model::function::Formula;
use crate::model::names::{Kind, suggestion};
use crate::model::number::{Meta, Number, Slot, Written};
use crate::model::reader::{Context, Reader};
use crate::model::schema;

/// A point to hold on to, and where the file says so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Where it is written.
    pub place: Place,
    /// What it is.
    pub spot: Spot,
}

/// A point to hold on to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// The ground.
    Ground,
    /// A point of a beam.
    Beam {
        /// Place of the beam in the list of beams.
        beam: usize,
        /// Where on it.
        along: Along,
    },
}

/// A point along a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// Its first node.
    Start,
    /// Its last node.
    End,
    /// A fraction of its undeformed arc length, 0 to 1.
    Fraction(Number),
    /// Node k, from 0.
    Node(usize),
}

impl Anchor {
    /// Reads `key`; none if it is missing or wrong, which is reported.
    pub(in crate::model) fn read(reader: &mut Reader<'_, '_>, key: &'static str) -> Option<Self> {
        let written = reader.has(key);
        let Some((text, place)) = reader.text(key) else {
            if !written {
                reader.missing(key, "ground, BEAM.start, BEAM.end, BEAM@0.5 or BEAM.node[3]");
            }
            return None;
        };
        parse(reader.context, &text, place).map(|spot| Self { place, spot })
    }

    /// Reads `key`, where the ground makes no sense.
    pub(in crate::model) fn read_beam_point(reader: &mut Reader<'_, '_>, key: &'static str) -> Option<Self> {
        let anchor = Self::read(reader, key)?;
        if anchor.spot == Spot::Ground {
            let message = format!("`{key}` of {} is the ground", reader.title);
            reader.context.report.error(anchor.place, &message, "a point of a beam was expected", "");
            return None;
        }
        Some(anchor)
    }
}

fn parse(context: &mut Context<'_>, text: &str, place: Place) -> Option<Spot> {
    if text == "ground" {
        return Some(Spot::Ground);
    }
    let length = text.find(['.', '@']).unwrap_or(text.len());
    let (name, rest) = text.split_at(length);
    let beam = match context.names.find(name) {
        Some(named) if named.kind == Kind::Beam => named.index,
        // The section itself is reported where it stands.
        Some(named) if matches!(named.kind, Kind::Body | Kind::Frame) => return None,
        Some(named) => {
            let word = named.kind.word();
            let at = context.report.source.inside(place, text, 0..length);
            let help = "available: ground and points of beams";
            context.report.error(at, &format!("`{name}` is a {word}"), "a beam was expected", help);
            return None;
        }
        None => {
            let near = suggestion(name, context.names.of(Kind::Beam).chain(["ground"]));
            let label = if near.is_empty() { "the name of a beam, or ground, was expected".to_owned() } else { near };
            let at = context.report.source.inside(place, text, 0..length);
            context.report.error(at, &format!("unknown beam `{name}`"), &label, "");
            return None;
        }
    };
    let along = if let Some(fraction) = rest.strip_prefix('@') {
        let at = context.report.source.inside(place, text, length + 1..text.len());
        let program = context.program(fraction, at, Variable::None);
        let written = program.map_or(Written::Broken, |program| Written::Formula(Formula::single(program)));
        let meta = Meta::of(&schema::FRACTION, format!("{name}@"));
        Along::Fraction(context.numbers.push(Slot { meta, place: at, listed: None, written }))
    } else {
        match rest {
            ".start" => Along::Start,
            ".end" => Along::End,
            _ => match node(rest) {
                Some(node) => Along::Node(node),
                None => {
                    let message = match rest {
                        "" => format!("`{name}` is a whole beam, a point was expected"),
                        _ => format!("a beam has no point `{rest}`"),
                    };
                    let label = suggestion(rest, [".start", ".end", ".node[0]"]);
                    let help = format!("{name}.start, {name}.end, {name}@0.5 or {name}.node[3]");
                    let at = if rest.is_empty() { 0 } else { length };
                    let at = context.report.source.inside(place, text, at..text.len());
                    context.report.error(at, &message, &label, &help);
                    return None;
                }
            },
        }
    };
    Some(Spot::Beam { beam, along })
}

/// `.node[3]` to 3.
fn node(rest: &str) -> Option<usize> {
    let digits = rest.strip_prefix(".node[")?.strip_suffix(']')?;
    digits.chars().all(|c| c.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}
