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
//! 2. *Collision* (`collision`, `living`): a piece whose profile reaches into a wall by more than half the piece's length is
//!    discarded as a whole; crowds are halved. A spatial index answers, so that tests take far fewer than the paper's `n · m` steps.
//! 3. Crossings of what is left, found through an index (`crossings`), rather than gaps as in the paper.
//! 4. Loops (`chains`): at a crossing the piece from which the other turns left goes below, for the erosion lies to the left of
//!    both; so every part of a piece has one successor or none. Successions that come back are candidates, and collision
//!    tests on some places of each decide; a loop that is free here and buried there is a contradiction.
//!
//! Dilation, opening and closing follow from erosion (`dilation`).
//!
//! **Exactness.** With lines and arcs on both sides there is no step, and so no error of one. The profile is grown by a
//! trifle first, so that slots exactly as wide as it vanish, whatever the rounding: by its size times [`FIRST_TURN`] and a few touch
//! lengths where it is narrowest, in proportion elsewhere.
//!
//! **Robustness** (`disturbance`). The walls of drawings are often parallel to edges of the profile, and so places coincide: the
//! profile is turned by [`FIRST_TURN`] before anything else. Where the successions still contradict the collisions, it is turned
//! farther, contours or corners of the region are moved by some touch lengths, and all is done anew, a few times at most.
//!
//! [`FIRST_TURN`]: crate::tolerance::profile::FIRST_TURN

mod chains;
mod collision;
mod crossings;
mod dilation;
mod disturbance;
mod elements;
mod living;
mod pieces;

#[cfg(test)]
mod tests;

pub use dilation::{closed, dilated, opened};

use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::nesting;
use crate::point::Point;
use crate::region::Region;
use crate::segment::Segment;
use crate::tolerance::profile::ATTEMPTS;
use crate::tolerance::touch_length;
use collision::Collider;
use disturbance::Disturbance;
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
    for attempt in 0..ATTEMPTS {
        match outline(region, profile, inside, &Disturbance::new(attempt, touch_length(bbox))) {
            Ok(loops) => {
                let parents = nesting::parents(&loops);
                return Ok(Region::from_parts_unchecked(loops, parents));
            }
            Err(at) => first = first.or(Some(at)),
        }
    }
    Err(MorphologyError::Outline { at: first.unwrap_or_default() })
}

/// The loops with region and profile disturbed, or a place that contradicts itself.
fn outline(region: &Region, profile: &Contour, inside: Point, by: &Disturbance) -> Result<Vec<Contour>, Point> {
    let middle = region.bbox().center().to_vec();
    let walls = by.moved(region.contours(), middle);
    let profile = by.grown(profile, inside);
    let segments: Vec<Segment> = walls.iter().flat_map(|c| c.segments.iter().copied()).collect();
    let index = SegmentIndex::new(&segments);
    let pieces = trajectory(&Elements::new(walls.iter()), &Elements::new(std::iter::once(&profile)));
    let loops = chains::loops(&pieces, &Collider::new(&index, &profile, inside), by.range).map_err(|p| p + middle)?;
    Ok(loops.iter().map(|c| c.translated(middle)).collect())
}
