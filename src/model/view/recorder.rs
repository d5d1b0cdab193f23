//! Numbers of a simulation at instants: where everything is, what sections bear, what acts.

use super::rope_line;
use super::scene::{Scene, Watched};
use super::stations::{RESULTS, Stations, quaternion, steps};
use crate::math::Vec3;
use crate::mechanics::force::load::Site;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::output::joint_loads::JointLoads;
use crate::mechanics::output::section_loads::SectionLoads;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::run::scale::Measures;
use crate::model::run::simulation::Simulation;
use crate::solve::step::response::{Responder, Response};

/// Numbers of one kind at all instants: instant by instant, in each thing by thing, of each its components.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// What it is: `station.place`, `stress`.
    pub name: &'static str,
    /// Numbers of each thing.
    pub components: usize,
    /// Number of things.
    pub things: usize,
    /// All numbers.
    pub values: Vec<f64>,
}

/// A simulation as it is seen.
#[derive(Debug)]
pub struct Recording {
    /// What never changes.
    pub scene: Scene,
    /// The instants that were looked at, s.
    pub times: Vec<f64>,
    /// What was seen, of each kind at all instants.
    pub tracks: Vec<Track>,
    pub(super) watched: Watched,
    /// How much each unit amounts to in the run so far.
    pub(super) measures: Measures,
    frames: FrameCache,
    responder: Option<Responder>,
    response: Response,
}

/// Kinds of numbers that every recording has, with their components, before those of [`RESULTS`].
const KINDS: [(&str, usize); 19] = [
    ("station.place", 3),
    ("station.turn", 4),
    ("body.place", 3),
    ("body.turn", 4),
    ("frame.place", 3),
    ("frame.turn", 4),
    ("joint.place", 3),
    ("joint.turn", 4),
    ("joint.a", 3),
    ("joint.b", 3),
    ("spring.a", 3),
    ("spring.b", 3),
    ("load.place", 3),
    ("load.force", 3),
    ("load.moment", 3),
    ("point.place", 3),
    ("surface.place", 3),
    ("surface.turn", 4),
    ("rope.place", 3),
];
/// What joints transmit; only where the simulation computes it.
const REACTIONS: [(&str, usize); 2] = [("joint.force", 3), ("joint.moment", 3)];

impl Recording {
    /// Of a simulation that has just been loaded: it is as drawn.
    pub fn new(simulation: &Simulation) -> Self {
        let (document, system) = (simulation.document(), simulation.system());
        let mut frames = FrameCache::default();
        let c = frames.of(system, simulation.state());
        let steps = steps(system);
        let beams = (0..system.beams.len()).map(|beam| Stations::new(system, &c, beam, steps)).collect();
        let watched = Watched::new(document, system, &c, beams);
        let scene = Scene::new(document, system, &watched);
        let reactions = if simulation.multipliers().is_some() { &REACTIONS[..] } else { &[] };
        let results = RESULTS.iter().map(|result| (result.word, 1));
        let kinds = KINDS.iter().copied().chain(results).chain(reactions.iter().copied());
        let tracks = kinds.map(|(name, components)| {
            let things = match name.split_once('.') {
                Some(("body", _)) => scene.bodies.len(),
                Some(("frame", _)) => scene.frames.len(),
                Some(("joint", _)) => scene.joints.len(),
                Some(("spring", _)) => scene.springs.len(),
                Some(("load", _)) => watched.arrows.len(),
                Some(("point", _)) => scene.points.len(),
                Some(("surface", _)) => scene.surfaces.len(),
                Some(("rope", _)) => scene.ropes.last().map_or(0, |rope| rope.points.end),
                _ => scene.beams.last().map_or(0, |beam| beam.stations.end),
            };
            Track { name, components, things, values: Vec::new() }
        });
        Self {
            tracks: tracks.collect(),
            scene,
            times: Vec::new(),
            watched,
            measures: simulation.measures(),
            frames,
            responder: None,
            response: Response::default(),
        }
    }

    /// Number of stations of all beams.
    pub fn stations(&self) -> usize {
        self.tracks[0].things
    }

    /// Looks at the state that the simulation has reached.
    pub fn record(&mut self, simulation: &Simulation) {
        let (system, state) = (simulation.system(), simulation.state());
        let mut seen: Vec<Vec<f64>> = vec![Vec::new(); self.tracks.len()];
        let is_known = simulation.respond(&mut self.responder, &mut self.response);
        let Response { acceleration, multipliers } = &self.response;
        let multipliers = simulation.multipliers().unwrap_or(multipliers);
        let c = self.frames.of(system, state);
        look(&self.watched, system, state, &c, &mut seen);
        let passage = simulation.passage();
        let loads = JointLoads::new((system, state), (&c, &passage), multipliers);
        let told = &mut seen[KINDS.len()..][..RESULTS.len()];
        if is_known {
            let loads = SectionLoads { joints: &loads, acceleration };
            for results in self.watched.beams.iter().flat_map(|stations| stations.results(&loads)) {
                told.iter_mut().zip(results).for_each(|(values, value)| values.push(value));
            }
        } else {
            told.iter_mut()
                .zip(&self.tracks[KINDS.len()..])
                .for_each(|(values, track)| values.resize(track.things, 0.0));
        }
        if simulation.multipliers().is_some() {
            let place = KINDS.len() + RESULTS.len();
            for (number, _) in &self.watched.joints {
                let (force, moment) = loads.reaction(&system.joint_parts[*number]);
                seen[place].extend(force.iter());
                seen[place + 1].extend(moment.iter());
            }
        }
        for (track, mut values) in self.tracks.iter_mut().zip(seen) {
            if track.name.ends_with(".turn") {
                continue_turns(&track.values, &mut values);
            }
            track.values.append(&mut values);
        }
        self.times.push(state.time);
        self.measures = simulation.measures();
    }

    /// Drops all instants except the last, so that a long export needs constant memory.
    pub fn keep_last(&mut self) {
        for track in &mut self.tracks {
            let rest = track.values.len().saturating_sub(track.components * track.things);
            track.values.drain(..rest);
        }
        self.times.drain(..self.times.len().saturating_sub(1));
    }
}

/// Pushes what is seen of an instant, in the order of the tracks.
fn look(watched: &Watched, system: &System, state: &State, c: &Configuration, seen: &mut [Vec<f64>]) {
    let place = |marker: &Marker| marker.pose(c).place;
    let [station_places, station_turns, body_places, body_turns, rest @ ..] = seen else { return };
    for stations in &watched.beams {
        stations.push_poses(c, station_places, station_turns);
    }
    for body in &system.bodies {
        // In principal axes: those of the solid that stands for it.
        let directors = Marker::Body { start: body.start, offset: Vec3::zeros(), axes: nalgebra::Matrix3::identity() };
        let pose = directors.pose(c);
        body_places.extend(pose.place.iter());
        body_turns.extend(quaternion(&pose.axes));
    }
    let [frame_places, frame_turns, joint_places, joint_turns, sides_a, sides_b, rest @ ..] = rest else { return };
    for frame in &c.prescribed.frames {
        frame_places.extend(frame.pose.place.iter());
        frame_turns.extend(quaternion(&frame.pose.axes));
    }
    for (_, sides) in &watched.joints {
        let pose = sides[1].pose(c);
        joint_places.extend(pose.place.iter());
        joint_turns.extend(quaternion(&sides[0].pose(c).axes));
        for (side, places) in sides.iter().zip([&mut *sides_a, &mut *sides_b]) {
            places.extend(place(&tied(side)).iter());
        }
    }
    let [spring_a, spring_b, arrow_places, forces, moments, points, surface_places, surface_turns, ropes, ..] = rest
    else {
        return;
    };
    for [a, b] in &watched.springs {
        spring_a.extend(place(a).iter());
        spring_b.extend(place(b).iter());
    }
    for (number, marker) in &watched.arrows {
        let load = &system.loads[*number];
        let wrench = load.at(state.instant(), &state.targets.loads[*number]);
        let moving = matches!(load.site, Site::Moving(_)).then(|| load.marker(state.instant())).flatten();
        let marker = moving.as_ref().unwrap_or(marker);
        let [force, moment] = load.in_space(marker, c, &wrench);
        arrow_places.extend(place(marker).iter());
        forces.extend(force.iter());
        moments.extend(moment.iter());
    }
    for sensor in &watched.points {
        points.extend(place(&system.sensors[*sensor].marker).iter());
    }
    for marker in &watched.surfaces {
        let pose = marker.pose(c);
        surface_places.extend(pose.place.iter());
        surface_turns.extend(quaternion(&pose.axes));
    }
    for rope in &system.ropes {
        ropes.extend(rope_line::moving(rope, c).iter().flatten());
    }
}

/// What the side of a joint is tied to: the other end of a rigid arm. The ground has none.
pub(super) fn tied(side: &Marker) -> Marker {
    if matches!(side, Marker::Ground(_)) { *side } else { side.bare() }
}

/// A quaternion and its negative are the same orientation: takes the one nearer to that of the instant before, so that
/// what lies between two instants can be interpolated.
fn continue_turns(before: &[f64], values: &mut [f64]) {
    let last = before.len().checked_sub(values.len()).map_or(&[][..], |begin| &before[begin..]);
    for (turn, last) in values.as_chunks_mut().0.iter_mut().zip(last.as_chunks::<4>().0) {
        if product(turn, last) < 0.0 {
            turn.iter_mut().for_each(|part| *part = -*part);
        }
    }
}

fn product(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the two quaternions of an orientation the one nearer to that before is taken; the first instant has nothing
    /// before it.
    #[test]
    fn quaternions_go_on_from_instant_to_instant() {
        let mut values = vec![-1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.0];
        continue_turns(&[1.0, 0.0, 0.0, 0.0, 0.7, 0.7, 0.0, 0.0], &mut values);
        assert_eq!(values, [1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.0]);
        let mut first = vec![-1.0, 0.0, 0.0, 0.0];
        continue_turns(&[], &mut first);
        assert_eq!(first[0], -1.0);
    }
}
