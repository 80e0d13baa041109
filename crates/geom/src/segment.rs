//! Line segments and circular arcs, the edges of every contour.

use crate::bbox::BBox;
use crate::point::{Point, Vec2, vec2};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// A straight segment from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
}

/// A circular arc from `start` to `end` about `center`.
///
/// `start == end` means the full turn. The five numbers are redundant on purpose: end points are shared
/// exactly with the neighbours, and arcs of one circle share `center` and `radius` exactly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arc {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// Centre of its circle.
    pub center: Point,
    /// Radius of its circle, mm, positive.
    pub radius: f64,
    /// Whether it is travelled counter-clockwise.
    pub ccw: bool,
}

/// An edge of a contour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Segment {
    /// Straight.
    Line(Line),
    /// Circular.
    Arc(Arc),
}

impl Line {
    /// The segment between two points.
    pub const fn new(start: Point, end: Point) -> Self {
        Self { start, end }
    }

    /// Unit direction of travel.
    pub fn direction(&self) -> Vec2 {
        (self.end - self.start).normalized()
    }

    /// The point of the closed segment nearest to `p`.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        let along = self.end - self.start;
        let t = (p - self.start).dot(along) / along.length_squared();
        if t <= 0.0 || t.is_nan() {
            self.start
        } else if t >= 1.0 {
            self.end
        } else {
            self.start + along * t
        }
    }

    /// Distance from `p` to the closed segment.
    #[inline]
    pub fn distance(&self, p: Point) -> f64 {
        let along = self.end - self.start;
        let from = p - self.start;
        let t = from.dot(along);
        if t <= 0.0 {
            from.length()
        } else if t >= along.length_squared() {
            p.distance(self.end)
        } else {
            (along.cross(from) / along.length()).abs()
        }
    }
}

impl Arc {
    /// The arc between two points with a DXF bulge, the tangent of a quarter of its sweep (positive to the left).
    ///
    /// Needs `start != end` and a finite bulge other than 0.
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Self {
        let chord = end - start;
        let length = chord.length();
        let radius = length * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        let height = length * (1.0 - bulge * bulge) / (4.0 * bulge);
        let center = start.midpoint(end) + chord.left() * (height / length);
        Self { start, end, center, radius, ccw: bulge > 0.0 }
    }

    /// Signed sweep in [−2π, 2π], positive counter-clockwise; ±2π where `start == end`.
    pub fn sweep(&self) -> f64 {
        if self.start == self.end {
            return if self.ccw { TAU } else { -TAU };
        }
        let turn = (self.start - self.center).angle_to(self.end - self.center);
        match (self.ccw, turn > 0.0) {
            (true, true) | (false, false) => turn,
            (true, false) => turn + TAU,
            (false, true) => turn - TAU,
        }
    }

    /// The DXF bulge: tangent of a quarter of the sweep.
    pub fn bulge(&self) -> f64 {
        (self.sweep() / 4.0).tan()
    }

    /// How far its middle lies from its chord, for arcs of less than a full turn.
    pub fn height(&self) -> f64 {
        0.5 * self.start.distance(self.end) * self.bulge().abs()
    }

    /// Whether the direction `from_center` points into the arc's closed angular range.
    #[inline]
    pub fn spans(&self, from_center: Vec2) -> bool {
        let (mut s, mut e) = (self.start - self.center, self.end - self.center);
        if self.start == self.end {
            return true;
        }
        if !self.ccw {
            std::mem::swap(&mut s, &mut e);
        }
        let after_start = s.cross(from_center) >= 0.0;
        let before_end = from_center.cross(e) >= 0.0;
        let turn = s.cross(e);
        if turn > 0.0 || (turn == 0.0 && s.dot(e) > 0.0) {
            after_start && before_end
        } else {
            after_start || before_end
        }
    }

    /// The point of the arc nearest to `p`; `start` where `p` is the centre.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        let from_center = p - self.center;
        let length = from_center.length();
        if length > 0.0 && self.spans(from_center) {
            self.center + from_center * (self.radius / length)
        } else if p.distance_squared(self.start) <= p.distance_squared(self.end) {
            self.start
        } else {
            self.end
        }
    }

    /// Distance from `p` to the closed arc.
    #[inline]
    pub fn distance(&self, p: Point) -> f64 {
        let from_center = p - self.center;
        if self.spans(from_center) {
            self.radial_distance(p).abs()
        } else {
            p.distance_squared(self.start).min(p.distance_squared(self.end)).sqrt()
        }
    }

    /// Signed distance from `p` to the circle, positive outside, exact to rounding for radii far larger than the part.
    #[inline]
    pub fn radial_distance(&self, p: Point) -> f64 {
        let from_start = p - self.start;
        let outward = self.start - self.center;
        let excess = from_start.dot(from_start + outward * 2.0);
        excess / ((p - self.center).length() + self.radius)
    }

    /// Unit direction of travel at a point of the arc.
    pub fn tangent_at(&self, p: Point) -> Vec2 {
        let outward = (p - self.center).normalized();
        if self.ccw { outward.left() } else { outward.right() }
    }
}

impl Segment {
    /// A straight segment.
    pub const fn line(start: Point, end: Point) -> Self {
        Self::Line(Line { start, end })
    }

    /// A segment as a polyline vertex describes it: straight where `bulge` is 0.
    pub fn from_bulge(start: Point, end: Point, bulge: f64) -> Self {
        if bulge == 0.0 || start == end {
            Self::line(start, end)
        } else {
            Self::Arc(Arc::from_bulge(start, end, bulge))
        }
    }

    /// Where it begins.
    #[inline]
    pub const fn start(&self) -> Point {
        match self {
            Self::Line(l) => l.start,
            Self::Arc(a) => a.start,
        }
    }

    /// Where it ends.
    #[inline]
    pub const fn end(&self) -> Point {
        match self {
            Self::Line(l) => l.end,
            Self::Arc(a) => a.end,
        }
    }

    /// The same points travelled the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match *self {
            Self::Line(l) => Self::line(l.end, l.start),
            Self::Arc(a) => Self::Arc(Arc { start: a.end, end: a.start, ccw: !a.ccw, ..a }),
        }
    }

    /// Length, mm.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(l) => l.start.distance(l.end),
            Self::Arc(a) => a.radius * a.sweep().abs(),
        }
    }

    /// DXF bulge, 0 for a line.
    pub fn bulge(&self) -> f64 {
        match self {
            Self::Line(_) => 0.0,
            Self::Arc(a) => a.bulge(),
        }
    }

    /// The point at fraction `t` of the length; exact at `t = 0` and `t = 1`.
    pub fn at(&self, t: f64) -> Point {
        match self {
            Self::Line(l) => l.start.lerp(l.end, t),
            Self::Arc(a) if t == 0.0 => a.start,
            Self::Arc(a) if t == 1.0 => a.end,
            Self::Arc(a) => a.center + (a.start - a.center).rotated(t * a.sweep()),
        }
    }

    /// Unit direction of travel at the start.
    pub fn start_tangent(&self) -> Vec2 {
        match self {
            Self::Line(l) => l.direction(),
            Self::Arc(a) => a.tangent_at(a.start),
        }
    }

    /// Unit direction of travel at the end.
    pub fn end_tangent(&self) -> Vec2 {
        match self {
            Self::Line(l) => l.direction(),
            Self::Arc(a) => a.tangent_at(a.end),
        }
    }

    /// Signed curvature, 1/mm: positive where it bends to the left.
    pub fn curvature(&self) -> f64 {
        match self {
            Self::Line(_) => 0.0,
            Self::Arc(a) => {
                if a.ccw {
                    1.0 / a.radius
                } else {
                    -1.0 / a.radius
                }
            }
        }
    }

    /// The point of the closed segment nearest to `p`.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        match self {
            Self::Line(l) => l.nearest(p),
            Self::Arc(a) => a.nearest(p),
        }
    }

    /// Distance from `p` to the closed segment.
    #[inline]
    pub fn distance(&self, p: Point) -> f64 {
        match self {
            Self::Line(l) => l.distance(p),
            Self::Arc(a) => a.distance(p),
        }
    }

    /// Split at a point of the segment's interior into the parts before and after it.
    pub fn split_at(&self, p: Point) -> (Self, Self) {
        match *self {
            Self::Line(l) => (Self::line(l.start, p), Self::line(p, l.end)),
            Self::Arc(a) => (Self::Arc(Arc { end: p, ..a }), Self::Arc(Arc { start: p, ..a })),
        }
    }

    /// The part between two points of it; from its start or to its end where there is none.
    #[must_use]
    pub fn part(&self, from: Option<Point>, to: Option<Point>) -> Self {
        let rest = from.map_or(*self, |p| self.split_at(p).1);
        to.map_or(rest, |q| rest.split_at(q).0)
    }

    /// The part between two shares of its length.
    #[must_use]
    pub fn between(&self, [from, to]: [f64; 2]) -> Self {
        self.part((from > 0.0).then(|| self.at(from)), (to < 1.0).then(|| self.at(to)))
    }

    /// Smallest axis-parallel box.
    pub fn bbox(&self) -> BBox {
        let ends = BBox::of(self.start(), self.end());
        match self {
            Self::Line(_) => ends,
            Self::Arc(a) => [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0), vec2(0.0, -1.0)]
                .into_iter()
                .filter(|&d| a.spans(d))
                .fold(ends, |b, d| b.with(a.center + d * a.radius)),
        }
    }

    /// Twice the signed area swept by the segment seen from `origin` (Green's theorem).
    pub fn area_twice(&self, origin: Point) -> f64 {
        let chord = (self.start() - origin).cross(self.end() - origin);
        match self {
            Self::Line(_) => chord,
            Self::Arc(a) => {
                let sweep = a.sweep();
                chord + a.radius * a.radius * (sweep - sweep.sin())
            }
        }
    }

    /// Whether every number in it is finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Line(l) => l.start.is_finite() && l.end.is_finite(),
            Self::Arc(a) => a.start.is_finite() && a.end.is_finite() && a.center.is_finite() && a.radius.is_finite(),
        }
    }

    /// Moved by `by`.
    #[must_use]
    pub fn translated(&self, by: Vec2) -> Self {
        match *self {
            Self::Line(l) => Self::line(l.start + by, l.end + by),
            Self::Arc(a) => Self::Arc(Arc { start: a.start + by, end: a.end + by, center: a.center + by, ..a }),
        }
    }

    /// Turned about the origin by an angle, radians counter-clockwise.
    #[must_use]
    pub fn rotated(&self, angle: f64) -> Self {
        if angle == 0.0 {
            return *self;
        }
        let (sin, cos) = angle.sin_cos();
        let turn = |p: Point| Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
        match *self {
            Self::Line(l) => Self::line(turn(l.start), turn(l.end)),
            Self::Arc(a) => Self::Arc(Arc { start: turn(a.start), end: turn(a.end), center: turn(a.center), ..a }),
        }
    }

    /// Points on the segment, start included and end left out, such that no chord lies farther than `tolerance` from it.
    pub fn flatten(&self, tolerance: f64, out: &mut Vec<Point>) {
        out.push(self.start());
        if let Self::Arc(a) = self {
            let sweep = a.sweep();
            let step = 2.0 * (1.0 - (tolerance / a.radius).min(1.0)).acos();
            let count = (sweep.abs() / step.max(PI / 1e6)).ceil().max(1.0) as usize;
            let spoke = a.start - a.center;
            out.extend((1..count).map(|k| a.center + spoke.rotated(sweep * k as f64 / count as f64)));
        }
    }
}

/// The polyline vertex form `(x, y, bulge)` of a segment's start.
impl From<&Segment> for [f64; 3] {
    fn from(s: &Segment) -> Self {
        [s.start().x, s.start().y, s.bulge()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::point;

    #[test]
    fn bulge_one_is_a_half_circle_to_the_right_of_the_chord() {
        let a = Arc::from_bulge(point(0.0, 0.0), point(2.0, 0.0), 1.0);
        assert!(a.ccw && (a.radius - 1.0).abs() < 1e-15);
        assert!((a.sweep() - PI).abs() < 1e-15);
        assert!(a.spans(vec2(0.0, -1.0)) && !a.spans(vec2(0.0, 1.0)));
        let s = Segment::Arc(a);
        assert!(s.at(0.5).distance(point(1.0, -1.0)) < 1e-15);
        assert!((s.bbox().min.y + 1.0).abs() < 1e-15);
    }

    #[test]
    fn large_sweep_spans_more_than_half() {
        let a = Arc::from_bulge(point(0.0, 0.0), point(1.0, 0.0), 3.0);
        assert!(a.sweep() > PI);
        assert!(a.spans(vec2(0.0, -1.0)) && a.spans(vec2(1.0, 0.0)) && a.spans(vec2(-1.0, 0.0)));
        assert!((a.bulge() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn distance_to_an_arc_beyond_its_ends_is_to_the_end() {
        let a = Arc::from_bulge(point(1.0, 0.0), point(0.0, 1.0), (PI / 8.0).tan());
        assert!((a.distance(point(0.0, 0.0)) - 1.0).abs() < 1e-15);
        assert!((a.distance(point(1.0, -1.0)) - 1.0).abs() < 1e-15);
    }
}
