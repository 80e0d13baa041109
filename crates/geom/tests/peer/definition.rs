//! The definition, point by point: what neither a strip nor a mitre covers.

use pocketry_geom::{Point, Region, Segment, Vec2};

/// Whether a point of the region lies in the strip of depth `d` along an edge or in the mitre at a reflex vertex.
pub(crate) fn covered(region: &Region, p: Point, d: f64, limit: f64) -> bool {
    region.contours().iter().any(|c| {
        let n = c.segments.len();
        (0..n).any(|k| {
            in_strip(&c.segments[k], p, d) || in_mitre(&c.segments[(k + n - 1) % n], &c.segments[k], p, d, limit)
        })
    })
}

fn height(s: &Segment, p: Point) -> (f64, f64) {
    let u = s.start_tangent();
    (u.dot(p - s.start()), u.cross(p - s.start()))
}

fn in_strip(s: &Segment, p: Point, d: f64) -> bool {
    let (along, up) = height(s, p);
    0.0 < along && along < s.length() && 0.0 < up && up < d
}

/// Below both offset lines, and ahead of the first edge's end and of the second one's start; below the square cut, too.
fn in_mitre(a: &Segment, b: &Segment, p: Point, d: f64, limit: f64) -> bool {
    let (u, v): (Vec2, Vec2) = (a.start_tangent(), b.start_tangent());
    if u.cross(v) >= 0.0 {
        return false;
    }
    let from = p - b.start();
    let between = u.dot(from) > 0.0 && v.dot(from) < 0.0;
    // 1/cos of half the turn; the bisector is square to u + v's left normal.
    let long = u.angle_to(v).abs() / 2.0;
    let bisector = u.rotated(u.angle_to(v) / 2.0).left();
    let cut = 1.0 / long.cos() > limit && bisector.dot(from) >= d;
    between && u.cross(from) < d && v.cross(from) < d && bisector.dot(from) > 0.0 && !cut
}
