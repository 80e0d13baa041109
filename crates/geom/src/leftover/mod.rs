//! What a round tool leaves: the largest scallop and the area in corners and necks, from the skeleton (J. J. Chou and
//! E. Cohen, *Computing Offsets and Tool Paths With Voronoi Diagrams*, UUCS-89-017, 1990, section 4: "the maximum scallop
//! size … can be calculated automatically", which the paper leaves at that).
//!
//! # Definitions
//!
//! A tool of radius `r` that leaves `q` on the walls has to cut the points of the region with clearance `q` and more; its
//! axis gets to those with clearance `q + r` and more, and it cuts everything within `r` of these. What has to be cut and
//! isn't is the *leftover*. Its parts lie under connected pieces of skeleton with less clearance; where such a piece rises
//! to `q + r` it has a *mouth*. The *depth* of a point of the leftover is its distance from the nearest mouth of its piece,
//! less `r`: how far the material stands out from where the tool gets nearest. The *largest scallop* is the largest
//! depth. Between loops that are no more than `r` apart there is no leftover, so it is that of a whole tool path.
//!
//! No place of the axis that could be reached from the point on a way inside of the region is nearer than the nearest mouth: a way to it
//! leaves the piece between a mouth and one of its feet, and no place of the axis is nearer to a point there than the mouth
//! is. Places behind a wall don't count, however thin it is. For the same reason the disks at a piece's own mouths cut all
//! of it that is cut at all.
//!
//! Channels narrower than the tool by no more than [`degenerate_slack`](crate::offset::degenerate_slack) count as passable
//! here as in offsets: vertices with that little less clearance are reached.
//!
//! # Steps
//!
//! 1. **Zones** ([`zones`]): pieces of skeleton with their stretches of wall and their mouths, by one walk around each cell.
//! 2. **Outline and area** ([`outline`]): lines and arcs only, hence in closed form, whatever kinds of sites meet: what is
//!    left is bounded by walls and by arcs about mouths.
//! 3. **Deepest place** ([`deepest`]): in closed form too, on a wall or equally far from three mouths.
//! 4. **Necks** ([`necks`]): the narrowest place of the widest way between two mouths of a piece.
//!
//! Constant-clearance edges, islands, reflex vertices and arcs of any sense are no special cases. O(n log n) time.

mod deepest;
mod mouths;
mod necks;
mod outline;
#[cfg(test)]
mod tests;
mod zones;

use crate::offset::{OffsetError, check_distance};
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::Skeleton;
use crate::tolerance::CROSSING;
use mouths::Mouths;
use zones::{Band, Zone};

/// A round tool, as far as what it leaves goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Its radius, mm.
    pub radius: f64,
    /// What it is to leave on the walls, mm.
    pub stock_to_leave: f64,
}

impl Reach {
    /// A tool of this radius (mm) that goes to the walls.
    pub const fn of(radius: f64) -> Self {
        Self { radius, stock_to_leave: 0.0 }
    }

    /// How far from walls its axis stays, mm.
    pub fn axis(&self) -> f64 {
        self.radius + self.stock_to_leave
    }
}

/// How deep material is left, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Distance from what the tool cuts, mm.
    pub size: f64,
    /// The place.
    pub at: Point,
}

/// A bottleneck that the tool can't pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neck {
    /// Its narrowest place, in the middle between the walls.
    pub at: Point,
    /// Width there, from wall to wall, mm.
    pub width: f64,
}

/// An outermost place of the tool's axis, from where it looks into a piece of leftover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mouth {
    /// The place.
    pub at: Point,
    /// Distance to the walls (less the stock to leave), mm: the tool's radius but for the slack of channels just too narrow.
    pub radius: f64,
    /// Where its disk touches the walls to both sides; the piece lies to the left of the way from one to the other.
    pub feet: [Point; 2],
}

/// What a piece of leftover is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The tool looks in from one side.
    Corner,
    /// From two or more: between them are bottlenecks, or it lies all around an island.
    Neck,
    /// A pocket in which the tool fits nowhere.
    Pocket,
}

/// A connected piece of skeleton that the tool's axis can't enter, and what is left around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// What it is.
    pub kind: Kind,
    /// Area that is left, mm².
    pub area: f64,
    /// Its deepest place; none of a pocket in which the tool fits nowhere.
    pub deepest: Option<Depth>,
    /// Its bottlenecks, the widest first.
    pub necks: Vec<Neck>,
    /// Of a pocket in which the tool fits nowhere the widest place.
    pub widest: Option<Neck>,
    /// Its mouths.
    pub mouths: Vec<Mouth>,
    /// What is left as lines and arcs, in no order, the material to the left. It may fall into several parts.
    pub outline: Vec<Segment>,
}

/// All that a round tool leaves of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Leftover {
    /// The tool.
    pub reach: Reach,
    /// The pieces, in the order in which they follow along the walls.
    pub pieces: Vec<Piece>,
}

impl Leftover {
    /// What a tool leaves of the region of a skeleton.
    ///
    /// # Errors
    /// When the radius is not a positive number, or the stock to leave is not a number from 0 on.
    pub fn new(skeleton: &Skeleton, reach: Reach) -> Result<Self, OffsetError> {
        check_distance(reach.radius)?;
        if reach.stock_to_leave != 0.0 {
            check_distance(reach.stock_to_leave)?;
        }
        let band = Band::new(skeleton, reach);
        let pieces = band.zones().iter().filter_map(|zone| piece(zone, &band, reach)).collect();
        Ok(Self { reach, pieces })
    }

    /// Area of all pieces, mm².
    pub fn area(&self) -> f64 {
        // A sum of nothing would be a negative zero.
        self.pieces.iter().fold(0.0, |sum, p| sum + p.area)
    }

    /// The largest scallop: the deepest place of all pieces; none where the tool leaves nothing. Pockets in
    /// which it fits nowhere have no depth, see [`Self::pockets`].
    pub fn deepest(&self) -> Option<Depth> {
        self.pieces.iter().filter_map(|p| p.deepest).max_by(|a, b| a.size.total_cmp(&b.size))
    }

    /// All bottlenecks.
    pub fn necks(&self) -> impl Iterator<Item = &Neck> {
        self.pieces.iter().flat_map(|p| &p.necks)
    }

    /// The pockets in which the tool fits nowhere.
    pub fn pockets(&self) -> impl Iterator<Item = &Piece> {
        self.pieces.iter().filter(|p| p.kind == Kind::Pocket)
    }
}

/// The piece in a zone; none where nothing is left, as below the normal at a smooth joint.
fn piece(zone: &Zone, band: &Band<'_>, reach: Reach) -> Option<Piece> {
    let mouths = Mouths::new(&zone.mouths);
    let facing = zone.mouths.iter().filter(|m| m.facing().is_some()).count();
    let kind = match (zone.mouths.len(), facing) {
        (0, _) => Kind::Pocket,
        (_, 0 | 1) => Kind::Corner,
        _ => Kind::Neck,
    };
    let deepest = (kind != Kind::Pocket).then(|| deepest::deepest(zone, &mouths, reach.radius));
    let is_something = |d: &Depth| d.size > CROSSING * reach.axis();
    if !deepest.as_ref().is_none_or(is_something) {
        return None;
    }
    let outline = outline::outline(zone, &mouths);
    Some(Piece {
        kind,
        area: outline::area(&outline),
        deepest,
        necks: necks::necks(zone, band),
        widest: if kind == Kind::Pocket { widest(zone, band.skeleton) } else { None },
        mouths: zone.mouths.clone(),
        outline,
    })
}

/// The widest place of a pocket.
fn widest(zone: &Zone, skeleton: &Skeleton) -> Option<Neck> {
    let ends = zone.edges.iter().flat_map(|&e| [skeleton.origin(e), skeleton.target(e)]);
    let widest = ends.map(|v| skeleton.vertices()[v as usize]).max_by(|a, b| a.clearance.total_cmp(&b.clearance))?;
    Some(Neck { at: widest.point, width: 2.0 * widest.clearance })
}
