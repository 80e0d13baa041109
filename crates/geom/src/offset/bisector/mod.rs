//! Mitre-joined offsets from bisectors: H.-C. Kim, S.-G. Lee and M.-Y. Yang, *A new offset algorithm for closed 2D lines
//! with islands*, Int. J. Adv. Manuf. Technol. 29, 2006.
//!
//! The steps, with the paper's sections:
//!
//! 1. [`corner`]: the offset point of every vertex lies on its bisector, equations (1) to (3) (section 2);
//! 2. [`raw`]: offset edges whose direction is reversed are invalid; the backward and the forward edge around one are
//!    extended to where they meet (case I), around several as often as that is allowed (case II), and what is left of
//!    them is offset pair-wise (section 3);
//! 3. [`grid`], [`crossings`]: intersections by the grid method;
//! 4. [`trace`]: loops are traced along the direction of travel, changing over at every intersection, boundary and
//!    islands alike, and selected (sections 4 and 5);
//!    Where edges crowd, those that are surely [`covered`] are left out of steps 3 and 4;
//! 5. [`unproven`]: shortcuts of step 2 that are not certain beforehand are checked against the loops found.
//!
//! # What is computed
//!
//! With S the strips of depth d along the edges (on the pocket's side) and K the mitres that fill the gaps between the
//! strips at reflex vertices, the offset bounds the region without S and K: what every mitre offset by winding numbers
//! means. Its differences from the round offset (the exact engine's) are all at reflex vertices: the loop keeps corners there
//! instead of arcs, and stays d/cos(φ/2) away from a vertex that turns by φ. Mitres are not stopped by walls: a long one
//! takes away what lies behind a thin wall, too. [`BisectorEngine::mitre_limit`] cuts long ones.
//!
//! # Why it is right
//!
//! The raw curve's winding number is that of the region minus one for each strip and mitre, plus one for each kite: the
//! quadrangle of a convex vertex, its offset point, and the ends there of the offset edges of both of its edges, which the
//! bisector cuts off. Where a kite lies in both strips (as far as it lies in the pocket), it can't make up for both: k kites in a row
//! lie in k + 1 strips. So positive winding numbers mean exactly the points outside S and K, if the curve goes back to the vertex itself at
//! convex vertices with kites that reach out of the strips (pair-wise), and at one vertex of a convex contour with invalid edges.
//! [`raw`] says when an invalid edge may be left out.
//!
//! Tracing resolves each intersection into two corners, on both sides of which the winding number is constant: it is carried
//! from loop to loop, and must come out the same on every way. The paper takes loops of the profile's own direction; that
//! accepts a loop inside of an invalid one, so here the winding number decides.
//!
//! Crossings are decided by exact predicates, their order along an edge by parameters with error bounds. Where
//! corners lie on edges, edges on edges or three lines meet in a point, the raw corners are moved by a trillionth of the region's
//! size and the distance grown by a little more (controlled perturbation; see [`crate::tolerance::bisector`]). What can't be decided
//! even so is an error that names the place.
//!
//! # Departures
//!
//! - The paper's *convex* is an interior angle above π, called reflex here, as everywhere else.
//! - Section 3's "more than two" of case II must be "more than one".
//! - (1) and (2) lose all digits near θ = π and θ = 0; [`corner`] has forms that do not.
//! - Case I as printed also extends edges where the invalid edge ends at a reflex vertex, and where the lines meet
//!   outside of both: both fail at a bulb behind a narrow neck. It is restricted to where it is proven or checked.
//! - Arcs become chords within [`BisectorEngine::chord_tolerance`]; loops consist of lines only, and have neither sites nor
//!   skeleton crossings. Paths along channels exactly as wide as the tool are not kept.
//!
//! Raw curve: O(n). Grid: O(n) for edges of similar lengths; edges much longer than the gaps between them
//! go through the segment tree instead, O((n + k) log n) for k crossings.

mod corner;
mod covered;
mod crossings;
mod grid;
mod leftover;
mod profile;
mod raw;
mod solve;
#[cfg(test)]
mod tests;
mod trace;
mod unproven;

pub use leftover::{MitreLeftover, mitre_leftovers};

use super::{Offset, OffsetEngine, OffsetError, OffsetLoop, OffsetOptions, check_distance};
use crate::contour::Contour;
use crate::nesting;
use crate::point::Point;
use crate::region::Region;
use crate::tolerance;
use rayon::prelude::*;

/// The engine of bisectors: mitre-joined offsets of polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BisectorEngine {
    /// Largest distance of a loop's corner from its reflex vertex, as a multiple of the offset distance (at least 1);
    /// beyond it the corner is cut square at the offset distance, the nearest that does not gouge. `None`: no limit, as in the paper.
    pub mitre_limit: Option<f64>,
    /// How far the chords that replace arcs may lie from them, mm.
    pub chord_tolerance: f64,
}

impl Default for BisectorEngine {
    fn default() -> Self {
        Self { mitre_limit: None, chord_tolerance: tolerance::FIT }
    }
}

impl OffsetEngine for BisectorEngine {
    fn name(&self) -> &'static str {
        "bisector"
    }

    fn offsets(&self, region: &Region, distances: &[f64], _: &OffsetOptions) -> Result<Vec<Offset>, OffsetError> {
        self.check()?;
        let profiles = profile::Profiles::new(region, self.chord_tolerance);
        distances.par_iter().map(|&d| self.offset(&profiles, check_distance(d)?)).collect()
    }
}

impl BisectorEngine {
    fn check(&self) -> Result<(), OffsetError> {
        let refuse = |reason: String| Err(OffsetError::Region { engine: self.name(), reason });
        if self.mitre_limit.is_some_and(|l| l.is_nan() || l < 1.0) {
            return refuse(format!("mitre limit {:?}: it must be 1 or more", self.mitre_limit.unwrap_or_default()));
        }
        if !(self.chord_tolerance > 0.0 && self.chord_tolerance.is_finite()) {
            return refuse(format!("chord tolerance {} mm: it must be a positive number", self.chord_tolerance));
        }
        Ok(())
    }

    fn offset(&self, profiles: &profile::Profiles, distance: f64) -> Result<Offset, OffsetError> {
        let polygons = solve::polygons(profiles, distance, self.mitre_limit).map_err(|at| OffsetError::Region {
            engine: self.name(),
            reason: format!(
                "the offset at {distance} mm can't be decided near ({:.4}, {:.4}): too many edges meet in one place; \
                 change the distance a little or use another engine",
                at.x, at.y
            ),
        })?;
        let loops = polygons.iter().map(|p| OffsetLoop { contour: closed(p), ..OffsetLoop::default() }).collect();
        Ok(Offset { distance, loops, degenerate: Vec::new() })
    }
}

/// What remains inside an offset, its islands assigned to their boundaries: the profile of the next offset.
pub fn remaining(offset: &Offset) -> Region {
    let contours: Vec<Contour> = offset.loops.iter().map(|l| l.contour.clone()).collect();
    let parents = nesting::parents(&contours);
    Region::from_parts_unchecked(contours, parents)
}

fn closed(points: &[Point]) -> Contour {
    let next = |k: usize| points[(k + 1) % points.len()];
    Contour::new((0..points.len()).map(|k| crate::Segment::line(points[k], next(k))).collect())
}
