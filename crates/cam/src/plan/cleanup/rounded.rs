//! Clean-up paths without a jerk, as in figure 12 of the paper: the tool leaves a corner of its loop straight on, turns back in an
//! arc, and comes in again straight on to the next side: a *drop*.
//!
//! A drop about the out-and-back path that it replaces leaves nothing that this would have cut. Let a point `x` be within
//! the tool's radius `r` of the path. Outside the drop, the way from `x` to the path crosses the drop, which is nearer. Inside,
//! the drop is no farther than the radius of its arc, which is at most `r`.
//!
//! No place of a drop is farther from the corner than its tip, and clearance falls no faster than way is made: so it stays as clear
//! of the walls as the outermost loop when its length is no more than the loop lies farther inside than that one.

use pocketry_geom::{Arc, Point, Segment, Vec2};

/// So many times as long as the path that it replaces a drop may be: half a circle's length over its diameter, and no more.
const LONGEST: f64 = 1.6;

/// The drop about a closed path from a corner where the tool arrives in the first direction and leaves in the second one, with
/// an arc of at most this radius, no longer than `room`; `None` where there is none or it takes too much longer.
pub(super) fn drop_around(
    tour: &[Segment],
    [before, after]: [Vec2; 2],
    radius: f64,
    room: f64,
) -> Option<Vec<Segment>> {
    let corner = tour.first()?.start();
    let turns_left = before.cross(after) >= 0.0;
    let axis = axis(before, after, turns_left);
    let (cos, sin) = (before.dot(axis), before.cross(axis).abs());
    // The circle in the wedge, its centre this far from the corner, that has a point within the drop.
    let around = |p: Point| {
        let to = p - corner;
        let along = to.dot(axis);
        let inside = along * along - to.length_squared() * cos * cos;
        (along > 0.0 && inside >= 0.0).then(|| to.length_squared() / (along + inside.sqrt()))
    };
    let mut center_at = 0.0_f64;
    for p in hull_points(tour).filter(|&p| p != corner) {
        center_at = center_at.max(around(p)?);
    }
    if center_at == 0.0 || center_at * sin > radius || center_at * (1.0 + sin) > room {
        return None;
    }
    let leg = center_at * cos;
    let [start, end] = [corner + before * leg, corner - after * leg];
    let (center, radius) = (corner + axis * center_at, center_at * sin);
    let farthest = center + axis * radius;
    let arc = |start, end| Segment::Arc(Arc { start, end, center, radius, ccw: !turns_left });
    let path = [Segment::line(corner, start), arc(start, farthest), arc(farthest, end), Segment::line(end, corner)];
    let drop: Vec<Segment> = path.into_iter().filter(|s| s.start() != s.end()).collect();
    let length = |path: &[Segment]| path.iter().map(Segment::length).sum::<f64>();
    (length(&drop) <= LONGEST * length(tour)).then_some(drop)
}

/// The direction out of a corner in the middle between straight on from before it and straight back from after it.
fn axis(before: Vec2, after: Vec2, turns_left: bool) -> Vec2 {
    let (across, along) = (before - after, before + after);
    if across.length_squared() > along.length_squared() {
        across.normalized()
    } else if turns_left {
        along.right().normalized()
    } else {
        along.left().normalized()
    }
}

/// Points whose convex hull holds a path.
fn hull_points(path: &[Segment]) -> impl Iterator<Item = Point> + '_ {
    let control = |s: &Segment| match s {
        // Where the tangents at both ends meet.
        Segment::Arc(a) => {
            let half = 0.5 * a.start.distance(a.end);
            Some(a.start + s.start_tangent() * (half / (0.5 * a.sweep()).cos()))
        }
        Segment::Line(_) => None,
    };
    path.iter().flat_map(move |s| [Some(s.start()), Some(s.end()), control(s)].into_iter().flatten())
}
