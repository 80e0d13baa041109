//! A spatial index over lines and arcs: nearest segment, segments near a box, pairs that come close, first hit to the left.
//!
//! An implicit binary tree over the segments in Hilbert order of their middles. Its boxes are oriented along what they
//! hold, so that bundles of long parallel or radial edges stay apart where axis-parallel boxes would all overlap.
//! Building takes O(n log n); a query visits what its answer needs and little more.

use crate::bbox::BBox;
use crate::distance;
use crate::point::Point;
use crate::ray::{Hit, crossings_left, lies_right};
use crate::segment::Segment;
use crate::tolerance::COORDINATE_ROUNDOFF;
use std::ops::ControlFlow;

mod boxes;
mod hilbert;
mod tree;

pub(crate) use boxes::Oriented;
pub(crate) use hilbert::order as hilbert_order;
pub(crate) use tree::BoxTree;

/// Segments in a leaf.
const LEAF: usize = 4;

/// The index; segments are known by their place in the slice that it was built from.
#[derive(Clone, Debug, Default)]
pub struct SegmentIndex {
    origin: Point,
    slack: f64,
    leaves: usize,
    /// Over leaves of some segments each. Coordinates relative to `origin`.
    tree: BoxTree,
    order: Vec<u32>,
    segments: Vec<Segment>,
}

impl SegmentIndex {
    /// Builds the index.
    pub fn new(segments: &[Segment]) -> Self {
        if segments.is_empty() {
            return Self::default();
        }
        let bbox = segments.iter().fold(BBox::EMPTY, |b, s| b.with(s.start()).with(s.end()));
        let order = hilbert::order(segments.iter().map(|s| s.start().midpoint(s.end())), bbox);
        let leaves = segments.len().div_ceil(LEAF).next_power_of_two();
        let largest = bbox.max.to_vec().length().max(bbox.min.to_vec().length());
        let mut index = Self {
            origin: bbox.center(),
            slack: COORDINATE_ROUNDOFF * (largest + bbox.size()),
            leaves,
            tree: BoxTree::default(),
            segments: order.iter().map(|&k| segments[k as usize]).collect(),
            order,
        };
        let leaf = |k| Oriented::around(&index.segments[index.items(k)], index.origin);
        index.tree = BoxTree::new((0..leaves).map(leaf).collect());
        index
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.segments.len()
    }

    /// Whether it holds no segment.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    fn items(&self, leaf: usize) -> std::ops::Range<usize> {
        let n = self.segments.len();
        leaf * n / self.leaves..(leaf + 1) * n / self.leaves
    }

    /// The segment nearest to `p` and its distance; of several equally near ones any. `None` in an empty index.
    pub fn nearest(&self, p: Point) -> Option<(usize, f64)> {
        self.nearest_within(p, f64::INFINITY)
    }

    /// The segment nearest to `p` among those closer than `bound`, and its distance.
    pub fn nearest_within(&self, p: Point, bound: f64) -> Option<(usize, f64)> {
        let at = p - self.origin;
        self.least(bound, |node| node.distance(at), |segment| segment.distance(p))
    }

    /// The segment nearest to a line or arc among those closer than `bound`, and its distance; see [`distance::between`].
    pub fn nearest_to(&self, s: &Segment, bound: f64) -> Option<(usize, f64)> {
        let own = Oriented::around(std::slice::from_ref(s), self.origin);
        self.least(bound, |node| node.gap(&own), |segment| distance::between(segment, s))
    }

    /// The segment for which `measure` is least and below `bound`; `floor` must be a lower bound of it for all in a box.
    fn least(
        &self,
        bound: f64,
        floor: impl Fn(&Oriented) -> f64,
        measure: impl Fn(&Segment) -> f64,
    ) -> Option<(usize, f64)> {
        if self.is_empty() {
            return None;
        }
        let mut best = (usize::MAX, bound);
        let mut stack = vec![(1, floor(self.tree.node(1)))];
        while let Some((node, lower)) = stack.pop() {
            if lower - self.slack >= best.1 {
                continue;
            }
            if node >= self.leaves {
                for k in self.items(node - self.leaves) {
                    let d = measure(&self.segments[k]);
                    if d < best.1 {
                        best = (self.order[k] as usize, d);
                    }
                }
                continue;
            }
            let children = [2 * node, 2 * node + 1].map(|c| (c, floor(self.tree.node(c))));
            let nearer = usize::from(children[1].1 < children[0].1);
            stack.push(children[1 - nearer]);
            stack.push(children[nearer]);
        }
        (best.0 != usize::MAX).then_some(best)
    }

    /// Calls `found` for every segment that comes within `margin` of `bbox`, and for some whose own boxes do.
    pub fn visit(&self, bbox: BBox, margin: f64, mut found: impl FnMut(usize, &Segment)) {
        self.any(bbox, margin, |k, segment| {
            found(k, segment);
            false
        });
    }

    /// Whether one of those that [`SegmentIndex::visit`] finds is as asked; none is looked at after that.
    pub fn any(&self, bbox: BBox, margin: f64, mut is_asked: impl FnMut(usize, &Segment) -> bool) -> bool {
        let near = Oriented::of(bbox, self.origin);
        let grown = bbox.inflated(margin + self.slack);
        self.any_item(&near, margin, |k| {
            self.segments[k].bbox().intersects(grown) && is_asked(self.order[k] as usize, &self.segments[k])
        })
    }

    fn any_item(&self, near: &Oriented, margin: f64, mut is_asked: impl FnMut(usize) -> bool) -> bool {
        let mut stack = if self.is_empty() { vec![] } else { vec![1] };
        while let Some(node) = stack.pop() {
            if !self.tree.node(node).comes_within(near, margin + self.slack) {
                continue;
            }
            if node < self.leaves {
                stack.extend([2 * node + 1, 2 * node]);
            } else if self.items(node - self.leaves).any(&mut is_asked) {
                return true;
            }
        }
        false
    }

    /// Calls `found` once for every pair of different segments that come within `margin` of each other, and for some
    /// whose boxes do; the order of the pairs is that of the tree.
    /// It stops early where `found` breaks, and returns what that says.
    pub fn visit_pairs<B>(&self, margin: f64, mut found: impl FnMut(usize, usize) -> ControlFlow<B>) -> ControlFlow<B> {
        if self.is_empty() {
            return ControlFlow::Continue(());
        }
        let margin = margin + self.slack;
        let boxes: Vec<BBox> = self.segments.iter().map(|s| s.bbox().inflated(0.5 * margin)).collect();
        self.tree.visit_pairs(margin, |a, b| {
            for i in self.items(a) {
                let from = if a == b { i + 1 } else { self.items(b).start };
                for j in (from..self.items(b).end).filter(|&j| boxes[i].intersects(boxes[j])) {
                    found(self.order[i] as usize, self.order[j] as usize)?;
                }
            }
            ControlFlow::Continue(())
        })
    }

    /// The first crossing of the ray from `p` towards −x with a segment that `admit` lets through.
    pub fn first_left(&self, p: Point, admit: impl Fn(usize, &Segment) -> bool) -> Option<(usize, Hit)> {
        let mut best: Option<(usize, Hit)> = None;
        let mut stack = if self.is_empty() { vec![] } else { vec![1] };
        let right = p - self.origin;
        while let Some(node) = stack.pop() {
            let left = best.map_or(f64::NEG_INFINITY, |(_, hit)| hit.x - self.origin.x);
            if !self.tree.node(node).meets_row(left, right, self.slack) {
                continue;
            }
            if node < self.leaves {
                let children = [2 * node, 2 * node + 1];
                let nearer =
                    usize::from(self.tree.node(children[1]).center().x > self.tree.node(children[0]).center().x);
                stack.extend([children[1 - nearer], children[nearer]]);
                continue;
            }
            for k in self.items(node - self.leaves).filter(|&k| admit(self.order[k] as usize, &self.segments[k])) {
                crossings_left(&self.segments[k], p, |hit| {
                    if best.is_none_or(|(b, h)| lies_right((&self.segments[k], hit), (&self.segments[b], h))) {
                        best = Some((k, hit));
                    }
                });
            }
        }
        best.map(|(k, hit)| (self.order[k] as usize, hit))
    }

    /// How many crossings the ray from `p` towards −x has with all segments: odd inside a set of closed curves (even-odd).
    pub fn crossings_left(&self, p: Point) -> usize {
        let mut count = 0;
        let mut stack = if self.is_empty() { vec![] } else { vec![1] };
        while let Some(node) = stack.pop() {
            if !self.tree.node(node).meets_row(f64::NEG_INFINITY, p - self.origin, self.slack) {
                continue;
            }
            if node < self.leaves {
                stack.extend([2 * node, 2 * node + 1]);
                continue;
            }
            for k in self.items(node - self.leaves) {
                crossings_left(&self.segments[k], p, |_| count += 1);
            }
        }
        count
    }
}

#[cfg(test)]
mod tests;
