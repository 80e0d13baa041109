//! What can go wrong, as the user and other programs are told it.

use serde::Serialize;
use std::fmt::Display;
use std::path::Path;

/// Exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum Exit {
    /// Written and proven.
    Done = 0,
    /// Planned but not provable; nothing was written.
    NotProven = 1,
    /// Bad input, bad arguments, or a tool that fits nowhere.
    BadInput = 2,
    /// A file could not be read or written.
    InputOutput = 3,
}

/// Why a job came to nothing.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    /// The exit code.
    pub(crate) exit: Exit,
    /// For programs: a word that stays the same.
    pub(crate) kind: &'static str,
    /// For people: what is wrong, where, and what to do.
    pub(crate) message: String,
    /// More lines, such as places.
    pub(crate) details: Vec<String>,
}

/// The failure as reports hold it.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ErrorReport {
    kind: &'static str,
    message: String,
}

impl Failure {
    pub(crate) fn new(exit: Exit, kind: &'static str, message: impl Display) -> Self {
        Self { exit, kind, message: message.to_string(), details: Vec::new() }
    }

    pub(crate) fn arguments(message: impl Display) -> Self {
        Self::new(Exit::BadInput, "arguments", message)
    }

    pub(crate) fn write(path: &Path, why: impl Display) -> Self {
        Self::new(Exit::InputOutput, "write", format!("can't write {}: {why}", path.display()))
    }

    pub(crate) fn read(path: &Path, why: impl Display) -> Self {
        Self::new(Exit::InputOutput, "read", format!("can't read {}: {why}", path.display()))
    }

    /// A fault of this program, caught at the last line of defence.
    pub(crate) fn panicked(payload: &(dyn std::any::Any + Send)) -> Self {
        let said =
            payload.downcast_ref::<String>().map(String::as_str).or_else(|| payload.downcast_ref::<&str>().copied());
        let message = format!("internal error, please report it with the drawing: {}", said.unwrap_or("unknown"));
        Self::new(Exit::NotProven, "internal", message)
    }

    pub(crate) fn with_details(self, details: Vec<String>) -> Self {
        Self { details, ..self }
    }

    pub(crate) fn report(&self) -> ErrorReport {
        ErrorReport { kind: self.kind, message: self.message.clone() }
    }
}

impl Display for ErrorReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}
