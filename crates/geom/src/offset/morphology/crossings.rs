//! Where two lines or arcs cross. Starts belong to a segment, ends do not.

use crate::point::{Point, Vec2};
use crate::predicates::orientation;
use crate::segment::{Arc, Line, Segment};
use std::f64::consts::TAU;

/// Calls `found` for every point where two segments cross, with whether the second turns left from the first there. Of two
/// crossings of one pair one turns left and the other one right, whatever the rounding.
pub(super) fn crossings(a: &Segment, b: &Segment, mut found: impl FnMut(Point, bool)) {
    match (a, b) {
        (Segment::Line(l), Segment::Line(m)) => lines(l, m, found),
        (Segment::Line(l), Segment::Arc(c)) => line_and_arc(l, c, found),
        (Segment::Arc(c), Segment::Line(l)) => line_and_arc(l, c, |p, left| found(p, !left)),
        (Segment::Arc(c), Segment::Arc(d)) => arcs(c, d, found),
    }
}

/// How far along a segment a point of it lies, 0 to 1.
pub(super) fn fraction(s: &Segment, p: Point) -> f64 {
    match s {
        Segment::Line(l) => {
            let along = l.end - l.start;
            (p - l.start).dot(along) / along.length_squared()
        }
        Segment::Arc(a) => {
            let turn = (a.start - a.center).angle_to(p - a.center);
            let way = if a.ccw { turn } else { -turn };
            let sweep = a.sweep().abs();
            // What rounding puts before the start is nearer to it than to the end.
            let way = if way < 0.0 && way + TAU < 0.5 * (sweep + TAU) { way + TAU } else { way };
            way / sweep
        }
    }
}

/// Exact; a point on a line counts as right of it, as if the profile were turned a trifle to the left.
fn lines(l: &Line, m: &Line, mut found: impl FnMut(Point, bool)) {
    let is_left = |l: &Line, p: Point| orientation(l.start, l.end, p) > 0.0;
    let ends = is_left(l, m.end);
    if is_left(l, m.start) != ends && is_left(m, l.start) != is_left(m, l.end) {
        let (u, v) = (l.end - l.start, m.end - m.start);
        let t = (m.start - l.start).cross(v) / u.cross(v);
        found(l.start.lerp(l.end, t.clamp(0.0, 1.0)), ends);
    }
}

fn line_and_arc(l: &Line, c: &Arc, mut found: impl FnMut(Point, bool)) {
    let along = l.end - l.start;
    let length = along.length();
    let u = along / length;
    let (middle, height) = ((c.center - l.start).dot(u), (c.center - l.start).cross(u));
    let square = (c.radius - height) * (c.radius + height);
    if square <= 0.0 {
        return;
    }
    let half = square.sqrt();
    for (t, leaves) in [(middle - half, false), (middle + half, true)] {
        let p = l.start + u * t;
        if t >= 0.0 && t < length && spans(c, p - c.center) {
            found(p, leaves == c.ccw);
        }
    }
}

fn arcs(c: &Arc, d: &Arc, mut found: impl FnMut(Point, bool)) {
    let apart = d.center - c.center;
    let distance = apart.length();
    if distance == 0.0 {
        return;
    }
    let axis = apart / distance;
    let along = 0.5 * (distance + (c.radius - d.radius) * (c.radius + d.radius) / distance);
    let square = (c.radius - along) * (c.radius + along);
    if square <= 0.0 {
        return;
    }
    let aside = axis.left() * square.sqrt();
    for (side, left) in [(aside, true), (-aside, false)] {
        let p = c.center + axis * along + side;
        if spans(c, p - c.center) && spans(d, p - d.center) {
            found(p, left == (c.ccw == d.ccw));
        }
    }
}

/// Whether a direction from the centre lies on the arc, its end left out.
fn spans(c: &Arc, o: Vec2) -> bool {
    let (s, e) = (c.start - c.center, c.end - c.center);
    let cross = |a: Vec2, b: Vec2| if c.ccw { a.cross(b) } else { b.cross(a) };
    let (after, before) = (cross(s, o) >= 0.0, cross(o, e) > 0.0);
    if cross(s, e) > 0.0 { after && before } else { after || before }
}
