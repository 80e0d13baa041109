//! What tests, benches and corpus runs share: regions from JSON lines, moved and mirrored copies of them, generated
//! shapes, a comparison of skeletons as graphs, a minimiser of failing cases, and pictures of skeletons.
//!
//! Nothing that is shipped depends on this crate.

pub mod corpus;
pub mod graph;
pub mod minimise;
pub mod picture;
pub mod sequences;
pub mod shapes;
pub mod strategies;
pub mod transform;

pub use corpus::Loops;
pub use transform::Transform;
