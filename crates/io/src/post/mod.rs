//! Programs as text: what a control unit reads.
//!
//! A post rounds every coordinate once, to the decimals that the output is written with, and keeps track of where the
//! machine *really* is after rounding; nothing drifts. What rounding may move a path is bounded by a few steps of the
//! last decimal (see [`PostOptions::for_tool`]), and an arc stays one only where the rounded numbers still describe it.

mod arc;
mod grid;
mod linuxcnc;
mod words;

pub use grid::OutputUnit;
pub use linuxcnc::LinuxCnc;

use pocketry_geom::tolerance;
use pocketry_motion::{Feeds, Program, ProgramFault, Tool};
use thiserror::Error;

/// A control unit's dialect of G-code.
pub trait Dialect {
    /// Name, as written in the header.
    fn name(&self) -> &'static str;

    /// The program's text.
    ///
    /// # Errors
    /// [`PostError`] where the program can't be said in this dialect.
    fn write(&self, program: &Program, options: &PostOptions) -> Result<String, PostError>;
}

/// Whether the machine may round corners.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PathControl {
    /// Every programmed point is reached (G61).
    #[default]
    Exact,
    /// Corners may be cut by so much, mm (G64 P); it belongs to the gouge budget.
    Blend(f64),
}

/// What goes into the text besides the moves.
#[derive(Clone, Debug, PartialEq)]
pub struct PostOptions {
    /// The unit of the written numbers.
    pub unit: OutputUnit,
    /// Digits after the decimal point of coordinates.
    pub decimals: usize,
    /// Exact stop or blending.
    pub path_control: PathControl,
    /// The tool to call.
    pub tool: Tool,
    /// Speeds.
    pub feeds: Feeds,
    /// Lines of the header, one comment each.
    pub header: Vec<String>,
}

impl PostOptions {
    /// Options with as many decimals as the tool needs: 4 in millimetres, 5 in inches, more for tools so small that
    /// a step of the last decimal would take more than [`tolerance::ROUNDING_SHARE`] of the gouge budget
    /// (0.002 mm or a hundredth of the radius).
    pub fn for_tool(tool: Tool, feeds: Feeds, unit: OutputUnit) -> Self {
        let budget = tolerance::GOUGE.min(0.01 * tool.radius());
        let step = tolerance::ROUNDING_SHARE * budget / unit.millimetres();
        let needed = (-step.log10()).ceil().clamp(0.0, 12.0) as usize;
        let decimals = needed.max(unit.usual_decimals());
        Self { unit, decimals, path_control: PathControl::Exact, tool, feeds, header: Vec::new() }
    }
}

/// Why a program can't be written.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PostError {
    /// The program itself is at fault.
    #[error(transparent)]
    Fault(#[from] ProgramFault),
    /// A coordinate is too large for the decimals.
    #[error(
        "coordinate {value} mm is too large to be written with {decimals} decimals; move the drawing towards the origin (--origin)"
    )]
    TooLarge {
        /// The coordinate.
        value: f64,
        /// Digits asked for.
        decimals: usize,
    },
    /// A feed or speed is not a positive number.
    #[error("{what} must be a positive number, not {value}")]
    BadSpeed {
        /// Which.
        what: &'static str,
        /// Its value, mm/min or rpm.
        value: f64,
    },
}
