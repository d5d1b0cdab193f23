//! Log lines: their categories (FMI 2.0, section 2.2.4) and the form in which a host's printf-like logger takes them.

use serde::{Deserialize, Serialize};
use std::ffi::{CStr, CString};

use super::{LogCategory, Status};

/// Longest message handed to a host, bytes: hosts copy it into fixed buffers, 2,048 bytes is the smallest one seen.
pub const LONGEST: usize = 2000;

/// The category that stands for all the others.
pub const ALL: &str = "logAll";

/// All categories, in the order of the description.
pub const CATEGORIES: [LogCategory; 7] = [
    LogCategory::Events,
    LogCategory::SingularLinearSystems,
    LogCategory::NonlinearSystems,
    LogCategory::StatusWarning,
    LogCategory::StatusDiscard,
    LogCategory::StatusError,
    LogCategory::StatusFatal,
];

impl LogCategory {
    /// The standard's name, as C text.
    pub fn c_name(self) -> &'static CStr {
        match self {
            Self::Events => c"logEvents",
            Self::SingularLinearSystems => c"logSingularLinearSystems",
            Self::NonlinearSystems => c"logNonlinearSystems",
            Self::StatusWarning => c"logStatusWarning",
            Self::StatusDiscard => c"logStatusDiscard",
            Self::StatusError => c"logStatusError",
            Self::StatusFatal => c"logStatusFatal",
        }
    }

    /// The standard's name.
    pub fn name(self) -> &'static str {
        self.c_name().to_str().expect("the names are ASCII literals")
    }

    /// What is logged there, one sentence.
    pub fn description(self) -> &'static str {
        match self {
            Self::Events => "Calls that change the course of the simulation, with their parameters",
            Self::SingularLinearSystems => "A linear system of the solver has no solution",
            Self::NonlinearSystems => "The equations of a step or of an equilibrium could not be solved",
            Self::StatusWarning => "Something is odd but the call succeeded",
            Self::StatusDiscard => "A status was asked for that this unit does not have",
            Self::StatusError => "A call failed and says why",
            Self::StatusFatal => "The instance has become unusable",
        }
    }
}

/// One line for the host's logger.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// How serious it is.
    pub status: Status,
    /// Its category.
    pub category: LogCategory,
    /// The text, not yet prepared for C.
    pub message: String,
}

/// Which debug messages the host wants. Warnings and errors are always logged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Switch {
    on: bool,
    selected: [bool; CATEGORIES.len()],
}

impl Switch {
    /// Everything on, or everything off.
    pub fn new(on: bool) -> Self {
        Self { on, selected: [true; CATEGORIES.len()] }
    }

    /// Switches the named categories on or off; none named means all (FMI 2.0, section 2.1.5). Gives back the unknown
    /// names.
    pub fn select<'a>(&mut self, on: bool, names: &[&'a str]) -> Vec<&'a str> {
        *self = Self::new(on);
        if names.is_empty() || names.contains(&ALL) {
            return Vec::new();
        }
        self.selected = CATEGORIES.map(|category| names.contains(&category.name()));
        names.iter().copied().filter(|name| CATEGORIES.iter().all(|category| category.name() != *name)).collect()
    }

    /// Switches the named categories on or off and leaves the others; none named means all (FMI 3.0, section 2.3.1).
    /// Gives back the unknown names.
    pub fn turn<'a>(&mut self, on: bool, names: &[&'a str]) -> Vec<&'a str> {
        if names.is_empty() {
            *self = Self::new(on);
            return Vec::new();
        }
        let before = *self;
        self.selected = CATEGORIES.map(|category| match names.contains(&category.name()) {
            true => on,
            false => before.wants(category),
        });
        self.on = true;
        names.iter().copied().filter(|name| CATEGORIES.iter().all(|category| category.name() != *name)).collect()
    }

    /// Whether a debug message of this category is wanted.
    pub fn wants(self, category: LogCategory) -> bool {
        self.on && CATEGORIES.iter().zip(self.selected).any(|(known, selected)| *known == category && selected)
    }
}

/// The message as a printf format without conversions, as FMI 2.0 takes it: every `%` and `#` doubled, no NUL, no final
/// newline, and at most
/// [`LONGEST`] bytes, cut between characters and never between the two halves of a doubled one.
pub fn prepare(message: &str) -> CString {
    double(message, &['%', '#'])
}

/// The message as FMI 3.0 takes it: as [`prepare`], but only `#` is doubled, which stands for value references
/// otherwise.
pub fn prepare_fmi3(message: &str) -> CString {
    double(message, &['#'])
}

fn double(message: &str, special: &[char]) -> CString {
    let mut text = String::with_capacity(LONGEST.min(2 * message.len()));
    for character in message.trim_end().chars() {
        let character = if character == '\0' { ' ' } else { character };
        let copies = if special.contains(&character) { 2 } else { 1 };
        if text.len() + copies * character.len_utf8() > LONGEST {
            break;
        }
        for _ in 0..copies {
            text.push(character);
        }
    }
    CString::new(text).expect("every NUL was replaced")
}
