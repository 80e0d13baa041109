//! Minkowski sums of convex contours.
//!
//! Both are travelled counter-clockwise at once: where they turn to a direction that is a line's, the lines of that
//! direction follow one another; between two such directions what both bend adds up.

use crate::contour::Contour;
use crate::point::{Point, Vec2};
use crate::segment::{Arc, Segment};
use crate::tolerance::profile::PARALLEL;
use std::f64::consts::TAU;

/// All sums of a point of one convex contour's inside and one of the other's, both counter-clockwise.
pub fn convex_sum(a: &Contour, b: &Contour) -> Contour {
    let edges: Vec<Edge> = a.segments.iter().chain(&b.segments).map(Edge::new).collect();
    let stops = directions(&edges);
    let mut segments: Vec<Segment> = Vec::with_capacity(edges.len());
    let mut at = Point::ORIGIN;
    for (k, &stop) in stops.iter().enumerate() {
        let along = edges.iter().filter_map(|e| e.line_along(stop)).fold(Vec2::default(), |sum, v| sum + v);
        if along != Vec2::default() {
            segments.push(Segment::line(at, at + along));
            at += along;
        }
        let turn = (stops[(k + 1) % stops.len()] - stop).rem_euclid(TAU);
        let radius: f64 = edges.iter().filter_map(|e| e.radius_at(stop + 0.5 * turn)).sum();
        if radius > 0.0 {
            let [from, to] = [stop, stop + turn].map(Vec2::from_angle);
            let center = at + from.left() * radius;
            let end = center + to.right() * radius;
            segments.push(Segment::Arc(Arc { start: at, end, center, radius, ccw: true }));
            at = end;
        }
    }
    close(&mut segments);
    let sum = Contour::new(segments);
    let lowest = a.bbox().min + b.bbox().min.to_vec();
    sum.translated(lowest - sum.bbox().min)
}

/// Puts the last end where the first segment starts, which rounding has not.
fn close(segments: &mut [Segment]) {
    let start = segments[0].start();
    match segments.last_mut() {
        Some(Segment::Line(l)) => l.end = start,
        Some(Segment::Arc(a)) => a.end = start,
        None => {}
    }
}

/// The angles of all lines and of the ends of all arcs, in order, near ones as one.
fn directions(edges: &[Edge]) -> Vec<f64> {
    let ends = |e: &Edge| [e.from, (e.from + e.turn).rem_euclid(TAU)];
    let mut all: Vec<f64> = edges.iter().flat_map(ends).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a <= PARALLEL);
    if all.len() > 1 && all[0] + TAU - all[all.len() - 1] <= PARALLEL {
        all.pop();
    }
    all
}

/// An edge by its directions of travel.
struct Edge {
    /// Radians, in [0, 2π).
    from: f64,
    /// How far an arc turns.
    turn: f64,
    /// 0 for a line.
    radius: f64,
    chord: Vec2,
}

impl Edge {
    fn new(s: &Segment) -> Self {
        let (turn, radius) = match s {
            Segment::Line(_) => (0.0, 0.0),
            Segment::Arc(a) => (a.sweep(), a.radius),
        };
        Self { from: s.start_tangent().angle().rem_euclid(TAU), turn, radius, chord: s.end() - s.start() }
    }

    fn line_along(&self, direction: f64) -> Option<Vec2> {
        let apart = (self.from - direction).rem_euclid(TAU);
        (self.radius == 0.0 && apart.min(TAU - apart) <= PARALLEL).then_some(self.chord)
    }

    fn radius_at(&self, direction: f64) -> Option<f64> {
        (self.radius > 0.0 && (direction - self.from).rem_euclid(TAU) < self.turn).then_some(self.radius)
    }
}
