//! Tools, stock, feeds and programs of moves: what planners make, posts write and nobody else shares.

pub mod check;
pub mod cutter;
pub mod figures;
pub mod program;
pub mod setup;

pub use check::ProgramFault;
pub use cutter::Cutter;
pub use figures::Figures;
pub use program::{FeedKind, Move, Point3, Program};
pub use setup::{Direction, Feeds, Heights, Stock, Tool};
