//! Boxes turned along what they hold.

use crate::bbox::BBox;
use crate::point::{Point, Vec2, vec2};
use crate::segment::Segment;

/// A box with its own axis: it holds the points whose components along `axis` and along its left normal lie in range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oriented {
    axis: Vec2,
    low: Vec2,
    high: Vec2,
}

impl Oriented {
    /// Holds nothing.
    pub(crate) const EMPTY: Self = Self {
        axis: vec2(1.0, 0.0),
        low: vec2(f64::INFINITY, f64::INFINITY),
        high: vec2(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn empty_along(axis: Vec2) -> Self {
        Self { axis, ..Self::EMPTY }
    }

    /// An axis-parallel box seen from `origin`.
    pub(crate) fn of(bbox: BBox, origin: Point) -> Self {
        Self { axis: vec2(1.0, 0.0), low: bbox.min - origin, high: bbox.max - origin }
    }

    /// The tightest of the boxes along x and along each segment's chord.
    pub(crate) fn around(segments: &[Segment], origin: Point) -> Self {
        let chords = segments.iter().map(|s| s.end() - s.start()).filter(|c| c.length_squared() > 0.0);
        Self::smallest(chords.map(Vec2::normalized), |b| segments.iter().for_each(|s| b.grow(s, origin)))
    }

    /// The box along an axis (any, if that has no length).
    pub(crate) fn along(axis: Vec2, segments: &[Segment], origin: Point) -> Self {
        let mut grown = if axis == Vec2::ZERO { Self::EMPTY } else { Self::empty_along(axis) };
        for s in segments {
            grown.grow(s, origin);
        }
        grown
    }

    /// The tightest of the boxes along x and along either box's axis that hold both.
    pub(super) fn merged(a: &Self, b: &Self) -> Self {
        Self::smallest([a.axis, b.axis].into_iter(), |grown| {
            a.corners().into_iter().chain(b.corners()).for_each(|c| grown.include(c));
        })
    }

    fn smallest(axes: impl Iterator<Item = Vec2>, fill: impl Fn(&mut Self)) -> Self {
        let mut best = Self::EMPTY;
        fill(&mut best);
        for axis in axes {
            let mut candidate = Self::empty_along(axis);
            fill(&mut candidate);
            if candidate.perimeter_and_area() < best.perimeter_and_area() {
                best = candidate;
            }
        }
        best
    }

    /// Area, ties (segments that are straight) broken by the extents' sum.
    fn perimeter_and_area(&self) -> (f64, f64) {
        let extent = self.high - self.low;
        (extent.x * extent.y, extent.x + extent.y)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    fn local(&self, v: Vec2) -> Vec2 {
        vec2(self.axis.dot(v), self.axis.cross(v))
    }

    fn world(&self, v: Vec2) -> Vec2 {
        self.axis * v.x + self.axis.left() * v.y
    }

    fn include(&mut self, v: Vec2) {
        let at = self.local(v);
        self.low = vec2(self.low.x.min(at.x), self.low.y.min(at.y));
        self.high = vec2(self.high.x.max(at.x), self.high.y.max(at.y));
    }

    fn grow(&mut self, segment: &Segment, origin: Point) {
        self.include(segment.start() - origin);
        self.include(segment.end() - origin);
        if let Segment::Arc(a) = segment {
            let directions = [self.axis, self.axis.left(), -self.axis, self.axis.right()];
            for d in directions.into_iter().filter(|&d| a.spans(d)) {
                self.include(a.center - origin + d * a.radius);
            }
        }
    }

    fn corners(&self) -> impl IntoIterator<Item = Vec2> + use<> {
        let (l, h) = (self.low, self.high);
        let corners = [l, vec2(h.x, l.y), h, vec2(l.x, h.y)].map(|v| self.world(v));
        corners.into_iter().take(if self.is_empty() { 0 } else { 4 })
    }

    /// The middle.
    pub(super) fn center(&self) -> Vec2 {
        self.world((self.low + self.high) * 0.5)
    }

    /// Distance from `v` to the box, 0 inside.
    #[inline]
    pub(crate) fn distance(&self, v: Vec2) -> f64 {
        let at = self.local(v);
        let dx = (self.low.x - at.x).max(at.x - self.high.x).max(0.0);
        let dy = (self.low.y - at.y).max(at.y - self.high.y).max(0.0);
        (dx * dx + dy * dy).sqrt()
    }

    /// Whether the boxes lie closer than `margin` along all four of their axes (separating axis test, conservative).
    #[inline]
    pub(super) fn comes_within(&self, other: &Self, margin: f64) -> bool {
        self.gap_along_own_axes(other) <= margin && other.gap_along_own_axes(self) <= margin
    }

    /// A lower bound of the distance between two boxes: the largest gap along one of their axes.
    #[inline]
    pub(crate) fn gap(&self, other: &Self) -> f64 {
        self.gap_along_own_axes(other).max(other.gap_along_own_axes(self)).max(0.0)
    }

    #[inline]
    fn gap_along_own_axes(&self, other: &Self) -> f64 {
        if self.is_empty() || other.is_empty() {
            return f64::INFINITY;
        }
        let (cos, sin) = (self.axis.dot(other.axis), self.axis.cross(other.axis));
        let half = (other.high - other.low) * 0.5;
        let reach = vec2(cos.abs() * half.x + sin.abs() * half.y, sin.abs() * half.x + cos.abs() * half.y);
        let middle = (other.low + other.high) * 0.5;
        let at = vec2(cos * middle.x - sin * middle.y, sin * middle.x + cos * middle.y);
        let gap = |low: f64, high: f64, at: f64, reach: f64| (low - at - reach).max(at - reach - high);
        gap(self.low.x, self.high.x, at.x, reach.x).max(gap(self.low.y, self.high.y, at.y, reach.y))
    }

    /// Whether the box may meet the horizontal segment from abscissa `left` to the point `right`.
    #[inline]
    pub(super) fn meets_row(&self, left: f64, right: Vec2, slack: f64) -> bool {
        if self.is_empty() {
            return false;
        }
        let (middle, half) = (self.center(), (self.high - self.low) * 0.5);
        let reach_x = self.axis.x.abs() * half.x + self.axis.y.abs() * half.y + slack;
        let reach_y = self.axis.y.abs() * half.x + self.axis.x.abs() * half.y + slack;
        if (middle.y - right.y).abs() > reach_y || middle.x - reach_x > right.x || middle.x + reach_x < left {
            return false;
        }
        if left == f64::NEG_INFINITY {
            return true;
        }
        let row = Self { axis: vec2(1.0, 0.0), low: vec2(left, right.y), high: right };
        self.gap_along_own_axes(&row) <= slack
    }
}
