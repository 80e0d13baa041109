//! The skeleton as a half-edge structure in flat arrays.

use crate::point::Point;
use crate::segment::{Arc, Line};

/// Index of a site in [`Skeleton::sites`].
pub type SiteId = u32;
/// Index of a vertex in [`Skeleton::vertices`].
pub type VertexId = u32;
/// Index of a half-edge in [`Skeleton::half_edges`]; its twin is `id ^ 1`.
pub type EdgeId = u32;

/// No such element.
pub const NONE: u32 = u32::MAX;

/// A boundary element that owns a cell of the skeleton (the paper's *owner element*).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Its geometry.
    pub shape: SiteShape,
    /// The contour it belongs to.
    pub contour: u32,
    /// The segment of that contour; for a reflex vertex the segment that starts there.
    pub segment: u32,
    /// The first half-edge of its cell: it leaves the vertex where the site starts.
    pub first: EdgeId,
}

/// The geometry of a site; the pocket lies to the left of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SiteShape {
    /// An open line segment.
    Line(Line),
    /// An open arc.
    Arc(Arc),
    /// A reflex vertex: the interior angle there is above π.
    Point(Point),
}

/// A vertex of the skeleton: the centre of a maximal disk, or a boundary point where cells begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its place.
    pub point: Point,
    /// Its distance to the boundary; 0 at a boundary vertex (convex corner, reflex vertex, smooth joint).
    pub clearance: f64,
}

/// One side of a skeleton edge. Its cell lies to the *right*, so that along `next` the feet run forward along the site,
/// with the pocket's direction of travel. Edges are monotone in clearance (split at apexes).
///
/// A cell's half-edges lead from the boundary vertex where its site starts to the one where it ends; the last one's
/// `next` is the first again (the site itself lies between).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfEdge {
    /// The vertex it leaves.
    pub origin: VertexId,
    /// The following half-edge of the same cell.
    pub next: EdgeId,
    /// The site whose cell lies to the right.
    pub site: SiteId,
}

/// The Voronoi diagram of a region's boundary inside the region, sites being open segments, open arcs and reflex
/// vertices. The normals at reflex vertices and at smooth joints (*spokes*), which bound the cells of the segments
/// there, are edges too. Every connected piece of the region has its own component.
#[derive(Clone, Debug, Default)]
pub struct Skeleton {
    /// Boundary elements, contour by contour in order of travel.
    pub(crate) sites: Vec<Site>,
    /// Vertices.
    pub(crate) vertices: Vec<Vertex>,
    /// Half-edges; `2k` and `2k + 1` are twins.
    pub(crate) half_edges: Vec<HalfEdge>,
}

impl Skeleton {
    /// The sites, contour by contour in order of travel.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// The vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// The half-edges; `2k` and `2k + 1` are twins.
    pub fn half_edges(&self) -> &[HalfEdge] {
        &self.half_edges
    }

    /// Number of (undirected) edges.
    pub fn edge_count(&self) -> usize {
        self.half_edges.len() / 2
    }

    /// The other side of a half-edge.
    #[inline]
    pub const fn twin(e: EdgeId) -> EdgeId {
        e ^ 1
    }

    /// The vertex that a half-edge leaves.
    #[inline]
    pub fn origin(&self, e: EdgeId) -> VertexId {
        self.half_edges[e as usize].origin
    }

    /// The vertex that a half-edge leads to.
    #[inline]
    pub fn target(&self, e: EdgeId) -> VertexId {
        self.half_edges[Self::twin(e) as usize].origin
    }

    /// The following half-edge of the same cell.
    #[inline]
    pub fn next(&self, e: EdgeId) -> EdgeId {
        self.half_edges[e as usize].next
    }

    /// The site whose cell lies to the right of a half-edge.
    #[inline]
    pub fn site(&self, e: EdgeId) -> SiteId {
        self.half_edges[e as usize].site
    }

    /// Clearance at the vertex that a half-edge leaves.
    #[inline]
    pub fn origin_clearance(&self, e: EdgeId) -> f64 {
        self.vertices[self.origin(e) as usize].clearance
    }

    /// Clearance at the vertex that a half-edge leads to.
    #[inline]
    pub fn target_clearance(&self, e: EdgeId) -> f64 {
        self.vertices[self.target(e) as usize].clearance
    }

    /// The half-edges of a site's cell, from the site's start to its end.
    pub fn cell(&self, site: SiteId) -> impl Iterator<Item = EdgeId> + '_ {
        let first = self.sites[site as usize].first;
        let mut at = Some(first).filter(|&e| e != NONE);
        std::iter::from_fn(move || {
            let e = at?;
            at = Some(self.next(e)).filter(|&n| n != first);
            Some(e)
        })
    }
}
