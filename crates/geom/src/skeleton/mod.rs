//! The Voronoi skeleton of a region of lines and arcs.

mod assemble;
mod boxes;
mod build;
mod cycle;
mod element;
mod joints;
mod recursion;
mod search;
mod topology;
mod vertex;

pub use build::SkeletonError;
pub use topology::{EdgeId, HalfEdge, NONE, Site, SiteId, SiteShape, Skeleton, Vertex, VertexId};
