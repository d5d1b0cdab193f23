//! The mistakes of sections: along their beam, and with its elements.

use super::twist;
use crate::math::quadrature::{FIVE_POINTS, GAUSS_POINTS, LOBATTO_POINTS};
use crate::mechanics::beam::ancf14::strain::Strain;
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::design::Elements;
use crate::mechanics::beam::section::Section;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::section::{Rigidities, SectionSpec, Shape};
use crate::model::file::number::Number;
use crate::model::shape::sections::{at_start, integrals, written_damping};
use crate::model::shape::shown;
use crate::model::text::diagnostic::Diagnostic;

/// The first mistake of a section that varies along `beam`, or that its elements cannot have.
pub fn mistake(document: &Document, beam: &BeamSpec, line: &Centerline) -> Option<Diagnostic> {
    let written = document.sections.get(beam.section)?;
    let functions = written.varying(&document.numbers);
    let sound = |number: &Number| document.is_sound(*number) && document.function(*number).objection().is_none();
    if !written.numbers().iter().all(sound) {
        return None;
    }
    if let (Elements::Ancf24 { .. }, Some(cause)) = (beam.formulation, beyond_ancf24(document, written, &functions)) {
        let message = format!("beam {} of ANCF24 elements cannot have section {}", beam.name, written.name);
        let help = "take element = \"ancf14\", or a section of a shape with constant dimensions";
        return Some(document.diagnostic(beam.place, &message, cause, help));
    }
    if let Elements::Ancf14 { strain: Strain::LargeTruncated, .. } = beam.formulation
        && let Shape::Rigidities(Rigidities { tension_center: Some([number, _]), .. }) = written.shape
    {
        let message = format!("beam {} has a section whose tension center is off its axis", beam.name);
        let label = "it couples bending with the axial strain, which the truncated strain has no terms for";
        let help = "take strain = \"small\", the default of rigidities, or \"large\" for the beam";
        return Some(document.diagnostic(document.place(number), &message, label, help));
    }
    let damping = written_damping(document, beam)?;
    let is_first = |other: &&BeamSpec| written_damping(document, other) == Some(damping);
    if document.beams.iter().find(is_first).is_some_and(|first| first.name == beam.name)
        && let Some((number, objection)) = damping.objection(|number| document.value(number))
    {
        let message = format!("`{}` {objection}", document.name(number));
        let label = format!("this is {}", shown(document.value(number)));
        return Some(document.diagnostic(document.place(number), &message, &label, ""));
    }
    if functions.is_empty() {
        let is_told = written.objection(|number| document.value(number)).is_some();
        return if is_told { None } else { unstable(document, written, &at_start(document, written), "") };
    }
    let length: f64 = line.spans.iter().map(|span| span.length).sum();
    let inside = FIVE_POINTS.into_iter().chain(GAUSS_POINTS).chain(LOBATTO_POINTS);
    let places = line.spans.iter().flat_map(|span| {
        let [begin, end] = [span.node, span.node + 1].map(|node| line.nodes[node].fraction);
        inside.clone().map(move |xi| (begin + (end - begin) * xi) * length)
    });
    places.into_iter().find_map(|s| wrong_at(document, beam, written, &functions, s)).or_else(|| {
        let turn = written.turn.filter(|turn| functions.iter().any(|(number, _)| number == turn))?;
        twist::by_section(document, beam, line, turn, length)
    })
}

/// Why elements of ANCF24 cannot have a section; none: they can.
fn beyond_ancf24(document: &Document, written: &SectionSpec, functions: &[(Number, Function)]) -> Option<&'static str> {
    if written.has_material() {
        return Some("the section is given by rigidities");
    }
    if !functions.is_empty() {
        return Some("the section varies along the beam");
    }
    (at_start(document, written).product_moment != 0.0).then_some("y and z are not the principal axes of the section")
}

/// The mistake of a section at the arc length `s`, m.
fn wrong_at(
    document: &Document,
    beam: &BeamSpec,
    written: &SectionSpec,
    functions: &[(Number, Function)],
    s: f64,
) -> Option<Diagnostic> {
    let value = |number: Number| {
        functions.iter().find(|(varying, _)| *varying == number).map_or(document.value(number), |(_, own)| own.value(s))
    };
    let there = format!("at s = {} m of beam {}", shown(s), beam.name);
    let report = |number: Number, objection: &str, help: &str| {
        let message = format!("`{}` {objection}", document.name(number));
        let label = format!("{there} this is {}", shown(value(number)));
        document.diagnostic(document.place(number), &message, &label, help)
    };
    for (number, function) in functions {
        if let Some(undefined) = function.undefined(s) {
            let message = format!("`{}` has no value {there}", document.name(*number));
            let help = format!("add rows to the table, or set outside = \"hold\" in [function.{}]", undefined.name);
            return Some(document.diagnostic(document.place(*number), &message, &undefined.to_string(), &help));
        }
        if let Some(objection) = document.objection_to(*number, function.value(s)) {
            return Some(report(*number, &objection, "`s` is the arc length from the start of the beam, in m"));
        }
    }
    written
        .objection(value)
        .map(|(number, objection)| report(number, &objection, ""))
        .or_else(|| unstable(document, written, &integrals(written, value), &there))
}

/// A section whose integrals contradict each other: it would have a negative bending stiffness.
fn unstable(document: &Document, written: &SectionSpec, section: &Section, there: &str) -> Option<Diagnostic> {
    let Section { second_moment_y, second_moment_z, product_moment, .. } = section;
    let limit = (second_moment_y * second_moment_z).sqrt();
    (product_moment.abs() >= limit && *product_moment != 0.0).then(|| {
        let message = format!("section {} has a negative bending stiffness {there}", written.name);
        let label = format!("its product of area is {}", shown(*product_moment));
        let help =
            format!("it must be less than the square root of the product of both second moments, {}", shown(limit));
        document.diagnostic(written.place, message.trim_end(), &label, &help)
    })
}
