//! Ways between loops on which the tool stays down.
//!
//! Every way is clear of the walls by construction:
//!
//! - A *side-step* leads from a point straight towards its nearest wall. Clearance falls along it exactly like length
//!   (the disk about each point of the way lies inside the disk about its start), so after the difference
//!   of the distances it is on the outer loop, and never nearer to a wall.
//! - A *medial way* leads along a loop that is already cut, and along edges of the skeleton whose clearance is above the
//!   loops' distance. It serves what a straight step would miss: the loops around islands.

mod fit;
mod medial;

pub(crate) use fit::fitted;
pub(crate) use medial::{Fans, medial_way};

use pocketry_geom::skeleton::SiteShape;
use pocketry_geom::{Point, Vec2};

/// The direction from `p` to the nearest point of a site's line or circle; any, where the centre of an arc is meant.
pub(crate) fn towards(shape: SiteShape, p: Point) -> Vec2 {
    let to = |foot: Point| (foot - p).normalized();
    match shape {
        SiteShape::Line(l) => l.direction().right(),
        SiteShape::Arc(a) if p == a.center => to(a.start),
        SiteShape::Arc(a) if a.ccw => -to(a.center),
        SiteShape::Arc(a) => to(a.center),
        SiteShape::Point(q) => to(q),
    }
}
