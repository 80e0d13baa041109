//! Z-level roughing: from a model and a block of stock to a program that leaves the model and the stock to leave.
//!
//! 1. The heights of the levels, equal steps from the stock's top to its bottom.
//! 2. The CL-surface of the model over the stock and as far around it as the tool needs to stand clear of it ([`crate::surface`]).
//! 3. For each level, in parallel, the region where the tool's *centre* may be: its boundary is a contour line of the
//!    CL-surface, so nothing is compensated again. Parts from which the tool reaches no stock are left out ([`level`]).
//! 4. Each region is pocketed by the planner of flat pockets, its first loops [`INSET`](pocketry_geom::tolerance::surface::INSET) inside the boundary instead of
//!    a radius: coverage holds as it is argued there, since any path of the centre crosses the loops just the same.
//!    Dilating the region by the radius instead, to plan it like a drawing, would close gaps between obstacles that are
//!    smaller than the tool (a ball passes *over* them), and gouge.
//!    Other engines than the exact one make the same loops, or mitred ones ([`family`]); their order and ways need no skeleton ([`chain`]).
//! 5. Levels are cut from the top down, groups of loops without lifting. Where a pocket reaches
//!    beyond the stock, the tool goes down there and cuts from the outside in; others are entered by helix or ramp ([`moves`]).
//!
//! A lower level's region lies within the upper one's, so that above a cut there is only what an upper level has cleared.

mod chain;
mod family;
mod forest;
mod job;
mod level;
mod moves;
#[cfg(test)]
mod tests;

pub use job::{Block, Engine, RoughError, RoughJob};
pub use level::Level;

use crate::surface::{ClSurface, HeightGrid};
use pocketry_geom::mesh::Mesh;
use pocketry_motion::Program;
use rayon::prelude::*;

/// A planned roughing job.
#[derive(Clone, Debug, Default)]
pub struct RoughPlan {
    /// The moves.
    pub program: Program,
    /// The levels that have anything to cut, from the top.
    pub levels: Vec<Level>,
    /// Distance between loops that was used, mm.
    pub stepover: f64,
    /// What the machinist should know.
    pub warnings: Vec<String>,
}

/// What is being worked on, for a progress bar: steps done, and all.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// Plans a job over a model.
///
/// # Errors
/// When the job asks for the impossible, or the tool reaches no stock at any level.
pub fn rough(mesh: &Mesh, job: &RoughJob, progress: Progress<'_>) -> Result<RoughPlan, RoughError> {
    job.check()?;
    let heights = job.levels();
    let surface = ClSurface::new(mesh, job.cutter, job.tool.radius(), job.stock_to_leave);
    let bounds = job.stock.plan().inflated(job.overhang() + job.cell);
    let grid = HeightGrid::new(&surface, bounds, job.cell);
    let steps = heights.len() + 1;
    progress(1, steps);
    let done = std::sync::atomic::AtomicUsize::new(1);
    let tops = std::iter::once(job.stock.high[2]).chain(heights.iter().copied());
    let pairs: Vec<(f64, f64)> = tops.zip(heights.iter().copied()).collect();
    let levels: Vec<Level> = pairs
        .into_par_iter()
        .map(|(top, z)| {
            let level = level::plan_level(&grid, &surface, job, top, z);
            progress(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1, steps);
            level
        })
        .collect::<Result<_, _>>()?;
    let mut plan = RoughPlan { stepover: job.stepover.min(job.tool.radius()), ..RoughPlan::default() };
    plan.warnings = levels.iter().flat_map(|l| l.warnings.iter().cloned()).collect();
    plan.levels = levels.into_iter().filter(|l| !l.loops.is_empty()).collect();
    if plan.levels.is_empty() {
        return Err(RoughError::NothingToCut { diameter: job.tool.diameter });
    }
    plan.program = moves::write(&plan.levels, job);
    Ok(plan)
}
