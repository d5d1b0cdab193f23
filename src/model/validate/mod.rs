//! The mistakes that only the geometry shows: beams without length, axes without direction, joints beside nodes. A
//! document without them is what [`Document::parse`] gives.
//!
//! A number that is wrong itself is reported elsewhere: what hangs on it is passed over here.

mod contacts;
mod fluids;
mod foundations;
mod heat;
mod meshes;
pub mod notes;
mod paths;
mod ropes;
mod sections;
mod slides;
mod twist;
mod winches;

use super::file::Folder;
use super::file::document::Document;
use super::file::entries::actuator::Action;
use super::file::entries::beam::BeamSpec;
use super::file::entries::body::{BodySpec, Inertia};
use super::file::entries::curve::Line;
use super::file::entries::gear::{GearSpec, Relation};
use super::file::entries::joint::{JointKind, JointSpec};
use super::file::entries::load;
use super::file::entries::material::Lateral;
use super::file::entries::simulation::{Analysis, IntegratorSpec};
use super::file::entries::stop::StopSpec;
use super::file::entries::surface::Shape;
use super::file::number::Number;
use super::file::reader::anchor::{Along, Anchor, Spot};
use super::flat::{self, Files};
use super::shape::{Lines, fits, lines, shown, vector};
use super::text::diagnostic::{Diagnostic, Diagnostics, Place, Source};
use super::text::folder::Refusal;
use crate::math::vectors::angle_between;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::centerline::{Centerline, Spacing};
use crate::mechanics::beam::design::Elements;
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// Sine of the smallest angle between a beam and its `y_axis`: one degree.
const SMALLEST_SINE: f64 = 0.017_452_4;
/// How far axes may be from perpendicular (cosine) and from length 1: what is printed with six digits passes.
const AXES_TOLERANCE: f64 = 1e-6;
/// How far the largest principal moment of inertia may be above the sum of the others, relative: the round-off of a
/// flat body.
const INERTIA_TOLERANCE: f64 = 1e-9;

impl Document {
    /// Reads a file with its overrides, key and value each. `file_name` is for messages only.
    ///
    /// # Errors
    /// Everything that is wrong with the file and the overrides, in their order.
    pub fn parse(file_name: &str, text: &str, overrides: &[(String, String)]) -> Result<Self, Diagnostics> {
        Self::parse_in(None, file_name, text, overrides)
    }

    /// Reads a file as [`Self::parse`] does; paths in it are relative to `folder`, without which it includes no other
    /// file.
    ///
    /// # Errors
    /// Everything that is wrong with the file, with included files and with the overrides.
    pub fn parse_in(
        folder: Option<Folder<'_>>,
        file_name: &str,
        text: &str,
        overrides: &[(String, String)],
    ) -> Result<Self, Diagnostics> {
        let read = |name: &str, path: &Path| match folder {
            Some(folder) => folder.text(name, path),
            None => Err(Refusal { message: format!("cannot read {name}"), help: "" }),
        };
        let files = folder.map(|folder| Files { folder: folder.path(), read: &read });
        let source = flat::flat(Source::new(file_name, text, overrides), overrides, files)?;
        let (mut document, mut report) = Self::read(&source, overrides);
        document.iter_mut().for_each(meshes::choose);
        report.extend(document.as_ref().map_or(Vec::new(), mistakes));
        document.filter(|_| report.is_empty()).ok_or_else(|| report.finish())
    }

    /// The other files that a file reads, included ones and tables, those too that are missing; where something is
    /// wrong with one of them, those up to it.
    pub fn files_in(folder: Folder<'_>, file_name: &str, text: &str, overrides: &[(String, String)]) -> Vec<PathBuf> {
        let found = RefCell::new(Vec::new());
        let read = |name: &str, path: &Path| {
            found.borrow_mut().push(path.to_owned());
            folder.text(name, path)
        };
        let files = Files { folder: folder.path(), read: &read };
        // What is wrong, parse_in tells.
        drop(flat::flat(Source::new(file_name, text, overrides), overrides, Some(files)));
        found.into_inner()
    }
}

/// All mistakes of the geometry with the parameters of now, in file order.
pub fn mistakes(document: &Document) -> Vec<Diagnostic> {
    examine(document).1
}

/// The lines of all beams with the parameters of now, and all mistakes of the geometry, in file order.
pub fn examine(document: &Document) -> (Lines, Vec<Diagnostic>) {
    let mut checker = Checker { document, lines: Lines::default(), mistakes: Vec::new() };
    for beam in &document.beams {
        let line = checker.check_beam(beam);
        checker.lines.push(document, beam, line);
    }
    for body in &document.bodies {
        checker.check_axes(&format!("body {}", body.name), "body", body.axes);
        checker.check_inertia(body);
    }
    for point in &document.points {
        checker.check_axes(&format!("point {}", point.name), "point", point.axes);
        checker.fraction(&point.on);
    }
    for surface in &document.surfaces {
        if let Shape::Box { edges, .. } = surface.shape {
            checker.check_axes(&format!("surface {}", surface.name), "box", edges);
        }
    }
    for joint in &document.joints {
        checker.check_joint(joint);
    }
    for spring in &document.springs {
        if let Some(ends) = spring.ends() {
            checker.check_ends(&format!("spring {}", spring.name), ends);
        }
    }
    document.winches.iter().for_each(|winch| checker.check_winch(winch));
    document.contacts.iter().for_each(|contact| checker.check_contact(contact));
    checker.check_pressures();
    document.foundations.iter().for_each(|foundation| checker.check_foundation(foundation));
    document.ropes.iter().for_each(|rope| checker.check_rope(rope));
    checker.check_fluids();
    document.gears.iter().for_each(|gear| checker.check_ratio(gear));
    document.stops.iter().for_each(|stop| checker.check_limits(stop));
    for actuator in &document.actuators {
        if let Action::Between { a, b } = actuator.action {
            checker.check_ends(&format!("actuator {}", actuator.name), [a, b]);
        }
    }
    let loaded = document.loads.iter().filter_map(|load| match &load.target {
        load::Target::At(anchor) => Some(anchor),
        load::Target::On(_) | load::Target::Moving { .. } => None,
    });
    let watched = document.outputs.iter().filter_map(|output| output.target.anchor());
    let observers = document.outputs.iter().filter_map(|output| Some(&output.observer.as_ref()?.anchor));
    for anchor in loaded.chain(watched).chain(observers) {
        checker.fraction(anchor);
    }
    checker.check_path();
    let Checker { lines, mut mistakes, .. } = checker;
    mistakes.sort_by_key(|mistake| mistake.place);
    (lines, mistakes)
}

struct Checker<'a> {
    document: &'a Document,
    lines: Lines,
    mistakes: Vec<Diagnostic>,
}

impl Checker<'_> {
    fn mistake(&mut self, place: Place, message: &str, label: &str, help: &str) {
        self.mistakes.push(self.document.diagnostic(place, message, label, help));
    }

    /// Reports that the integrator `generalized_alpha` does not support `name`, one of the `parts`, in a motion.
    fn refuse_generalized_alpha(&mut self, place: Place, [part, parts]: [&str; 2], name: &str) {
        let simulation = &self.document.simulation;
        if simulation.analysis == Analysis::Dynamic
            && matches!(simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
        {
            let message = format!("generalized_alpha does not support {parts}, and {name} is one");
            let label = format!("a model with this {part} needs another integrator");
            self.mistake(place, &message, &label, &format!("leave integrator out: the default supports {parts}"));
        }
    }

    /// Why nothing can act along a beam but at its nodes, and the remedy.
    fn unfit_along(&self, beam: usize) -> Option<[&'static str; 2]> {
        let document = self.document;
        if matches!(document.beams.get(beam)?.formulation, Elements::Ancf24 { .. }) {
            Some(["its elements are of ancf24", "use element = \"ancf14\""])
        } else if document.winches.iter().any(|own| own.beam == beam) {
            Some(["a winch pays it out, and its material passes through the mesh", "divide it into two beams"])
        } else {
            None
        }
    }

    /// The line of a beam, if it can be drawn.
    fn check_beam(&mut self, beam: &BeamSpec) -> Option<Centerline> {
        let document = self.document;
        let elements = lines::whole(document, beam);
        // A straight beam can be looked at with any number of elements.
        let is_straight = matches!(beam.line, Some(Line::Straight { .. }));
        let line = match lines::line(document, beam, elements.or(is_straight.then_some(1))?) {
            Ok(line) => line?,
            Err(mistake) => {
                self.mistakes.push(*mistake);
                return None;
            }
        };
        if let Some(y_axis) = vector(document, beam.y_axis) {
            let sine = line.nodes[0].tangent.cross(&y_axis).norm() / y_axis.norm();
            if y_axis.norm() == 0.0 || !y_axis.norm().is_finite() {
                let message = format!("the y_axis of beam {} has no direction", beam.name);
                self.mistake(document.place(beam.y_axis[0]), &message, "a vector other than zero was expected", "");
            } else if sine < SMALLEST_SINE {
                let message = format!("the y_axis of beam {} is along the beam", beam.name);
                let place = document.place(beam.y_axis[0]);
                let help = match self.document.is_written(beam.y_axis[0]) {
                    true => format!("give {} a y_axis that is more than 1 degree off its direction", beam.name),
                    // The default is along y, and so is the beam.
                    false => String::from("the default is y_axis = [0, 1, 0]; for this beam, write y_axis = [0, 0, 1]"),
                };
                self.mistake(place, &message, "the section's y must be across the beam", &help);
            }
        }
        self.check_law(beam);
        elements?;
        self.mistakes.extend(twist::by_pretwist(document, beam, &line));
        self.mistakes.extend(sections::mistake(document, beam, &line).or_else(|| heat::mistake(document, beam, &line)));
        Some(line)
    }

    /// Hooke's law in three dimensions needs a Poisson's ratio below 0.5, also where the moduli alone are given.
    fn check_law(&mut self, beam: &BeamSpec) {
        let document = self.document;
        let Some(material) = beam.material.and_then(|material| document.materials.get(material)) else { return };
        let (Elements::Ancf24 { poisson: true, .. }, Lateral::Shear(shear)) = (beam.formulation, material.lateral)
        else {
            return;
        };
        let (young, modulus) = (document.value(material.young), document.value(shear));
        let poisson = 0.5 * young / modulus - 1.0;
        if poisson >= 0.5 {
            let message = format!("the moduli of {} imply a Poisson's ratio of {}", material.name, shown(poisson));
            let label = format!("ancf24_poisson = true of beam {} needs one below 0.5", beam.name);
            let help =
                format!("take a shear modulus above young/3 = {} Pa, or ancf24_poisson = false", shown(young / 3.0));
            self.mistake(document.place(shear), &message, &label, &help);
        }
    }

    /// Beam and fraction of its length; none for the ground, or after a mistake. What a point is on is looked at with
    /// the point.
    fn fraction(&mut self, anchor: &Anchor) -> Option<(usize, f64)> {
        let Spot::Beam { beam, along } = anchor.spot else { return None };
        let document = self.document;
        let written = document.beams.get(beam)?;
        let elements = lines::whole(document, written)?;
        if let Along::Node(node) = along
            && node > elements
        {
            if anchor.point.is_some() {
                return None;
            }
            let message = format!("beam {} has no node {node}", written.name);
            let label = format!("{elements} elements have the nodes 0 to {elements}");
            self.mistake(anchor.place, &message, &label, "");
            return None;
        }
        self.lines.fraction(document, beam, along).map(|fraction| (beam, fraction))
    }

    /// Beam and node that an anchor names; none for the ground, or after a mistake.
    fn node(&mut self, anchor: &Anchor) -> Option<(usize, usize)> {
        let (beam, fraction) = self.fraction(anchor)?;
        let document = self.document;
        let division = self.lines.division(beam)?;
        let node = division.end_at(fraction);
        // Beyond the ends the fraction itself is out of its range.
        if node.is_none() && (0.0..=1.0).contains(&fraction) {
            let written = &document.beams[beam];
            let (element, _) = division.place(fraction);
            let nearest = [element, element + 1].map(|end| division.fraction(end).unwrap_or(1.0));
            let message = match anchor.point.and_then(|point| document.points.get(point)) {
                Some(point) => format!(
                    "point {} is on beam {} at the fraction {fraction}, where the beam has no node",
                    point.name, written.name
                ),
                None => format!("there is no node of beam {} at the fraction {fraction}", written.name),
            };
            let label = format!("the nearest nodes are at {} and {}", nearest[0], nearest[1]);
            let closer = element + usize::from(nearest[1] - fraction < fraction - nearest[0]);
            let fits = |count: &usize| fits(document, written, *count, fraction);
            let counts: Vec<String> = (1..=100).filter(fits).take(5).map(|count| count.to_string()).collect();
            let help = match counts.is_empty() {
                true => {
                    let name = format!("take the node {}.node[{closer}]", written.name);
                    let uneven =
                        matches!(&written.line, Some(Line::Curved(curve)) if curve.spacing == Spacing::Parameter);
                    let even = if uneven {
                        ", or set spacing = \"arc\" and a count of elements that puts a node there"
                    } else {
                        ""
                    };
                    format!("joints attach to nodes only, and no element count up to 100 puts one there: {name}{even}")
                }
                false => format!("joints attach to nodes only; elements = {} puts one there", counts.join(", ")),
            };
            self.mistake(anchor.place, &message, &label, &help);
        }
        node.map(|node| (beam, node))
    }

    /// The ratio of a gear, which must not be 0.
    fn check_ratio(&mut self, gear: &GearSpec) {
        let Relation::Ratio(ratio) = gear.relation else { return };
        if self.document.value(ratio) == 0.0 {
            let message = format!("the ratio of gear {} is 0", gear.name);
            let help = "to hold a joint, use a drive with value = 0";
            self.mistake(self.document.place(ratio), &message, "joint a would not move at all", help);
        }
    }

    /// Both limits of a stop, of which the lower one must be below the upper one.
    fn check_limits(&mut self, stop: &StopSpec) {
        let (Some(lower), Some(upper)) = (stop.lower, stop.upper) else { return };
        let [least, largest] = [lower, upper].map(|number| self.document.value(number));
        // Not-a-number is reported where it begins.
        if least >= largest {
            let message = format!("the lower limit of stop {} is not below its upper limit", stop.name);
            let label = format!("`lower` is {least}, and `upper` is {largest}");
            let help = "the coordinate moves freely from `lower` to `upper`: exchange the two or change one";
            self.mistake(self.document.place(lower), &message, &label, help);
        }
    }

    /// Axes, a row each, of a part of the kind `kind`.
    fn check_axes(&mut self, part: &str, kind: &str, axes: Option<[[Number; 3]; 3]>) {
        let document = self.document;
        let Some(numbers) = axes else { return };
        let [Some(x), Some(y), Some(z)] = numbers.map(|row| vector(document, row)) else { return };
        let rows = [x, y, z];
        let place = document.place(numbers[0][0]).to(document.place(numbers[2][2]));
        let message = format!("the axes of {part} are not perpendicular unit vectors");
        let help = &format!("one row for each {kind} axis, right-handed, to 6 digits: \"sqrt(0.5)\" for 0.707...");
        if let Some(k) = (0..3).find(|k| (rows[*k].norm() - 1.0).abs() > AXES_TOLERANCE) {
            self.mistake(place, &message, &format!("row {} has length {}", k + 1, rows[k].norm()), help);
        } else if let Some((i, j)) =
            [(0, 1), (0, 2), (1, 2)].into_iter().find(|(i, j)| rows[*i].dot(&rows[*j]).abs() > AXES_TOLERANCE)
        {
            let angle = angle_between(&rows[i], &rows[j]).to_degrees();
            let label = format!("rows {} and {} are {angle:.4} degrees apart", i + 1, j + 1);
            self.mistake(place, &message, &label, help);
        } else if x.cross(&y).dot(&z) < 0.0 {
            let message = format!("the axes of {part} are left-handed");
            let third = x.cross(&y);
            let label = format!("row 3 must be row 1 x row 2: [{}, {}, {}]", third[0], third[1], third[2]);
            self.mistake(place, &message, &label, "");
        }
    }

    /// No body has principal moments of which one is above the sum of the other two.
    fn check_inertia(&mut self, body: &BodySpec) {
        let document = self.document;
        let span = |first, last| document.place(first).to(document.place(last));
        let (place, mut moments) = match body.inertia {
            Inertia::Principal(numbers) => (span(numbers[0], numbers[2]), document.vector(numbers)),
            Inertia::Tensor(numbers) => {
                let [xx, yy, zz, xy, yz, zx] = numbers.map(|number| document.value(number));
                let tensor = Mat3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
                if tensor.iter().any(|value| !value.is_finite()) {
                    return;
                }
                // Of a tensor near 1: the iteration for the eigenvalues must not overflow.
                let size = tensor.amax();
                let values = (tensor / if size > 0.0 { size } else { 1.0 }).symmetric_eigenvalues() * size;
                (span(numbers[0], numbers[5]), values.into())
            }
        };
        moments.sort_by(f64::total_cmp);
        let [small, middle, large] = moments;
        let is_tensor = matches!(body.inertia, Inertia::Tensor(_));
        // A principal moment that is not positive is out of the range of its key, which is reported there.
        if moments.iter().any(|moment| !moment.is_finite()) || (!is_tensor && small <= 0.0) {
            return;
        }
        let label = format!("principal moments {}, {} and {} kg.m2", shown(small), shown(middle), shown(large));
        let (message, help) = if small <= 0.0 {
            let help =
                "all must be positive: xy, yz and zx are tensor components, minus the integral of x y dm and so on";
            ("is not positive", help)
        } else if large - (small + middle) > INERTIA_TOLERANCE * large {
            (
                "is not physically possible",
                "none can be greater than the sum of the other two: check their order and unit",
            )
        } else {
            return;
        };
        let message = format!("the inertia of body {} {message}", body.name);
        self.mistake(place, &message, &label, help);
    }

    fn check_joint(&mut self, joint: &JointSpec) {
        if joint.kind == JointKind::Slide {
            self.check_slide(joint);
            return;
        }
        let document = self.document;
        let (a, b) = (self.node(&joint.a), self.node(&joint.b));
        let same_body = matches!(joint.a.spot, Spot::Body(_)) && joint.a.spot == joint.b.spot;
        if (a.is_some() && a == b) || same_body {
            let what = if same_body { "a body" } else { "a point" };
            let message = format!("joint {} joins {what} to itself", joint.name);
            self.mistake(joint.b.place, &message, "another point was expected", "");
        }
        let axis = self.axis(joint, joint.axis, "axis");
        let axis2 = self.axis(joint, joint.axis2, "axis2");
        if let (Some(axis), Some(axis2), Some(numbers)) = (axis, axis2, joint.axis2)
            && axis.normalize().dot(&axis2.normalize()).abs() > AXES_TOLERANCE
        {
            let message = format!("the axes of joint {} are not perpendicular", joint.name);
            let label = format!("axis and axis2 are {:.4} degrees apart", angle_between(&axis, &axis2).to_degrees());
            let place = document.place(numbers[0]).to(document.place(numbers[2]));
            self.mistake(place, &message, &label, "the cross of a universal joint has a right angle");
        }
    }

    /// An axis of a joint; none if the joint has none, or after a mistake.
    fn axis(&mut self, joint: &JointSpec, numbers: Option<[Number; 3]>, key: &str) -> Option<Vec3> {
        let numbers = numbers?;
        let axis = vector(self.document, numbers)?;
        if axis.norm() == 0.0 || !axis.norm().is_finite() {
            let message = format!("the {key} of joint {} has no direction", joint.name);
            self.mistake(self.document.place(numbers[0]), &message, "a vector other than zero was expected", "");
            return None;
        }
        Some(axis)
    }

    /// The ends of a spring or an actuator must be apart: its force is along the line between them.
    fn check_ends(&mut self, title: &str, ends: [Anchor; 2]) {
        let document = self.document;
        for end in &ends {
            self.fraction(end);
        }
        // Where a moving frame is at the start, which need not be t = 0, the builder sees.
        let moves = |anchor: &Anchor| match anchor.spot {
            Spot::Frame(frame) => document
                .frames
                .get(frame)
                .is_none_or(|frame| frame.position.iter().any(|number| !document.function(*number).is_constant())),
            // Where an arm on a section points, the builder sees exactly.
            Spot::Beam { .. } => anchor.point.is_some(),
            Spot::Ground | Spot::Body(_) => false,
        };
        if ends.iter().any(moves) {
            return;
        }
        let drawn = |end: &Anchor| end.is_ground() || self.lines.place(document, *end).is_some();
        let [a, b] = ends.map(|end| self.lines.place(document, end).unwrap_or_else(Vec3::zeros));
        if ends.iter().all(drawn) && a == b {
            let message = format!("the ends of {title} are at the same place");
            let label = "another place was expected: a force along a line needs a direction";
            let help = "the ground is the origin here; a [point.NAME] gives any other fixed point";
            self.mistake(ends[1].place, &message, label, help);
        }
    }
}
