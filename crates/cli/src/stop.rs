//! Why a command ends early: what is told, and the exit code.

use super::voice::Complaint;
use ancf14::model::text::diagnostic::{Diagnostic, Diagnostics};

/// Why a command ends early, with its exit code.
#[derive(Debug)]
pub enum Stop {
    /// The run failed: 1.
    Failed(String),
    /// Bad file or arguments: 2.
    Bad(String),
    /// Mistakes of the model file, each with its place: 2.
    Mistaken(Diagnostics),
    /// A signal ended it: the code is given.
    Interrupted(String, u8),
}

impl Stop {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::Failed(_) => 1,
            Self::Bad(_) | Self::Mistaken(_) => 2,
            Self::Interrupted(_, code) => *code,
        }
    }

    /// The errors one by one.
    pub fn complaints(&self) -> Vec<Complaint> {
        match self {
            Self::Mistaken(mistakes) => mistakes.0.iter().map(complaint).collect(),
            Self::Failed(message) | Self::Bad(message) | Self::Interrupted(message, _) => vec![Complaint::new(message)],
        }
    }
}

impl Stop {
    /// The first line of the message, without its kind.
    pub fn reason(&self) -> String {
        let text = self.to_string();
        let line = text.lines().next().unwrap_or("");
        line.trim_start_matches("error: ").trim_end_matches('.').to_owned()
    }
}

impl std::fmt::Display for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Mistaken(mistakes) => write!(f, "{mistakes}"),
            Self::Failed(message) | Self::Bad(message) | Self::Interrupted(message, _) => write!(f, "{message}"),
        }
    }
}

/// A mistake of the model file as an error in a document.
fn complaint(mistake: &Diagnostic) -> Complaint {
    let some = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    Complaint {
        location: Some(mistake.location().to_owned()),
        line: mistake.line(),
        column: mistake.column(),
        excerpt: some(mistake.excerpt()),
        label: some(mistake.label()),
        help: some(mistake.help()),
        ..Complaint::new(&mistake.message)
    }
}
