//! Reads a G-code program back as the control would: the part of LinuxCNC's language that milling posts write.
//!
//! Taken: G0–G3 (lines, arcs by I J or R, helices, full circles, P turns, with the rotary axis C), G4, G17, G20/G21, G40, G49, G54, G61, G61.1,
//! G64 with P and Q, G80, G90/G91, G90.1/G91.1, G94, M0–M9, M30, M48/M49, F, S, T, H, N, comments, `%`. Everything else, parameters,
//! expressions, subroutines, canned cycles and tool compensation among them, is refused with its line: what can't be
//! read for certain can't be proven.

mod arcs;
mod state;
mod words;

use pocketry_geom::Segment;
use pocketry_motion::Point3;
use thiserror::Error;

pub(crate) use state::read;

/// How a motion goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2 or G3.
    Arc,
}

/// One motion of the program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// Line of the text, from 1.
    pub(crate) line: u32,
    pub(crate) kind: Kind,
    /// Where it starts; the height is infinite where the program has not set it yet.
    pub(crate) from: Point3,
    pub(crate) to: Point3,
    /// Its curves in the plane: a range of [`Trace::curves`]; a single line without length where it goes straight up or down.
    pub(crate) first: u32,
    pub(crate) count: u32,
    /// Length in space, mm.
    pub(crate) length: f64,
    /// How far the tool may be from the curves: rounding of an arc's centre, blending under G64, mm.
    pub(crate) slack: f64,
    /// Whether the start in the plane was known.
    pub(crate) known: bool,
    /// The rotary axis C at both ends, radians counter-clockwise; 0 where it is not known.
    pub(crate) turn: [f64; 2],
    /// Whether it is known at both ends.
    pub(crate) turn_known: bool,
}

impl Motion {
    /// The lower of its ends.
    pub(crate) fn low(&self) -> f64 {
        self.from.z.min(self.to.z)
    }

    /// The higher of its ends.
    pub(crate) fn high(&self) -> f64 {
        self.from.z.max(self.to.z)
    }

    /// Whether it stays on the spot in the plane.
    pub(crate) fn is_vertical(&self) -> bool {
        self.kind != Kind::Arc && self.from.x == self.to.x && self.from.y == self.to.y
    }
}

/// What the program makes the tool do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    pub(crate) motions: Vec<Motion>,
    /// Curves of all motions, arcs in parts of at most half a turn.
    pub(crate) curves: Vec<Segment>,
    /// The last decimal place that any X or Y was written with, mm.
    pub(crate) resolution: f64,
    /// First line that cuts under a path control without a tolerance (plain G64, or none set).
    pub(crate) unbounded_blending: Option<u32>,
    /// First line that sets C to anything but whole turns.
    pub(crate) turned: Option<u32>,
    /// First line that cuts while the spindle stands.
    pub(crate) spindle_stopped: Option<u32>,
    /// Whether M2 or M30 ended it.
    pub(crate) ended: bool,
}

impl Trace {
    /// The curves of a motion.
    pub(crate) fn curves_of(&self, m: &Motion) -> &[Segment] {
        &self.curves[m.first as usize..(m.first + m.count) as usize]
    }
}

/// Why a program can't be read; every message names the line.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProgramError {
    /// Not letters and numbers.
    #[error(
        "line {line}: can't read \"{text}\": a word is a letter and a plain decimal number (no parameters, expressions or subroutines)"
    )]
    Syntax {
        /// Line of the program, from 1.
        line: u32,
        /// What stands there.
        text: String,
    },
    /// A code that this reader does not know for certain.
    #[error(
        "line {line}: {code} is not supported, so nothing can be proven; use G0 to G3 in the XY plane without compensation or cycles"
    )]
    Unsupported {
        /// Line of the program, from 1.
        line: u32,
        /// The code.
        code: String,
    },
    /// Two words that can't stand together, or one twice.
    #[error("line {line}: {word} stands twice or clashes with another word of the line")]
    Clash {
        /// Line of the program, from 1.
        line: u32,
        /// The second word.
        word: String,
    },
    /// Axis words without a motion mode.
    #[error("line {line}: coordinates, but no motion mode is active (G0, G1, G2 or G3)")]
    NoMotionMode {
        /// Line of the program, from 1.
        line: u32,
    },
    /// Cutting before F.
    #[error("line {line}: a cutting move before any feed (F) was set")]
    NoFeed {
        /// Line of the program, from 1.
        line: u32,
    },
    /// A cutting or relative move from nowhere.
    #[error(
        "line {line}: the move starts at a place that the program has not set: start with rapid moves to X, Y and Z in G90"
    )]
    UnknownStart {
        /// Line of the program, from 1.
        line: u32,
    },
    /// C words where the tool is said to keep its direction.
    #[error(
        "line {line}: C turns the tool, but its profile was said to keep its direction; say that it turns with the walls"
    )]
    Turns {
        /// Line of the program, from 1.
        line: u32,
    },
    /// An arc that the control would refuse.
    #[error("line {line}: impossible arc: {reason}")]
    Arc {
        /// Line of the program, from 1.
        line: u32,
        /// What is wrong with it.
        reason: String,
    },
    /// A number beyond all measure.
    #[error("line {line}: {word} is out of range")]
    Range {
        /// Line of the program, from 1.
        line: u32,
        /// The word.
        word: String,
    },
}
