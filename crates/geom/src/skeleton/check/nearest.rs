//! Distance to the boundary: all segments one by one, or through a tree of boxes that gives the very same number.

use crate::bbox::BBox;
use crate::point::Point;
use crate::region::Region;
use crate::segment::Segment;

const LEAF: usize = 4;

/// The segments of a region, ready for distance queries.
pub(super) struct Nearest {
    segments: Vec<Segment>,
    /// An implicit tree: node `k` has the children `2k + 1` and `2k + 2`; empty for brute force.
    boxes: Vec<BBox>,
}

impl Nearest {
    /// Looks at every segment up to `brute_force_up_to` of them, and builds a tree above that.
    pub(super) fn new(region: &Region, brute_force_up_to: usize) -> Self {
        let mut segments: Vec<Segment> = region.segments().copied().collect();
        let mut boxes = Vec::new();
        if segments.len() > brute_force_up_to {
            boxes.resize(2 * segments.len().next_power_of_two(), BBox::EMPTY);
            build(&mut segments, &mut boxes, 0);
        }
        Self { segments, boxes }
    }

    /// Distance from `x` to the nearest segment.
    pub(super) fn distance(&self, x: Point) -> f64 {
        let mut best = f64::INFINITY;
        if self.boxes.is_empty() {
            for s in &self.segments {
                best = best.min(s.distance(x));
            }
        } else {
            self.search(x, 0, 0..self.segments.len(), &mut best);
        }
        best
    }

    fn search(&self, x: Point, node: usize, range: std::ops::Range<usize>, best: &mut f64) {
        if range.len() <= LEAF {
            for s in &self.segments[range] {
                *best = best.min(s.distance(x));
            }
            return;
        }
        let middle = range.start + range.len() / 2;
        let bound = |child: usize| self.boxes[child].distance_squared(x).sqrt();
        let mut children = [(2 * node + 1, range.start..middle), (2 * node + 2, middle..range.end)];
        if bound(children[1].0) < bound(children[0].0) {
            children.swap(0, 1);
        }
        for (child, range) in children {
            // A little more than the best, so that rounding of the box never hides a nearer segment.
            if bound(child) <= *best + 4.0 * f64::EPSILON * (best.abs() + x.x.abs() + x.y.abs()) {
                self.search(x, child, range, best);
            }
        }
    }
}

fn build(segments: &mut [Segment], boxes: &mut [BBox], node: usize) {
    let bounds = segments.iter().fold(BBox::EMPTY, |b, s| b.union(s.bbox()));
    boxes[node] = bounds;
    if segments.len() <= LEAF {
        return;
    }
    let wide = bounds.width() >= bounds.height();
    let key = |s: &Segment| {
        let c = s.bbox().center();
        if wide { c.x } else { c.y }
    };
    let middle = segments.len() / 2;
    segments.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
    let (left, right) = segments.split_at_mut(middle);
    build(left, boxes, 2 * node + 1);
    build(right, boxes, 2 * node + 2);
}
