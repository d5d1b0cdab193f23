//! The sections of a file, one module each: the keys, the typed data, and how it is read. [`Parts`] is the list of
//! those with names.

pub mod acting;
pub mod actuator;
pub mod air;
pub mod beam;
pub mod body;
pub mod contact;
pub mod curve;
pub mod damping;
pub mod drive;
pub mod foundation;
pub mod frame;
pub mod friction;
pub mod function;
pub mod gear;
pub mod immersion;
pub mod joint;
pub mod load;
pub mod lock;
pub mod material;
mod namesakes;
pub mod output;
pub mod overview;
pub mod parameters;
pub mod point;
pub mod reading;
pub mod rope;
pub mod seabed;
pub mod section;
pub mod simulation;
pub mod spring;
pub mod stop;
mod summary;
pub mod surface;
pub mod switch;
pub mod water;
pub mod wave;
pub mod winch;

use super::number::{Number, Numbers};
pub use super::reader::anchor;
use super::reader::{Context, Reader};
use super::schema::Key;
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;
use crate::model::text::tree::{Entry, Node};

/// Makes [`Parts`] and [`SECTIONS`] of a row for each section of things with names: its list, its kind, its module,
/// named by its word, and its type.
macro_rules! parts {
    ($($list:ident: $kind:ident, $module:ident::$spec:ident, $what:literal;)*) => {
        /// All things that have names and sections of their own.
        #[derive(Clone, Debug, Default)]
        pub struct Parts {
            $(#[doc = $what] pub $list: Vec<$module::$spec>,)*
        }

        impl Parts {
            /// Reads the sections, of which `take` gives the things by the word of the section. Each may refer to
            /// what is above it.
            pub(super) fn read(context: &mut Context<'_>, mut take: impl FnMut(&str) -> Vec<Entry>) -> Self {
                let mut parts = Self::default();
                $(for Entry { key: name, key_place, item } in take(stringify!($module)) {
                    let Node::Table(entries) = item.node else { continue };
                    let title = format!("[{}.{name}]", stringify!($module));
                    let reader =
                        Reader::new(context, $module::KEYS, title, format!("{name}."), key_place, entries);
                    let part = $module::$spec::read(&name, reader, &parts);
                    parts.$list.extend(part);
                })*
                parts
            }

            /// Kind, name and place of all parts, kind after kind, each in file order.
            pub fn each(&self) -> impl Iterator<Item = (Kind, &str, Place)> {
                let mut all = Vec::new();
                $(all.extend(self.$list.iter().map(|part| (Kind::$kind, part.name.as_str(), part.place)));)*
                all.into_iter()
            }
        }

        /// The sections that a model has one of, without names.
        pub const SINGLE: [&str; 5] = ["air", "model", "seabed", "simulation", "water"];

        /// The sections of the format with their keys.
        pub const SECTIONS: &[(&str, &[Key])] = &[
            ("model", overview::KEYS),
            ("function", function::KEYS),
            ("water", water::KEYS),
            ("air", air::KEYS),
            ("seabed", seabed::KEYS),
            $((stringify!($module), $module::KEYS),)*
            ("simulation", simulation::KEYS),
        ];
    };
}

parts! {
    materials: Material, material::MaterialSpec, "Materials, in file order.";
    sections: Section, section::SectionSpec, "Sections, in file order.";
    beams: Beam, beam::BeamSpec, "Beams, in file order.";
    bodies: Body, body::BodySpec, "Bodies, in file order.";
    frames: Frame, frame::FrameSpec, "Frames, in file order.";
    points: Point, point::PointSpec, "Points, in file order.";
    joints: Joint, joint::JointSpec, "Joints, in file order.";
    drives: Drive, drive::DriveSpec, "Drives, in file order.";
    winches: Winch, winch::WinchSpec, "Winches, in file order.";
    actuators: Actuator, actuator::ActuatorSpec, "Actuators, in file order.";
    gears: Gear, gear::GearSpec, "Gears, in file order.";
    springs: Spring, spring::SpringSpec, "Springs, in file order.";
    frictions: Friction, friction::FrictionSpec, "Friction, in file order.";
    stops: Stop, stop::StopSpec, "Stops, in file order.";
    locks: Lock, lock::LockSpec, "Locks, in file order.";
    surfaces: Surface, surface::SurfaceSpec, "Surfaces, in file order.";
    contacts: Contact, contact::ContactSpec, "Contacts, in file order.";
    foundations: Foundation, foundation::FoundationSpec, "Foundations, in file order.";
    ropes: Rope, rope::RopeSpec, "Ropes, in file order.";
    loads: Load, load::LoadSpec, "Loads, in file order.";
    waves: Wave, wave::WaveSpec, "Waves, in file order.";
    outputs: Output, output::OutputSpec, "Outputs, in file order.";
}

impl Parts {
    /// Numbers that do not go together though each is allowed, in a run to `stop` s, with the reason.
    pub(super) fn objections(&self, numbers: &Numbers, stop: f64) -> impl Iterator<Item = (Number, String)> {
        let sections = self.sections.iter().filter_map(|own| own.objection(|number| numbers.value(number)));
        let surfaces = self.surfaces.iter().filter_map(|own| own.objection(|number| numbers.value(number)));
        let foundations = self.foundations.iter().filter_map(|own| own.objection(numbers));
        let loads = self.loads.iter().filter_map(|own| own.objection(numbers));
        let begins = self.outputs.iter().filter_map(|own| own.range);
        let summaries = begins.filter_map(move |from| summary::objection(from, numbers, stop));
        sections.chain(surfaces).chain(foundations).chain(loads).chain(summaries)
    }
}

/// The keys of a section.
pub fn keys_of(section: &str) -> &'static [Key] {
    SECTIONS.iter().find(|(word, _)| *word == section).map_or(&[], |(_, keys)| keys)
}
