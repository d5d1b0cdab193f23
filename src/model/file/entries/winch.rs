//! `[winch.NAME]`: pays out a beam at one of its ends.

use super::Parts;
use super::drive::Motion;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Allowed, Along, Anchor, Spot};
use crate::model::file::reader::input::{REACHED, make_input};
use crate::model::file::schema::{Key, PLACES, Role, Rule};
use crate::model::text::diagnostic::{Place, Report};
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("at", Role::Name(PLACES), "the end of the beam that it pays out"),
    Key::number(&[&PAID_OUT]),
    Key::number(&[&PAYOUT_RATE]),
    Key::word("input", &["length", "rate"], "what the host gives"),
];

const PAID_OUT: Rule =
    Rule::new("length", "length of the beam that the winch has paid out, beyond the one as drawn", "m").in_time();
const PAYOUT_RATE: Rule = Rule::new("rate", "rate at which the winch pays out the beam", "m/s").in_time();

/// A section `[winch.NAME]`.
#[derive(Clone, Debug)]
pub struct WinchSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Place in the list of beams.
    pub beam: usize,
    /// Whether the winch is at the end of the beam, not at its start.
    pub at_end: bool,
    /// The length that is paid out beyond the one as drawn, m, or its rate, m/s.
    pub motion: Motion,
    /// true: the host gives it; the number is the start value.
    pub input: bool,
}

/// Where a winch can be.
const ENDS: Allowed = Allowed { kinds: &[Kind::Beam], ground: false, forms: "BEAM.start or BEAM.end" };

/// What a winch prescribes: a word of `input`, and how its key becomes a motion.
type Way = (&'static Rule, fn(Number) -> Motion);

const LENGTH: Way = (&PAID_OUT, Motion::Value);
const RATE: Way = (&PAYOUT_RATE, Motion::Rate);

impl WinchSpec {
    /// Reads a section.
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let at = Anchor::read(&mut reader, "at", &ENDS).and_then(|anchor| match anchor.spot {
            Spot::Beam { beam, along: Along::Start } => Some((beam, false)),
            Spot::Beam { beam, along: Along::End } => Some((beam, true)),
            _ => {
                let message = format!("{} is not at an end of a beam", reader.title);
                reader.context.report.error(anchor.place, &message, &format!("{} was expected", ENDS.forms), "");
                None
            }
        });
        let has_input = reader.has("input");
        let inputs: [(&'static str, Way); 2] = [("length", LENGTH), ("rate", RATE)];
        let word = if has_input { reader.word("input", &inputs, None) } else { None };
        let motion = match word {
            Some(way) => Some(given(&mut reader, way)),
            None => written(&mut reader, has_input),
        };
        let place = reader.place;
        reader.finish();
        let (beam, at_end) = at?;
        Some(Self { name: name.to_owned(), place, beam, at_end, motion: motion?, input: word.is_some() })
    }

    /// Reports every winch of a beam that another one before it pays out already.
    pub(in crate::model) fn report_doubles(winches: &[Self], report: &mut Report<'_>) {
        for (k, winch) in winches.iter().enumerate() {
            let Some(first) = winches[..k].iter().find(|other| other.beam == winch.beam) else { continue };
            let label = format!("line {} has the winch {}", report.source.line(first.place), first.name);
            report.error(winch.place, "two winches pay out the same beam", &label, "");
        }
    }
}

/// `length` or `rate`, as the file has it; where `input` is there but wrong, neither is missing.
fn written(reader: &mut Reader<'_, '_>, is_given: bool) -> Option<Motion> {
    for (rule, motion) in [LENGTH, RATE] {
        if let Some(number) = reader.optional(rule) {
            if rule.key == LENGTH.0.key {
                reader.exclude(RATE.0.key, LENGTH.0.key);
            }
            return Some(motion(number));
        }
    }
    if !is_given {
        reader.missing("length", "or `rate`, or input = \"length\" or \"rate\": the host gives it");
    }
    None
}

/// `length` or `rate`, as the host gives it: the file has its start value, default 0.
fn given(reader: &mut Reader<'_, '_>, (rule, motion): Way) -> Motion {
    let number = reader.number_or(rule, 0.0);
    let other = if rule.key == LENGTH.0.key { RATE.0.key } else { LENGTH.0.key };
    let message = format!("{} has an input and a {other}", reader.title);
    let label = format!("with input = \"{0}\", only `{0}` is allowed; it sets the start value", rule.key);
    reader.refuse(other, &message, &label);
    make_input(reader.context, number);
    reader.context.numbers.slots[number.0].meta.description.push_str(&format!(", {REACHED}"));
    motion(number)
}
