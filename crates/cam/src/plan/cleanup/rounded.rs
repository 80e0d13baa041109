//! Clean-up paths without a jerk, as in figure 12 of the paper: the tool leaves a corner of its loop straight on, turns back in an
//! arc, and comes in again straight on to the next side: a *drop*.
//!
//! A drop about the out-and-back path that it replaces leaves nothing that this would have cut. Let a point `x` be within
//! the tool's radius `r` of the path. Outside the drop, the way from `x` to the path crosses the drop, which is nearer. Inside,
//! the drop is no farther than the radius of its arc, which is at most `r`.
//!
//! Clearance falls no faster than way is made. So a drop is as clear of walls as the outermost loop when its tip is no farther from
//! the corner than the loop lies inside that one, or no place of it farther from the path than that keeps to spare ([`Room`]).

use crate::plan::length_of;
use pocketry_geom::{Arc, Point, Segment, Vec2};

/// So many times as long as the path that it replaces a drop may be: half a circle's length over its diameter, and no more.
const LONGEST: f64 = 1.6;

/// Cosine of the angle between two directions that count as square to each other.
const SQUARE: f64 = 0.02;

/// How far from what the tool may stray until it is as near to walls as on the outermost loop, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// From the loop on which the path hangs.
    pub(super) about_loop: f64,
    /// From the path.
    pub(super) about_tour: f64,
}

impl Room {
    /// Whether a path instead of a tour has room whose farthest place is so far away from the loop.
    pub(super) fn holds(&self, path: &[Segment], tour: &[Segment], farthest: f64) -> bool {
        let apart = |p: Point| tour.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        let places = || path.iter().flat_map(|s| (0..=SAMPLES).map(|k| s.at(f64::from(k) / f64::from(SAMPLES))));
        farthest <= self.about_loop || places().all(|p| apart(p) <= SPARED * self.about_tour)
    }
}

/// Places of each segment of a path at which it is seen how far away it is.
const SAMPLES: u32 = 8;

/// Share of the room about a path that is used: the rest is for what is between the samples.
const SPARED: f64 = 0.8;

/// The drop about a closed path from a corner where the tool arrives in the first direction and leaves in the second one, with
/// an arc of at most this radius; `None` where there is none or it takes too much longer.
pub(super) fn drop_around(
    tour: &[Segment],
    [before, after]: [Vec2; 2],
    radius: f64,
    room: Room,
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
    if center_at == 0.0 || center_at * sin > radius {
        return None;
    }
    let tip_at = center_at * (1.0 + sin);
    let leg = center_at * cos;
    let [start, end] = [corner + before * leg, corner - after * leg];
    let (center, radius) = (corner + axis * center_at, center_at * sin);
    let farthest = center + axis * radius;
    let arc = |start, end| Segment::Arc(Arc { start, end, center, radius, ccw: !turns_left });
    let path = [Segment::line(corner, start), arc(start, farthest), arc(farthest, end), Segment::line(end, corner)];
    let drop: Vec<Segment> = path.into_iter().filter(|s| s.start() != s.end()).collect();
    (length_of(&drop) <= LONGEST * length_of(tour) && room.holds(&drop, tour, tip_at)).then_some(drop)
}

/// The circle about a straight path, out and back, that leaves square to a smooth place of a loop which is travelled in these
/// directions before and after it. Inside the loop the path leads straight away from the wall, and so the circle is as clear of
/// walls as the loop; outside it must be no wider than there is room about the loop.
pub(super) fn circle_about(
    tour: &[Segment],
    [before, after]: [Vec2; 2],
    radius: f64,
    room: Room,
) -> Option<Vec<Segment>> {
    let [Segment::Line(out), Segment::Line(_)] = tour else { return None };
    let (foot, tip) = (out.start, out.end);
    let (aside, center) = (out.direction(), foot.midpoint(tip));
    let half = foot.distance(center);
    let is_inside = before.cross(aside) > 0.0;
    let is_square = [before, after].iter().all(|t| t.dot(aside).abs() <= SQUARE && t.dot(before) > 0.0);
    if !is_square || half > radius || (!is_inside && 2.0 * half > room.about_loop) {
        return None;
    }
    let arc = |start, end| Segment::Arc(Arc { start, end, center, radius: half, ccw: is_inside });
    Some(vec![arc(foot, tip), arc(tip, foot)])
}

/// The direction out of a corner in the middle between straight on from before it and straight back from after it.
pub(super) fn axis(before: Vec2, after: Vec2, turns_left: bool) -> Vec2 {
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
pub(super) fn hull_points(path: &[Segment]) -> impl Iterator<Item = Point> + '_ {
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
