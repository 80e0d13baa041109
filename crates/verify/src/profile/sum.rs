//! The outline of what a curve sweeps along another one.
//!
//! The sum of two curves is the set of all `a + b`. A point of its outline has an end of one of them as a part, or parts at which
//! the two have parallel tangents; so the outline lies on copies of either curve at the ends of the other and on their *envelopes*.

use pocketry_geom::tolerance::proof::CUSP;
use pocketry_geom::{Arc, Line, Segment, Vec2};

/// Adds the envelopes of two curves.
pub(crate) fn envelopes(a: &Segment, b: &Segment, out: &mut Vec<Segment>) {
    match (a, b) {
        (Segment::Line(_), Segment::Line(_)) => {}
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => along_line(l, c, out),
        (Segment::Arc(c), Segment::Arc(d)) => {
            for sign in [1.0, -1.0] {
                along_arc(c, d, sign, out);
            }
        }
    }
}

/// Adds the envelope of a wall, whose region lies to the left, and an edge of a counter-clockwise outline on which the two have one
/// normal: to the left of the wall, and outwards from the outline.
pub(crate) fn facing(wall: &Segment, edge: &Segment, out: &mut Vec<Segment>) {
    match (wall, edge) {
        (Segment::Line(_), Segment::Line(_)) => {}
        (Segment::Line(l), Segment::Arc(e)) => {
            let outwards = l.direction().left() * outward(e);
            if outwards.x.is_finite() && spans(e, outwards) {
                out.push(wall.translated(e.center.to_vec() + outwards * e.radius));
            }
        }
        (Segment::Arc(w), Segment::Line(l)) => {
            let outwards = l.direction().right() * -outward(w);
            if outwards.x.is_finite() && spans(w, outwards) {
                out.push(edge.translated(w.center.to_vec() + outwards * w.radius));
            }
        }
        (Segment::Arc(w), Segment::Arc(e)) => along_arc(w, e, -outward(w) * outward(e), out),
    }
}

/// 1 where the right normal of an arc points away from its centre, else −1.
fn outward(a: &Arc) -> f64 {
    if a.ccw { 1.0 } else { -1.0 }
}

/// Whether an arc points into a direction, or misses it by rounding.
pub(crate) fn spans(a: &Arc, direction: Vec2) -> bool {
    let near = |d: Vec2| direction.angle_to(d).abs() < CUSP;
    a.spans(direction) || near(a.start - a.center) || near(a.end - a.center)
}

/// The line carried by the points of the arc at which its tangent is parallel to it.
fn along_line(l: &Line, c: &Arc, out: &mut Vec<Segment>) {
    let normal = l.direction().left();
    if normal.x.is_finite() {
        let sides = [normal, -normal].into_iter().filter(|&n| spans(c, n));
        out.extend(sides.map(|n| Segment::Line(*l).translated(c.center.to_vec() + n * c.radius)));
    }
}

/// The arc of all sums of points of `c` in a direction and of `d` in the same (`sign` 1) or the opposite direction (−1).
fn along_arc(c: &Arc, d: &Arc, sign: f64, out: &mut Vec<Segment>) {
    let radius = c.radius + sign * d.radius;
    let center = c.center + d.center.to_vec();
    if radius == 0.0 {
        return;
    }
    let mut cuts = [c.start - c.center, c.end - c.center, (d.start - d.center) * sign, (d.end - d.center) * sign];
    cuts.sort_by(|u, v| u.angle().total_cmp(&v.angle()));
    for k in 0..cuts.len() {
        let (u, v) = (cuts[k].normalized(), cuts[(k + 1) % cuts.len()].normalized());
        let turn = u.angle_to(v).rem_euclid(std::f64::consts::TAU);
        let middle = u.rotated(0.5 * turn);
        let (start, end) = (center + u * radius, center + v * radius);
        if turn > 0.0 && start != end && c.spans(middle) && d.spans(middle * sign) {
            out.push(Segment::Arc(Arc { start, end, center, radius: radius.abs(), ccw: true }));
        }
    }
}
