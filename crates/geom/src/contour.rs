//! Closed chains of segments.

use crate::bbox::BBox;
use crate::point::{Point, Vec2};
use crate::segment::Segment;
use serde::{Deserialize, Serialize};

/// A closed curve of lines and arcs: each segment ends exactly where the next one starts, the last where the first starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Contour {
    /// The edges in order of travel.
    pub segments: Vec<Segment>,
}

impl Contour {
    /// A contour of these segments, which must close.
    pub const fn new(segments: Vec<Segment>) -> Self {
        Self { segments }
    }

    /// A contour from polyline vertices `[x, y, bulge]`; vertices that repeat the one before them are skipped.
    pub fn from_vertices(vertices: &[[f64; 3]]) -> Self {
        let point = |k: usize| Point::new(vertices[k % vertices.len()][0], vertices[k % vertices.len()][1]);
        let segments = (0..vertices.len())
            .filter(|&k| point(k) != point(k + 1))
            .map(|k| Segment::from_bulge(point(k), point(k + 1), vertices[k][2]))
            .collect();
        Self { segments }
    }

    /// The vertices `[x, y, bulge]` of this contour.
    pub fn to_vertices(&self) -> Vec<[f64; 3]> {
        self.segments.iter().map(Into::into).collect()
    }

    /// Signed area, mm²: positive where it runs counter-clockwise.
    pub fn area(&self) -> f64 {
        let origin = self.segments.first().map_or(Point::ORIGIN, Segment::start);
        0.5 * self.segments.iter().map(|s| s.area_twice(origin)).sum::<f64>()
    }

    /// Length, mm.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// Smallest axis-parallel box.
    pub fn bbox(&self) -> BBox {
        self.segments.iter().fold(BBox::EMPTY, |b, s| b.union(s.bbox()))
    }

    /// The same curve travelled the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { segments: self.segments.iter().rev().map(Segment::reversed).collect() }
    }

    /// Moved by `by`.
    #[must_use]
    pub fn translated(&self, by: Vec2) -> Self {
        Self { segments: self.segments.iter().map(|s| s.translated(by)).collect() }
    }

    /// Distance from `p` to the curve (all segments are looked at; see the spatial index for many queries).
    pub fn distance(&self, p: Point) -> f64 {
        self.segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min)
    }
}
