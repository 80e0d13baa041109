//! The Voronoi skeleton of a region of lines and arcs.

#[cfg(test)]
pub(crate) mod handmade;
mod topology;
pub mod trees;

pub use topology::{EdgeId, HalfEdge, NONE, Site, SiteId, SiteShape, Skeleton, Vertex, VertexId};
