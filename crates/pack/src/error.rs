//! What can go wrong in packing. One sentence each: what happened, and a way out.

/// Why a model was not packed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The variable table cannot be described.
    #[error("variable {name}: {problem}")]
    Variable {
        /// Its name.
        name: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The model identifier is not a C identifier.
    #[error(
        "the model identifier `{0}` is not a C identifier; it must be letters, digits and `_`, not begin with a digit, \
         and be no keyword"
    )]
    Identifier(String),
    /// The shared library that goes into every FMU was not found.
    #[error(
        "the library {name} was not found; looked at {looked}. Build it with scripts/build.sh and pass `--library PATH`, \
         or put it beside the executable or in ../lib"
    )]
    NoLibrary {
        /// File name of the library.
        name: String,
        /// The places, separated by commas.
        looked: String,
    },
    /// A linear system has too many states.
    #[error(
        "the linear system has {order} states, and an FMU can have at most {}; `ancf14 reduce` leaves out those that its \
         inputs and outputs do not need",
        ancf14::linear::MOST_STATES
    )]
    States {
        /// How many.
        order: usize,
    },
    /// The matrices of a linear system belong to one position of a mechanism that turns.
    #[error(
        "the linear system about the rotation of {drive} is in the frame that turns: the matrices of its inputs and \
         outputs are those of the position as drawn, and an FMU would keep them as the mechanism turns on; write a file \
         of matrices, .npz, .mat or .json"
    )]
    Turns {
        /// The drive.
        drive: String,
    },
    /// A linear system is not a unit.
    #[error("{0}")]
    Linear(String),
    /// Reading or writing failed.
    #[error("{what}: {reason}")]
    Io {
        /// What was attempted, with the path.
        what: String,
        /// The system's reason.
        reason: String,
    },
}
