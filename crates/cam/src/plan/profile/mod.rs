//! Pocketing with a tool of any cross-section: the stack-based form of the recursive algorithm of R. Molina-Carmona, A. Jimeno and
//! M. Davia, *Contour pocketing computation using mathematical morphology*, section 2 and figure 8.
//!
//! 1. `A₀`, the places at which the profile `B` lies in the region: its erosion by `B`. Its outline is the
//!    first loop, and there are as many loops as it has contours, islands included.
//! 2. `Aₖ₊₁`, the erosion of `Aₖ` by a *step* `T`, until nothing is left. `Aₖ` is the erosion of the region by `B ⊕ kT`, and computed as
//!    that where `B` is convex (`levels`): what was eroded is not eroded again.
//! 3. The connected parts of all `Aₖ` make a forest (`tree`). A stack walks it: a part's loops are cut when the parts inside it are done
//!    (`walk`). The tool lifts before each part that holds no other part, where a branch of the tree begins, and nowhere else but between
//!    loops of one part that no straight way inside `A₀` joins.
//! 4. The moves, once a depth pass (`moves`).
//!
//! **Nothing is left.** Let `b` be a point of `B` and `T ⊆ b − B`. Let `x` be a point that `B` covers at some admissible place; the places
//! that cover `x` are `x − B`, a connected set that meets `A₀`. If it meets the outline of any `Aₖ`, then that loop cuts `x`. If not,
//! it lies within some last `Aₖ`; but then `(x − b) + T ⊆ x − B ⊆ Aₖ`, so that `x − b` is a point of `Aₖ₊₁`, which thus is not
//! empty and holds `x − B` too: a contradiction. Nothing in this asks for the same `T` each time: a smaller one does as well.
//! For convex `B` the step is `σ(b − B)` with `b` the mean of its corners and σ ≤ 1 (the
//! stepover as a share of the radius of the largest inscribed circle); else it is a circle with σ times that radius.
//!
//! Departures from the paper: successive offsets are taken by `T` and not by `B`, so that they overlap and so that profiles
//! without symmetry leave nothing; ways from a part's loop to the next one out lead straight to its nearest point, which is inside
//! `Aₖ` always.

mod levels;
mod moves;
mod tree;
mod walk;

#[cfg(test)]
mod tests;

use super::{Plan, PlanError, Warning};
use crate::job::PocketJob;
use levels::Levels;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Point, Region, ToolProfile};

/// More loops than this around one another are a slip of the finger.
const MOST_LEVELS: usize = 10_000;

/// The largest circle in a profile: its centre relative to the reference point, and its radius (mm).
///
/// # Errors
/// Where the profile has no skeleton.
pub fn inscribed_circle(profile: &ToolProfile) -> Result<(Point, f64), PlanError> {
    let region = Region::from_parts_unchecked(vec![profile.contour().clone()], vec![None]);
    let unusable = |e: &dyn std::fmt::Display| PlanError::Profile { reason: e.to_string() };
    let skeleton = Skeleton::build(&region).map_err(|e| unusable(&e))?;
    let widest = skeleton.vertices().iter().max_by(|a, b| a.clearance.total_cmp(&b.clearance));
    widest.map(|v| (v.point, v.clearance)).ok_or_else(|| unusable(&"it encloses nothing"))
}

/// Plans a job in a region for a tool with this cross-section. Of the job's tool only the number is used, and the radius as a
/// measure: let it be that of [`inscribed_circle`]. A stepover of that radius is the largest (σ = 1).
///
/// # Errors
/// When the job asks for the impossible, the profile fits nowhere in the region, or the engine fails.
pub fn plan_profile(region: &Region, profile: &ToolProfile, job: &PocketJob) -> Result<Plan, PlanError> {
    job.check()?;
    if job.stock_to_leave > 0.0 {
        return Err(PlanError::Job { what: "stock to leave with a tool profile", value: job.stock_to_leave });
    }
    let (center, radius) = inscribed_circle(profile)?;
    let mut warnings = Vec::new();
    if job.stepover > radius {
        warnings.push(Warning::ProfileStepoverClamped { asked: job.stepover, used: radius });
    }
    let stepover = job.stepover.min(radius);
    let forest = tree::Forest::new(&Levels::new(region, profile, (center, radius), stepover)?)?;
    if forest.roots.is_empty() {
        return Err(PlanError::ProfileDoesNotFit {
            width: profile.contour().bbox().width(),
            height: profile.contour().bbox().height(),
        });
    }
    let chains = walk::chains(&forest);
    let mut plan = moves::write(&forest, &chains, job, stepover);
    warnings.append(&mut plan.warnings);
    plan.warnings = warnings;
    plan.stepover = stepover;
    Ok(plan)
}
