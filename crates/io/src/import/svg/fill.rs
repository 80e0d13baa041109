//! The nonzero fill rule, for loops that nest without crossing.

use pocketry_geom::index::SegmentIndex;
use pocketry_geom::ray::{self, crossings_left};
use pocketry_geom::{BBox, Contour, Point, Segment, point};

/// Which loops bound what the nonzero rule fills: those with filled on one side and empty on the other. The others are
/// drawn inside what is filled anyway. O(n log n) and the depth of nesting.
pub(super) fn bounding(loops: &[Contour]) -> Vec<bool> {
    let segments: Vec<Segment> = loops.iter().flat_map(|c| c.segments.iter().copied()).collect();
    let owners: Vec<usize> = loops.iter().enumerate().flat_map(|(k, c)| c.segments.iter().map(move |_| k)).collect();
    let left = segments.iter().fold(BBox::EMPTY, |b, s| b.union(s.bbox())).min.x;
    let index = SegmentIndex::new(&segments);
    let winding_around = |k: usize| {
        let at = leftmost(&loops[k]);
        let mut turns = 0_i64;
        index.visit(BBox::of(point(left, at.y), at), 0.0, |j, segment| {
            if owners[j] != k {
                crossings_left(segment, at, |hit| turns += if hit.upward { -1 } else { 1 });
            }
        });
        turns
    };
    (0..loops.len())
        .map(|k| {
            let around = winding_around(k);
            let inside = around + if loops[k].area() > 0.0 { 1 } else { -1 };
            (around == 0) != (inside == 0)
        })
        .collect()
}

fn leftmost(contour: &Contour) -> Point {
    let points = contour.segments.iter().map(ray::leftmost);
    points.reduce(|a, b| if b.x < a.x { b } else { a }).unwrap_or_default()
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
