//! What the check finds.

use crate::point::Point;
use crate::skeleton::{EdgeId, SiteId, Skeleton, VertexId};
use std::collections::BTreeMap;
use std::fmt;

/// What can be wrong with a skeleton.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// An index points outside its array, or a half-edge does not end where the next one begins.
    BrokenLink,
    /// A number is not finite.
    NotFinite,
    /// A half-edge lies in no cell, in two, or in one that is not its site's.
    NotInOneCell,
    /// A cell does not begin or end where its site does.
    CellEnds,
    /// Two neighbours along the boundary do not share the vertex between their cells.
    JointNotShared,
    /// A segment or a reflex vertex has no site.
    SiteMissing,
    /// An element has two sites.
    SiteTwice,
    /// A site that is no element of the region: an index out of range, or a point that is no reflex vertex.
    SiteUnexpected,
    /// A site's copy of its element differs from the region's.
    SiteShape,
    /// A vertex's clearance is not its distance to the boundary.
    VertexClearance,
    /// A vertex does not touch a site whose cell it lies on.
    FootDistance,
    /// A vertex lies on the wall's side of a site whose cell it lies on.
    FootSide,
    /// A vertex's foot lies beyond the ends of the site.
    FootOutside,
    /// Contacts do not turn once around a vertex.
    ContactsTurn,
    /// No point equidistant from the two sites was found between an edge's ends.
    EdgeNotEquidistant,
    /// A point of an edge is nearer to another element than to the edge's two sites.
    EdgeClearance,
    /// Clearance rises and falls along one edge.
    NotMonotone,
    /// Feet run backwards along a cell.
    FeetBackwards,
    /// A component's numbers of vertices and edges do not fit its islands and reflex vertices.
    Euler,
    /// A component does not hold exactly the contours of one piece of the region.
    Component,
    /// The cells' areas do not add up to the region's.
    Area,
}

/// The part of a skeleton that a fault concerns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A vertex.
    Vertex(VertexId),
    /// A half-edge (its twin is the same edge).
    Edge(EdgeId),
    /// A site or its cell.
    Site(SiteId),
    /// A segment of the region: contour, segment.
    Segment(u32, u32),
    /// A connected component, by its first vertex.
    Component(VertexId),
    /// The whole.
    Whole,
}

/// One thing that is wrong, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// Which part.
    pub element: Element,
    /// Where.
    pub place: Point,
    /// By how much, in the kind's own measure: lengths and areas as a part of the region's, or a number of elements.
    pub amount: f64,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, element, place, amount } = self;
        write!(f, "{kind:?} of {element:?} at ({}, {}): {amount:.3e}", place.x, place.y)
    }
}

/// The outcome of a check. Lengths are relative to the region's size.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckReport {
    /// The larger extent of the region's box, mm: the unit of the other lengths.
    pub size: f64,
    /// Number of sites.
    pub sites: usize,
    /// Number of vertices, those on the boundary included.
    pub vertices: usize,
    /// Number of edges, spokes included.
    pub edges: usize,
    /// Connected components.
    pub components: usize,
    /// Largest difference of a vertex's clearance and its distance to the boundary.
    pub worst_vertex: f64,
    /// Largest difference of a vertex's clearance and its distance to a site named there.
    pub worst_foot: f64,
    /// How far the worst foot lies beyond the ends of its site.
    pub worst_outside: f64,
    /// How far the worst foot runs backwards.
    pub worst_backwards: f64,
    /// Largest difference, at a sampled point of an edge, of the distances to the two sites and to the boundary.
    pub worst_edge: f64,
    /// Vertices whose clearance is off by more than the tight tolerance.
    pub over_tight: usize,
    /// Points sampled on edges.
    pub samples: usize,
    /// The cells' areas together against the region's, as a part of it.
    pub area_error: f64,
    /// Number of faults of each kind.
    pub counts: BTreeMap<FaultKind, usize>,
    /// The first faults, with their places.
    pub faults: Vec<Fault>,
}

impl CheckReport {
    pub(super) fn new(size: f64, skeleton: &Skeleton) -> Self {
        Self {
            size,
            sites: skeleton.sites().len(),
            vertices: skeleton.vertices().len(),
            edges: skeleton.edge_count(),
            ..Self::default()
        }
    }

    pub(super) fn fault(&mut self, fault: Fault, keep: usize) {
        *self.counts.entry(fault.kind).or_default() += 1;
        if self.faults.len() < keep {
            self.faults.push(fault);
        }
    }

    /// Whether nothing is wrong.
    pub fn is_ok(&self) -> bool {
        self.counts.is_empty()
    }
}

impl fmt::Display for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} sites, {} vertices, {} edges; errors: vertex {:.1e}, foot {:.1e}, outside {:.1e}, backwards {:.1e}, \
             edge {:.1e}, area {:.1e}; {} vertices over the tight tolerance",
            self.sites,
            self.vertices,
            self.edges,
            self.worst_vertex,
            self.worst_foot,
            self.worst_outside,
            self.worst_backwards,
            self.worst_edge,
            self.area_error,
            self.over_tight
        )?;
        for (kind, count) in &self.counts {
            write!(f, "; {count} × {kind:?}")?;
        }
        Ok(())
    }
}
