//! The point of a skeleton edge at a given clearance, and edges as curves.
//!
//! Edges are monotone in clearance and lie on one side of the axis of symmetry of their two sites, so that the point at
//! clearance `d` is the one intersection of the sites' parallels on that side: a closed form, polished by two steps that
//! split the error into a part along the edge and a part across it. Where that leaves the edge or misses the clearance
//! (nearly tangent sites), the edge itself is bisected. The point never lies beyond the edge's end vertices.

use super::carrier::{Carrier, Parallel};
use crate::point::{Point, Vec2};
use crate::segment::{Arc, Segment};
use crate::skeleton::{EdgeId, Skeleton, Vertex};
use crate::tolerance::{COORDINATE_ROUNDOFF, CROSSING, FLAT_EDGE, GRADIENT, SPOKE_RATE};
use std::f64::consts::FRAC_PI_2;

/// Halvings of an edge that leave less than rounding.
const BISECTIONS: usize = 60;
/// Newton steps: the closed form is at most one step from rounding.
const POLISH: usize = 3;
/// Halvings of a curved edge when it is drawn with chords.
const CHORD_DEPTH: usize = 12;

/// The same as a number of chords of equal length.
const MOST_CHORDS: f64 = (1_u32 << CHORD_DEPTH) as f64;
/// What counts as next to nothing beside a radius: how far apart centres lie, or a place from their common axis.
const ECCENTRIC: f64 = 1.0 / 64.0;

/// An edge of the skeleton, directed towards larger clearance, with the two sites that form it.
#[derive(Clone, Copy, Debug)]
pub struct EdgeCurve {
    low: Vertex,
    high: Vertex,
    /// The site to the right when going up.
    right: Carrier,
    left: Carrier,
}

/// How far chords may leave an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chording {
    tolerance: f64,
    /// Chords that keep this clearance may leave it further.
    floor: f64,
}

impl From<f64> for Chording {
    fn from(tolerance: f64) -> Self {
        Self { tolerance, floor: f64::INFINITY }
    }
}

impl Chording {
    /// Whether a chord between points of these clearances keeps clear: clearance changes by no more than the way.
    fn is_clear(self, a: (f64, Point), b: (f64, Point)) -> bool {
        0.5 * (a.0 + b.0 - a.1.distance(b.1)) >= self.floor
    }
}

impl EdgeCurve {
    /// The curve of a half-edge or its twin: both give the same.
    pub fn new(skeleton: &Skeleton, edge: EdgeId) -> Self {
        let up = upward(skeleton, edge);
        let vertex = |e| skeleton.vertices()[skeleton.origin(e) as usize];
        let carrier = |e| Carrier::of(skeleton.sites()[skeleton.site(e) as usize].shape);
        let down = Skeleton::twin(up);
        Self { low: vertex(up), high: vertex(down), right: carrier(up), left: carrier(down) }
    }

    /// The vertex with the smaller clearance.
    pub const fn low(&self) -> Vertex {
        self.low
    }

    /// The vertex with the larger clearance.
    pub const fn high(&self) -> Vertex {
        self.high
    }

    /// The point at clearance `d`, an end vertex where `d` lies outside the edge's range.
    pub fn at_clearance(&self, d: f64) -> Point {
        if d <= self.low.clearance {
            return self.low.point;
        }
        if d >= self.high.clearance {
            return self.high.point;
        }
        let (guess, error) = self.polished(self.closed_form(d), d);
        if self.within(guess) && error <= CROSSING * self.scale() {
            return guess;
        }
        let sought = self.bisected(d);
        let best = if self.within(guess) && error < self.error(sought, d) { guess } else { sought };
        if best.is_finite() { best } else { self.chord(d) }
    }

    /// The part of the edge between two clearances, from `from` to `to`, as lines and arcs: exact where the edge is
    /// straight or circular, else chords that stay within `tolerance` of it.
    pub fn between(&self, from: f64, to: f64, tolerance: f64) -> Vec<Segment> {
        self.path((from, self.at_clearance(from)), (to, self.at_clearance(to)), from <= to, tolerance.into())
    }

    /// The whole edge as lines and arcs, upwards or downwards; see [`EdgeCurve::between`]. It serves edges of constant
    /// clearance too.
    pub fn whole(&self, upward: bool, tolerance: f64) -> Vec<Segment> {
        self.end_to_end(upward, tolerance.into())
    }

    /// The edge as a way for a tool that has to keep the clearance `floor`: from end to end, or up from where the edge has
    /// it. Curved edges are left for chords of any length that provably keep it, else followed within `tolerance`.
    pub fn clear(&self, upward: bool, floor: f64, tolerance: f64) -> Vec<Segment> {
        let chording = Chording { tolerance, floor };
        if floor <= self.low.clearance {
            return self.end_to_end(upward, chording);
        }
        let (low, high) = ((floor, self.at_clearance(floor)), (self.high.clearance, self.high.point));
        if upward { self.path(low, high, true, chording) } else { self.path(high, low, false, chording) }
    }

    fn end_to_end(&self, upward: bool, chording: Chording) -> Vec<Segment> {
        let end = |v: Vertex| (v.clearance, v.point);
        let (low, high) = (end(self.low), end(self.high));
        if upward { self.path(low, high, true, chording) } else { self.path(high, low, false, chording) }
    }

    /// The part between two points given with their clearances.
    pub(super) fn path(&self, from: (f64, Point), to: (f64, Point), upward: bool, by: Chording) -> Vec<Segment> {
        let (start, end) = (from.1, to.1);
        if start == end {
            return Vec::new();
        }
        if self.is_straight() {
            return vec![Segment::line(start, end)];
        }
        if let Some(arc) = self.circular(start, end, upward) {
            return vec![Segment::Arc(arc)];
        }
        let points = self.around(start, end, upward, by).unwrap_or_else(|| {
            let mut points = vec![start];
            if self.high.clearance - self.low.clearance <= FLAT_EDGE * self.scale() {
                let ends = [start, end].map(|p| (self.share_of(p), p));
                self.flat_chords(ends[0], ends[1], by, CHORD_DEPTH, &mut points);
            } else {
                self.chords(from, to, by, CHORD_DEPTH, &mut points);
            }
            points
        });
        points.windows(2).filter(|w| w[0] != w[1]).map(|w| Segment::line(w[0], w[1])).collect()
    }

    /// Whether the edge is a straight line.
    fn is_straight(&self) -> bool {
        self.is_spoke()
            || matches!((self.right, self.left), (Carrier::Line(..), Carrier::Line(..)))
            || matches!((self.right, self.left), (Carrier::Point(_), Carrier::Point(_)))
    }

    /// Whether clearance grows like length: the edge leads straight away from both sites.
    fn is_spoke(&self) -> bool {
        let rise = self.high.clearance - self.low.clearance;
        rise >= (1.0 - SPOKE_RATE) * self.low.point.distance(self.high.point)
    }

    /// The centres of both sites, and in which sense the edge leads around them; `upward` tells which of them lies to the right.
    fn centers(&self, upward: bool) -> Option<([Point; 2], bool)> {
        let ((right, right_ccw), (left, left_ccw)) = (self.right.center()?, self.left.center()?);
        Some(([right, left], if upward { right_ccw } else { left_ccw }))
    }

    /// The arc of constant clearance between concentric sites.
    fn circular(&self, start: Point, end: Point, upward: bool) -> Option<Arc> {
        let ([right, left], ccw) = self.centers(upward)?;
        let constant = self.high.clearance - self.low.clearance <= CROSSING * self.scale();
        let concentric = right.distance(left) <= CROSSING * self.scale();
        let radius = start.distance(right).midpoint(end.distance(right));
        (constant && concentric && radius > 0.0).then_some(Arc { start, end, center: right, radius, ccw })
    }

    /// Points of an edge that leads around two centres which are next to the same for more than a quarter of a turn: there the
    /// chord between its ends does not tell on which side of the centres it lies.
    fn around(&self, start: Point, end: Point, upward: bool, by: Chording) -> Option<Vec<Point>> {
        let ([right, left], ccw) = self.centers(upward)?;
        let center = right.midpoint(left);
        let radius = start.distance(center).midpoint(end.distance(center));
        let arc = Arc { start, end, center, radius, ccw };
        if right.distance(left) > ECCENTRIC * radius || arc.sweep().abs() <= FRAC_PI_2 {
            return None;
        }
        let widest = 2.0 * (1.0 - 0.5 * by.tolerance / radius).clamp(0.0, 1.0).acos();
        let count = (arc.sweep().abs() / widest).ceil().min(MOST_CHORDS) as usize;
        let mut points = vec![start];
        for k in 1..count {
            let guess = Segment::Arc(arc).at(k as f64 / count as f64);
            let found = self.brought_to_bisector(guess);
            points.push(Some(found).filter(|p| p.distance(guess) <= ECCENTRIC * radius)?);
        }
        points.push(end);
        Some(points)
    }

    fn chords(&self, a: (f64, Point), b: (f64, Point), by: Chording, depth: usize, out: &mut Vec<Point>) {
        if by.is_clear(a, b) {
            out.push(b.1);
            return;
        }
        let clearance = a.0.midpoint(b.0);
        let middle = self.at_clearance(clearance);
        let off = Segment::line(a.1, b.1).distance(middle);
        if depth == 0 || (off <= 0.5 * by.tolerance && depth < CHORD_DEPTH) {
            out.push(b.1);
        } else {
            self.chords(a, (clearance, middle), by, depth - 1, out);
            self.chords((clearance, middle), b, by, depth - 1, out);
        }
    }

    /// The same where clearance is too nearly constant to tell points apart: halved by their place along the chord.
    fn flat_chords(&self, a: (f64, Point), b: (f64, Point), by: Chording, depth: usize, out: &mut Vec<Point>) {
        if by.is_clear((self.low.clearance, a.1), (self.low.clearance, b.1)) {
            out.push(b.1);
            return;
        }
        let share = a.0.midpoint(b.0);
        let middle = self.on_bisector(share);
        let off = Segment::line(a.1, b.1).distance(middle);
        if depth == 0 || off <= 0.5 * by.tolerance || !middle.is_finite() {
            out.push(b.1);
        } else {
            self.flat_chords(a, (share, middle), by, depth - 1, out);
            self.flat_chords((share, middle), b, by, depth - 1, out);
        }
    }

    /// Where along the chord from the lower to the upper vertex a point lies, as a share of it.
    fn share_of(&self, p: Point) -> f64 {
        let chord = self.high.point - self.low.point;
        ((p - self.low.point).dot(chord) / chord.length_squared()).clamp(0.0, 1.0)
    }

    /// The point of the chord at the share of the way that `d` has of the clearance.
    fn chord(&self, d: f64) -> Point {
        let rise = self.high.clearance - self.low.clearance;
        self.low.point.lerp(self.high.point, (d - self.low.clearance) / rise)
    }

    fn closed_form(&self, d: f64) -> Point {
        if self.is_straight() && !matches!((self.right, self.left), (Carrier::Point(_), Carrier::Point(_))) {
            return self.chord(d);
        }
        let (base, axis, offset) = match (self.right.parallel(d), self.left.parallel(d)) {
            (Parallel::Line(p, u), Parallel::Circle(c, r)) | (Parallel::Circle(c, r), Parallel::Line(p, u)) => {
                let foot = p + u * u.dot(c - p);
                let height = foot.distance(c);
                (foot, u.left(), (r - height) * (r + height))
            }
            (Parallel::Circle(c, r), Parallel::Circle(k, s)) => {
                let apart = c.distance(k);
                let axis = (k - c) / apart;
                let along = 0.5 * (apart + (r - s) * (r + s) / apart);
                (c + axis * along, axis, (r - along) * (r + along))
            }
            (Parallel::Line(..), Parallel::Line(..)) => return self.chord(d),
        };
        let aside = offset.max(0.0).sqrt();
        let side = |p: Point| axis.cross(p - base);
        let (low, high) = (side(self.low.point), side(self.high.point));
        if low.abs().max(high.abs()) <= (CROSSING * self.scale()).max(ECCENTRIC * aside) {
            // from apex to apex: the ends lie on the axis, or next to it on either side, and tell nothing
            let left = base + axis.left() * aside;
            return if self.rises_at(left) { left } else { base - axis.left() * aside };
        }
        let side = if low.abs() > high.abs() { low } else { high };
        base + axis.left() * aside.copysign(side)
    }

    /// Whether clearance grows at `x` in the direction that has the right site to its right.
    fn rises_at(&self, x: Point) -> bool {
        let (g, h) = (self.right.gradient(x), self.left.gradient(x));
        (g - h).right().dot(g + h) > 0.0
    }

    /// A point near the one at clearance `d` after Newton steps towards it, and its error.
    fn polished(&self, mut x: Point, d: f64) -> (Point, f64) {
        let mut off = self.off(x, d);
        let error = |off: (f64, f64)| off.0.abs().max(off.1.abs());
        let rounding = COORDINATE_ROUNDOFF * d;
        for _ in 0..POLISH {
            if error(off) <= rounding {
                break;
            }
            let step = self.step(x, off.0, off.1);
            if !(step.length_squared() > 0.0 && step.length() <= self.low.point.distance(self.high.point)) {
                break;
            }
            let next = self.off(x + step, d);
            if error(next) >= error(off) {
                break;
            }
            (x, off) = (x + step, next);
        }
        (x, error(off))
    }

    /// The least displacement that changes the two distances by these amounts. The half sum and half difference of the
    /// gradients are orthogonal, so one serves clearance and the other keeps to the bisector.
    fn step(&self, x: Point, right: f64, left: f64) -> Vec2 {
        let (g, h) = (self.right.gradient(x), self.left.gradient(x));
        share((g + h) * 0.5, 0.5 * (right + left)) + share((g - h) * 0.5, 0.5 * (right - left))
    }

    /// Bisection on the chord's parameter, each point brought to the bisector across the chord.
    fn bisected(&self, d: f64) -> Point {
        let (mut below, mut above) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let t = f64::midpoint(below, above);
            if self.clearance(self.on_bisector(t)) < d { below = t } else { above = t }
        }
        self.on_bisector(f64::midpoint(below, above))
    }

    fn on_bisector(&self, t: f64) -> Point {
        self.brought_to_bisector(self.low.point.lerp(self.high.point, t))
    }

    /// The point of the bisector next to one near it.
    fn brought_to_bisector(&self, mut x: Point) -> Point {
        for _ in 0..POLISH {
            let off = 0.5 * (self.left.distance(x) - self.right.distance(x));
            x = x + self.step(x, off, -off);
        }
        x
    }

    /// Mean distance of a point to the edge's two sites (to the lines and circles that carry them): its clearance, on the edge.
    pub fn clearance(&self, x: Point) -> f64 {
        self.right.distance(x).midpoint(self.left.distance(x))
    }

    /// What is missing at a point to a distance of `d` from the right and the left site.
    fn off(&self, x: Point, d: f64) -> (f64, f64) {
        (d - self.right.distance(x), d - self.left.distance(x))
    }

    fn error(&self, x: Point, d: f64) -> f64 {
        let (right, left) = self.off(x, d);
        right.abs().max(left.abs())
    }

    /// Whether `x` is as near to both end vertices as they are to each other.
    fn within(&self, x: Point) -> bool {
        let length = self.low.point.distance(self.high.point) * (1.0 + CROSSING) + CROSSING * self.scale();
        x.distance(self.low.point) <= length && x.distance(self.high.point) <= length
    }

    fn scale(&self) -> f64 {
        self.high.clearance + self.low.point.distance(self.high.point)
    }
}

/// The half-edge of a pair that leads towards larger clearance; of equal ends, the even one.
pub fn upward(skeleton: &Skeleton, edge: EdgeId) -> EdgeId {
    let even = edge & !1;
    if skeleton.origin_clearance(even) <= skeleton.target_clearance(even) { even } else { even | 1 }
}

/// The multiple of `gradient` that changes a distance with that gradient by `amount`; none where it says nothing.
fn share(gradient: Vec2, amount: f64) -> Vec2 {
    let squared = gradient.length_squared();
    if squared > GRADIENT { gradient * (amount / squared) } else { Vec2::ZERO }
}
