//! Contours by direction: edges, and at corners the directions that sweep from one edge to the next.
//!
//! Directions of travel are compared by angles from a cut that no drawing is expected to use, −π to π. What sweeps
//! past the cut is split there, so that every element has a plain interval of angles. The same edge
//! direction gives the same angle, bit by bit, and all decisions are comparisons of angles: they never contradict one another.

use crate::contour::Contour;
use crate::point::{Point, Vec2};
use crate::predicates::orientation;
use crate::segment::Segment;
use crate::tolerance::profile::{FLAT_SWEEP, SLIGHT};
use crate::tolerance::skeleton::CUSP;
use std::f64::consts::{PI, TAU};

/// Where angles are counted from, radians: a direction like no other.
const CUT: f64 = 2.034_443_935_795_703;

/// A direction of travel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    /// From the cut, −π to π.
    pub(super) angle: f64,
    /// The same as a vector.
    pub(super) unit: Vec2,
}

impl Direction {
    fn of(unit: Vec2) -> Self {
        // Adding zero makes both zeros one.
        let angle = (unit.y + 0.0).atan2(unit.x + 0.0) - CUT;
        Self { angle: if angle <= -PI { angle + TAU } else { angle }, unit }
    }

    /// The cut itself, seen from below (π) or above (−π).
    fn cut(angle: f64) -> Self {
        Self { angle, unit: Vec2::from_angle(CUT + PI) }
    }

    /// Whether it is the cut.
    pub(super) fn is_cut(self) -> bool {
        self.angle.abs() == PI
    }

    /// The angle in (−π, π] that turns this direction into another.
    fn turn_to(self, other: Self) -> f64 {
        let turn = other.angle - self.angle;
        if turn <= -PI {
            turn + TAU
        } else if turn > PI {
            turn - TAU
        } else {
            turn
        }
    }
}

/// How an element turns as its contour is travelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// A line.
    Straight,
    /// An arc to the left, or a convex corner.
    Left,
    /// An arc to the right, or a reflex corner.
    Right,
}

/// A line, an arc, or a corner as an arc of radius 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) turn: Turn,
    pub(super) start: Point,
    pub(super) end: Point,
    center: Point,
    /// Positive to the left, negative (perhaps a negative zero) to the right.
    pub(super) radius: f64,
    /// The least of its directions.
    pub(super) low: Direction,
    /// The greatest.
    pub(super) high: Direction,
}

impl Element {
    /// Signed; infinite at corners.
    pub(super) fn curvature(&self) -> f64 {
        if self.turn == Turn::Straight { 0.0 } else { 1.0 / self.radius }
    }

    /// The angle that its directions span.
    pub(super) fn turning(&self) -> f64 {
        self.high.angle - self.low.angle
    }

    pub(super) const fn is_line(&self) -> bool {
        matches!(self.turn, Turn::Straight)
    }

    pub(super) const fn center(&self) -> Point {
        self.center
    }

    /// The point of an arc or corner that is travelled in this direction.
    pub(super) fn point_at(&self, d: Direction) -> Point {
        let (low, high) = if self.turn == Turn::Right { (self.end, self.start) } else { (self.start, self.end) };
        if d.angle == self.low.angle {
            low
        } else if d.angle == self.high.angle {
            high
        } else {
            self.center + d.unit.right() * self.radius
        }
    }
}

/// The elements of closed contours in a row.
#[derive(Clone, Debug, Default)]
pub(super) struct Elements {
    pub(super) all: Vec<Element>,
    next: Vec<u32>,
    previous: Vec<u32>,
}

impl Elements {
    pub(super) fn new<'a>(contours: impl Iterator<Item = &'a Contour>) -> Self {
        let mut elements = Self::default();
        contours.for_each(|c| elements.add(c));
        elements
    }

    pub(super) fn next(&self, element: u32) -> u32 {
        self.next[element as usize]
    }

    pub(super) fn previous(&self, element: u32) -> u32 {
        self.previous[element as usize]
    }

    /// Joints of arcs that are smooth but for slight bends are smooth: both sides have one direction there.
    fn add(&mut self, contour: &Contour) {
        let first = self.all.len() as u32;
        let mut edges: Vec<Edge> = contour.segments.iter().map(Edge::new).collect();
        for k in 0..edges.len() {
            let next = (k + 1) % edges.len();
            if edges[k].arrives.turn_to(edges[next].leaves).abs() <= SLIGHT {
                if edges[next].bends() {
                    edges[next].leaves = edges[k].arrives;
                } else if edges[k].bends() {
                    edges[k].arrives = edges[next].leaves;
                }
            }
        }
        for (k, edge) in edges.iter().enumerate() {
            self.corner(&edges[(k + edges.len() - 1) % edges.len()], edge);
            self.edge(edge);
        }
        let end = self.all.len() as u32;
        self.next.extend((first..end).map(|k| if k + 1 == end { first } else { k + 1 }));
        self.previous.extend((first..end).map(|k| if k == first { end - 1 } else { k - 1 }));
    }

    fn edge(&mut self, edge: &Edge) {
        let (start, end) = (edge.segment.start(), edge.segment.end());
        match edge.segment {
            Segment::Arc(a) if !edge.flat => {
                self.sweep(a.center, a.radius, a.ccw, (start, edge.leaves), (end, edge.arrives));
            }
            _ => {
                let (turn, d) = (Turn::Straight, edge.leaves);
                self.all.push(Element { turn, start, end, center: start, radius: 0.0, low: d, high: d });
            }
        }
    }

    fn corner(&mut self, before: &Edge, after: &Edge) {
        let (from, to) = (before.arrives, after.leaves);
        let turn = from.turn_to(to);
        if turn == 0.0 {
            return;
        }
        let at = after.segment.start();
        let left = if turn.abs() < 0.5 * PI { turn > 0.0 } else { turns_left(before, after) };
        self.sweep(at, 0.0, left, (at, from), (at, to));
    }

    /// An arc or corner from one direction to another, split at the cut.
    fn sweep(&mut self, center: Point, radius: f64, left: bool, start: (Point, Direction), end: (Point, Direction)) {
        let (turn, radius) = if left { (Turn::Left, radius) } else { (Turn::Right, -radius) };
        let mut push = |(start, from): (Point, Direction), (end, to): (Point, Direction)| {
            let (low, high) = if left { (from, to) } else { (to, from) };
            self.all.push(Element { turn, start, end, center, radius, low, high });
        };
        let passes = if left { end.1.angle < start.1.angle } else { end.1.angle > start.1.angle };
        if !passes {
            return push(start, end);
        }
        let [first, second] = if left { [PI, -PI] } else { [-PI, PI] }.map(Direction::cut);
        let at = center + first.unit.right() * radius;
        push(start, (at, first));
        push((at, second), end);
    }
}

/// An edge with the directions at its ends.
struct Edge {
    segment: Segment,
    leaves: Direction,
    arrives: Direction,
    /// Whether it is an arc whose directions are too close to tell.
    flat: bool,
}

impl Edge {
    /// Whether it is an arc whose ends may turn a little without it being another arc.
    fn bends(&self) -> bool {
        matches!(self.segment, Segment::Arc(a) if !self.flat && a.sweep().abs() > 8.0 * SLIGHT)
    }

    fn new(segment: &Segment) -> Self {
        let [leaves, arrives] = [segment.start_tangent(), segment.end_tangent()].map(Direction::of);
        let flat = match segment {
            Segment::Line(_) => false,
            Segment::Arc(a) => {
                let turn = leaves.turn_to(arrives);
                let way = if a.ccw { turn } else { -turn };
                way < FLAT_SWEEP && a.sweep().abs() < 1.0
            }
        };
        let chord = || Direction::of((segment.end() - segment.start()).normalized());
        let (leaves, arrives) = if flat { (chord(), chord()) } else { (leaves, arrives) };
        let line = matches!(segment, Segment::Line(_));
        Self { segment: *segment, leaves, arrives: if line { leaves } else { arrives }, flat }
    }
}

/// Whether a contour turns left at a corner sharper than a right angle.
fn turns_left(before: &Edge, after: &Edge) -> bool {
    if let (Segment::Line(b), Segment::Line(a)) = (&before.segment, &after.segment) {
        return orientation(b.start, b.end, a.end) > 0.0;
    }
    let cross = before.arrives.unit.cross(after.leaves.unit);
    // At a cusp the curve that bends away more tells on which side of the other it lies.
    if cross.abs() < CUSP { before.segment.curvature() + after.segment.curvature() < 0.0 } else { cross > 0.0 }
}
