//! A milling program as a sequence of moves.

use crate::figures::Figures;
use crate::setup::{Feeds, Stock};
use pocketry_geom::{Arc, Point, Segment};
use serde::Serialize;

/// A position of the tool's tip, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point3 {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// Along z, upwards.
    pub z: f64,
}

impl Point3 {
    /// The place `p` at height `z`.
    pub const fn at(p: Point, z: f64) -> Self {
        Self { x: p.x, y: p.y, z }
    }

    /// The place in the plane.
    pub const fn xy(self) -> Point {
        Point::new(self.x, self.y)
    }

    /// Whether all coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

/// Which of the job's feeds a cutting move takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum FeedKind {
    /// Horizontal cutting.
    Cut,
    /// Descent along a helix or ramp.
    Ramp,
    /// Straight descent.
    Plunge,
}

/// One move; each starts where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Move {
    /// At rapid speed, in a straight line (G0).
    Rapid {
        /// Where it ends.
        to: Point3,
    },
    /// At feed, in a straight line (G1).
    Line {
        /// Where it ends.
        to: Point3,
        /// At which feed.
        feed: FeedKind,
    },
    /// At feed, along a circular arc or helix in the XY plane (G2, G3); a full turn where it ends over its start.
    Arc {
        /// Where it ends.
        to: Point3,
        /// Centre of the circle.
        center: Point,
        /// Counter-clockwise (G3) or clockwise (G2).
        ccw: bool,
        /// At which feed.
        feed: FeedKind,
    },
}

/// The moves of a job, from the first rapid above the stock to the last retract.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Program {
    /// In order of execution.
    pub moves: Vec<Move>,
    /// Direction of a tool that turns with the walls at the end of each move, radians counter-clockwise, full turns counted on: the rotary
    /// axis C. Linear along the move. Empty for all other tools.
    pub headings: Vec<f64>,
}

impl Move {
    /// Where the move ends.
    pub const fn to(&self) -> Point3 {
        match *self {
            Self::Rapid { to } | Self::Line { to, .. } | Self::Arc { to, .. } => to,
        }
    }

    /// Which feed it takes; `None` for a rapid move.
    pub const fn feed(&self) -> Option<FeedKind> {
        match *self {
            Self::Rapid { .. } => None,
            Self::Line { feed, .. } | Self::Arc { feed, .. } => Some(feed),
        }
    }

    /// Its path seen from above, starting at `from`.
    pub fn plan_view(&self, from: Point) -> Segment {
        match *self {
            Self::Rapid { to } | Self::Line { to, .. } => Segment::line(from, to.xy()),
            Self::Arc { to, center, ccw, .. } => {
                Segment::Arc(Arc { start: from, end: to.xy(), center, radius: from.distance(center), ccw })
            }
        }
    }

    /// Its length from `from`, mm; a helix is measured along its slope.
    pub fn length(&self, from: Point3) -> f64 {
        self.plan_view(from.xy()).length().hypot(self.to().z - from.z)
    }
}

impl Program {
    /// Every move but the first with the place where it starts; where the first one starts is the machine's affair.
    pub fn steps(&self) -> impl Iterator<Item = (Point3, &Move)> {
        self.moves.windows(2).map(|pair| (pair[0].to(), &pair[1]))
    }

    /// Lengths, counts and the time it takes, for a stock whose upper face lies at `stock.top`.
    pub fn figures(&self, feeds: &Feeds, stock: &Stock) -> Figures {
        Figures::of(self, feeds, stock)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;
    use std::f64::consts::PI;

    #[test]
    fn a_helix_is_as_long_as_its_slope() {
        let from = Point3 { x: 1.0, y: 0.0, z: 0.0 };
        let to = Point3 { z: -3.0, ..from };
        let turn = Move::Arc { to, center: point(0.0, 0.0), ccw: true, feed: FeedKind::Ramp };
        assert!((turn.length(from) - (2.0 * PI).hypot(3.0)).abs() < 1e-12);
    }

    #[test]
    fn a_clockwise_quarter_is_a_quarter() {
        let from = Point3 { x: 0.0, y: 2.0, z: 0.0 };
        let to = Point3 { x: 2.0, y: 0.0, z: 0.0 };
        let quarter = |ccw| Move::Arc { to, center: point(0.0, 0.0), ccw, feed: FeedKind::Cut }.length(from);
        assert!((quarter(false) - PI).abs() < 1e-12);
        assert!((quarter(true) - 3.0 * PI).abs() < 1e-12);
    }
}
