//! The Voronoi skeleton of a region of lines and arcs.

mod topology;

pub use topology::{EdgeId, HalfEdge, NONE, Site, SiteId, SiteShape, Skeleton, Vertex, VertexId};
