//! Sections of the file as integrals, at one place or along a beam, and what is wrong with them there.

use super::lines::LARGEST_TWIST;
use super::shown;
use crate::math::curve_defect::LARGEST_BEND;
use crate::math::quadrature::{FIVE_POINTS, GAUSS_POINTS, LOBATTO_POINTS};
use crate::mechanics::beam::ancf14::strain::Strain;
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::design::Elements;
use crate::mechanics::beam::material::Material;
use crate::mechanics::beam::profile::Profile;
use crate::mechanics::beam::section::Section;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::damping::Damping;
use crate::model::file::entries::material::Lateral;
use crate::model::file::entries::section::{Flanged, Rigidities, SectionSpec, Shape, Walls};
use crate::model::file::number::Number;
use crate::model::text::diagnostic::Diagnostic;

/// The material of a beam; where its section has rigidities, one whose moduli are 1. None: a mistake, which is reported.
pub fn material(document: &Document, beam: &BeamSpec) -> Option<Material> {
    let value = |number| document.value(number);
    let [damping, _] = damping(document, beam)?;
    if document.sections.get(beam.section)?.has_material() {
        return Some(Material { young: 1.0, shear: 1.0, density: 1.0, damping });
    }
    let written = document.materials.get(beam.material?)?;
    let young = value(written.young);
    let shear = match written.lateral {
        Lateral::Poisson(poisson) => Material::shear_from_poisson(young, value(poisson)),
        Lateral::Shear(shear) => value(shear),
    };
    Some(Material { young, shear, density: value(written.density), damping })
}

/// The damping that the file gives a beam.
pub fn written_damping(document: &Document, beam: &BeamSpec) -> Option<Damping> {
    match document.sections.get(beam.section)?.shape {
        Shape::Rigidities(Rigidities { damping, .. }) => Some(damping),
        _ => Some(document.materials.get(beam.material?)?.damping),
    }
}

/// The damping of a beam in proportion to stiffness, s, and to mass, 1/s.
pub fn damping(document: &Document, beam: &BeamSpec) -> Option<[f64; 2]> {
    written_damping(document, beam).map(|damping| damping.coefficients(|number| document.value(number)))
}

/// The thermal expansion of a beam, 1/K; none: it is not given.
pub fn expansion(document: &Document, beam: &BeamSpec) -> Option<f64> {
    let written = match document.sections.get(beam.section)?.shape {
        Shape::Rigidities(Rigidities { expansion, .. }) => expansion,
        _ => document.materials.get(beam.material?)?.expansion,
    };
    written.map(|number| document.value(number))
}

/// The section at the start of a beam.
pub fn at_start(document: &Document, written: &SectionSpec) -> Section {
    integrals(written, |number| document.value(number))
}

/// The section along a beam of length `length`, m; none where it is the same everywhere, in principal axes.
pub fn along(document: &Document, written: &SectionSpec, length: f64) -> Option<Profile> {
    let written = written.clone();
    let start = at_start(document, &written);
    let functions = written.varying(&document.numbers);
    if functions.is_empty() {
        let is_plain = start.product_moment == 0.0 && start.tension_center == [0.0; 2];
        return (!is_plain).then(|| Profile::new(move |_| start));
    }
    let constants: Vec<(Number, f64)> =
        written.numbers().into_iter().map(|number| (number, document.value(number))).collect();
    Some(Profile::new(move |fraction| {
        integrals(&written, |number| match functions.iter().find(|(varying, _)| *varying == number) {
            Some((_, function)) => function.value(fraction * length),
            None => constants.iter().find(|(known, _)| *known == number).map_or(f64::NAN, |(_, value)| *value),
        })
    }))
}

/// Integrals of the shape, those that are written instead of the shape's own.
fn integrals(written: &SectionSpec, value: impl Fn(Number) -> f64) -> Section {
    let given = |number: Option<Number>, own: f64| number.map_or(own, &value);
    let shape = match written.shape {
        Shape::Rectangle { width, height } => Section::rectangle(value(width), value(height)),
        Shape::Circle { radius } => Section::circle(value(radius)),
        Shape::Tube { inner, outer } => Section::tube(value(inner), value(outer)),
        Shape::Ellipse { width, height } => Section::ellipse(value(width), value(height)),
        Shape::Walls { kind, width, height, wall } => {
            let [width, height, wall] = [width, height, wall].map(&value);
            match kind {
                Walls::Box => Section::hollow(width, height, wall),
                Walls::Angle => Section::angle(width, height, wall),
            }
        }
        Shape::Flanged { kind, width, height, web, flange } => {
            let [width, height, web, flange] = [width, height, web, flange].map(&value);
            match kind {
                Flanged::I => Section::i_beam(width, height, web, flange),
                Flanged::Channel => Section::channel(width, height, web, flange),
                Flanged::Tee => Section::tee(width, height, web, flange),
            }
        }
        Shape::General => Section::EMPTY,
        Shape::Rigidities(rigidities) => {
            return Section { twist: given(written.turn, 0.0), ..of_rigidities(&rigidities, value) };
        }
    };
    let second_moment_y = given(written.second_moment_y, shape.second_moment_y);
    let second_moment_z = given(written.second_moment_z, shape.second_moment_z);
    let section = Section {
        area: given(written.area, shape.area),
        second_moment_y,
        second_moment_z,
        torsion_constant: given(written.torsion_constant, shape.torsion_constant),
        polar_moment: given(written.polar_moment, second_moment_y + second_moment_z),
        product_moment: given(written.product_moment, shape.product_moment),
        twist: given(written.turn, 0.0),
        ..shape
    };
    match (written.fourth_moments, written.shape) {
        (Some(numbers), _) => Section { fourth_moments: numbers.map(value), ..section },
        (None, Shape::General) => like_a_rectangle(section),
        (None, _) => section,
    }
}

/// A section whose material has the moduli 1: integrals are rigidities.
fn of_rigidities(rigidities: &Rigidities, value: impl Fn(Number) -> f64) -> Section {
    let [axial, torsion, line_density] = [rigidities.axial, rigidities.torsion, rigidities.line_density].map(&value);
    let [second_moment_y, second_moment_z] = rigidities.bending.map(&value);
    let polar_moment = second_moment_y + second_moment_z;
    let spin = rigidities.polar_inertia.map_or(line_density * polar_moment / axial, &value);
    let about_tension_center = like_a_rectangle(Section {
        area: axial,
        second_moment_y,
        second_moment_z,
        torsion_constant: torsion,
        polar_moment,
        product_moment: rigidities.coupling.map_or(0.0, &value),
        inertia: Some([line_density, spin]),
        ..Section::EMPTY
    });
    match rigidities.tension_center.map(|center| center.map(&value)) {
        None | Some([0.0, 0.0]) => about_tension_center,
        Some(center) => about_tension_center.with_tension_center(center),
    }
}

/// The section with the fourth moments of the rectangle that has its area and principal second moments.
fn like_a_rectangle(section: Section) -> Section {
    let (_, [about_y, about_z]) = section.principal_axes();
    Section { fourth_moments: Section::rectangular_fourth_moments(section.area, about_y, about_z), ..section }
}

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
        let twist = written.turn.filter(|twist| functions.iter().any(|(number, _)| number == twist))?;
        overtwisted(document, beam, line, twist, length)
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

/// An element between whose ends the section turns too far.
fn overtwisted(
    document: &Document,
    beam: &BeamSpec,
    line: &Centerline,
    twist: Number,
    length: f64,
) -> Option<Diagnostic> {
    let function = document.function(twist);
    let turn = |node: usize| {
        let fraction = line.nodes[node].fraction;
        function.value(fraction * length) + document.value(beam.pretwist) * fraction
    };
    let angle = line.spans.iter().map(|span| (turn(span.node + 1) - turn(span.node)).abs()).fold(0.0, f64::max);
    (angle > LARGEST_TWIST).then(|| {
        let message =
            format!("an element of beam {} is turned by {:.1} degrees from end to end", beam.name, angle.to_degrees());
        let most = format!("the limit is {} degrees an element", LARGEST_BEND.to_degrees().round());
        let help = format!("{most}: take more elements; the `turn` of a section is in rad");
        document.diagnostic(document.place(twist), &message, "by its section", &help)
    })
}
