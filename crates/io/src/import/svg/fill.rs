//! The nonzero fill rule, for loops that nest without crossing.

use pocketry_geom::ray::{self, crossings_left};
use pocketry_geom::{BBox, Contour, Point, Segment};

/// Which loops bound what the nonzero rule fills: those with filled on one side and empty on the other. The others are
/// drawn inside what is filled anyway.
pub(super) fn bounding(loops: &[Contour]) -> Vec<bool> {
    let boxes: Vec<BBox> = loops.iter().map(Contour::bbox).collect();
    (0..loops.len())
        .map(|k| {
            let at = leftmost(&loops[k]);
            let around: i64 = (0..loops.len())
                .filter(|&j| j != k && boxes[j].contains(at))
                .map(|j| winding(&loops[j], at))
                .sum();
            let inside = around + if loops[k].area() > 0.0 { 1 } else { -1 };
            (around == 0) != (inside == 0)
        })
        .collect()
}

fn leftmost(contour: &Contour) -> Point {
    let points = contour.segments.iter().map(ray::leftmost);
    points.reduce(|a, b| if b.x < a.x { b } else { a }).unwrap_or_default()
}

/// How often a closed curve runs counter-clockwise around a point that is not on it.
fn winding(contour: &Contour, p: Point) -> i64 {
    let mut turns = 0;
    for segment in &contour.segments {
        if may_cross(segment, p) {
            crossings_left(segment, p, |hit| turns += if hit.upward { -1 } else { 1 });
        }
    }
    turns
}

fn may_cross(segment: &Segment, p: Point) -> bool {
    match segment {
        Segment::Line(l) => (l.start.y > p.y) != (l.end.y > p.y),
        Segment::Arc(a) => (a.center.y - p.y).abs() <= a.radius || (a.start.y > p.y) != (a.end.y > p.y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64, ccw: bool) -> Contour {
        let corners = [[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]];
        let contour = Contour::from_vertices(&corners);
        if ccw { contour } else { contour.reversed() }
    }

    #[test]
    fn a_loop_of_the_same_direction_inside_bounds_nothing() {
        assert_eq!(bounding(&[square(1.0, true), square(2.0, true)]), [false, true]);
        assert_eq!(bounding(&[square(1.0, false), square(2.0, true)]), [true, true]);
        let three = [square(3.0, false), square(2.0, false), square(1.0, true)];
        assert_eq!(bounding(&three), [true, false, false]);
    }
}
