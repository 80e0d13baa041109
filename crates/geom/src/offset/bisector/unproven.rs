//! Whether the strips of edges that were left out without proof are covered by others.
//!
//! Leaving an edge out loses nothing of the offset, but may leave too much of it (see [`super::raw`]). Too much is just what lies in
//! the strip of such an edge; and as that strip begins at the wall, a loop that takes some of it in must enter it.

use super::corner::Joint;
use super::profile::Edge;
use crate::bbox::BBox;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::segment::Segment;
use crate::tolerance::bisector::STRIP_SLACK;

/// The names of the edges whose strips a loop enters.
pub(super) fn uncovered(edges: &[(u32, Edge)], loops: &[Vec<Point>], joint: &Joint, bbox: BBox) -> Vec<u32> {
    if edges.is_empty() || loops.is_empty() {
        return Vec::new();
    }
    let segments: Vec<Segment> =
        loops.iter().flat_map(|l| (0..l.len()).map(|k| Segment::line(l[k], l[(k + 1) % l.len()]))).collect();
    let index = SegmentIndex::new(&segments);
    let slack = STRIP_SLACK * bbox.size();
    let is_entered = |e: &Edge| {
        let reach = e.direction.left() * joint.distance;
        let strip = BBox::of(e.start, e.end()).with(e.start + reach).with(e.end() + reach);
        let mut entered = false;
        index.visit(strip, 0.0, |_, s| entered |= enters(e, joint.distance, slack, s.start(), s.end()));
        entered
    };
    edges.iter().filter(|(_, e)| is_entered(e)).map(|(name, _)| *name).collect()
}

/// Whether a segment comes into an edge's strip by more than `slack`.
fn enters(edge: &Edge, depth: f64, slack: f64, from: Point, to: Point) -> bool {
    let local = |p: Point| [edge.direction.dot(p - edge.start), edge.direction.cross(p - edge.start)];
    let (a, b) = (local(from), local(to));
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (axis, high) in [(0, edge.length), (1, depth)] {
        let (low, high, step) = (slack, high - slack, b[axis] - a[axis]);
        if step == 0.0 {
            if a[axis] <= low || a[axis] >= high {
                return false;
            }
            continue;
        }
        let (t, u) = ((low - a[axis]) / step, (high - a[axis]) / step);
        (enter, leave) = (enter.max(t.min(u)), leave.min(t.max(u)));
    }
    enter < leave
}
