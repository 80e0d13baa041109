//! What is wrong with a drawing, where, and what to do about it.

use super::units::UnknownUnits;
use pocketry_geom::Point;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Where in a drawing something is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// The file, as it was named.
    pub file: Option<PathBuf>,
    /// The line of the file, from 1.
    pub line: Option<usize>,
    /// The layer (DXF) or group (SVG).
    pub layer: Option<String>,
    /// The entity: its type and, where there is one, its handle or id.
    pub entity: Option<String>,
    /// The point, in millimetres.
    pub at: Option<Point>,
}

impl Place {
    /// A line of a file.
    pub(crate) fn line(line: usize) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// With a point.
    pub(crate) fn at(mut self, p: Point) -> Self {
        self.at = Some(p);
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        match (&self.file, self.line) {
            (Some(file), Some(line)) => parts.push(format!("{}:{line}", file.display())),
            (Some(file), None) => parts.push(file.display().to_string()),
            (None, Some(line)) => parts.push(format!("line {line}")),
            (None, None) => {}
        }
        if let Some(layer) = &self.layer {
            parts.push(format!("layer {layer}"));
        }
        if let Some(entity) = &self.entity {
            parts.push(entity.clone());
        }
        if let Some(p) = self.at {
            parts.push(format!("at ({:.4}, {:.4})", p.x, p.y));
        }
        if parts.is_empty() { f.write_str("drawing") } else { f.write_str(&parts.join(", ")) }
    }
}

/// What was healed or assumed while a drawing was read: the program is made, but the machinist should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// Where.
    pub place: Place,
    /// What was done.
    pub message: String,
}

impl Warning {
    pub(crate) fn new(place: Place, message: impl Into<String>) -> Self {
        Self { place, message: message.into() }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

/// Which kind of mistake a [`Fault`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// Not a drawing of a kind that is read.
    Format,
    /// The file breaks its format's rules, or is cut.
    Syntax,
    /// A number or an entity that can't be used.
    Value,
    /// More work than a drawing can mean: bombs of nested blocks, absurd sizes.
    Limit,
    /// A layer that isn't there.
    Layer,
    /// There is nothing to mill in it.
    Empty,
    /// A contour doesn't close.
    Open,
    /// The contours don't bound a region.
    Region,
    /// The options given make no sense.
    Options,
}

impl FaultKind {
    /// A short name for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Format => "format",
            Self::Syntax => "syntax",
            Self::Value => "value",
            Self::Limit => "limit",
            Self::Layer => "layer",
            Self::Empty => "empty",
            Self::Open => "open-contour",
            Self::Region => "region",
            Self::Options => "options",
        }
    }
}

/// What is wrong with a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Which kind of mistake it is.
    pub kind: FaultKind,
    /// Where.
    pub place: Place,
    /// What is wrong.
    pub problem: String,
    /// What to do.
    pub hint: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.problem)?;
        if self.hint.is_empty() { Ok(()) } else { write!(f, "; {}", self.hint) }
    }
}

/// Why no drawing was read.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file couldn't be read at all: an input/output failure (exit code 3).
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file was read, but it isn't a drawing of a pocket: bad input (exit code 2).
    #[error("{0}")]
    Bad(Box<Fault>),
}

impl ImportError {
    pub(crate) fn new(kind: FaultKind, place: Place, problem: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Bad(Box::new(Fault { kind, place, problem: problem.into(), hint: hint.into() }))
    }

    /// Whether the file couldn't be read, as against a file that was read and is no good.
    pub const fn is_io(&self) -> bool {
        matches!(self, Self::Io { .. })
    }

    /// A short name of the kind of error, for reports.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Io { .. } => "io",
            Self::Bad(fault) => fault.kind.name(),
        }
    }

    /// The same error with the file named.
    pub(crate) fn in_file(mut self, file: &Path) -> Self {
        if let Self::Bad(fault) = &mut self {
            fault.place.file.get_or_insert_with(|| file.to_owned());
        }
        self
    }
}

impl From<UnknownUnits> for ImportError {
    fn from(unknown: UnknownUnits) -> Self {
        Self::new(FaultKind::Value, Place::default(), unknown.to_string(), "")
    }
}
