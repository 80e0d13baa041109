//! Which of the two tool paths.

use super::quickest::quickest_of;
use super::{Plan, PlanError, plan, plan_pairwise, plan_subpockets, quickest};
use crate::job::PocketJob;
use pocketry_geom::Region;
use pocketry_geom::skeleton::Skeleton;
use serde::Serialize;

/// How loops are laid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Strategy {
    /// Whichever of the two takes less time.
    #[default]
    Auto,
    /// Tool path I: around the whole region, innermost first.
    Contour,
    /// Tool path II: around one subpocket after the other.
    Subpockets,
}

/// What a strategy costs in a region.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StrategyCost {
    /// Which one.
    pub strategy: Strategy,
    /// Time at the programmed speeds, s: cutting, rapids and entries.
    pub machine_seconds: f64,
    /// mm.
    pub cut_length: f64,
    /// mm.
    pub rapid_length: f64,
    /// Lifts from below the stock's top.
    pub retracts: usize,
    /// Loops in each depth pass.
    pub loops: usize,
}

impl StrategyCost {
    /// What a plan costs.
    pub fn of(plan: &Plan, job: &PocketJob) -> Self {
        let figures = plan.program.figures(&job.feeds, &job.stock);
        Self {
            strategy: plan.strategy,
            machine_seconds: figures.machine_seconds,
            cut_length: figures.cut_length,
            rapid_length: figures.rapid_length,
            retracts: figures.retracts,
            loops: plan.loops.len(),
        }
    }
}

/// The plans of a strategy with their costs, the best first: both for [`Strategy::Auto`] (of equals, tool path I).
///
/// # Errors
/// As [`plan`].
pub fn plans(
    region: &Region,
    skeleton: &Skeleton,
    job: &PocketJob,
    strategy: Strategy,
) -> Result<Vec<(Plan, StrategyCost)>, PlanError> {
    let plans = match strategy {
        // Beyond the radius there are clean-up paths, and tool path I alone has them.
        Strategy::Auto if job.stepover > job.tool.radius() => vec![plan(region, skeleton, job)?],
        Strategy::Contour => vec![plan(region, skeleton, job)?],
        Strategy::Subpockets => vec![plan_subpockets(region, skeleton, job)?],
        Strategy::Auto => vec![plan(region, skeleton, job)?, plan_subpockets(region, skeleton, job)?],
    };
    Ok(costed(plans, job))
}

/// The same where nobody has asked for a stepover: tool path I at the quickest one, tool path II at the widest that it
/// takes.
///
/// # Errors
/// As [`plan`].
pub fn quickest_plans(
    region: &Region,
    skeleton: &Skeleton,
    job: &PocketJob,
    strategy: Strategy,
) -> Result<Vec<(Plan, StrategyCost)>, PlanError> {
    let widest = PocketJob { stepover: job.tool.radius(), ..job.clone() };
    let plans = match strategy {
        Strategy::Contour => vec![quickest(region, skeleton, job)?],
        Strategy::Subpockets => vec![plan_subpockets(region, skeleton, &widest)?],
        Strategy::Auto => vec![quickest(region, skeleton, job)?, plan_subpockets(region, skeleton, &widest)?],
    };
    Ok(costed(plans, job))
}

/// The plan from the pair-wise engine's offsets with its cost: at the job's stepover, or at the quickest one.
///
/// # Errors
/// As [`plan_pairwise`].
pub fn pairwise_plans(
    region: &Region,
    job: &PocketJob,
    any_stepover: bool,
) -> Result<Vec<(Plan, StrategyCost)>, PlanError> {
    let planned = |job: &PocketJob| plan_pairwise(region, job);
    let plan = if any_stepover { quickest_of(job, planned)? } else { planned(job)? };
    Ok(costed(vec![plan], job))
}

fn costed(plans: Vec<Plan>, job: &PocketJob) -> Vec<(Plan, StrategyCost)> {
    let cost = |plan: Plan| {
        let cost = StrategyCost::of(&plan, job);
        (plan, cost)
    };
    let mut plans: Vec<(Plan, StrategyCost)> = plans.into_iter().map(cost).collect();
    plans.sort_by(|a, b| a.1.machine_seconds.total_cmp(&b.1.machine_seconds));
    plans
}
