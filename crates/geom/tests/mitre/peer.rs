//! The mitre offset and the booleans of `clipper2-rust`, on an integer grid.

use clipper2_rust::clipper::{difference_64, inflate_paths_64};
use clipper2_rust::core::{FillRule, Paths64, Point64};
use clipper2_rust::offset::{EndType, JoinType};
use pocketry_geom::offset::Offset;
use pocketry_geom::{BBox, Point, Region, point};

/// Steps of the grid in the region's size.
const STEPS: f64 = 1e9;

/// A grid over a region.
pub(crate) struct Grid {
    origin: Point,
    scale: f64,
}

impl Grid {
    pub(crate) fn new(bbox: BBox) -> Self {
        Self { origin: bbox.center(), scale: STEPS / bbox.size() }
    }

    fn path(&self, points: impl Iterator<Item = Point>) -> Vec<Point64> {
        let snap = |p: Point| {
            let v = (p - self.origin) * self.scale;
            Point64::new(v.x.round() as i64, v.y.round() as i64)
        };
        points.map(snap).collect()
    }

    pub(crate) fn region(&self, region: &Region) -> Paths64 {
        region.contours().iter().map(|c| self.path(c.segments.iter().map(pocketry_geom::Segment::start))).collect()
    }

    pub(crate) fn offset(&self, offset: &Offset) -> Paths64 {
        offset.loops.iter().map(|l| self.path(l.contour.segments.iter().map(pocketry_geom::Segment::start))).collect()
    }

    /// Their offset, with the same fallback beyond the limit: square, at the offset distance.
    pub(crate) fn inwards(&self, paths: &Paths64, distance: f64, limit: f64) -> Paths64 {
        inflate_paths_64(paths, -distance * self.scale, JoinType::Miter, EndType::Polygon, limit, 0.0)
    }

    /// A point in each part of the first that is not in the second.
    pub(crate) fn excess(&self, first: &Paths64, second: &Paths64) -> Vec<Point> {
        let parts = difference_64(first, second, FillRule::NonZero);
        let back = |p: Point| self.origin + (p - Point::ORIGIN) / self.scale;
        // Holes run the other way round.
        parts.iter().filter(|p| clipper2_rust::core::area(p) > 0.0).filter_map(|p| middle(p)).map(back).collect()
    }
}

/// A point inside of a polygon: half-way between the first two crossings of its widest row between corners.
fn middle(path: &[Point64]) -> Option<Point> {
    let mut rows: Vec<i64> = path.iter().map(|p| p.y).collect();
    rows.sort_unstable();
    rows.dedup();
    let widest = rows.windows(2).max_by_key(|w| w[1] - w[0])?;
    let y = 0.5 * (widest[0] as f64 + widest[1] as f64);
    let mut xs: Vec<f64> = (0..path.len())
        .filter_map(|k| {
            let (a, b) = (path[k], path[(k + 1) % path.len()]);
            let (ay, by) = (a.y as f64, b.y as f64);
            ((ay < y) != (by < y)).then(|| a.x as f64 + (y - ay) / (by - ay) * (b.x - a.x) as f64)
        })
        .collect();
    xs.sort_by(f64::total_cmp);
    Some(point(0.5 * (xs.first()? + xs.get(1)?), y))
}
