//! Legal models that are hardly ever meant: parts that nothing holds, materials in other units than SI.

use crate::model::file::document::Document;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::Spot;

/// Young's modulus below which a number is in MPa or GPa, Pa: no beam is made of what is softer.
const SOFTEST: f64 = 1e6;
/// Density below which a number is in g/cm³ or t/mm³, kg/m³: osmium has 22.6 g/cm³.
const LIGHTEST: f64 = 25.0;
/// Parts that a note names, at most.
const NAMED: usize = 5;

/// What the author of a model should know about it, a sentence each.
pub fn notes(document: &Document) -> Vec<String> {
    loose_parts(document).into_iter().chain(odd_materials(document)).collect()
}

/// Says which parts no chain of joints and springs connects to the ground or to a frame.
fn loose_parts(document: &Document) -> Option<String> {
    let groups = Groups::of(document);
    let beams = document.beams.iter().map(|beam| format!("beam {}", beam.name));
    let bodies = document.bodies.iter().map(|body| format!("body {}", body.name));
    let parts: Vec<String> = beams.chain(bodies).collect();
    let loose: Vec<&str> =
        parts.iter().enumerate().filter(|(part, _)| !groups.is_held(*part)).map(|(_, name)| name.as_str()).collect();
    let to = "no joint or spring connects";
    match loose.as_slice() {
        [] => None,
        [one] if parts.len() > 1 && groups.is_alone(&parts, one) => {
            Some(format!("{one} is connected to nothing: it moves freely"))
        }
        all if all.len() == parts.len() => {
            Some(format!("nothing holds the mechanism: {to} it to the ground or to a frame, and it moves freely"))
        }
        some => Some(format!("{to} {} to the ground or to a frame: they move freely", listed(some))),
    }
}

/// `beam a, beam b and 3 more`.
pub fn listed(names: &[&str]) -> String {
    let (shown, rest) = names.split_at(names.len().min(NAMED));
    match (rest.len(), shown.split_last()) {
        (0, Some((last, others))) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        (0, _) => shown.join(", "),
        (count, _) => format!("{} and {count} more", shown.join(", ")),
    }
}

/// Beams, bodies and the world, in groups of what is connected.
struct Groups {
    /// For each part the next one on the way to the first of its group. The last part is the world.
    parents: Vec<usize>,
}

impl Groups {
    fn of(document: &Document) -> Self {
        let world = document.beams.len() + document.bodies.len();
        let mut groups = Self { parents: (0..=world).collect() };
        let part = |spot: Spot| match spot {
            Spot::Ground | Spot::Frame(_) => world,
            Spot::Beam { beam, .. } => beam,
            Spot::Body(body) => document.beams.len() + body,
        };
        let joints = document.joints.iter().map(|joint| (joint.a, joint.b));
        let springs = document.springs.iter().map(|spring| (spring.a, spring.b));
        for (a, b) in joints.chain(springs) {
            let (a, b) = (groups.first(part(a.spot)), groups.first(part(b.spot)));
            groups.parents[a.max(b)] = a.min(b);
        }
        groups
    }

    /// The first part of the group of `part`.
    fn first(&self, mut part: usize) -> usize {
        while self.parents[part] != part {
            part = self.parents[part];
        }
        part
    }

    fn is_held(&self, part: usize) -> bool {
        self.first(part) == self.first(self.parents.len() - 1)
    }

    /// Whether the part of this name is a group by itself.
    fn is_alone(&self, parts: &[String], name: &str) -> bool {
        let of = |part: usize| self.first(part);
        let own = parts.iter().position(|part| part == name);
        own.is_some_and(|own| (0..parts.len()).filter(|part| of(*part) == of(own)).count() == 1)
    }
}

/// Names moduli and densities that are far below those of all that beams are made of. In statics the density need not matter.
fn odd_materials(document: &Document) -> Vec<String> {
    let used = |index: &usize| document.beams.iter().any(|beam| beam.material == *index);
    let is_dynamic = document.simulation.analysis == Analysis::Dynamic;
    let mut notes = Vec::new();
    let mut note = |number: Number, least: f64, what: &str, unit: &str| {
        let value = document.value(number);
        if value < least {
            let (origin, name) = (document.origin(number), document.name(number));
            notes
                .push(format!("{origin}: {name} = {value} {unit} is unusually small for a {what}: its unit is {unit}"));
        }
    };
    for material in (0..document.materials.len()).filter(used).map(|index| &document.materials[index]) {
        note(material.young, SOFTEST, "Young's modulus", "Pa");
        if is_dynamic {
            note(material.density, LIGHTEST, "density", "kg/m3");
        }
    }
    notes
}
