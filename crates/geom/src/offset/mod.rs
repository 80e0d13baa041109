//! Offsets of regions: the engine trait and what every engine returns.
//!
//! The offset of a region at distance `d` is the boundary of the set of its points with clearance above `d`. Every
//! engine guarantees closed loops that neither cross nor share an edge, nested like the contours of a
//! [`Region`]: counter-clockwise around what remains, clockwise around what does not, the remaining
//! pocket to the left of travel. Loops may touch at points: two loops meet at a pass whose clearance is exactly `d`.

pub mod bisector;
pub mod morphology;
pub mod outward;
pub mod pairwise;
pub mod voronoi;

use crate::contour::Contour;
use crate::point::Point;
use crate::region::Region;
use crate::segment::Segment;
use crate::skeleton::{EdgeId, SiteId};
use crate::tolerance::{FIT_SLACK, FIT_SLACK_SHARE};

pub use bisector::BisectorEngine;
pub use outward::outward;
pub use pairwise::{Interference, PairwiseEngine, PairwiseOffset, PairwiseOffsetter};
pub use voronoi::{EdgeCurve, VoronoiEngine, VoronoiOffsetter, upward};

/// An algorithm that offsets regions.
pub trait OffsetEngine {
    /// A short name for reports.
    fn name(&self) -> &'static str;

    /// The offsets of `region` at each of `distances` (mm, positive, in any order), in the order asked.
    ///
    /// # Errors
    /// When a distance is not a positive number, or the engine cannot take the region.
    fn offsets(&self, region: &Region, distances: &[f64], options: &OffsetOptions) -> Result<Vec<Offset>, OffsetError>;
}

/// How an offset treats channels that are exactly as wide as twice the distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Degenerate {
    /// They vanish: what remains is the open set of points with clearance *above* the distance.
    #[default]
    Drop,
    /// They stay as open paths or points (see [`DegeneratePath`]): where a tool of that radius still goes.
    Keep,
}

/// Options shared by all engines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OffsetOptions {
    /// What becomes of channels exactly as wide as the tool.
    pub degenerate: Degenerate,
}

/// Why an offset could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OffsetError {
    /// A distance that is zero, negative or not a number.
    #[error("offset distance {0} mm: it must be a positive number")]
    Distance(f64),
    /// The engine cannot take this region.
    #[error("{engine} engine: {reason}")]
    Region {
        /// Name of the engine.
        engine: &'static str,
        /// What is wrong, where, and what to do.
        reason: String,
    },
}

/// All loops at one distance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offset {
    /// Distance to the boundary, mm.
    pub distance: f64,
    /// The loops; together they bound the points with clearance above the distance.
    pub loops: Vec<OffsetLoop>,
    /// Where clearance reaches the distance but does not exceed it; only on request ([`Degenerate::Keep`]).
    pub degenerate: Vec<DegeneratePath>,
}

/// One closed curve of an offset.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OffsetLoop {
    /// Its lines and arcs, the remaining pocket to the left.
    pub contour: Contour,
    /// For each segment the site it is parallel to; empty where the engine knows none.
    pub sites: Vec<SiteId>,
    /// For each segment the skeleton half-edge on which it starts, directed towards larger clearance; empty
    /// where the engine has no skeleton.
    pub crossings: Vec<EdgeId>,
}

/// A connected part of the set of points whose clearance equals the distance and is nowhere exceeded: the middle of a
/// channel exactly as wide as the tool, or the centre of a disc just as large.
///
/// *Equals* allows for the rounding of drawings: clearances down to [`degenerate_slack`] below the distance count.
#[derive(Clone, Debug, PartialEq)]
pub struct DegeneratePath {
    /// A point of it, where the tour starts and ends.
    pub start: Point,
    /// A closed tour of the whole part, out and back along open ends; empty where the part is a point.
    pub tour: Vec<Segment>,
    /// Where it hangs on a loop: the half-edge (see [`OffsetLoop::crossings`]) at whose crossing the tour starts.
    pub attached: Option<EdgeId>,
}

/// By how much clearance may fall short of `distance` for a tool of that radius to go there still, mm.
pub fn degenerate_slack(distance: f64) -> f64 {
    FIT_SLACK.min(FIT_SLACK_SHARE * distance)
}

/// Refuses distances that are not positive numbers.
///
/// # Errors
/// [`OffsetError::Distance`] with the value.
pub fn check_distance(distance: f64) -> Result<f64, OffsetError> {
    if distance > 0.0 && distance.is_finite() { Ok(distance) } else { Err(OffsetError::Distance(distance)) }
}
