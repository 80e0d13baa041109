//! Planning and linking: from a region, its skeleton and a job to a program of moves.
//!
//! [`plan()`] cuts a pocket with contour-parallel loops, innermost first (tool path I of J. J. Chou and E. Cohen,
//! *Computing Offsets and Tool Paths With Voronoi Diagrams*, UUCS-89-017, University of Utah, 1990, algorithm 4.1). It guarantees
//! that the tool's axis never comes nearer to a wall than its radius and the stock to leave, and that everything a tool
//! of that radius can reach is cut.

pub mod job;
mod link;
pub mod plan;
pub mod rough;
pub mod surface;
pub mod tools;

pub use job::{Entry, PocketJob};
pub use plan::{
    Cleanup, EntryKind, Group, Link, LinkKind, Plan, PlanError, PlannedLoop, Uncut, Warning, plan, quickest,
};
pub use plan::{
    Strategy, StrategyCost, inscribed_circle, pairwise_plans, plan_pairwise, plan_profile, plan_subpockets,
    plan_turning, plans, quickest_plans,
};
pub use tools::{Choice, Narrow, Scallop, ToolFit, choose};
