//! Offsets from the Voronoi skeleton: algorithm 3.6 of J. J. Chou and E. Cohen, *Computing Offsets and Tool Paths With
//! Voronoi Diagrams*, UUCS-89-017, University of Utah, 1990.
//!
//! Departures from the paper, and what they guarantee:
//!
//! - An edge spans `d` when `low <= d < high`, decided by the clearances stored at its two vertices alone: the walk
//!   sees the distance as `d` plus an infinitesimal. Around a cell, which begins and ends on the boundary at clearance 0,
//!   edges then span upwards and downwards in turn, and crossing over to the twin is a permutation of the upward
//!   half-edges: *every loop closes, whatever the rounding*, and constant-clearance edges never span.
//! - All spanning edges start loops, not only those on key branches: a region with islands may have a loop
//!   that crosses no key branch (both of its boundaries may have been led to a peak beyond it).
//! - Spokes at reflex vertices and smooth joints are edges too, so that a disc or a slot has crossings.
//!
//! At a distance equal to a peak's clearance, the peak has no loop; equal to a pass's, two loops touch there; equal to a
//! constant-clearance path's, the path is outside. [`Degenerate::Keep`] returns what falls away like this at the
//! distance: the tool of that radius still goes there.

mod carrier;
mod crossing;
mod degenerate;
mod gate;
mod piece;
mod stabbing;
#[cfg(test)]
mod tests;
mod walk;

use super::{Degenerate, Offset, OffsetEngine, OffsetError, OffsetLoop, OffsetOptions, check_distance};
use crate::bbox::BBox;
use crate::region::Region;
use crate::skeleton::{EdgeId, Skeleton};
use crate::tolerance::OFFSET_DROP;
use stabbing::EdgeIntervals;

pub use crossing::{EdgeCurve, upward};
pub use gate::Gate;

pub(crate) use carrier::Carrier;
pub(crate) use piece::parallel_piece;

/// A skeleton prepared for offsets at many distances.
///
/// Preparing takes O(n log n) time and O(n) space. Each offset then takes O(log n + k log k) for the k pieces it has, better
/// than the paper's O(n): an interval tree over the clearances finds the edges that span the distance, and sorting them by
/// cell tells which piece follows which, so that no other edge is ever looked at. The logarithm is that of a sort of
/// integers, a fifth of the time that a piece takes. ([`Degenerate::Keep`] looks at every edge.)
#[derive(Debug)]
pub struct VoronoiOffsetter<'a> {
    skeleton: &'a Skeleton,
    intervals: EdgeIntervals,
    ranks: Vec<u32>,
    /// Highest first.
    gates: Vec<Gate>,
    size: f64,
}

impl<'a> VoronoiOffsetter<'a> {
    /// Prepares a skeleton.
    pub fn new(skeleton: &'a Skeleton) -> Self {
        Self::with_gates(skeleton, Vec::new())
    }

    /// Prepares a skeleton cut at gates, which are given highest first: loops stay on their side of each.
    pub fn with_gates(skeleton: &'a Skeleton, gates: Vec<Gate>) -> Self {
        let bbox = skeleton.vertices().iter().fold(BBox::EMPTY, |b, v| b.with(v.point));
        let (intervals, ranks) = (EdgeIntervals::new(skeleton), walk::ranks(skeleton));
        Self { skeleton, intervals, ranks, gates, size: bbox.size() }
    }

    /// The skeleton this works on.
    pub const fn skeleton(&self) -> &'a Skeleton {
        self.skeleton
    }

    /// The offset at `distance`, mm.
    ///
    /// # Errors
    /// When the distance is not a positive number.
    pub fn offset(&self, distance: f64, options: &OffsetOptions) -> Result<Offset, OffsetError> {
        let distance = check_distance(distance)?;
        let loops = self.loops_and_edges(distance).into_iter().map(|l| l.0).collect();
        let degenerate = match options.degenerate {
            Degenerate::Drop => Vec::new(),
            Degenerate::Keep => degenerate::paths(self.skeleton, distance),
        };
        Ok(Offset { distance, loops, degenerate })
    }

    /// The loops at a distance from 0 on, each with an edge that lies on its side of the gates; at 0 they are the walls, and
    /// with gates the contours of subpockets.
    pub(crate) fn loops_and_edges(&self, distance: f64) -> Vec<(OffsetLoop, EdgeId)> {
        let open = self.gates.partition_point(|g| g.clearance > distance);
        let walk = walk::Walk {
            skeleton: self.skeleton,
            ranks: &self.ranks,
            gates: &self.gates[..open],
            d: distance,
            drop: OFFSET_DROP * self.size,
        };
        walk.loops(&self.intervals.spanning(distance))
    }
}

/// The exact engine: builds the skeleton and walks it.
#[derive(Clone, Copy, Debug, Default)]
pub struct VoronoiEngine;

impl OffsetEngine for VoronoiEngine {
    fn name(&self) -> &'static str {
        "voronoi"
    }

    fn offsets(&self, region: &Region, distances: &[f64], options: &OffsetOptions) -> Result<Vec<Offset>, OffsetError> {
        let skeleton =
            Skeleton::build(region).map_err(|e| OffsetError::Region { engine: self.name(), reason: e.to_string() })?;
        let offsetter = VoronoiOffsetter::new(&skeleton);
        distances.iter().map(|&d| offsetter.offset(d, options)).collect()
    }
}
