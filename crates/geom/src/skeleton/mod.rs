//! The Voronoi skeleton of a region of lines and arcs: every point inside that is nearest to two sites or more, the
//! sites being the open segments, open arcs and reflex vertices of the boundary (J. J. Chou and E. Cohen, *Computing
//! Offsets and Tool Paths With Voronoi Diagrams*, 1990, sections 2 and 3.1).
//!
//! # Construction
//!
//! 1. **Frame** (`build`). Each pocket is moved to the origin and scaled by a power of two to a size of 0.5 … 1, so
//!    that tolerances are plain numbers. Boundary vertices keep their exact places in the result.
//! 2. **Joints** (`joints`). Where segments meet, the interior angle decides: below π one skeleton edge starts at the
//!    corner; above, the vertex is a site whose cell fans between two normals; at π (smooth) the cells meet along the
//!    normal. Such normals, *spokes*, are edges of the skeleton here: a disc or a slot has no others to cross.
//! 3. **Cycle** (`cycle`). Islands are joined to the boundary by bridges, so that a pocket is one cycle of elements.
//! 4. **Recursion** (`recursion`). Each junction of the cycle starts one edge, so the dual is a triangulation of the
//!    cycle: n − 2 triangles, whatever the rounding. For a dual edge between `a` and `b` the next vertex is the first disk
//!    of the pencil touching both that touches a *third* element between them.
//! 5. **Third contact** (`search`). Guess a neighbour, compute the disk in closed form (`vertex`), ask for the nearest
//!    element in the range (`boxes`), repeat with what was hit. Where no closed form can be vouched for, a walk along the
//!    pencil, sampled and bisected, always answers.
//!    What it finds is looked at from the whole boundary; where that leaves doubts, steps 3 to 5 begin again from
//!    another corner and with other bridges, and the draft with the fewest doubts goes on.
//! 6. **Assembly** (`assemble`). Edges cut by bridges are joined again, edges are split at apexes so that clearance is
//!    monotone along each, cells are closed.
//!
//! The other candidate was one-sided insertion of the walls into a constrained Delaunay triangulation. It spends most of
//! its time in the triangulation, needs three times the code, and decides conflicts by distances; here the combinatorics
//! hold by construction and rounding can only misplace a vertex.
//!
//! # Guarantees and limits
//!
//! It terminates, doesn't panic on a valid [`Region`](crate::Region), and its dual is always a triangulation. O(n log n) time is
//! observed, not proven. That each vertex is *right* is not proven either: [`Skeleton::check`] judges a result
//! independently, and a planner's program is proven against the region itself. Known to be hard: joints whose turn is near
//! [`SMOOTH`](crate::tolerance::skeleton::SMOOTH) between arcs of nearly the same circle, where feet, not clearances, are
//! lost to rounding.
//!
//! # Departures from the paper
//!
//! Edges of constant clearance (parallel lines, concentric arcs) are included. Spokes are edges. The boundary's convex
//! corners are vertices but not sites.

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
