//! Which contour lies directly inside which.

use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::ray::leftmost;
use crate::segment::Segment;

/// For each contour `None` if it runs counter-clockwise (outer), else the outer contour that the island lies directly
/// inside. The contours must neither cross nor run along each other, and must keep the interior to the left.
///
/// From an island's leftmost point the first contour to the left bounds the same piece of the interior: it is either the
/// outer one or an island that lies further left. O(n log n) in all, at any depth.
pub fn parents(contours: &[Contour]) -> Vec<Option<u32>> {
    let segments: Vec<Segment> = contours.iter().flat_map(|c| c.segments.iter().copied()).collect();
    let owners: Vec<u32> = (0..).zip(contours).flat_map(|(k, c)| c.segments.iter().map(move |_| k)).collect();
    parents_by(contours, &SegmentIndex::new(&segments), |k| owners[k])
}

/// The same with an index over the contours' segments, in any order and direction, whose owners are known.
pub(crate) fn parents_by(contours: &[Contour], index: &SegmentIndex, owner: impl Fn(usize) -> u32) -> Vec<Option<u32>> {
    let outer: Vec<bool> = contours.iter().map(|c| c.area() > 0.0).collect();
    let mut islands: Vec<(Point, usize)> =
        (0..contours.len()).filter(|&k| !outer[k]).map(|k| (leftmost_of(&contours[k]), k)).collect();
    islands.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.cmp(&b.1)));
    let mut parents = vec![None; contours.len()];
    for (at, island) in islands {
        let passes = |k: usize, s: &Segment| owner(k) != island as u32 && s.start() != at && s.end() != at;
        if let Some((k, _)) = index.first_left(at, passes) {
            let other = owner(k);
            parents[island] = if outer[other as usize] { Some(other) } else { parents[other as usize] };
        }
    }
    parents
}

fn leftmost_of(contour: &Contour) -> Point {
    let points = contour.segments.iter().map(leftmost);
    points.reduce(|a, b| if b.x < a.x { b } else { a }).unwrap_or_default()
}
