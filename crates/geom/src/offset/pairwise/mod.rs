//! Offsets of point-sequence curves by pair-wise interference detection: the *expanded PWID offset* of S. C. Park and B. K. Choi,
//! *Uncut free pocketing tool-paths generation using pair-wise offset algorithm*, Computer-Aided Design 33, 2001, section 2.
//!
//! 1. Local interfering ranges are removed before a raw offset exists (`local`): at every convex vertex the elements on both
//!    sides are tested in pairs; one that lies wholly within reach of the other goes, until two meet in a point.
//!    No local loop is ever formed: a fillet of a thousand tiny segments vanishes like a single one.
//! 2. What remains, joined, makes one raw curve a contour.
//! 3. All intersections among raw curves are found through the spatial index, O((n + k) log n) on everything seen (`crossings`).
//! 4. Global interfering ranges are removed (`global`): the run of a curve between two crossings is valid or interfering as a
//!    whole, and the distance of one of its points to the boundary tells. It settles the inclusion of curves that cross
//!    nothing (the paper's figure 8), too.
//! 5. Valid runs join at the crossings to loops.
//!
//! **Exactness.** Segments stay lines, and reflex vertices get true arcs: the curves are the true offset, not chords of it.
//! Arcs *of the region* are replaced by chords first, within [`PairwiseEngine::chord_tolerance`] and on the pocket's side.
//!
//! **Robustness.** Straight pieces cross by exact predicates; what arcs do is computed, and may contradict itself where a
//! curve passes through a joint of another. Then a valid run leads nowhere: the offset is made anew at a distance larger by [`PERTURBATION`] of the region's size, a few times at most, and refused with an
//! error if that does not help. Channels exactly twice as wide as the distance are decided in the same way.
//!
//! **Departures from the paper.** It trims ranges along the boundary and builds the raw offset from what is left;
//! here the offset elements themselves are trimmed, which is the same. Its global test goes from
//! an intersection element by element until the interference ends; here the next intersection ends it.

mod chains;
mod chords;
mod crossings;
mod element;
mod global;
mod local;
mod raw;
#[cfg(test)]
mod tests;
mod walls;

use super::{Degenerate, Offset, OffsetEngine, OffsetError, OffsetOptions, check_distance, degenerate_slack};
use crate::distance::Boundary;
use crate::point::Point;
use crate::region::Region;
use crate::segment::Line;
use crate::skeleton::{SiteId, SiteShape};
use crate::tolerance::pairwise::{ATTEMPTS, PERTURBATION, WELD};
use crate::tolerance::{CHORDS, CHORDS_SHARE};
use chords::Fineness;
use element::Element;
use raw::RawCurves;
use walls::Walls;

/// An interfering range that was removed: the boundary from one foot to another, collapsed to one vertex of an offset loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interference {
    /// Whether it was found from a convex vertex; else from a crossing of raw curves.
    pub local: bool,
    /// The vertex of the loop that it collapsed to (the paper's *degenerate vertex*).
    pub degenerate: Point,
    /// The boundary point that the loop leaves: nearest to the vertex, on the element before it.
    pub from: Point,
    /// The boundary point where it goes on.
    pub to: Point,
    /// The elements, numbered like the sites of offset loops, on which these two points lie.
    pub elements: [SiteId; 2],
}

/// An offset with the interfering ranges that were removed from it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairwiseOffset {
    /// The loops.
    pub offset: Offset,
    /// The ranges, in no order that means anything.
    pub interferences: Vec<Interference>,
}

/// The pair-wise engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct PairwiseEngine;

impl PairwiseEngine {
    /// How far the chords that stand for a region's arcs may lie from them at offset distance `d`, mm. Where a channel is about as wide as a
    /// tool of that radius, they lie within half of [`degenerate_slack`].
    pub fn chord_tolerance(d: f64) -> f64 {
        CHORDS.min(CHORDS_SHARE * d)
    }

    /// The offsets with their interfering ranges, in the order asked.
    ///
    /// # Errors
    /// Where a distance is not a positive number, or the raw curves contradict themselves.
    pub fn with_ranges(&self, region: &Region, distances: &[f64]) -> Result<Vec<PairwiseOffset>, OffsetError> {
        all(region, distances, true)
    }

    /// The region with chords for arcs, within the tolerance for offsets at distance `d` (mm) and nowhere larger; `None` where
    /// it has no arcs.
    pub fn straightened(region: &Region, d: f64) -> Option<Region> {
        let fineness = Fineness { radius: d, fine: 0.5 * degenerate_slack(d), coarse: Self::chord_tolerance(d) };
        chords::chorded(region, fineness)
    }
}

impl OffsetEngine for PairwiseEngine {
    fn name(&self) -> &'static str {
        "pairwise"
    }

    fn offsets(&self, region: &Region, distances: &[f64], options: &OffsetOptions) -> Result<Vec<Offset>, OffsetError> {
        if options.degenerate == Degenerate::Keep {
            let reason = "it cannot keep channels just as wide as the tool; use the voronoi engine".to_owned();
            return Err(OffsetError::Region { engine: self.name(), reason });
        }
        Ok(all(region, distances, false)?.into_iter().map(|found| found.offset).collect())
    }
}

/// The offsets at all distances, with the region's arcs as chords fine enough for the least.
fn all(region: &Region, distances: &[f64], with_ranges: bool) -> Result<Vec<PairwiseOffset>, OffsetError> {
    for &d in distances {
        check_distance(d)?;
    }
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let straight = PairwiseEngine::straightened(region, least);
    let offsetter = PairwiseOffsetter::new(straight.as_ref().unwrap_or(region));
    distances.iter().map(|&d| offsetter.attempts(d, with_ranges)).collect()
}

/// A region of lines, ready to be offset many times.
#[derive(Clone, Debug)]
pub struct PairwiseOffsetter<'a> {
    /// The elements of all contours, by number.
    elements: Vec<Element>,
    /// For each contour its first element; one more at the end.
    bounds: Vec<u32>,
    walls: Walls<'a>,
    size: f64,
    /// How far the boundary's vertices are from the elements', mm.
    strayed: f64,
}

impl<'a> PairwiseOffsetter<'a> {
    /// Finds the elements of a region, whose arcs, if any, count as their chords ([`PairwiseEngine::straightened`]).
    pub fn new(region: &'a Region) -> Self {
        let mut elements = Vec::with_capacity(region.edge_count() + region.edge_count() / 2);
        let mut bounds = vec![0];
        let size = region.bbox().size();
        let mut strayed = 0.0_f64;
        for contour in region.contours() {
            strayed = strayed.max(element::add_contour(contour, WELD * size, &mut elements));
            bounds.push(elements.len() as u32);
        }
        Self { elements, bounds, walls: Walls::new(region), size, strayed }
    }

    /// What a site of its offsets is: a line or a reflex vertex.
    pub fn shape(&self, site: SiteId) -> SiteShape {
        let e = &self.elements[site as usize];
        if e.is_vertex() { SiteShape::Point(e.start) } else { SiteShape::Line(Line::new(e.start, e.end)) }
    }

    /// The larger extent of the region, mm.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The region's boundary.
    pub fn boundary(&self) -> &Boundary {
        self.walls.boundary()
    }

    /// The offset at a distance (mm).
    ///
    /// # Errors
    /// Where the distance is not a positive number, or the raw curves contradict themselves.
    pub fn offset(&self, distance: f64) -> Result<Offset, OffsetError> {
        Ok(self.attempts(distance, false)?.offset)
    }

    /// The same with its interfering ranges: one for each convex vertex, so that they take more memory than the loops.
    ///
    /// # Errors
    /// As for [`PairwiseOffsetter::offset`].
    pub fn with_ranges(&self, distance: f64) -> Result<PairwiseOffset, OffsetError> {
        self.attempts(distance, true)
    }

    fn attempts(&self, distance: f64, with_ranges: bool) -> Result<PairwiseOffset, OffsetError> {
        check_distance(distance)?;
        let mut reason = String::new();
        for attempt in 0..ATTEMPTS {
            let d = distance + f64::from(attempt) * PERTURBATION * self.size;
            match self.attempt(d, with_ranges) {
                Ok(mut found) => {
                    found.offset.distance = distance;
                    return Ok(found);
                }
                Err(why) => reason = why,
            }
        }
        let reason =
            format!("the raw curves at {distance} mm contradict themselves ({reason}); use the voronoi engine");
        Err(OffsetError::Region { engine: PairwiseEngine.name(), reason })
    }

    fn attempt(&self, d: f64, with_ranges: bool) -> Result<PairwiseOffset, String> {
        let mut curves = RawCurves::with_capacity(self.elements.len());
        let mut ranges = Vec::new();
        for bounds in self.bounds.windows(2) {
            let contour = &self.elements[bounds[0] as usize..bounds[1] as usize];
            local::add_raw_curve(contour, d, &mut curves, &mut ranges);
        }
        global::loops(&curves, d, self, with_ranges.then_some(ranges.as_slice()))
    }
}
