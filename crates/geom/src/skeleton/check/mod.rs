//! An independent judge of a skeleton: [`Skeleton::check`].
//!
//! The judge knows the structure and the region, nothing of how the one was made from the other. It takes every site's
//! geometry from the region, derives the points of every edge from the definition (centres of disks that touch both
//! sites), measures distances to the boundary on its own and computes the cells' areas site by site. What it finds is
//! a [`CheckReport`]: the worst errors, and a list of [`Fault`]s with their places.
//!
//! A report without faults says: the structure is consistent, every vertex and every sampled point of every edge has
//! the stated clearance, touches the sites named there within their extents, from inside the pocket; feet run forward
//! around every cell; contacts turn once around every vertex; every piece of the region has one connected skeleton
//! with one cycle an island; the cells fill the region.

mod cells;
mod components;
mod edges;
mod element;
mod feet;
mod nearest;
mod report;
mod structure;
#[cfg(test)]
mod tests;
mod vertices;

pub use report::{CheckReport, Element, Fault, FaultKind};

use super::{EdgeId, SiteId, SiteShape, Skeleton};
use crate::point::Point;
use crate::region::Region;
use crate::tolerance;
use nearest::Nearest;

/// How strictly and how densely [`Skeleton::check`] looks. Lengths are relative to the region's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckOptions {
    /// How far a clearance may lie from the distance to the boundary or to a named site.
    pub clearance: f64,
    /// Vertices whose clearance is farther off than this are counted, not faulted.
    pub tight: f64,
    /// How far a foot may miss its site's extent or run backwards, where that changes a distance by more than `tight`.
    pub foot: f64,
    /// By how much the cells' areas may miss the region's, as a part of it.
    pub area: f64,
    /// Points sampled within each edge.
    pub samples: u32,
    /// Regions of up to so many segments are measured against every segment, larger ones through a tree of boxes,
    /// which gives the same distances.
    pub brute_force_up_to: usize,
    /// How many faults are kept with their places; all are counted.
    pub max_faults: usize,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self {
            clearance: tolerance::CHECK_CLEARANCE,
            tight: tolerance::CHECK_TIGHT,
            foot: tolerance::CHECK_FOOT,
            area: tolerance::CHECK_AREA,
            samples: 5,
            brute_force_up_to: 500,
            max_faults: 100,
        }
    }
}

impl CheckOptions {
    /// The same with every tolerance `factor` times as wide.
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            clearance: self.clearance * factor,
            tight: self.tight * factor,
            foot: self.foot * factor,
            area: self.area * factor,
            ..self
        }
    }
}

impl Skeleton {
    /// Judges this skeleton of `region`; see the module for what a report without faults says.
    pub fn check(&self, region: &Region, options: &CheckOptions) -> CheckReport {
        let mut judge = Judge::new(self, region, options);
        if judge.check_structure() {
            judge.check_vertices();
            judge.check_edges();
            judge.check_cells();
            judge.check_components();
        }
        judge.report
    }
}

/// Every edge as a polyline: its ends and `between` points within, derived from the definition as the check does; only
/// the ends where the skeleton is too broken to be walked.
pub fn edge_polylines(skeleton: &Skeleton, region: &Region, between: u32) -> Vec<Vec<Point>> {
    let options = CheckOptions { max_faults: 0, brute_force_up_to: usize::MAX, ..CheckOptions::default() };
    let mut judge = Judge::new(skeleton, region, &options);
    let sound = judge.check_structure();
    let between = if sound { between } else { 0 };
    (0..skeleton.half_edges().len() as EdgeId).step_by(2).map(|e| judge.polyline(e, between)).collect()
}

/// What all parts of the check share.
struct Judge<'a> {
    skeleton: &'a Skeleton,
    region: &'a Region,
    options: &'a CheckOptions,
    /// One for each site, filled while the structure is checked.
    elements: Vec<element::Element>,
    nearest: Nearest,
    report: CheckReport,
}

impl<'a> Judge<'a> {
    fn new(skeleton: &'a Skeleton, region: &'a Region, options: &'a CheckOptions) -> Self {
        let report = CheckReport::new(region.bbox().size(), skeleton);
        let nearest = Nearest::new(region, options.brute_force_up_to);
        Self { skeleton, region, options, elements: Vec::new(), nearest, report }
    }

    fn size(&self) -> f64 {
        self.report.size
    }

    fn fault(&mut self, kind: FaultKind, element: Element, place: Point, amount: f64) {
        self.report.fault(Fault { kind, element, place, amount }, self.options.max_faults);
    }

    /// Whether a foot's slip, relative to the size, changes a distance r by more than the tight tolerance.
    fn is_felt(&self, slip: f64, r: f64) -> bool {
        slip * slip * self.size() > 2.0 * r * self.options.tight
    }

    fn is_corner(&self, site: SiteId) -> bool {
        matches!(self.skeleton.sites()[site as usize].shape, SiteShape::Point(_))
    }

    fn origin_point(&self, e: EdgeId) -> Point {
        self.skeleton.vertices()[self.skeleton.origin(e) as usize].point
    }

    fn target_point(&self, e: EdgeId) -> Point {
        self.origin_point(Skeleton::twin(e))
    }
}
