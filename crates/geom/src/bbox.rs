//! Axis-parallel bounding boxes.

use crate::point::{Point, point};

/// An axis-parallel box; [`BBox::EMPTY`] holds nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BBox {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl BBox {
    /// The box of no point at all.
    pub const EMPTY: Self =
        Self { min: point(f64::INFINITY, f64::INFINITY), max: point(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// The box of two opposite corners.
    pub fn of(a: Point, b: Point) -> Self {
        Self::EMPTY.with(a).with(b)
    }

    /// Grown to hold `p`.
    #[inline]
    pub fn with(self, p: Point) -> Self {
        Self {
            min: point(self.min.x.min(p.x), self.min.y.min(p.y)),
            max: point(self.max.x.max(p.x), self.max.y.max(p.y)),
        }
    }

    /// Grown to hold `other`.
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: point(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: point(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }

    /// Grown by `margin` on every side.
    pub fn inflated(self, margin: f64) -> Self {
        Self {
            min: point(self.min.x - margin, self.min.y - margin),
            max: point(self.max.x + margin, self.max.y + margin),
        }
    }

    /// Whether it holds no point.
    pub fn is_empty(self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y)
    }

    /// Extent along x; 0 for the empty box.
    pub fn width(self) -> f64 {
        (self.max.x - self.min.x).max(0.0)
    }

    /// Extent along y; 0 for the empty box.
    pub fn height(self) -> f64 {
        (self.max.y - self.min.y).max(0.0)
    }

    /// The larger extent: the size that relative tolerances refer to.
    pub fn size(self) -> f64 {
        self.width().max(self.height())
    }

    /// The middle.
    pub fn center(self) -> Point {
        self.min.midpoint(self.max)
    }

    /// Whether `p` lies in the closed box.
    #[inline]
    pub fn contains(self, p: Point) -> bool {
        self.min.x <= p.x && p.x <= self.max.x && self.min.y <= p.y && p.y <= self.max.y
    }

    /// Whether the closed boxes share a point.
    #[inline]
    pub fn intersects(self, other: Self) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }

    /// Squared distance from `p` to the closed box, 0 inside.
    #[inline]
    pub fn distance_squared(self, p: Point) -> f64 {
        let dx = (self.min.x - p.x).max(p.x - self.max.x).max(0.0);
        let dy = (self.min.y - p.y).max(p.y - self.max.y).max(0.0);
        dx * dx + dy * dy
    }
}
