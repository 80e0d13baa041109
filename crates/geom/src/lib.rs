//! Geometry of pockets: points, lines and arcs, regions, the skeleton and the offset engines.
//!
//! Everything is in millimetres and radians.

mod around;
pub mod bbox;
pub mod chain;
pub mod contour;
pub mod distance;
pub mod freeform;
pub mod index;
pub mod intersect;
pub mod leftover;
pub mod mesh;
pub mod nesting;
pub mod offset;
pub mod point;
pub mod predicates;
pub mod profile;
pub mod quadrature;
pub mod ray;
pub mod region;
pub mod repair;
pub mod segment;
pub mod skeleton;
pub mod subpockets;
pub mod tolerance;

pub use bbox::BBox;
pub use contour::Contour;
pub use point::{Point, Vec2, point, vec2};
pub use profile::{ToolProfile, ToolShape};
pub use region::{Pocket, Region};
pub use segment::{Arc, Line, Segment};
