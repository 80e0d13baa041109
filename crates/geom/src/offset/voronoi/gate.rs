//! Critical edges as the walk meets them.

use crate::point::Point;
use crate::skeleton::EdgeId;

/// A critical edge, which leads from a pass to its projection on a site (Chou and Cohen, section 5), as a place of that
/// site's cell where one subpocket's part ends and the next one's begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    /// The half-edge of the cell that arrives at the pass; the next one of the cell lies beyond the gate.
    pub after: EdgeId,
    /// The gate at the same pass through which a walk that has come to this one goes on (an index).
    pub over: u32,
    /// The gate from which a walk that goes on here has come: `over` the other way.
    pub from: u32,
    /// The pass.
    pub pass: Point,
    /// Its projection.
    pub foot: Point,
    /// Clearance of the pass, mm.
    pub clearance: f64,
}

impl Gate {
    /// The point of the critical edge at distance `d` (mm) from its site.
    pub fn at(&self, d: f64) -> Point {
        if d <= 0.0 { self.foot } else { self.foot + (self.pass - self.foot).normalized() * d }
    }
}
