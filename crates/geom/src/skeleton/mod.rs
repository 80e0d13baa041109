//! The Voronoi skeleton of a region of lines and arcs.

mod assemble;
mod boxes;
mod build;
pub mod check;
mod cycle;
mod element;
#[cfg(test)]
pub(crate) mod handmade;
mod joints;
mod recursion;
mod search;
mod topology;
pub mod trees;
mod vertex;

pub use build::SkeletonError;
pub use topology::{EdgeId, HalfEdge, NONE, Site, SiteId, SiteShape, Skeleton, Vertex, VertexId};
