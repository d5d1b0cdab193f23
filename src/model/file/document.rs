//! A model file as typed data: everything is there, checked as far as it can be without building the mechanism.

use super::collisions;
use super::entries::SINGLE;
use super::entries::actuator::Action;
use super::entries::air::AirSpec;
use super::entries::drive::DriveSpec;
use super::entries::function;
use super::entries::load::Target;
use super::entries::overview::ModelSpec;
use super::entries::parameters;
use super::entries::rope::RopeSpec;
use super::entries::seabed;
use super::entries::simulation::{Analysis, SimulationSpec, Steps};
use super::entries::spring::SpringSpec;
use super::entries::surface::Shape;
use super::entries::water::WaterSpec;
use super::entries::winch::WinchSpec;
use super::entries::{Parts, keys_of};
use super::many_results;
use super::number::{Number, Numbers, Written};
use super::objections;
use super::overrides;
use super::parameter::{Parameter, typed};
use super::range::Range;
use super::reader::anchor::Anchor;
use super::reader::{Context, Reader};
use super::released;
use crate::model::expression::function::Function;
use crate::model::text::diagnostic::{Diagnostic, Place, Report, Source};
use crate::model::text::names::{Kind, Named, Names, SECTIONS, free_name, is_legal, is_reserved, suggestion};
use crate::model::text::tree::{self, Entry, Node};
use crate::solve::step::pacing::Pacing;
use std::collections::BTreeSet;
use std::ops::Deref;

/// A model file.
#[derive(Clone, Debug)]
pub struct Document {
    source: Source,
    pub(in crate::model) numbers: Numbers,
    pub(super) parameters: Vec<Parameter>,
    /// Name, description, gravity.
    pub model: ModelSpec,
    /// The water around beams; none: they are dry.
    pub water: Option<WaterSpec>,
    /// The air above it; none: nothing is in air.
    pub air: Option<AirSpec>,
    /// All that has a name.
    pub parts: Parts,
    /// What is computed.
    pub simulation: SimulationSpec,
}

/// The only version of the format.
const FORMAT: i64 = 1;

impl Deref for Document {
    type Target = Parts;

    fn deref(&self) -> &Parts {
        &self.parts
    }
}

impl Document {
    /// Reads a file with its overrides, key and value each, except for what only its geometry shows; the report has
    /// everything that is wrong with the file and the overrides, in their order. Without a document the report is not
    /// empty.
    pub(in crate::model) fn read<'a>(source: &'a Source, overrides: &[(String, String)]) -> (Option<Self>, Report<'a>) {
        let mut report = Report::new(source);
        let Some(mut tree) = tree::parse(source.text(0), 0, &mut report) else { return (None, report) };
        overrides::apply(&mut tree, overrides, &mut report);
        let mut context = Context {
            report,
            numbers: Numbers::default(),
            names: Names::default(),
            carriers: Vec::new(),
            moving_frames: Vec::new(),
            free_meshes: Vec::new(),
            functions: Vec::new(),
        };
        context.names = collect_names(&tree, &mut context);
        let mut tree = Top(tree);
        tree.format(&mut context);
        let empty = Vec::new();
        let entries = tree.table("parameters");
        let values = parameters::names(&mut context, entries.as_ref().unwrap_or(&empty));
        function::read(&mut context, tree.table("function").unwrap_or_default());
        parameters::read(&mut context, values);
        context.numbers.sort(&mut context.report);

        let model = tree.single(&mut context, "model").map(ModelSpec::read);
        let water = tree.optional(&mut context, "water").map(WaterSpec::read);
        let air = tree.optional(&mut context, "air").map(AirSpec::read);
        let mut parts = Parts::read(&mut context, |word| tree.table(word).unwrap_or_default());
        if let Some(reader) = tree.optional(&mut context, "seabed") {
            seabed::read(reader, water.as_ref(), &mut parts);
        }
        DriveSpec::report_doubles(&parts.drives, &mut context.report);
        WinchSpec::report_doubles(&parts.winches, &mut context.report);
        if parts.joints.len() == context.names.of(Kind::Joint).count() {
            released::report(&parts, &context.numbers, &mut context.report);
        }
        many_results::report(&parts.outputs, &mut context.report);
        let simulation = tree.single(&mut context, "simulation").map(SimulationSpec::read);
        tree.finish(&mut context);

        let Context { mut report, mut numbers, names, .. } = context;
        numbers.resolve();
        numbers.spread_tunable();
        let stop = simulation.as_ref().map_or(0.0, |simulation| numbers.values[simulation.stop.0]);
        let undefined = objections::report_undefined(&numbers, stop, &mut report);
        objections::report_objections(&numbers, &parts, stop, &undefined, &mut report);
        let parameters = Parameter::table(&numbers);
        collisions::report(&parameters, &numbers, &parts.outputs, &names, &mut report);
        let (Some(model), Some(simulation)) = (model, simulation) else { return (None, report) };
        let document = Self { source: source.clone(), numbers, parameters, model, water, air, parts, simulation };
        (Some(document), report)
    }

    /// The text of the model: that of the file, without copies and includes.
    pub fn text(&self) -> &str {
        self.source.text(0)
    }

    /// The overrides that [`Self::text`] does not have in it, of those that the file was read with.
    pub fn remaining(&self, overrides: &[(String, String)]) -> Vec<(String, String)> {
        let open = overrides.iter().enumerate().filter(|(number, _)| !self.source.has_applied(*number));
        open.map(|(_, pair)| pair.clone()).collect()
    }

    /// The value of a number, parameters resolved; of one that changes in time the value at 0.
    pub fn value(&self, number: Number) -> f64 {
        self.numbers.values[number.0]
    }

    /// What a host's relative tolerance stands for: the accuracy of a motion whose steps follow from it, else what
    /// Newton may leave of a step.
    pub fn asked_accuracy(&self) -> f64 {
        let SimulationSpec { analysis, steps, tolerance, .. } = self.simulation;
        match (analysis, steps) {
            (Analysis::Dynamic, Steps::ForAccuracy(accuracy)) => self.value(accuracy),
            _ => self.value(tolerance),
        }
    }

    /// How the solver chooses the steps of a motion from `start`, s; none where they are given.
    pub fn pacing(&self, start: f64) -> Option<Pacing> {
        let SimulationSpec {
            analysis: Analysis::Dynamic, steps: Steps::ForAccuracy(accuracy), longest_step, stop, ..
        } = self.simulation
        else {
            return None;
        };
        let stop = self.value(stop);
        let duration = if stop > start { stop - start } else { stop };
        let longest = longest_step.map_or(f64::INFINITY, |number| self.value(number));
        Some(Pacing { accuracy: self.value(accuracy), duration, longest, is_given: false })
    }

    /// Gives a beam whose file leaves that to the program so many elements.
    pub(in crate::model) fn choose_elements(&mut self, beam: usize, count: usize) {
        let number = self.parts.beams[beam].elements;
        let slot = &mut self.numbers.slots[number.0];
        slot.written = Written::Plain(count as f64);
        self.numbers.values[number.0] = count as f64;
        let start = typed(slot, count as f64);
        let own = self.parameters.iter_mut().filter(|parameter| parameter.number == number);
        own.for_each(|parameter| parameter.variable.start = start);
    }

    /// Rise of the bottom of the water per length along x and along y.
    pub fn slope_of_bottom(&self) -> [f64; 2] {
        let slope = self.surfaces.iter().find_map(|own| match own.shape {
            Shape::Bottom { slope, .. } => Some(slope.map(|number| self.value(number))),
            _ => None,
        });
        slope.unwrap_or([0.0; 2])
    }

    /// The values of three numbers.
    pub fn vector(&self, numbers: [Number; 3]) -> [f64; 3] {
        numbers.map(|number| self.value(number))
    }

    /// A number as a function of time with the parameters of now: it owns what it needs.
    pub fn function(&self, number: Number) -> Function {
        self.numbers.function(number)
    }

    /// Whether everything that a number is made of is finite; if not, that is reported.
    pub fn is_sound(&self, number: Number) -> bool {
        self.numbers.is_sound(number.0)
    }

    /// Why the value of a number is not allowed; none: it is.
    pub fn objection(&self, number: Number) -> Option<String> {
        self.numbers.slots[number.0].meta.objection(self.value(number))
    }

    /// Why `value` is not allowed for a number; none: it is.
    pub fn objection_to(&self, number: Number, value: f64) -> Option<String> {
        self.numbers.slots[number.0].meta.objection(value)
    }

    /// The allowed values of a number.
    pub fn range(&self, number: Number) -> Range {
        self.numbers.slots[number.0].meta.range
    }

    /// The name of a number: `tip.force[1]`.
    pub fn name(&self, number: Number) -> &str {
        &self.numbers.slots[number.0].meta.name
    }

    /// Where a number is written; for a default the name of its section.
    pub fn place(&self, number: Number) -> Place {
        self.numbers.slots[number.0].place
    }

    /// Whether a number is written in the file or in an override; else it is a default.
    pub fn is_written(&self, number: Number) -> bool {
        self.numbers.slots[number.0].listed.is_some() || self.place(number).source > 0
    }

    /// Where something is written, for messages: `m.toml, line 7`, or the override.
    pub fn origin(&self, place: Place) -> String {
        self.source.line_of(place)
    }

    /// What is probably a mistake in copies and includes, which the text no longer has.
    pub fn remarks(&self) -> &[String] {
        self.source.remarks()
    }

    /// Where the text of something comes from: copies of one text have one origin.
    pub fn origin_place(&self, place: Place) -> Place {
        self.source.told(place).place
    }

    /// Where springs, actuators and loads act at points.
    pub fn anchors_of_forces(&self) -> impl Iterator<Item = Anchor> {
        let springs = self.springs.iter().filter_map(SpringSpec::ends).flatten();
        let actuators = self.actuators.iter().filter_map(|actuator| match actuator.action {
            Action::Between { a, b } => Some([a, b]),
            Action::Joint { .. } => None,
        });
        let loads = self.loads.iter().filter_map(|load| match load.target {
            Target::At(anchor) => Some(anchor),
            Target::On(_) | Target::Moving { .. } => None,
        });
        let ropes = self.ropes.iter().flat_map(RopeSpec::points);
        springs.chain(actuators.flatten()).chain(loads).chain(ropes)
    }

    /// A mistake that shows itself only when the mechanism is built; `label` stands behind the underlining, `help`
    /// below it.
    pub fn diagnostic(&self, place: Place, message: &str, label: &str, help: &str) -> Diagnostic {
        Diagnostic::new(&self.source, place, message, label, help)
    }
}

/// The top level of the file; sections are taken out of it one by one.
struct Top(Vec<Entry>);

impl Top {
    fn take(&mut self, key: &str) -> Option<Entry> {
        self.0.iter().position(|entry| entry.key == key).map(|at| self.0.remove(at))
    }

    fn format(&mut self, context: &mut Context<'_>) {
        match self.take("format") {
            Some(Entry { item, .. }) => {
                if !matches!(item.node, Node::Integer(FORMAT)) {
                    let message = "this version reads format 1 only";
                    context.report.error(item.place, message, "format = 1 was expected", "");
                }
            }
            None => {
                let help = "the first line of every model file is: format = 1";
                context.report.error(Place::file(0..0), "the file does not say its format", "missing here", help);
            }
        }
    }

    /// The entries of a section that may be missing; a wrong type is reported with the names.
    fn table(&mut self, key: &str) -> Option<Vec<Entry>> {
        match self.take(key)?.item.node {
            Node::Table(entries) => Some(entries),
            _ => None,
        }
    }

    /// A section that may be missing.
    fn optional<'c, 'a>(&mut self, context: &'c mut Context<'a>, key: &str) -> Option<Reader<'c, 'a>> {
        self.0.iter().any(|entry| entry.key == key).then(|| self.single(context, key)).flatten()
    }

    /// A section that must be there.
    fn single<'c, 'a>(&mut self, context: &'c mut Context<'a>, key: &str) -> Option<Reader<'c, 'a>> {
        match self.take(key) {
            Some(Entry { key_place, item, .. }) => match item.node {
                Node::Table(entries) => {
                    let prefix = if key == "model" { String::new() } else { format!("{key}.") };
                    Some(Reader::new(context, keys_of(key), format!("[{key}]"), prefix, key_place, entries))
                }
                _ => {
                    context.wrong_type(key, &item, &format!("a section [{key}]"));
                    None
                }
            },
            None => {
                let message = format!("the section [{key}] is missing");
                let end = context.report.source.end();
                context.report.error(end, &message, "missing at the end of the file", "");
                None
            }
        }
    }

    /// What is left over, and whether there is anything to move.
    fn finish(self, context: &mut Context<'_>) {
        let known = || SECTIONS.iter().map(|(word, _)| *word).chain(["format", "parameters"]).chain(SINGLE);
        for entry in &self.0 {
            let message = format!("unknown section or key `{}`", entry.key);
            let help = format!("known here: {}", known().collect::<Vec<_>>().join(", "));
            context.report.error(entry.key_place, &message, &suggestion(&entry.key, known()), &help);
        }
        let none = |kind: Kind| context.names.of(kind).next().is_none();
        let is_explained = context.names.has_nameless || !context.names.unclear.is_empty();
        // A spring or an actuator at a frame has a force without anything that it could move.
        let is_force = !none(Kind::Frame) && [Kind::Spring, Kind::Actuator].into_iter().any(|kind| !none(kind));
        if none(Kind::Beam) && none(Kind::Body) && !is_force && !is_explained {
            let end = context.report.source.end();
            let label = "a section [beam.NAME] or [body.NAME] is missing";
            let help = "a spring or an actuator alone acts on a [frame.NAME] that moves";
            context.report.error(end, "the file has no beam and no body", label, help);
        }
    }
}

/// Which things cannot have the same name.
const SHARED: &str = "beams, bodies, frames and points share their names, and so do joints, drives, actuators, gears, springs, friction, stops and locks";

/// Every name with what it stands for; illegal, reserved and double ones are reported.
fn collect_names(tree: &[Entry], context: &mut Context<'_>) -> Names {
    let mut names = Names::default();
    let report = &mut context.report;
    let mut found: Vec<(Kind, usize, &Entry)> = Vec::new();
    let mut nameless: Vec<Kind> = Vec::new();
    for entry in tree {
        let kind = match SECTIONS.iter().find(|(word, _)| *word == entry.key) {
            Some((_, kind)) => *kind,
            None if entry.key == "parameters" => Kind::Parameter,
            None => {
                names.unclear.extend(names_in(entry));
                continue;
            }
        };
        let title = if kind == Kind::Parameter { "[parameters]".to_owned() } else { format!("[{}.NAME]", entry.key) };
        let Node::Table(things) = &entry.item.node else {
            let message = format!("`{}` is {}", entry.key, entry.item.node.describe());
            report.error(entry.item.place, &message, &format!("a section {title} was expected"), "");
            continue;
        };
        let mut index = 0;
        for thing in things {
            if kind != Kind::Parameter && !matches!(thing.item.node, Node::Table(_)) {
                // The keys of a section without a name are one mistake.
                if !nameless.contains(&kind) {
                    let message = format!("`{}` in [{}] is {}", thing.key, entry.key, thing.item.node.describe());
                    let help = format!("each {} has its own section with its own name", entry.key);
                    report.error(thing.key_place, &message, &format!("a section {title} was expected"), &help);
                    nameless.push(kind);
                }
                continue;
            }
            found.push((kind, index, thing));
            index += 1;
        }
    }
    found.sort_by_key(|(_, _, thing)| thing.key_place);
    let taken: BTreeSet<&str> = found.iter().map(|(_, _, thing)| thing.key.as_str()).collect();
    for (kind, index, thing) in found {
        let name = &thing.key;
        if !is_legal(name) {
            let help = "a name is a letter, then letters, digits and _";
            report.error(thing.key_place, &format!("`{name}` is not a valid name"), "", help);
        } else if is_reserved(kind, name) {
            report.error(thing.key_place, &format!("the name `{name}` is reserved"), "another name was expected", "");
        } else if let Some(first) = names.clash(kind, name) {
            let message = format!("the name `{name}` is used twice");
            let label = format!("line {} has a {} of this name", report.source.line(first.place), first.kind.word());
            let help = match kind {
                Kind::Parameter => String::new(),
                _ => {
                    let free = free_name(name, kind, |name| taken.contains(name));
                    format!("{SHARED}: call this one `{free}`, for instance")
                }
            };
            report.error(thing.key_place, &message, &label, &help);
            names.unclear.push(name.clone());
        }
        names.add(Named { name: name.clone(), kind, index, place: thing.key_place });
    }
    names.has_nameless = !nameless.is_empty();
    name_seabed(tree, context, &mut names);
    names
}

/// Names the contact that `[seabed]` stands for, which outputs look at.
fn name_seabed(tree: &[Entry], context: &mut Context<'_>, names: &mut Names) {
    let Some(entry) = tree.iter().find(|entry| entry.key == seabed::NAME) else { return };
    let place = entry.key_place;
    for kind in [Kind::Contact, Kind::Surface] {
        if let Some(first) = names.clash(kind, seabed::NAME) {
            let message = format!("the {} `seabed` has the name of [seabed]", first.kind.word());
            context.report.error(first.place, &message, "another name was expected", "[seabed] is a contact itself");
        }
    }
    let index = names.of(Kind::Contact).count();
    names.add(Named { name: seabed::NAME.to_owned(), kind: Kind::Contact, index, place });
}

/// The names of the things in a section that is not known: `arm` of `[baem.arm]`.
fn names_in(entry: &Entry) -> impl Iterator<Item = String> + '_ {
    let things = if let Node::Table(things) = &entry.item.node { things.as_slice() } else { &[] };
    things.iter().filter(|thing| matches!(thing.item.node, Node::Table(_))).map(|thing| thing.key.clone())
}
