//! Sections of the file as integrals, at one position or along a beam.

use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::material::Material;
use crate::mechanics::beam::profile::Profile;
use crate::mechanics::beam::section::Section;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::damping::Damping;
use crate::model::file::entries::material::Lateral;
use crate::model::file::entries::section::{Flanged, Rigidities, SectionSpec, Shape, Walls};
use crate::model::file::number::Number;
use std::f64::consts::PI;

/// The material of a beam; where its section has rigidities, one whose moduli are 1. None: a mistake, which is
/// reported.
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
pub fn integrals(written: &SectionSpec, value: impl Fn(Number) -> f64) -> Section {
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
    let contents = match (written.shape, written.immersion.contents_density) {
        (Shape::Tube { inner, .. }, Some(density)) => value(density) * PI * value(inner).powi(2),
        _ => 0.0,
    };
    let section = Section {
        area: given(written.area, shape.area),
        second_moment_y,
        second_moment_z,
        torsion_constant: given(written.torsion_constant, shape.torsion_constant),
        polar_moment: given(written.polar_moment, second_moment_y + second_moment_z),
        product_moment: given(written.product_moment, shape.product_moment),
        twist: given(written.turn, 0.0),
        contents,
        ..shape
    };
    match (written.fourth_moments, written.shape) {
        (Some(numbers), _) => Section { fourth_moments: numbers.map(value), ..section },
        (None, Shape::General) => like_a_rectangle(section),
        (None, _) => section,
    }
}

/// Rigidity that a beam without bending or torsion stiffness has instead, as a share of its weight, or of a millionth
/// of its axial rigidity, times the square of an element: far below what the tension of a line does.
const LEAST_SHARE: f64 = 1e-7;
const LEAST_STRAIN: f64 = 1e-6;

/// The rigidity against bending and torsion of a beam that has none of its own, N m²; 0 where it has both, or a
/// material.
pub fn least_rigidity(document: &Document, beam: &BeamSpec, line: &Centerline) -> f64 {
    let Some(Shape::Rigidities(own)) = document.sections.get(beam.section).map(|section| section.shape) else {
        return 0.0;
    };
    let value = |number: Number| document.value(number);
    if [own.bending[0], own.bending[1], own.torsion].into_iter().all(|number| value(number) > 0.0) {
        return 0.0;
    }
    let length: f64 = line.spans.iter().map(|span| span.length).sum();
    let longest = line.spans.iter().map(|span| span.length).fold(0.0, f64::max);
    let gravity = document.vector(document.model.gravity).iter().map(|part| part * part).sum::<f64>().sqrt();
    let tension = (value(own.line_density) * gravity * length).max(LEAST_STRAIN * value(own.axial));
    LEAST_SHARE * tension * longest * longest
}

/// The diameter that water sees, m; none: the shape is not round, and the file does not give one.
pub fn outer_diameter(written: &SectionSpec, value: impl Fn(Number) -> f64) -> Option<f64> {
    match (written.immersion.outer_diameter, written.shape) {
        (Some(diameter), _) => Some(value(diameter)),
        (None, Shape::Circle { radius } | Shape::Tube { outer: radius, .. }) => Some(2.0 * value(radius)),
        (None, _) => None,
    }
}

/// A section whose material has the moduli 1: integrals are rigidities.
fn of_rigidities(rigidities: &Rigidities, value: impl Fn(Number) -> f64) -> Section {
    let [axial, torsion, line_density] = [rigidities.axial, rigidities.torsion, rigidities.line_density].map(&value);
    let [second_moment_y, second_moment_z] = rigidities.bending.map(&value);
    let polar_moment = second_moment_y + second_moment_z;
    let about = rigidities.inertia.map(|number| number.map_or(0.0, &value));
    let spin = match (rigidities.polar_inertia, rigidities.inertia) {
        (Some(number), _) => value(number),
        (None, [Some(_), Some(_)]) => about[0] + about[1],
        (None, _) => line_density * polar_moment / axial,
    };
    let about_tension_center = like_a_rectangle(Section {
        area: axial,
        second_moment_y,
        second_moment_z,
        torsion_constant: torsion,
        polar_moment,
        product_moment: rigidities.coupling.map_or(0.0, &value),
        inertia: Some([line_density, spin, about[0], about[1]]),
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
