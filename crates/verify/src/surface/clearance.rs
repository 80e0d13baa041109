//! How deep the cutter stands in the model, measured along the normal, at one place of its tip.
//!
//! Two ways to touch are looked at. An *edge's* point inside the cutter lies as deep as it is from the cutter's surface; along an edge that is a
//! concave function, so that its top is found by narrowing. A *facet*
//! meets the cutter first at the point that reaches deepest below the facet's plane, where that point's foot lies in the facet (or, once
//! it is below, where the facet lies above it). Vertical facets are bounded by edges. The greatest of all is the gouge;
//! where it is negative, nothing is nearer to the cutter than that.

use super::body::Body;
use pocketry_geom::mesh::{Corner, Mesh, above};
use pocketry_geom::tolerance::proof::NARROWED;
use pocketry_geom::{BBox, Point};

/// A facet prepared for many questions.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corners: [Corner; 3],
    /// Unit normal that points up; `None` for a vertical facet.
    normal: Option<Corner>,
    /// Which of its edges are its to judge: each edge has one owner.
    owns: [bool; 3],
    bbox: BBox,
    top: f64,
}

/// The model by where its facets lie seen from above.
#[derive(Clone, Debug)]
pub(super) struct Clearance {
    body: Body,
    /// Farther than this from the cutter nothing is looked at, mm.
    pub(super) horizon: f64,
    facets: Vec<Facet>,
    bounds: BBox,
    cell: f64,
    columns: usize,
    /// For each cell its facets, the highest first.
    cells: Vec<Vec<u32>>,
}

/// Cells along the longer side at most.
const MOST_CELLS: f64 = 1000.0;

impl Clearance {
    pub(super) fn new(mesh: &Mesh, body: Body, horizon: f64) -> Self {
        let mut owned = vec![false; mesh.edges().len()];
        let mut facets: Vec<Facet> = (0..mesh.facets().len())
            .map(|f| {
                let owns = mesh.sides()[f].map(|e| !std::mem::replace(&mut owned[e as usize], true));
                Facet::new(mesh.corners(f), owns)
            })
            .collect();
        facets.sort_by(|a, b| b.top.total_cmp(&a.top));
        let bounds = mesh.bbox();
        let cell = (0.5 * body.radius).max(bounds.size() / MOST_CELLS);
        let count = |extent: f64| (extent / cell).floor() as usize + 1;
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        let mut own =
            Self { body, horizon, facets: Vec::new(), bounds, cell, columns, cells: vec![Vec::new(); columns * rows] };
        for (k, facet) in facets.iter().enumerate() {
            for c in own.covered(facet.bbox) {
                own.cells[c].push(k as u32);
            }
        }
        own.facets = facets;
        own
    }

    fn covered(&self, bbox: BBox) -> impl Iterator<Item = usize> + use<> {
        let (cell, columns, rows) = (self.cell, self.columns, self.cells.len() / self.columns);
        let index = |x: f64, count: usize| (x / cell).floor().clamp(0.0, count as f64 - 1.0) as usize;
        let min = self.bounds.min;
        let (i, m) = (index(bbox.min.x - min.x, columns), index(bbox.max.x - min.x, columns));
        let (j, n) = (index(bbox.min.y - min.y, rows), index(bbox.max.y - min.y, rows));
        (j..=n).flat_map(move |j| (i..=m).map(move |i| j * columns + i))
    }

    /// The depth with the tip at `p` and height `z`, mm; not below minus the horizon.
    pub(super) fn depth(&self, p: Point, z: f64) -> f64 {
        self.deeper_than(p, z, -self.horizon, f64::INFINITY)
    }

    /// Whether nothing is nearer to the cutter than `clearance`.
    pub(super) fn is_clear(&self, p: Point, z: f64, clearance: f64) -> bool {
        self.deeper_than(p, z, -clearance, -clearance) <= -clearance
    }

    /// The greatest depth, if above `known`; any above `enough` will do.
    fn deeper_than(&self, p: Point, z: f64, known: f64, enough: f64) -> f64 {
        let radius = self.body.radius;
        let reach = BBox::of(p, p).inflated(radius - known.min(0.0));
        let mut most = known;
        if !reach.intersects(self.bounds) {
            return most;
        }
        for c in self.covered(reach) {
            for &k in &self.cells[c] {
                let facet = &self.facets[k as usize];
                if self.body.depth_below(facet.top - z) <= most || most > enough {
                    break;
                }
                if radius - facet.bbox.distance_squared(p).sqrt() > most {
                    most = self.facet_depth(facet, p, z, most);
                }
            }
        }
        most
    }

    fn facet_depth(&self, facet: &Facet, p: Point, z: f64, mut most: f64) -> f64 {
        if let Some(n) = facet.normal {
            let low = self.body.deepest(n);
            let at = [p.x + low[0], p.y + low[1], z + low[2]];
            let a = facet.corners[0];
            let depth = n[0] * (a[0] - at[0]) + n[1] * (a[1] - at[1]) + n[2] * (a[2] - at[2]);
            let foot = [0, 1, 2].map(|k| at[k] + depth * n[k]);
            if depth > most && facet.is_above(above(if depth > 0.0 { at } else { foot })) {
                most = depth;
            }
        }
        for k in (0..3).filter(|&k| facet.owns[k]) {
            most = self.edge_depth([facet.corners[k], facet.corners[(k + 1) % 3]], p, z, most);
        }
        most
    }

    /// The greatest depth along an edge, if above `most`: depth grows no faster than the way along the edge, and is concave.
    fn edge_depth(&self, [a, b]: [Corner; 2], p: Point, z: f64, most: f64) -> f64 {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
        let at = |t: f64| {
            let c = [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            self.body.depth(p.distance(above(c)), c[2] - z)
        };
        let (mut low, mut high) = (0.0, 1.0);
        if at(0.5) + 0.5 * length <= most {
            return most;
        }
        let mut best = f64::max(at(0.0), at(1.0));
        while (high - low) * length > NARROWED {
            let (s, t) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            let (u, v) = (at(s), at(t));
            best = best.max(u).max(v);
            if u.max(v) + (high - low) * length <= most {
                break;
            }
            if u < v { low = s } else { high = t }
        }
        best.max(most)
    }
}

impl Facet {
    fn new(corners: [Corner; 3], owns: [bool; 3]) -> Self {
        let [a, b, c] = corners;
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = n[0].hypot(n[1]).hypot(n[2]);
        let up = if n[2] < 0.0 { -length } else { length };
        let normal = (n[2] != 0.0 && length > 0.0).then(|| n.map(|x| x / up));
        Self {
            corners,
            normal,
            owns,
            bbox: corners.iter().fold(BBox::EMPTY, |b, &c| b.with(above(c))),
            top: corners.iter().map(|c| c[2]).fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Whether the facet lies above or below `p`, seen from above.
    fn is_above(&self, p: Point) -> bool {
        let [a, b, c] = self.corners.map(above);
        let sides = [(a, b), (b, c), (c, a)].map(|(s, t)| (t - s).cross(p - s));
        sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0)
    }
}
