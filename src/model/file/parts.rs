//! The parts of a model file with their places: where a message of the solver belongs.

use super::document::Document;
use super::entries::drive::Motion;
use crate::model::text::diagnostic::Diagnostic;

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
            let mut parts = self.each().filter(|(kind, known, _)| kind.is_in_system() && *known == name);
            parts.find(|(kind, ..)| is_point || before == kind.word() || before == "bushing").map(|(.., place)| place)
        });
        place.map(|place| self.diagnostic(place, message, "", ""))
    }
}
