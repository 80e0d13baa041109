//! The Voronoi skeleton of a region of lines and arcs.

pub mod check;
mod topology;

pub use topology::{EdgeId, HalfEdge, NONE, Site, SiteId, SiteShape, Skeleton, Vertex, VertexId};
