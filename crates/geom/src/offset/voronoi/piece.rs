//! The part of a site's parallel between two crossings.

use crate::point::Point;
use crate::segment::{Arc, Segment};
use crate::skeleton::SiteShape;
use std::f64::consts::{PI, TAU};

/// The segment at distance `d` from a site, from `start` to `end`.
///
/// An arc that rounding has turned round (its end before its start, so that it would run almost the whole circle) is
/// replaced by its chord.
pub(crate) fn parallel_piece(shape: SiteShape, d: f64, start: Point, end: Point) -> Segment {
    let (arc, limit) = match shape {
        SiteShape::Line(_) => return Segment::line(start, end),
        SiteShape::Point(center) => (Arc { start, end, center, radius: d, ccw: false }, PI.midpoint(TAU)),
        SiteShape::Arc(a) => {
            let radius = if a.ccw { a.radius - d } else { a.radius + d };
            (Arc { start, end, center: a.center, radius, ccw: a.ccw }, a.sweep().abs().midpoint(TAU))
        }
    };
    // Less than half a turn is below any limit: a sign tells it, without the angle.
    let turn = (start - arc.center).cross(end - arc.center);
    let is_short = if arc.ccw { turn > 0.0 } else { turn < 0.0 };
    if arc.radius > 0.0 && (is_short || arc.sweep().abs() <= limit) {
        Segment::Arc(arc)
    } else {
        Segment::line(start, end)
    }
}
