//! What is to be milled, and how.

use crate::plan::PlanError;
use pocketry_motion::{Direction, Feeds, Heights, Stock, Tool};
use serde::Serialize;

/// A pocketing job: everything but the region. Lengths are in mm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PocketJob {
    /// The end mill.
    pub tool: Tool,
    /// Top of the material and depth of the pocket.
    pub stock: Stock,
    /// Distance between successive loops; more than the tool's diameter (less a tolerance) is clamped, with a warning.
    pub stepover: f64,
    /// Whether loops make detours to what stays uncut between them at stepovers above the tool's radius; without, a program
    /// may not be provable.
    pub cleanup: bool,
    /// Thickness of material left on the walls (the paper's border *q*).
    pub stock_to_leave: f64,
    /// Largest depth of one pass; all passes are made equal.
    pub stepdown: f64,
    /// Climb or conventional milling.
    pub direction: Direction,
    /// Safe heights above the stock's top.
    pub heights: Heights,
    /// Feeds and spindle speed.
    pub feeds: Feeds,
    /// How the tool goes down into the material.
    pub entry: Entry,
}

/// How the tool goes down into the material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// Steepest descent along a helix or ramp, radians from the horizontal.
    pub angle: f64,
    /// Smallest radius of a helix as a share of the tool's radius; where there is less room, the tool ramps.
    pub least_helix: f64,
    /// Largest radius of a helix as a share of the tool's radius; below 1, so that no core stays.
    pub largest_helix: f64,
    /// Shortest loop that a ramp may follow, as a share of the tool's radius; on shorter ones the tool plunges.
    pub least_ramp: f64,
}

impl PocketJob {
    /// Share of the tool's radius that is the default distance between loops.
    pub const DEFAULT_STEPOVER: f64 = 0.9;

    /// The default job for an end mill of this diameter: depth and stepdown of one tool radius.
    pub fn for_diameter(diameter: f64) -> Self {
        let tool = Tool { diameter, number: 1 };
        let radius = tool.radius();
        Self {
            tool,
            stock: Stock { top: 0.0, depth: radius },
            stepover: Self::DEFAULT_STEPOVER * radius,
            cleanup: true,
            stock_to_leave: 0.0,
            stepdown: radius,
            direction: Direction::default(),
            heights: Heights::default(),
            feeds: Feeds::default(),
            entry: Entry::default(),
        }
    }

    /// Distance from the walls that the tool's axis keeps, mm.
    pub fn first_distance(&self) -> f64 {
        self.tool.radius() + self.stock_to_leave
    }

    /// Refuses numbers that no machine can do.
    ///
    /// # Errors
    /// [`PlanError::Job`] naming the first bad number.
    pub fn check(&self) -> Result<(), PlanError> {
        let positive = [
            ("tool diameter", self.tool.diameter),
            ("stepover", self.stepover),
            ("stepdown", self.stepdown),
            ("depth", self.stock.depth),
            ("retract height", self.heights.retract),
            ("entry angle", self.entry.angle),
        ];
        let numbers = [("stock to leave", self.stock_to_leave), ("clearance height", self.heights.clearance)];
        let bad = positive.into_iter().find(|(_, v)| !(*v > 0.0 && v.is_finite()));
        let bad = bad.or(numbers.into_iter().find(|(_, v)| !(*v >= 0.0 && v.is_finite())));
        match bad {
            Some((what, value)) => Err(PlanError::Job { what, value }),
            None if !self.stock.top.is_finite() => Err(PlanError::Job { what: "stock top", value: self.stock.top }),
            None => Ok(()),
        }
    }
}

impl Default for PocketJob {
    /// The default job for a 6 mm end mill.
    fn default() -> Self {
        Self::for_diameter(6.0)
    }
}

impl Default for Entry {
    fn default() -> Self {
        Self { angle: 3.0_f64.to_radians(), least_helix: 0.25, largest_helix: 0.9, least_ramp: 1.0 }
    }
}
