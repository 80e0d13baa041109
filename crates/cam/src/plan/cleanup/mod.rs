//! Clean-up paths: nothing is left uncut at any stepover up to the tool's diameter. After S. C. Park and B. K. Choi, *Uncut
//! free pocketing tool-paths generation using pair-wise offset algorithm*, Computer-Aided Design 33, 2001, section 3.
//!
//! Let loops lie at the distances `d` and `d + w`, the tool's radius be `r < w <= 2r`. A point `x` of clearance `c` is missed
//! by the loop at `d` where `c > d + r`. From its nearest wall through `x` the way leads on to a place `p` of the skeleton,
//! of clearance `m`. If `m >= d + w`, the way crosses the inner loop after at most `w - r <= r`: `x` is cut. So what may be
//! uncut belongs to the *interfering range*: the pieces of the skeleton with clearance in `(d + r, d + w)`. A place `p`
//! answers for the points within its *reach*, `m - (d + r) <= w - r <= r`; a tool that visits all of a piece leaves nothing.
//!
//! The ends of a piece on the inner loop are the paper's *degenerate vertices*: none make it a centre, one a corner, several
//! a neck ([`Uncut`]). The ends at `d + r` are where the clean-up curve comes to a point.
//!
//! 1. A piece becomes a graph of places joined by lines and arcs ([`Piece`]): all that an engine has to provide (`pieces`
//!    for the skeleton, `pairwise::ranges` for the pair-wise engine). The rest is the same for all (`gather`).
//! 2. Each place is led to its nearest root: the degenerate vertices, or a place of the outer loop where there are none
//!    (`forest`).
//! 3. From the tips of each tree the path is cut back as far as what lies behind stays within `r` of its end (`prune`).
//!    Nothing may be left of it: then nothing was uncut.
//! 4. What is left is travelled out and back when the tool passes the root, without a retract.
//! 5. It hangs on the loop as that is travelled (`hang`), entered and left in the loop's direction: at a corner as a bulge that
//!    cuts the corner (`bulge`), or as a drop, where a side is smooth as a circle (`rounded`).
//! 6. A group of loops may start at the tip of a path: then it is travelled once. Where the tool lifts does not depend on clean-up.
//!
//! Departures from the paper. It takes a range for uncut if its clean-up curve is farther than `r` from *one* degenerate
//! vertex; here it must be farther from every place of the path. It mills along the clean-up curve; here the
//! path is the skeleton, which is shorter and as clear of walls as can be. Long paths into narrow corners that branch or bend
//! are left as they are: there the tool turns where the skeleton does, and at its tips.
//!
//! Along a line or a short arc `|s - p| + reach(p)`, which decides whether a stop at `s` serves `p`, is convex where clearance
//! is (lines, points, arcs seen from outside); arcs seen from inside are walked in steps of [`CLEANUP_STEP`] radii. So ends
//! decide, but for less than a tenth of what the proof lets pass.

mod bulge;
mod forest;
mod gather;
mod hang;
mod pieces;
mod prune;
mod rounded;
#[cfg(test)]
mod tests;

use pocketry_geom::offset::degenerate_slack;
use pocketry_geom::skeleton::SiteId;
use pocketry_geom::{Point, Segment};
use serde::Serialize;

pub(super) use gather::{CANDIDATES, Gathered, gather};
pub(super) use hang::{hang, mark_entrances};
pub(super) use pieces::of_skeleton;

/// What kind of place would stay uncut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Uncut {
    /// Between a loop's corner and the wall's.
    Corner,
    /// Inside a loop that no other one follows.
    Center,
    /// Between inner loops that a narrow place parts.
    Neck,
}

/// A clean-up path: out and back from a loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cleanup {
    /// What would be uncut without it.
    pub kind: Uncut,
    /// Where it starts and ends.
    pub start: Point,
    /// Its length, mm: there and back, or one way where the tool comes in by it.
    pub length: f64,
}

/// A place of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) at: Point,
    /// The points this place answers for lie within this distance of it; negative: none.
    pub(crate) reach: f64,
}

/// A way between two places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Way {
    pub(crate) ends: [u32; 2],
    /// From the first end to the second.
    pub(crate) segment: Segment,
}

/// A way out of a place: straight from it to one of its nearest walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exit {
    pub(crate) place: u32,
    /// The wall.
    pub(crate) site: SiteId,
    /// Where it meets the outer loop.
    pub(crate) at: Point,
}

/// An interfering range between two distances, as a graph on which the tool may travel and which answers for all that
/// might be uncut there. It is all that an engine has to provide.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Piece {
    /// Clearance on all of its ways, at the least, mm.
    pub(crate) least: f64,
    pub(crate) places: Vec<Place>,
    pub(crate) ways: Vec<Way>,
    /// The degenerate vertices: places on the inner loop, with its track and the segment of it that starts there.
    pub(crate) roots: Vec<(u32, (u32, u32))>,
    /// Where there are no roots, ways to the outer loop to choose from.
    pub(crate) exits: Vec<Exit>,
}

impl Piece {
    pub(crate) fn kind(&self) -> Uncut {
        match self.roots.len() {
            0 => Uncut::Center,
            1 => Uncut::Corner,
            _ => Uncut::Neck,
        }
    }
}

/// What a tool of this radius is trusted to cut about its axis: a slack for chords and rounding is left.
pub(crate) fn trusted(radius: f64) -> f64 {
    radius - degenerate_slack(radius)
}
