//! Step 3: all crossings among raw curves.

use super::chains::Chains;
use super::raw::RawCurves;
use crate::point::{Point, Vec2};
use crate::predicates::orientation;
use crate::segment::{Arc, Line, Segment};

/// A crossing of two pieces, by their numbers among all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) at: Point,
    /// The piece that goes below the other here: the other turns left from it.
    pub(super) below: u32,
    /// The piece that comes up.
    pub(super) above: u32,
}

/// The crossings of all pieces but bridges.
pub(super) fn crossings(curves: &RawCurves) -> Vec<Crossing> {
    let mut found = Vec::new();
    Chains::new(curves).visit_pairs(|i, j| {
        if !curves.is_bridge(i) && !curves.is_bridge(j) {
            let (a, b) = (curves.segment(i), curves.segment(j));
            cross(a, b, |at| {
                let turn = tangent(a, at).cross(tangent(b, at));
                let (below, above) = if turn > 0.0 { (i, j) } else { (j, i) };
                found.push(Crossing { at, below, above });
            });
        }
    });
    found
}

/// Unit direction of travel at a point of a segment.
fn tangent(s: &Segment, at: Point) -> Vec2 {
    match s {
        Segment::Line(l) => l.direction(),
        Segment::Arc(a) => a.tangent_at(at),
    }
}

/// Calls `found` for every point where two segments cross. Starts belong to a segment, ends do not.
fn cross(a: &Segment, b: &Segment, mut found: impl FnMut(Point)) {
    match (a, b) {
        (Segment::Line(l), Segment::Line(m)) => {
            if lines_cross(l, m) {
                found(meeting(l, m));
            }
        }
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => {
            for p in line_and_arc(l, c).into_iter().flatten() {
                found(p);
            }
        }
        (Segment::Arc(c), Segment::Arc(d)) => {
            for p in arcs(c, d).into_iter().flatten() {
                found(p);
            }
        }
    }
}

/// Whether two segments cross; a point on a line counts as left of it.
fn lines_cross(l: &Line, m: &Line) -> bool {
    let apart = |l: &Line, p: Point, q: Point| {
        (orientation(l.start, l.end, p) >= 0.0) != (orientation(l.start, l.end, q) >= 0.0)
    };
    apart(l, m.start, m.end) && apart(m, l.start, l.end)
}

fn meeting(l: &Line, m: &Line) -> Point {
    let (u, v) = (l.end - l.start, m.end - m.start);
    let t = (m.start - l.start).cross(v) / u.cross(v);
    l.start.lerp(l.end, t.clamp(0.0, 1.0))
}

fn line_and_arc(l: &Line, c: &Arc) -> [Option<Point>; 2] {
    let along = l.end - l.start;
    let length = along.length();
    let u = along / length;
    let (middle, height) = ((c.center - l.start).dot(u), (c.center - l.start).cross(u));
    let square = (c.radius - height) * (c.radius + height);
    if square <= 0.0 {
        return [None, None];
    }
    let half = square.sqrt();
    [middle - half, middle + half].map(|t| {
        let p = l.start + u * t;
        (t >= 0.0 && t < length && spans(c, p)).then_some(p)
    })
}

/// Whether a point of the circle lies on a clockwise arc of less than half a turn, its end left out.
fn spans(c: &Arc, p: Point) -> bool {
    let [a, b, o] = [c.start, c.end, p].map(|p| p - c.center);
    a.cross(o) <= 0.0 && o.cross(b) < 0.0 && o.dot(a + b) > 0.0
}

fn arcs(c: &Arc, d: &Arc) -> [Option<Point>; 2] {
    let apart = d.center - c.center;
    let half = 0.5 * apart.length();
    if half <= 0.0 || half >= c.radius {
        return [None, None];
    }
    let aside = apart.left() * (((c.radius - half) * (c.radius + half)).sqrt() / (2.0 * half));
    let middle = c.center.midpoint(d.center);
    [aside, -aside].map(|s| Some(middle + s).filter(|&p| spans(c, p) && spans(d, p)))
}
