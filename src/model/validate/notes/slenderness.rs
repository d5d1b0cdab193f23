//! Beams that are too short for their section: ANCF14 has no shear deformation.

use super::groups::Groups;
use super::{Note, listed};
use crate::mechanics::beam::design::Elements;
use crate::mechanics::beam::section::Section;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::joint::JointKind;
use crate::model::file::reader::anchor::Spot;
use crate::model::shape::{Lines, sections, shown};

/// Length over section size below which shear matters: of a cantilever with a square section it is 3 % of the
/// deflection.
const STUBBY: f64 = 5.0;

/// A stub matters if it gives way at least this share as far as the beam of the mechanism that gives way most, under
/// the same force: a crank between slender beams does not, nor does a leaf spring in its plane.
const NOTABLE: f64 = 0.05;

/// A section in one direction of bending.
#[derive(Clone, Copy)]
struct Bending {
    /// Extent in that direction, m.
    size: f64,
    /// Second moment of area, m⁴.
    moment: f64,
}

/// Names beams that are short for their section. Beams that welds join count as one: a tapered beam is made of such
/// pieces.
pub fn stubby_beams(document: &Document, lines: &Lines) -> Vec<Note> {
    let beam_of = |spot: Spot| if let Spot::Beam { beam, .. } = spot { Some(beam) } else { None };
    let welds = document.joints.iter().filter(|joint| joint.kind == JointKind::Weld);
    let pairs = welds.filter_map(|joint| Some((beam_of(joint.a.spot)?, beam_of(joint.b.spot)?)));
    let groups = Groups::new(document.beams.len(), pairs);
    let mut lengths = vec![0.0; document.beams.len()];
    for beam in 0..document.beams.len() {
        let spans = lines.line(beam).map(|line| line.spans.iter().map(|span| span.length).sum::<f64>());
        lengths[groups.first(beam)] += spans.unwrap_or(f64::INFINITY);
    }
    let section =
        |beam: &BeamSpec| document.sections.get(beam.section).map(|section| sections::at_start(document, section));
    let bendings = |beam: &BeamSpec| section(beam).map(|section| bendings(&section));
    let compliance = |beam: &BeamSpec, length: f64, bending: Bending| {
        length.powi(3)
            / (sections::material(document, beam).map_or(f64::NAN, |material| material.young) * bending.moment)
    };
    let beams = || document.beams.iter().enumerate().map(|(index, beam)| (beam, lengths[groups.first(index)]));
    let all = beams().flat_map(|(beam, length)| {
        bendings(beam).into_iter().flatten().map(move |bending| compliance(beam, length, bending))
    });
    let most = all.fold(0.0, f64::max);
    let stubby = |(beam, length): (&BeamSpec, f64)| {
        let is_stubby =
            |bending: &Bending| length < STUBBY * bending.size && compliance(beam, length, *bending) > NOTABLE * most;
        let is_sheared = matches!(beam.formulation, Elements::Ancf24 { .. });
        let size = bendings(beam)?.into_iter().find(is_stubby)?.size;
        (!is_sheared).then_some((beam.place, beam.name.clone(), length, size))
    };
    let found: Vec<_> = beams().filter_map(stubby).collect();
    let Some((place, first, length, size)) = found.first() else { return Vec::new() };
    let others: Vec<&str> = found[1..].iter().map(|(_, name, ..)| name.as_str()).collect();
    let others = if others.is_empty() { String::new() } else { format!(" The same holds for {}.", listed(&others)) };
    let text = format!(
        "beam {first} is {:.2} times as long as its section is large ({} m, {} m). Below {STUBBY} times, shear deformation matters, which \
         ANCF14 does not have.{others} Use a [body.NAME], or element = \"ancf24\"",
        length / size,
        shown(*length),
        shown(*size)
    );
    vec![Note { place: *place, text }]
}

/// A section in both directions, the stiffer one first. A general one is the rectangle with its area and second
/// moments; one that varies is looked at where it begins.
fn bendings(section: &Section) -> [Bending; 2] {
    let sizes = section.outline.size();
    let mut both = [(1, section.second_moment_y), (0, section.second_moment_z)].map(|(axis, moment)| {
        let size = sizes.map_or((12.0 * moment / section.area).sqrt(), |sizes| sizes[axis]);
        Bending { size, moment }
    });
    both.sort_by(|a, b| b.size.total_cmp(&a.size));
    both
}
