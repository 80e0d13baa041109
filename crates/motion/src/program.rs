//! A milling program as a sequence of moves.

use pocketry_geom::Point;
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
}

impl Move {
    /// Where the move ends.
    pub const fn to(&self) -> Point3 {
        match *self {
            Self::Rapid { to } | Self::Line { to, .. } | Self::Arc { to, .. } => to,
        }
    }
}
