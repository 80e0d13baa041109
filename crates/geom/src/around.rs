//! The order of curves around a point that they leave.

use crate::point::Point;
use crate::segment::Segment;
use crate::tolerance::TANGENT;
use std::cmp::Ordering;

/// Compares two segments that start at one point, do not cross, and lead into the same open half-plane or nearly in the
/// same direction: `Less` where `a` comes before `b` counter-clockwise.
pub(crate) fn before(a: &Segment, b: &Segment) -> Ordering {
    let turn = a.start_tangent().angle_to(b.start_tangent());
    if turn.abs() >= TANGENT { 0.0_f64.total_cmp(&turn) } else { side_by_side(a, b) }
}

/// Which of two curves that leave a point in nearly the same direction comes first counter-clockwise: the right one.
/// They don't cross, so the middle of the shorter one tells.
pub(crate) fn side_by_side(a: &Segment, b: &Segment) -> Ordering {
    if a.length() <= b.length() {
        left_of(b, a.at(0.5)).total_cmp(&0.0)
    } else {
        0.0_f64.total_cmp(&left_of(a, b.at(0.5)))
    }
}

/// How far `p` lies to the left of the segment's line or circle.
fn left_of(segment: &Segment, p: Point) -> f64 {
    match segment {
        Segment::Line(l) => l.direction().cross(p - l.start),
        Segment::Arc(a) if a.ccw => -a.radial_distance(p),
        Segment::Arc(a) => a.radial_distance(p),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::point;

    #[test]
    fn tangent_curves_are_ordered_by_curvature() {
        let o = Point::ORIGIN;
        let curves = [
            Segment::from_bulge(o, point(0.0, -2.0), -1.0),
            Segment::from_bulge(o, point(0.0, -20.0), -1.0),
            Segment::line(o, point(5.0, 0.0)),
            Segment::from_bulge(o, point(0.0, 20.0), 1.0),
            Segment::from_bulge(o, point(0.0, 2.0), 1.0),
            Segment::line(o, point(1.0, 1.0)),
        ];
        for (i, a) in curves.iter().enumerate() {
            for (j, b) in curves.iter().enumerate().filter(|&(j, _)| j != i) {
                assert_eq!(before(a, b), i.cmp(&j), "{i} {j}");
            }
        }
    }
}
