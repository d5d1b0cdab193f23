//! The parts of a model file with their places: where a message of the solver belongs.

use super::document::Document;
use super::entries::drive::Motion;
use crate::model::text::diagnostic::{Diagnostic, Place};

impl Document {
    /// What drives and winches prescribe, in the order of the drives of the system, and whether a host gives it.
    pub fn motions(&self) -> impl Iterator<Item = (Motion, bool)> + '_ {
        let drives = self.drives.iter().map(|drive| (drive.motion, drive.input));
        drives.chain(self.winches.iter().map(|winch| (winch.motion, winch.input)))
    }

    /// A message of the solver at the line of the first part of the model that it names; none if it names none.
    pub fn locate(&self, message: &str) -> Option<Diagnostic> {
        let words: Vec<&str> =
            message.split_whitespace().map(|word| word.trim_matches([',', ';', ':', '\''])).collect();
        let place = words.iter().enumerate().find_map(|(k, word)| {
            let name = word.split(['.', '@']).next().unwrap_or(word);
            let before = k.checked_sub(1).map_or("", |k| words[k]);
            let is_point = name.len() < word.len() || words.get(k + 1).is_some_and(|next| next.starts_with('('));
            let mut parts = self.parts().filter(|(_, known, _)| *known == name);
            parts.find(|(kind, ..)| is_point || before == *kind || before == "bushing").map(|(.., place)| place)
        });
        place.map(|place| self.diagnostic(place, message, "", ""))
    }

    /// What the solver's messages name: kind, name and place.
    fn parts(&self) -> impl Iterator<Item = (&'static str, &str, Place)> {
        let beams = self.beams.iter().map(|part| ("beam", part.name.as_str(), part.place));
        let bodies = self.bodies.iter().map(|part| ("body", part.name.as_str(), part.place));
        let frames = self.frames.iter().map(|part| ("frame", part.name.as_str(), part.place));
        let points = self.points.iter().map(|part| ("point", part.name.as_str(), part.place));
        let joints = self.joints.iter().map(|part| ("joint", part.name.as_str(), part.place));
        let drives = self.drives.iter().map(|part| ("drive", part.name.as_str(), part.place));
        let winches = self.winches.iter().map(|part| ("winch", part.name.as_str(), part.place));
        let actuators = self.actuators.iter().map(|part| ("actuator", part.name.as_str(), part.place));
        let gears = self.gears.iter().map(|part| ("gear", part.name.as_str(), part.place));
        let springs = self.springs.iter().map(|part| ("spring", part.name.as_str(), part.place));
        let frictions = self.frictions.iter().map(|part| ("friction", part.name.as_str(), part.place));
        let stops = self.stops.iter().map(|part| ("stop", part.name.as_str(), part.place));
        let locks = self.locks.iter().map(|part| ("lock", part.name.as_str(), part.place));
        let loads = self.loads.iter().map(|part| ("load", part.name.as_str(), part.place));
        let motions = joints.chain(drives).chain(winches).chain(actuators).chain(gears);
        beams
            .chain(bodies)
            .chain(frames)
            .chain(points)
            .chain(motions)
            .chain(springs)
            .chain(frictions)
            .chain(stops)
            .chain(locks)
            .chain(loads)
    }
}
