//! A tree of boxes over lines and arcs, for questions about what lies near.

use crate::distance;
use pocketry_geom::{BBox, Point, Segment};

/// How many segments a leaf holds at most.
const LEAF: usize = 4;

/// A tree of boxes; a segment is known by its place in the list that the tree was made of.
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// In the order of the leaves.
    items: Vec<Item>,
    /// Where each segment of the list stands in `items`.
    places: Vec<u32>,
}

/// A segment, its box and its place in the list.
struct Item {
    segment: Segment,
    bbox: BBox,
    id: u32,
}

struct Node {
    bbox: BBox,
    /// First item of a leaf, or the right child of an inner node (the left one follows its parent).
    first: u32,
    /// Number of items; 0 for an inner node.
    count: u32,
}

/// A curve and the lower bounds of its distance to boxes.
struct Probe<'a> {
    curve: &'a Segment,
    bbox: BBox,
}

impl Probe<'_> {
    /// A bound from below of the distance between the curve and anything in the box.
    fn bound(&self, b: &BBox) -> f64 {
        let dx = (b.min.x - self.bbox.max.x).max(self.bbox.min.x - b.max.x).max(0.0);
        let dy = (b.min.y - self.bbox.max.y).max(self.bbox.min.y - b.max.y).max(0.0);
        let apart = (dx * dx + dy * dy).sqrt();
        let (middle, half) = (b.center(), (b.max - b.min) * 0.5);
        match self.curve {
            Segment::Line(l) => {
                let along = l.end - l.start;
                let length = along.length();
                if length == 0.0 {
                    return apart;
                }
                let shadow = along.x.abs() * half.y + along.y.abs() * half.x;
                apart.max((along.cross(middle - l.start).abs() - shadow) / length)
            }
            Segment::Arc(a) => apart.max(a.radial_distance(middle).abs() - half.length()),
        }
    }
}

impl Tree {
    /// The tree over these segments.
    pub(crate) fn new(segments: &[Segment]) -> Self {
        let mut boxed: Vec<(BBox, u32)> = segments.iter().map(Segment::bbox).zip(0..).collect();
        let mut nodes = Vec::with_capacity(segments.len());
        if !boxed.is_empty() {
            let count = boxed.len();
            split(&mut boxed, 0, count, &mut nodes);
        }
        let items = boxed.iter().map(|&(bbox, id)| Item { segment: segments[id as usize], bbox, id }).collect();
        let mut places = vec![0; segments.len()];
        for (place, &(_, k)) in (0..).zip(&boxed) {
            places[k as usize] = place;
        }
        Self { nodes, items, places }
    }

    /// The segment at a place of the list.
    pub(crate) fn segment(&self, id: u32) -> &Segment {
        &self.items[self.places[id as usize] as usize].segment
    }

    /// The segment nearest to `p` and its distance, where that is less than `within`.
    pub(crate) fn nearest(&self, p: Point, within: f64) -> Option<(f64, u32)> {
        let mut best: Option<(f64, u32)> = None;
        let mut limit = within;
        self.walk(
            |b| b.distance_squared(p).sqrt(),
            |limit, item| {
                let d = item.segment.distance(p);
                if d < *limit {
                    *limit = d;
                    best = Some((d, item.id));
                }
            },
            &mut limit,
        );
        best
    }

    /// Whether any segment is nearer to `p` than `radius`.
    pub(crate) fn any_within(&self, p: Point, radius: f64) -> bool {
        let mut found = false;
        let mut limit = radius;
        self.walk(
            |b| b.distance_squared(p).sqrt(),
            |limit, item| {
                if !found && item.segment.distance(p) < radius {
                    found = true;
                    *limit = f64::NEG_INFINITY;
                }
            },
            &mut limit,
        );
        found
    }

    /// The segment nearest to a curve and its distance, where that is less than `within`.
    pub(crate) fn nearest_to_curve(&self, curve: &Segment, within: f64) -> Option<(f64, u32)> {
        let probe = Probe { curve, bbox: curve.bbox() };
        let mut best: Option<(f64, u32)> = None;
        let mut limit = within;
        self.walk(
            |b| probe.bound(b),
            |limit, item| {
                if probe.bound(&item.bbox) < *limit {
                    let d = distance::between(curve, &item.segment);
                    if d < *limit {
                        *limit = d;
                        best = Some((d, item.id));
                    }
                }
            },
            &mut limit,
        );
        best
    }

    /// Calls `visit` for every segment that may lie within `margin` of a curve, until it says to stop (`false`).
    pub(crate) fn near(&self, curve: &Segment, margin: f64, mut visit: impl FnMut(&Segment) -> bool) {
        self.near_by_id(curve, margin, |_, segment| visit(segment));
    }

    /// The same with each segment's place in the list.
    pub(crate) fn near_by_id(&self, curve: &Segment, margin: f64, mut visit: impl FnMut(u32, &Segment) -> bool) {
        let probe = Probe { curve, bbox: curve.bbox() };
        let mut limit = margin;
        self.walk(
            |b| probe.bound(b),
            |limit, item| {
                if probe.bound(&item.bbox) < margin && !visit(item.id, &item.segment) {
                    *limit = f64::NEG_INFINITY;
                }
            },
            &mut limit,
        );
    }

    /// Calls `visit` for every segment whose box meets the ray from `p` in the direction of +x.
    pub(crate) fn on_ray(&self, p: Point, mut visit: impl FnMut(&Segment)) {
        let off = |b: &BBox| if b.min.y <= p.y && p.y <= b.max.y && b.max.x >= p.x { 0.0 } else { f64::INFINITY };
        let mut limit = f64::MAX;
        self.walk(off, |_, item| visit(&item.segment), &mut limit);
    }

    /// Visits items whose nodes are bounded below the limit, near children first; `visit` may lower the limit, to stop at once
    /// to negative infinity.
    fn walk(&self, bound: impl Fn(&BBox) -> f64, mut visit: impl FnMut(&mut f64, &Item), limit: &mut f64) {
        let mut stack = [(0u32, 0.0f64); 64];
        let mut height = 0;
        if let Some(root) = self.nodes.first() {
            stack[0] = (0, bound(&root.bbox));
            height = 1;
        }
        while height > 0 {
            height -= 1;
            let (index, apart) = stack[height];
            if apart >= *limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                let (first, count) = (node.first as usize, node.count as usize);
                for item in &self.items[first..first + count] {
                    visit(limit, item);
                    if *limit == f64::NEG_INFINITY {
                        return;
                    }
                }
                continue;
            }
            let (left, right) = (index + 1, node.first);
            let near = (left, bound(&self.nodes[left as usize].bbox));
            let far = (right, bound(&self.nodes[right as usize].bbox));
            let (near, far) = if near.1 <= far.1 { (near, far) } else { (far, near) };
            for child in [far, near] {
                if child.1 < *limit {
                    stack[height] = child;
                    height += 1;
                }
            }
        }
    }
}

/// Appends the subtree over `items[from..to]`; halves by count, so that its height is the logarithm of their number.
fn split(items: &mut [(BBox, u32)], from: usize, to: usize, nodes: &mut Vec<Node>) {
    let part = &mut items[from..to];
    let bbox = part.iter().fold(BBox::EMPTY, |b, i| b.union(i.0));
    let index = nodes.len();
    if part.len() <= LEAF {
        nodes.push(Node { bbox, first: from as u32, count: part.len() as u32 });
        return;
    }
    nodes.push(Node { bbox, first: 0, count: 0 });
    let half = part.len() / 2;
    let wide = bbox.width() > bbox.height();
    let key = |b: &BBox| if wide { b.min.x + b.max.x } else { b.min.y + b.max.y };
    part.select_nth_unstable_by(half, |a, b| key(&a.0).total_cmp(&key(&b.0)).then(a.1.cmp(&b.1)));
    split(items, from, from + half, nodes);
    nodes[index].first = nodes.len() as u32;
    split(items, from + half, to, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    #[test]
    fn a_visitor_that_says_stop_is_not_asked_again() {
        let at = |k: u32| point(f64::from(k), 0.0);
        let rungs: Vec<Segment> = (0..20).map(|k| Segment::line(at(k), at(k + 1))).collect();
        for stop in 1..=rungs.len() {
            let mut asked = 0;
            Tree::new(&rungs).near(&Segment::line(at(0), at(20)), 1.0, |_| {
                asked += 1;
                asked < stop
            });
            assert_eq!(asked, stop);
        }
    }
}
