//! Boundary elements: segments and reflex vertices, each with its offset.

use crate::contour::Contour;
use crate::point::{Point, Vec2};
use crate::segment::{Arc, Line, Segment};
use crate::tolerance::pairwise::SMOOTH_TURN;

/// How two elements in a row join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joint {
    /// Their offsets overlap.
    Convex,
    /// Their offsets touch, up to rounding.
    Smooth,
    /// Their offsets touch: one of them is a reflex vertex.
    Reflex,
}

/// A straight segment, or a reflex vertex (then both ends are the same).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Element {
    pub(super) start: Point,
    pub(super) end: Point,
    /// Unit normal into the pocket at the start.
    pub(super) n0: Vec2,
    /// The same at the end.
    pub(super) n1: Vec2,
    /// Number among all elements of the region.
    pub(super) number: u32,
    /// How the element after it joins it.
    pub(super) joint: Joint,
}

impl Element {
    pub(super) fn is_vertex(&self) -> bool {
        self.start == self.end
    }

    /// Where its offset starts.
    pub(super) fn offset_start(&self, d: f64) -> Point {
        self.start + self.n0 * d
    }

    /// Where its offset ends.
    pub(super) fn offset_end(&self, d: f64) -> Point {
        self.end + self.n1 * d
    }

    /// Direction of travel, of a segment.
    pub(super) fn along(&self) -> Vec2 {
        self.n0.right()
    }

    /// The boundary point that a point of its offset is nearest to.
    pub(super) fn foot(&self, p: Point) -> Point {
        Line::new(self.start, self.end).nearest(p)
    }

    /// Distance of a point.
    pub(super) fn distance(&self, p: Point) -> f64 {
        if self.is_vertex() { self.start.distance(p) } else { Line::new(self.start, self.end).distance(p) }
    }

    /// The part of its offset between two points of it.
    pub(super) fn piece(&self, d: f64, start: Point, end: Point) -> Segment {
        if self.is_vertex() && start != end {
            Segment::Arc(Arc { start, end, center: self.start, radius: d, ccw: false })
        } else {
            Segment::line(start, end)
        }
    }
}

/// Adds the elements of a contour of lines, from which edges no longer than `weld` (mm) are left out: neither their directions nor
/// those of their parallels mean anything. Says how far its vertices are from those that are left.
pub(super) fn add_contour(contour: &Contour, weld: f64, elements: &mut Vec<Element>) -> f64 {
    let (points, strayed) = welded(contour, weld);
    let ends = (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()]));
    let mut lines = ends.map(|(a, b)| (a, b, (b - a).normalized().left())).peekable();
    let Some(&(_, _, first)) = lines.peek() else { return strayed };
    let mut push = |start, end, n0, n1, joint| {
        let number = elements.len() as u32;
        elements.push(Element { start, end, n0, n1, number, joint });
    };
    while let Some((start, end, n)) = lines.next() {
        let after = lines.peek().map_or(first, |next| next.2);
        let turn = n.cross(after);
        // A spike that turns back on itself is an end of the wall: its vertex is reflex.
        let reflex = turn < -SMOOTH_TURN || (turn <= SMOOTH_TURN && n.dot(after) < 0.0);
        let smooth = turn.abs() <= SMOOTH_TURN;
        let open = if smooth { Joint::Smooth } else { Joint::Convex };
        push(start, end, n, n, if reflex { Joint::Reflex } else { open });
        if reflex {
            push(end, end, n, after, Joint::Reflex);
        }
    }
    strayed
}

/// The contour's vertices, of those nearer than `weld` to one another in a row the first (none where no area is left), and how far
/// the others are from them.
fn welded(contour: &Contour, weld: f64) -> (Vec<Point>, f64) {
    let mut points: Vec<Point> = Vec::with_capacity(contour.segments.len());
    let mut strayed = 0.0_f64;
    for p in contour.segments.iter().map(Segment::start) {
        match points.last().map(|last| last.distance(p)).filter(|&far| far <= weld) {
            Some(far) => strayed = strayed.max(far),
            None => points.push(p),
        }
    }
    while points.len() > 1 && points[0].distance(points[points.len() - 1]) <= weld {
        strayed = strayed.max(points[0].distance(points[points.len() - 1]));
        points.pop();
    }
    (if points.len() > 2 { points } else { Vec::new() }, strayed)
}
