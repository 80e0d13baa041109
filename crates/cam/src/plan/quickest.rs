//! The stepover that takes the least time.

use super::{Plan, PlanError, plan};
use crate::job::PocketJob;
use pocketry_geom::Region;
use pocketry_geom::skeleton::Skeleton;

/// Stepovers that are tried, as shares of the tool's diameter. Wide ones need fewer loops but more clean-up.
const SHARES: [f64; 6] = [0.45, 0.5, 0.65, 0.8, 0.9, 0.98];

/// Plans a job at several stepovers (its own does not count) and keeps the plan that takes the least time at the programmed
/// feeds; of equal ones the first, which is the narrowest. Nothing is left uncut by any of them.
///
/// # Errors
/// As [`plan()`].
pub fn quickest(region: &Region, skeleton: &Skeleton, job: &PocketJob) -> Result<Plan, PlanError> {
    quickest_of(job, |job| plan(region, skeleton, job))
}

/// The same with any planner.
pub(super) fn quickest_of(
    job: &PocketJob,
    plan: impl Fn(&PocketJob) -> Result<Plan, PlanError>,
) -> Result<Plan, PlanError> {
    let mut best: Option<(f64, Plan)> = None;
    for share in SHARES {
        let job = PocketJob { stepover: share * job.tool.diameter, cleanup: true, ..job.clone() };
        let plan = plan(&job)?;
        let seconds = plan.program.figures(&job.feeds, &job.stock).machine_seconds;
        if best.as_ref().is_none_or(|b| seconds < b.0) {
            best = Some((seconds, plan));
        }
    }
    best.map(|b| b.1).ok_or(PlanError::Job { what: "stepover", value: job.stepover })
}
