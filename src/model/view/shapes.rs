//! Natural modes as a picture shows them: how stations and bodies move.

use super::modes::{Kind, Mode, Modes};
use super::recorder::{Recording, tied};
use super::rope_line;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::run::simulation::Simulation;

/// A natural mode: how it moves stations and bodies, in units of the mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    /// How it goes on.
    pub kind: Kind,
    /// Angular frequency, rad/s; 0 of what does not swing.
    pub angular_frequency: f64,
    /// Rate of the growth, 1/s; 0 of what is not unstable.
    pub growth_rate: f64,
    /// What it moves most, in words.
    pub moves: String,
    /// Displacement (m) and turn (rad) of each station.
    pub stations: Vec<([f64; 3], [f64; 3])>,
    /// The same of each body.
    pub bodies: Vec<([f64; 3], [f64; 3])>,
    /// Displacements (m) of what else is drawn, by the name of the track that has its positions.
    pub places: Vec<(&'static str, Vec<[f64; 3]>)>,
}

impl Recording {
    /// The shapes of `found` about the state that the simulation has reached, which is that of the last look.
    pub fn swings(&self, simulation: &Simulation, found: &Modes) -> Vec<Swing> {
        let mut snapshot = FrameCache::default();
        let system = simulation.system();
        let c = snapshot.of(system, simulation.state());
        let at_rest = vec![0.0; system.coordinates()];
        let displacement = |marker: Marker, shape: &[f64]| -> [f64; 3] {
            let sensor = Sensor::new(&system.beams, &c, marker, None);
            // What drives and frames do by themselves is no part of a mode.
            (sensor.motion(&c, shape).0 - sensor.motion(&c, &at_rest).0).into()
        };
        let watched = &self.watched;
        let joints = |side: usize| watched.joints.iter().map(move |(_, sides)| sides[side]);
        let springs = |side: usize| watched.springs.iter().map(move |sides| sides[side]);
        let kinds: [(&str, Vec<Marker>); 8] = [
            ("joint.place", joints(1).collect()),
            ("joint.a", joints(0).map(|side| tied(&side)).collect()),
            ("joint.b", joints(1).map(|side| tied(&side)).collect()),
            ("spring.a", springs(0).collect()),
            ("spring.b", springs(1).collect()),
            ("load.place", watched.arrows.iter().map(|(_, marker)| *marker).collect()),
            ("point.place", watched.points.iter().map(|sensor| system.sensors[*sensor].marker).collect()),
            // A rope follows the centers of its wheels.
            ("rope.place", system.ropes.iter().flat_map(rope_line::seats).copied().collect()),
        ];
        let swing = |mode: &Mode| Swing {
            kind: mode.kind,
            angular_frequency: mode.angular_frequency(),
            growth_rate: mode.growth_rate(),
            moves: mode.moves.clone(),
            stations: self.watched.beams.iter().flat_map(|beam| beam.motions(&c, &mode.shape)).collect(),
            places: kinds
                .iter()
                .filter(|(_, markers)| !markers.is_empty())
                .map(|(name, markers)| {
                    (*name, markers.iter().map(|marker| displacement(*marker, &mode.shape)).collect())
                })
                .collect(),
            bodies: mode.motions[found.nodes..].iter().map(|motion| (motion.displacement, motion.turn)).collect(),
        };
        found.modes.iter().map(swing).collect()
    }
}
