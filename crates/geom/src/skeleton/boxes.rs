//! Nearest elements in a range of the boundary cycle: an implicit heap of oriented boxes.
//!
//! The boxes follow the chords of the chain, so that a disk that touches a smooth wall meets few of them. Built bottom
//! up in O(n); a query starts at the lowest common ancestor of its range.

use super::element::{Carrier, Element};
use crate::point::{Point, Vec2, vec2};

/// Elements in a leaf.
const LEAF: u32 = 4;

/// A box along `axis`; nothing is nearer than its distance.
#[derive(Clone, Copy, Debug)]
struct OrientedBox {
    center: Point,
    axis: Vec2,
    half: Vec2,
}

impl OrientedBox {
    const EMPTY: Self =
        Self { center: Point::ORIGIN, axis: vec2(1.0, 0.0), half: vec2(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    fn is_empty(&self) -> bool {
        self.half.x < 0.0
    }

    #[inline]
    fn distance_squared(&self, p: Point) -> f64 {
        let v = p - self.center;
        let x = (v.dot(self.axis).abs() - self.half.x).max(0.0);
        let y = (self.axis.cross(v).abs() - self.half.y).max(0.0);
        x * x + y * y
    }

    /// The box along `axis` between the given extremes, measured from `origin`.
    fn spanning(origin: Point, axis: Vec2, low: Vec2, high: Vec2) -> Self {
        let middle = (low + high) * 0.5;
        let center = origin + axis * middle.x + axis.left() * middle.y;
        Self { center, axis, half: (high - low) * 0.5 }
    }
}

/// The heap; see the module's page.
#[derive(Debug)]
pub(super) struct BoxHeap {
    boxes: Vec<OrientedBox>,
    /// Number of leaves, a power of two: the first leaf's index.
    leaves: u32,
}

impl BoxHeap {
    pub(super) fn new(elements: &[Element]) -> Self {
        let leaves = (elements.len() as u32).div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![OrientedBox::EMPTY; 2 * leaves as usize];
        for (k, chunk) in elements.chunks(LEAF as usize).enumerate() {
            boxes[leaves as usize + k] = box_of_elements(chunk);
        }
        let mut span = LEAF as usize;
        let mut level = leaves as usize;
        while level > 1 {
            level /= 2;
            span *= 2;
            for k in 0..level {
                let first = k * span;
                if first >= elements.len() {
                    break;
                }
                let last = (first + span).min(elements.len()) - 1;
                let node = level + k;
                boxes[node] = box_of_boxes(&boxes[2 * node..2 * node + 2], elements[first].start, elements[last].end);
            }
        }
        Self { boxes, leaves }
    }

    /// The element of `low ..= high` nearest to `p`, if it is nearer than `bound`, and its distance.
    pub(super) fn nearest(
        &self,
        elements: &[Element],
        (low, high): (u32, u32),
        p: Point,
        bound: f64,
    ) -> Option<(u32, f64)> {
        self.nearest_but(elements, (low, high), p, bound, |_| false)
    }

    /// Like [`Self::nearest`], leaving out what `skip` says.
    pub(super) fn nearest_but(
        &self,
        elements: &[Element],
        (low, high): (u32, u32),
        p: Point,
        mut bound: f64,
        skip: impl Fn(u32) -> bool,
    ) -> Option<(u32, f64)> {
        if low > high {
            return None;
        }
        let (first, last) = (low / LEAF + self.leaves, high / LEAF + self.leaves);
        let height = self.leaves.trailing_zeros();
        let mut stack = [(0_u32, 0.0_f64); 64];
        stack[0] = (first >> (u32::BITS - (first ^ last).leading_zeros()), 0.0);
        let mut depth = 1;
        let mut best = None;
        while depth > 0 {
            depth -= 1;
            let (node, squared) = stack[depth];
            if squared >= bound * bound {
                continue;
            }
            if node >= self.leaves {
                let begin = (node - self.leaves) * LEAF;
                for k in begin.max(low)..=(begin + LEAF - 1).min(high) {
                    let d = elements[k as usize].distance(p);
                    if d < bound && !skip(k) {
                        bound = d;
                        best = Some((k, d));
                    }
                }
                continue;
            }
            let shift = height - (u32::BITS - 1 - (2 * node).leading_zeros());
            let reach = |child: u32| {
                let left = child << shift;
                if left > last || left + ((1 << shift) - 1) < first {
                    f64::INFINITY
                } else {
                    self.boxes[child as usize].distance_squared(p)
                }
            };
            let (near, far) = {
                let (a, b) = ((2 * node, reach(2 * node)), (2 * node + 1, reach(2 * node + 1)));
                if a.1 <= b.1 { (a, b) } else { (b, a) }
            };
            for child in [far, near] {
                if child.1 < bound * bound {
                    stack[depth] = child;
                    depth += 1;
                }
            }
        }
        best
    }
}

/// Direction of a chord, or any where it is too short to tell.
fn chord_axis(from: Point, to: Point) -> Vec2 {
    let chord = to - from;
    let length = chord.length();
    if length > 0.0 { chord / length } else { vec2(1.0, 0.0) }
}

fn box_of_elements(chunk: &[Element]) -> OrientedBox {
    let origin = chunk[0].start;
    let axis = chord_axis(origin, chunk[chunk.len() - 1].end);
    let mut low = vec2(f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    for e in chunk {
        for p in [e.start, e.end] {
            let v = p - origin;
            let q = vec2(v.dot(axis), axis.cross(v));
            (low, high) = (vec2(low.x.min(q.x), low.y.min(q.y)), vec2(high.x.max(q.x), high.y.max(q.y)));
        }
        if e.rho != 0.0 {
            let c = e.center - origin;
            let (c, radius) = (vec2(c.dot(axis), axis.cross(c)), e.rho.abs());
            let toward = |d: Vec2| e.covers(if e.carrier == Carrier::Inside { -d } else { d });
            if toward(axis) {
                high.x = high.x.max(c.x + radius);
            }
            if toward(-axis) {
                low.x = low.x.min(c.x - radius);
            }
            if toward(axis.left()) {
                high.y = high.y.max(c.y + radius);
            }
            if toward(axis.right()) {
                low.y = low.y.min(c.y - radius);
            }
        }
    }
    OrientedBox::spanning(origin, axis, low, high)
}

fn box_of_boxes(parts: &[OrientedBox], from: Point, to: Point) -> OrientedBox {
    let axis = chord_axis(from, to);
    let mut low = vec2(f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    for part in parts.iter().filter(|b| !b.is_empty()) {
        let v = part.center - from;
        let c = vec2(v.dot(axis), axis.cross(v));
        let (cos, sin) = (part.axis.dot(axis).abs(), part.axis.cross(axis).abs());
        let h = vec2(part.half.x * cos + part.half.y * sin, part.half.x * sin + part.half.y * cos);
        (low, high) =
            (vec2(low.x.min(c.x - h.x), low.y.min(c.y - h.y)), vec2(high.x.max(c.x + h.x), high.y.max(c.y + h.y)));
    }
    OrientedBox::spanning(from, axis, low, high)
}
