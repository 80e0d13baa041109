//! What stands on the machine: tool, stock, feeds and safe heights.

use serde::Serialize;

/// A round end mill.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tool {
    /// Cutting diameter, mm.
    pub diameter: f64,
    /// Number in the machine's tool table.
    pub number: u32,
}

impl Tool {
    /// Half the diameter, mm.
    pub fn radius(&self) -> f64 {
        0.5 * self.diameter
    }
}

/// The block of material and how deep the pocket goes into it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stock {
    /// Z of its upper face, mm.
    pub top: f64,
    /// Depth of the pocket's floor below the top, mm, positive.
    pub depth: f64,
}

/// Speeds: mm/min and rpm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Feeds {
    /// Horizontal cutting.
    pub cut: f64,
    /// Along an entry helix or ramp.
    pub ramp: f64,
    /// Straight down.
    pub plunge: f64,
    /// What the machine does in a rapid move; for estimates only.
    pub rapid: f64,
    /// Spindle speed.
    pub spindle: f64,
}

/// Heights of moves through the air, above the stock's top, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Heights {
    /// Above clamps: between pockets, at the start and at the end.
    pub clearance: f64,
    /// Just above the stock: between the paths of one pocket.
    pub retract: f64,
}

/// Which way the tool runs round what it cuts, for a spindle that turns clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Direction {
    /// The wall to the right of travel: the cutter bites from thick to thin.
    #[default]
    Climb,
    /// The wall to the left of travel.
    Conventional,
}

impl Default for Feeds {
    fn default() -> Self {
        Self { cut: 600.0, ramp: 300.0, plunge: 150.0, rapid: 3000.0, spindle: 12_000.0 }
    }
}

impl Default for Heights {
    fn default() -> Self {
        Self { clearance: 10.0, retract: 2.0 }
    }
}
