//! Tool path II: algorithms 6.3 and 6.4 of Chou and Cohen.
//!
//! 1. The region is cut into subpockets (`geom::subpockets`).
//! 2. The loops of each at the distances of tool path I (algorithm 6.3); where a pass is higher than the distance, they
//!    run along its critical edges, so that no fillet is left between neighbours.
//! 3. Each subpocket is entered at its peak and cut to its outermost loop by side-steps (algorithm 6.4). They never leave
//!    it: a step towards the nearest wall crosses no critical edge.
//! 4. From one subpocket the tool goes on to a neighbour without lifting where it can (`through`), else it lifts: at most
//!    once for each subpocket and depth pass.
//!
//! **Nothing is left**, by the argument for tool path I: the way from a point straight to its nearest wall stays within
//! its subpocket and meets that one's next loop. That holds up to a stepover of the tool's radius, to which it is clamped:
//! clean-up paths belong to tool path I.

use super::levels::{Area, Levels};
use super::order::Orderer;
use super::ways::SkeletonWays;
use super::{Limits, Plan, PlanError, Strategy, Track, Warning, distances, limits, moves, report};
use crate::job::PocketJob;
use pocketry_geom::Region;
use pocketry_geom::offset::{Degenerate, OffsetOptions};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::subpockets::{SubpocketLoop, Subpockets};
use std::collections::BTreeMap;

/// Plans a job in a region with its skeleton, subpocket by subpocket ([`Strategy::Subpockets`]).
///
/// # Errors
/// When the job asks for the impossible, or the tool fits nowhere in the region.
pub fn plan_subpockets(region: &Region, skeleton: &Skeleton, job: &PocketJob) -> Result<Plan, PlanError> {
    let mut warnings = Vec::new();
    let first = job.first_distance();
    let Limits { stepover, highest } = limits(region, skeleton, job, first, &mut warnings)?;
    let radius = job.tool.radius();
    if stepover > radius {
        warnings.push(Warning::StepoverClamped { asked: stepover, used: radius });
    }
    let stepover = stepover.min(radius);
    let subpockets = Subpockets::new(skeleton);
    let (levels, roots) = loops(&subpockets, &distances(first, stepover, highest))?;
    if levels.tracks.is_empty() {
        let largest = 2.0 * (highest - job.stock_to_leave);
        return Err(PlanError::DoesNotFit { diameter: job.tool.diameter, largest });
    }
    let ways = SkeletonWays::new(subpockets.skeleton());
    let orderer = Orderer::new(&ways, &levels);
    let chains = orderer.subpocket_chains(&subpockets, &roots, first, longest_detour(job));
    warnings.extend(report::unreached(skeleton, subpockets.trees(), first, job.stock_to_leave));
    let mut plan = moves::write(&levels, &chains, job, first);
    plan.strategy = Strategy::Subpockets;
    plan.subpockets = Some(subpockets.list().len());
    plan.control_vertices = subpockets.trees().controls().len();
    warnings.append(&mut plan.warnings);
    plan.warnings = warnings;
    plan.stepover = stepover;
    Ok(plan)
}

/// The length of cutting that takes as long as going down to the floor of a pass again, mm.
fn longest_detour(job: &PocketJob) -> f64 {
    job.stepdown.min(job.stock.depth) / job.entry.angle.sin() * job.feeds.cut / job.feeds.ramp
}

/// The loops at these increasing distances as areas, each inside the next one out, and each subpocket's outermost area.
fn loops(subpockets: &Subpockets, distances: &[f64]) -> Result<(Levels, BTreeMap<u32, u32>), PlanError> {
    let offsetter = subpockets.offsetter();
    let mut levels = Levels::default();
    let mut outermost: BTreeMap<u32, u32> = BTreeMap::new();
    for (level, &d) in distances.iter().enumerate().rev() {
        let mut fresh: BTreeMap<u32, u32> = BTreeMap::new();
        for SubpocketLoop { subpocket, path } in subpockets.loops_at(&offsetter, d)? {
            let area = *fresh.entry(subpocket).or_insert_with(|| {
                let s = &subpockets.list()[subpocket as usize];
                let children = outermost.get(&subpocket).copied().into_iter().collect();
                let peak = s.peak.first().copied();
                levels.areas.push(Area { children, peak, clearance: s.clearance, tracks: Vec::new() });
                levels.areas.len() as u32 - 1
            });
            levels.areas[area as usize].tracks.push(levels.tracks.len() as u32);
            levels.tracks.push(Track::of_loop(path, d, level));
        }
        outermost.append(&mut fresh);
    }
    if let Some(&first) = distances.first() {
        let kept = offsetter.offset(first, &OffsetOptions { degenerate: Degenerate::Keep })?;
        kept.degenerate.into_iter().for_each(|path| levels.add_path(path, first));
    }
    Ok((levels, outermost))
}
