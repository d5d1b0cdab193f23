//! Legal models that are hardly ever meant: parts that nothing holds, materials in other units than SI, angles in degrees, steps almost as long as
//! the motion.

use crate::model::file::document::Document;
use crate::model::file::entries::drive::{DriveSpec, Motion};
use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::Spot;

/// Young's modulus below which a number is in MPa or GPa, Pa: no beam is made of what is softer.
const SOFTEST: f64 = 1e6;
/// Density below which a number is in g/cm³ or t/mm³, kg/m³: osmium has 22.6 g/cm³.
const LIGHTEST: f64 = 25.0;
/// Steps of a motion below which its results are not a curve.
const FEWEST_STEPS: f64 = 10.0;
/// Angles of a half or a full turn and their usual parts, in degrees. As radians, each is several turns and no special position.
const DEGREES: [f64; 9] = [30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 180.0, 270.0, 360.0];
/// Relative distance from such an angle, and from standing still: round-off of an expression.
const ROUND_OFF: f64 = 1e-9;
/// Parts that a note names, at most.
const NAMED: usize = 5;

/// What the author of a model should know about it, a sentence each.
pub fn notes(document: &Document) -> Vec<String> {
    let parts = loose_parts(document).into_iter().chain(odd_materials(document));
    parts.chain(odd_angles(document)).chain(long_step(document)).collect()
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
        let springs = document.springs.iter().filter_map(|spring| spring.ends().map(|[a, b]| (a, b)));
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

/// Names drives that come to rest, or in statics end, at an angle that is an angle in degrees. A shaft that turns on may stop anywhere.
fn odd_angles(document: &Document) -> Vec<String> {
    let stop = document.value(document.simulation.stop);
    let is_static = document.simulation.analysis == Analysis::Static;
    let degrees = |drive: &DriveSpec| {
        let Motion::Value(number) = drive.motion else { return None };
        let function = document.function(number);
        let (angle, rate) = (function.value(stop), function.jet(stop).first);
        let is_still = is_static || rate.abs() * stop <= ROUND_OFF * angle.abs();
        let round = DEGREES.into_iter().find(|round| (angle.abs() - round).abs() <= ROUND_OFF * round);
        let is_meant = drive.is_angle() && !drive.input && is_still;
        let round = round.filter(|_| is_meant)?;
        let (origin, name) = (document.origin(number), document.name(number));
        Some(format!(
            "{origin}: {name} reaches {angle} rad, {:.1} turns: angles are in radians, {round} degrees are \"{round}*pi/180\"",
            angle.abs() / std::f64::consts::TAU
        ))
    };
    document.drives.iter().filter_map(degrees).collect()
}

/// Says that a motion has few steps only.
fn long_step(document: &Document) -> Option<String> {
    let Steps::Fixed(step) = document.simulation.steps else { return None };
    let (length, stop) = (document.value(step), document.value(document.simulation.stop));
    let is_long = document.simulation.analysis == Analysis::Dynamic && length * FEWEST_STEPS > stop * (1.0 + ROUND_OFF);
    is_long.then(|| {
        let origin = document.origin(step);
        format!(
            "{origin}: simulation.step = {length} s is longer than a tenth of stop = {stop} s: leave `step` out, and the solver chooses \
             its steps"
        )
    })
}
