//! Offsets by any cross-section: the morphological erosion of R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing
//! computation using mathematical morphology*, section 2.
//!
//! The erosion of a region by a profile `B` is the set of places of the profile's reference point at which the profile lies in the
//! region. Equations 3 and 4 of the paper disagree about touching; here containment is closed: a profile may touch walls.
//!
//! 1. *Instant basic erosions* along the trajectory (`elements`, `pieces`): at every boundary point the profile touches from
//!    inside with the point of its contour that has the same direction; at corners the direction sweeps. For lines and arcs
//!    these places are lines and arcs again, and so are computed whole instead of at steps: a line moves by a corner of the
//!    profile, an arc of radius `R` and one of radius `r` make an arc of radius `R ± r`. Only where the profile bends
//!    at least as much as the wall can it touch from inside at all.
//! 2. *Collision* (`collision`): a piece whose profile reaches into a wall by more than half the piece's length is
//!    discarded as a whole. A spatial index answers, so that tests take far fewer than the paper's `n · m` steps.
//! 3. Crossings of what is left, found through an index (`crossings`), rather than gaps as in the paper.
//! 4. Loops (`chains`): at a crossing the piece from which the other turns left goes below, for the erosion lies to the left of
//!    both; so every part of a piece has one successor or none. Successions that come back are candidates, and collision
//!    tests on some places of each decide; a loop that is free here and buried there is a contradiction.
//!
//! **Exactness.** With lines and arcs on both sides there is no step, and so no error of one. The profile is grown by a
//! trifle first, so that slots exactly as wide as it vanish, whatever the rounding.
//!
//! **Robustness.** Where rounding makes the successions contradict the collisions, corners of the region are moved by a few
//! touch lengths, and all is done anew, a few times at most.

mod chains;
mod collision;
mod crossings;
mod elements;
mod general;
mod pieces;

#[cfg(test)]
mod tests;

use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::nesting;
use crate::point::Point;
use crate::region::Region;
use crate::segment::Segment;
use crate::tolerance::profile::{ATTEMPTS, RANGE_GROWTH, SHORTEST};
use crate::tolerance::touch_length;
use collision::Collider;
use elements::Elements;
use pieces::trajectory;

/// Why a region could not be eroded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MorphologyError {
    /// The outline of the places at which the profile may be does not close.
    #[error(
        "the places of this tool profile have no clear outline near ({:.4}, {:.4}); look for walls there that run along one another \
         within a micrometre, or change the profile's size a little",
        .at.x, .at.y
    )]
    Outline {
        /// A place of the tool there.
        at: Point,
    },
}

/// The places at which a profile lies in a region; empty where it fits nowhere. The profile is a counter-clockwise contour, convex or
/// not, about its reference point at the origin; `inside` is a point within it.
///
/// # Errors
/// Where the outline of the places does not close, with a place.
pub fn eroded(region: &Region, profile: &Contour, inside: Point) -> Result<Region, MorphologyError> {
    let (bbox, tool) = (region.bbox(), profile.bbox());
    if bbox.is_empty() || tool.width() > bbox.width() || tool.height() > bbox.height() {
        return Ok(Region::default());
    }
    let mut first = None;
    let mut range = 0.0;
    for seed in 0..ATTEMPTS {
        match attempt(region, profile, inside, range, u64::from(seed)) {
            Ok(loops) => {
                let parents = nesting::parents(&loops);
                return Ok(Region::from_parts_unchecked(loops, parents));
            }
            Err(at) => first = first.or(Some(at)),
        }
        range = if range == 0.0 { touch_length(bbox) } else { range * RANGE_GROWTH };
    }
    Err(MorphologyError::Outline { at: first.unwrap_or_default() })
}

/// The loops with corners moved by up to `range`, or a place that contradicts itself.
fn attempt(region: &Region, profile: &Contour, inside: Point, range: f64, seed: u64) -> Result<Vec<Contour>, Point> {
    let bbox = region.bbox();
    let (middle, unit) = (bbox.center().to_vec(), touch_length(bbox));
    let walls = general::moved(region.contours(), middle, range, SHORTEST * unit.max(range), seed);
    // Moved walls come nearer to one another by less than this.
    let profile = general::grown(profile, inside, unit.max(4.0 * range));
    let segments: Vec<Segment> = walls.iter().flat_map(|c| c.segments.iter().copied()).collect();
    let index = SegmentIndex::new(&segments);
    let pieces = trajectory(&Elements::new(walls.iter()), &Elements::new(std::iter::once(&profile)));
    let loops = chains::loops(&pieces, &Collider::new(&index, &profile), unit.max(range)).map_err(|p| p + middle)?;
    Ok(loops.iter().map(|c| c.translated(middle)).collect())
}
