//! The region's contours as closed sequences of straight edges.

use crate::bbox::BBox;
use crate::point::{Point, Vec2};
use crate::predicates::orientation;
use crate::region::Region;
use crate::segment::Segment;

/// A straight edge of a profile, possibly extended beyond its own ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Where it begins.
    pub(super) start: Point,
    /// Unit direction of travel; the pocket lies to the left.
    pub(super) direction: Vec2,
    /// Length, mm.
    pub(super) length: f64,
    /// Tangent of half the turn at its start, from the edge before: positive at convex vertices, 0 at parallel ones.
    pub(super) half_turn: f64,
}

impl Edge {
    /// Where it ends.
    pub(super) fn end(&self) -> Point {
        self.start + self.direction * self.length
    }
}

/// All contours of a region.
#[derive(Clone, Debug)]
pub(super) struct Profiles {
    /// The edges of each contour in order of travel.
    pub(super) loops: Vec<Vec<Edge>>,
    /// The box of their points.
    pub(super) bbox: BBox,
}

impl Profiles {
    /// The contours with chords in the place of arcs, no farther from them than `tolerance`.
    pub(super) fn new(region: &Region, tolerance: f64) -> Self {
        let mut loops = Vec::with_capacity(region.contours().len());
        let mut points = Vec::new();
        for contour in region.contours() {
            points.clear();
            contour.segments.iter().for_each(|s: &Segment| s.flatten(tolerance, &mut points));
            points.dedup();
            while points.len() > 1 && points.first() == points.last() {
                points.pop();
            }
            if points.len() > 2 {
                loops.push(edges(&points));
            }
        }
        Self { loops, bbox: region.bbox() }
    }
}

fn edges(points: &[Point]) -> Vec<Edge> {
    let n = points.len();
    let spans: Vec<(Vec2, f64)> = (0..n)
        .map(|k| {
            let span = points[(k + 1) % n] - points[k];
            let length = span.length();
            (span / length, length)
        })
        .collect();
    (0..n)
        .map(|k| {
            let before = (k + n - 1) % n;
            let ((came, came_length), (direction, length)) = (spans[before], spans[k]);
            let twice_area = orientation(points[before], points[k], points[(k + 1) % n]);
            let sine = twice_area / (came_length * length);
            Edge { start: points[k], direction, length, half_turn: half_turn(sine, came.dot(direction)) }
        })
        .collect()
}

/// Tangent of half an angle in (−π, π) from its sine and cosine, with all the digits that the sine has.
pub(super) fn half_turn(sine: f64, cosine: f64) -> f64 {
    if cosine >= 0.0 {
        sine / (1.0 + cosine)
    } else if sine == 0.0 {
        f64::NEG_INFINITY
    } else {
        (1.0 - cosine) / sine
    }
}
