//! What a profile that turns with the walls must cut.
//!
//! Its x axis is kept along the nearest wall, which lies to its right. Two things must be cut:
//!
//! 1. all that it covers at places where it touches a wall: equation 6 of Molina-Carmona, Jimeno and Davia. They lie on the parallels of
//!    the walls, and on arcs about reflex corners, at the distance to which the profile reaches on its −y side. Each is followed: some
//!    place of the path lies within the tolerance of it, with the profile's direction, or the profile would certainly enter a wall there;
//! 2. all points so far from the walls that the profile can turn freely about them. The plane is divided into cells for these.
//!
//! Between the two it may cut more, and the planner does; that is not asked for.

use super::places::Places;
use super::pose::{Body, Part};
use crate::outline::{Side, parallel};
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::tolerance::proof::{CUSP, SMOOTH_JOINT};
use pocketry_geom::{Arc, Segment};
use std::f64::consts::{PI, TAU};

/// A curve is divided until its parts are shorter than this share of the tube about the path, and of what the profile has to spare: between
/// two smooth walls the one changes as slowly as the other.
const FINEST: f64 = 0.05;

/// The share of the distance to spare that a touching profile must have from all walls; it has all of it from the one it touches.
const SPARE: f64 = 0.5;

/// The path of a profile that turns.
pub(crate) struct Path<'a> {
    pub(crate) parts: &'a [Part],
    pub(crate) tree: &'a Tree,
    /// How far from it a place counts as visited, mm.
    pub(crate) tube: f64,
}

/// A place at which the profile touches a wall that is not known to be on the path, if any.
pub(crate) fn off_the_path(walls: &Walls, places: &Places, path: &Path, touch: f64) -> Option<pocketry_geom::Point> {
    touching(walls, touch).into_iter().find_map(|curve| unvisited(places, path, curve))
}

/// The curves on which the profile touches walls, with its x axis along them.
fn touching(walls: &Walls, touch: f64) -> Vec<Segment> {
    let mut curves = Vec::new();
    for (wall, &next) in walls.segments.iter().zip(&walls.next) {
        curves.extend(parallel(wall, touch, Side::Left));
        let (arriving, leaving) = (wall.end_tangent(), walls.segments[next as usize].start_tangent());
        let turn = arriving.angle_to(leaving);
        if (-SMOOTH_JOINT..=PI - CUSP).contains(&turn) {
            continue;
        }
        let (center, radius) = (wall.end(), touch);
        let arm = |v: pocketry_geom::Vec2| center + v.left() * radius;
        curves.push(Segment::Arc(Arc { start: arm(arriving), end: arm(leaving), center, radius, ccw: false }));
    }
    curves
}

/// A place of such a curve where the profile may be, and that is not visited.
fn unvisited(places: &Places, path: &Path, curve: Segment) -> Option<pocketry_geom::Point> {
    let mut rest = vec![curve];
    while let Some(part) = rest.pop() {
        let middle = part.at(0.5);
        let angle = part.start_tangent().angle() + if let Segment::Arc(a) = part { 0.5 * a.sweep() } else { 0.0 };
        let half = 0.5 * part.length();
        let turned = if let Segment::Arc(a) = part { 0.5 * a.sweep().abs() * places.shape.reach } else { 0.0 };
        if places.exclude_turned(middle, angle, half + turned, SPARE) || visited(places, path, &part, half + turned) {
            continue;
        }
        if half < FINEST * path.tube.min(SPARE * places.distance) {
            return Some(middle);
        }
        let (first, second) = part.split_at(middle);
        rest.extend([second, first]);
    }
    None
}

/// Whether all places of a curve, half of which moves the profile by `half`, lie in the tube of one piece of the path.
fn visited(places: &Places, path: &Path, curve: &Segment, half: f64) -> bool {
    if half >= path.tube {
        return false;
    }
    let middle = curve.at(0.5);
    let angle = curve.start_tangent().angle() + if let Segment::Arc(a) = curve { 0.5 * a.sweep() } else { 0.0 };
    let mut found = false;
    path.tree.near_by_id(&Segment::line(middle, middle), path.tube, |k, way| {
        let part = &path.parts[k as usize];
        let apart = way.distance(middle);
        let off = match part.body {
            // On the spot: within what it turns through.
            Body::About { by, .. } if part.curve.start() == part.curve.end() => {
                let ahead = (angle - part.angle) * by.signum();
                let ahead = (ahead + PI).rem_euclid(TAU) - PI;
                (ahead - by.abs()).max(-ahead).max(0.0)
            }
            Body::Shift => off(angle - part.angle),
            Body::About { by, .. } => off(angle - (part.angle + by * share(way, way.nearest(middle)))),
        };
        found = found || apart + off * places.shape.reach + half <= path.tube;
        !found
    });
    found
}

/// An angle's distance from a whole number of turns.
fn off(angle: f64) -> f64 {
    let over = angle.rem_euclid(TAU);
    over.min(TAU - over)
}

/// Where on an arc one of its points lies, as a share of its length.
fn share(arc: &Segment, p: pocketry_geom::Point) -> f64 {
    let Segment::Arc(a) = arc else { return 0.0 };
    let ahead = (a.start - a.center).angle_to(p - a.center) * a.sweep().signum();
    let ahead = if ahead < -CUSP { ahead + TAU } else { ahead };
    (ahead / a.sweep().abs()).clamp(0.0, 1.0)
}
