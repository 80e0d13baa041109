//! The mitre offset, the Minkowski sum and the booleans of `clipper2-rust`, on an integer grid.
//!
//! Where edges are far shorter than the distance, the peer's raw curve crosses itself a billion times. There the strips and mitres that the raw
//! curve goes round are united by the peer instead, neighbours first, so that nearly all crossings are gone before they meet.

use clipper2_rust::clipper::{difference_64, inflate_paths_64, rect_clip_64, union_64, union_subjects_64};
use clipper2_rust::core::{FillRule, Path64, Paths64, Point64, Rect64};
use clipper2_rust::minkowski::minkowski_sum;
use clipper2_rust::offset::{EndType, JoinType};
use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::Offset;
use pocketry_geom::{BBox, Contour, Point, Region, Segment, point};

/// Steps of the grid in the region's size.
const STEPS: f64 = 1e9;

/// What is no wider than this many steps of the grid is rounding.
const ROUNDING: f64 = 4.0;

/// Windows are halved until they have no more walls nearby than this.
const FEW: usize = 1000;

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
        region.contours().iter().map(|c| self.path(c.segments.iter().map(Segment::start))).collect()
    }

    pub(crate) fn offset(&self, offset: &Offset) -> Paths64 {
        offset.loops.iter().map(|l| self.path(l.contour.segments.iter().map(Segment::start))).collect()
    }

    /// Their offset, with the same fallback beyond the limit: square, at the offset distance.
    pub(crate) fn inwards(&self, paths: &Paths64, distance: f64, limit: f64) -> Paths64 {
        inflate_paths_64(paths, -distance * self.scale, JoinType::Miter, EndType::Polygon, limit, 0.0)
    }

    /// The same, put together from strips and mitres.
    pub(crate) fn inwards_by_parts(&self, region: &Region, distance: f64, limit: f64) -> Paths64 {
        let parts = region.contours().iter().flat_map(|c| strips_and_mitres(c, distance, limit));
        without(&self.region(region), parts.map(|p| vec![self.path(p.into_iter())]).collect())
    }

    /// The places in a window of a convex polygon, with its reference point at the origin, in a region of lines: what the polygon reflected
    /// does not reach from any edge.
    pub(crate) fn places(&self, window: &Window, polygon: &[Point]) -> Paths64 {
        let turned = polygon.iter().map(|p| p.to_vec() * -self.scale);
        let pattern: Path64 = turned.map(|v| Point64::new(v.x.round() as i64, v.y.round() as i64)).collect();
        let reach = |s: &Segment| {
            let ends = self.path([s.start(), s.end()].into_iter());
            // The sum of a path and a polygon is without the polygon's inside where the path is short.
            let at_start = pattern.iter().map(|q| Point64::new(ends[0].x + q.x, ends[0].y + q.y)).collect();
            let mut reached = minkowski_sum(&pattern, &ends, false);
            reached.push(at_start);
            reached
        };
        without(&window.inside, window.near.iter().map(reach).collect())
    }

    /// Windows that make up a region's box, each with few walls nearer than `far`, or no larger than that.
    pub(crate) fn windows(&self, region: &Region, far: f64) -> Vec<Window> {
        let (boundary, paths) = (Boundary::new(region), self.region(region));
        let (mut windows, mut rest) = (Vec::new(), vec![region.bbox()]);
        while let Some(bbox) = rest.pop() {
            let mut near = Vec::new();
            boundary.index().visit(bbox, far, |k, _| near.push(k));
            if bbox.size() <= far || near.len() <= FEW {
                near.sort_unstable();
                let near = near.into_iter().map(|k| boundary.segments()[k]).collect();
                windows.push(Window { bbox, inside: self.within(&paths, bbox), near });
            } else {
                rest.extend(halves(bbox));
            }
        }
        windows
    }

    /// What lies in a window.
    pub(crate) fn within(&self, paths: &Paths64, window: BBox) -> Paths64 {
        let corners = self.path([window.min, window.max].into_iter());
        rect_clip_64(&Rect64::new(corners[0].x, corners[0].y, corners[1].x, corners[1].y), paths)
    }

    /// A point in each part of the first that is not in the second.
    pub(crate) fn excess(&self, first: &Paths64, second: &Paths64) -> Vec<Point> {
        let parts = difference_64(first, second, FillRule::NonZero);
        let back = |p: Point| self.origin + (p - Point::ORIGIN) / self.scale;
        parts.iter().filter(|p| is_wide(p)).filter_map(|p| middle(p)).map(back).collect()
    }
}

/// A part of the plane, with what of a region matters there.
pub(crate) struct Window {
    pub(crate) bbox: BBox,
    /// What of the region lies in it.
    inside: Paths64,
    /// The walls near it, in the region's order.
    near: Vec<Segment>,
}

/// Halved across its longer side.
fn halves(window: BBox) -> [BBox; 2] {
    let c = window.center();
    let corner = if window.width() > window.height() {
        [point(c.x, window.max.y), point(c.x, window.min.y)]
    } else {
        [point(window.max.x, c.y), point(window.min.x, c.y)]
    };
    [BBox { max: corner[0], ..window }, BBox { min: corner[1], ..window }]
}

/// Something without parts, which are in such an order that neighbours lie near one another.
fn without(paths: &Paths64, mut unions: Vec<Paths64>) -> Paths64 {
    while unions.len() > 1 {
        unions = unions.chunks(2).map(united).collect();
    }
    difference_64(paths, &unions.pop().unwrap_or_default(), FillRule::NonZero)
}

/// Whether a part is wider than the rounding of its corners: parts that share an edge leave slits of a step or two. Holes, which run the other
/// way round, are not.
fn is_wide(part: &[Point64]) -> bool {
    let next = part.iter().cycle().skip(1);
    let length: f64 = part.iter().zip(next).map(|(a, b)| ((a.x - b.x) as f64).hypot((a.y - b.y) as f64)).sum();
    clipper2_rust::core::area(&part.to_vec()) > ROUNDING * length
}

fn united(pair: &[Paths64]) -> Paths64 {
    match pair {
        [a, b] => union_64(a, b, FillRule::NonZero),
        one => union_subjects_64(&one.concat(), FillRule::NonZero),
    }
}

/// The polygons that the offset of a contour sweeps, in its order: the strip along each edge, and what closes the gap after it.
fn strips_and_mitres(contour: &Contour, d: f64, limit: f64) -> Vec<Vec<Point>> {
    let edges = &contour.segments;
    let mut parts = Vec::with_capacity(2 * edges.len());
    for (k, a) in edges.iter().enumerate() {
        let up = a.start_tangent().left() * d;
        parts.push(vec![a.start(), a.end(), a.end() + up, a.start() + up]);
        parts.extend(mitre(a, &edges[(k + 1) % edges.len()], d, limit));
    }
    parts
}

/// The mitre at a reflex vertex, cut square at the distance where it is longer than the limit.
fn mitre(a: &Segment, b: &Segment, d: f64, limit: f64) -> Option<Vec<Point>> {
    let (u, v, at) = (a.start_tangent(), b.start_tangent(), b.start());
    let half = 0.5 * u.angle_to(v);
    let (up, down) = (at + u.left() * d, at + v.left() * d);
    // On along the offset of an edge to the tip, or to where the cut, square to the bisector, leaves it.
    let ahead = d * if 1.0 / half.cos() > limit { (0.5 * half).tan().abs() } else { half.tan().abs() };
    (half < 0.0).then(|| vec![at, down, down - v * ahead, up + u * ahead, up])
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
