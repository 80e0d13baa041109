//! Contour-parallel pocketing: algorithm 4.1 of Chou and Cohen, *tool path generation I*; and algorithm 6.4, *tool path
//! generation II*, which cuts subpocket after subpocket (`subpockets`, `through`). Which is better, `strategy` decides.
//!
//! Of I:
//!
//! 1. The loops at distances `r + q`, `r + q + w`, … for tool radius `r`, border `q` and stepover `w` (`levels`).
//! 2. Their order: innermost first, each area's inner areas before its own loops; one *group* of loops for each area
//!    that holds no inner one, that is, for each peak that the levels tell apart (`order`).
//! 3. Within a group the tool stays down: side-steps and ways along the skeleton ([`crate::link`]). Between groups it
//!    lifts. There are at most as many groups as peaks, and so fewer lifts than control vertices times depth passes.
//! 4. The moves, once a depth pass (`moves`).
//!
//! **Nothing is left.** Let `x` be a point that some disk of the tool at a centre `c` with clearance `≥ r + q` covers.
//! If the clearance of `x` is above `r + q`, walk from `x` straight to its nearest wall: clearance falls like length, so
//! after at most `w` one meets the next loop (above the last distance there is less than `w`): with `w ≤ r`
//! it covers `x`. Otherwise the way from `c` to `x`, at most `r` long, leaves the area within the first loops and crosses
//! one. Where `c` lies on no area's closure it is on a degenerate path (a channel just as wide as the tool), which is
//! toured too. Passes and peaks between the levels need nothing more.

mod cleanup;
mod levels;
mod moves;
mod order;
mod pairwise;
mod profile;
mod quickest;
mod report;
mod strategy;
mod subpockets;
#[cfg(test)]
mod testing;
mod through;
mod track;
mod turning;
mod ways;

use crate::job::PocketJob;
use cleanup::Gathered;
use levels::Levels;
use order::Orderer;
use pocketry_geom::Region;
use pocketry_geom::offset::degenerate_slack;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::trees::Trees;
use ways::SkeletonWays;

pub(crate) use moves::{Writer, helix_of, oriented, ramp_of};
pub(crate) use track::{Cut, Landing, Track, length_of, shorter_way};

pub use cleanup::{Cleanup, Uncut};
pub use pairwise::plan_pairwise;
pub use profile::{inscribed_circle, plan_profile};
pub use quickest::quickest;
pub use report::{EntryKind, Group, Link, LinkKind, Plan, PlanError, PlannedLoop, Warning};
pub use strategy::{Strategy, StrategyCost, pairwise_plans, plans, quickest_plans};
pub use subpockets::plan_subpockets;
pub use turning::plan_turning;

/// More loops or passes than this are a slip of the finger.
const MOST_LEVELS: f64 = 100_000.0;

/// Plans a job in a region with its skeleton, by loops around the whole region ([`Strategy::Contour`]).
///
/// # Errors
/// When the job asks for the impossible, or the tool fits nowhere in the region.
pub fn plan(region: &Region, skeleton: &Skeleton, job: &PocketJob) -> Result<Plan, PlanError> {
    plan_from(region, skeleton, job, job.first_distance())
}

/// The same with the first loops at distance `first` from the boundary: next to nothing where that bounds the tool's centre.
pub(crate) fn plan_from(region: &Region, skeleton: &Skeleton, job: &PocketJob, first: f64) -> Result<Plan, PlanError> {
    let mut warnings = Vec::new();
    let Limits { stepover, highest } = limits(region, skeleton, job, first, &mut warnings)?;
    let trees = Trees::new(skeleton);
    let distances = distances(first, stepover, highest);
    let mut levels = Levels::new(skeleton, &distances)?;
    if levels.tracks.is_empty() {
        return Err(PlanError::DoesNotFit {
            diameter: job.tool.diameter,
            largest: 2.0 * (highest - job.stock_to_leave),
        });
    }
    let radius = job.tool.radius();
    let ways = SkeletonWays::new(skeleton);
    let mut gathered = Gathered::default();
    // Loops no farther apart than the tool's radius leave nothing.
    if job.cleanup && stepover > radius {
        let orderer = Orderer::new(&ways, &levels);
        let pieces = cleanup::of_skeleton(&ways, &orderer, &distances, radius);
        gathered = cleanup::gather(&pieces, &orderer, radius);
        cleanup::mark_entrances(&mut levels, &gathered, job, first);
    }
    let mut chains = Orderer::new(&ways, &levels).chains();
    let cleanups = cleanup::hang(&mut chains, gathered, &levels, job, first);
    warnings.extend(report::unreached(skeleton, &trees, first, job.stock_to_leave));
    let mut plan = moves::write(&levels, &chains, job, first);
    plan.strategy = Strategy::Contour;
    plan.control_vertices = trees.controls().len();
    warnings.append(&mut plan.warnings);
    plan.warnings = warnings;
    plan.stepover = stepover;
    plan.cleanups = cleanups;
    Ok(plan)
}

/// How far apart loops lie, and up to where, mm.
struct Limits {
    stepover: f64,
    /// The largest clearance of the skeleton.
    highest: f64,
}

/// The limits of a job that can be done.
fn limits(
    region: &Region,
    skeleton: &Skeleton,
    job: &PocketJob,
    first: f64,
    warnings: &mut Vec<Warning>,
) -> Result<Limits, PlanError> {
    job.check()?;
    let stepover = clamped_stepover(job, warnings);
    let highest = skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
    if region.contours().is_empty() || highest < first - degenerate_slack(first) {
        let largest = (2.0 * (highest - job.stock_to_leave)).max(0.0);
        return Err(PlanError::DoesNotFit { diameter: job.tool.diameter, largest });
    }
    if highest > region.bbox().size() {
        return Err(PlanError::Skeleton { clearance: highest });
    }
    if highest > MOST_LEVELS * stepover {
        return Err(PlanError::Job { what: "stepover", value: stepover });
    }
    if job.stock.depth > MOST_LEVELS * job.stepdown {
        return Err(PlanError::Job { what: "stepdown", value: job.stepdown });
    }
    Ok(Limits { stepover, highest })
}

/// Step 2 of algorithm 4.1: the distances of the loops, in increasing order.
fn distances(first: f64, stepover: f64, highest: f64) -> Vec<f64> {
    let more = ((highest - first) / stepover).ceil().max(0.0) as u32;
    let further = (1..=more).map(|k| first + f64::from(k) * stepover).filter(|&d| d < highest);
    std::iter::once(first).chain(further).collect()
}

fn clamped_stepover(job: &PocketJob, warnings: &mut Vec<Warning>) -> f64 {
    let most = 2.0 * cleanup::trusted(job.tool.radius());
    if job.stepover > most {
        warnings.push(Warning::StepoverClamped { asked: job.stepover, used: most });
    }
    job.stepover.min(most)
}
