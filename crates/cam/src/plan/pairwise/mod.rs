//! Tool path I from the pair-wise engine's offsets, as S. C. Park and B. K. Choi make it (*Uncut free pocketing tool-paths
//! generation using pair-wise offset algorithm*, 2001): no skeleton is built.
//!
//! 1. Arcs of the region become chords on the pocket's side ([`PairwiseEngine::straightened`]).
//! 2. Loops at `r + q`, `r + q + w`, … until none is left; which lies in which, the loops themselves say (`nesting`).
//! 3. What stays uncut is found in the interfering ranges of the offsets (`ranges`); the paths to it are made as for the
//!    exact engine ([`super::cleanup`]), and what they leave is cut by detours straight away from walls (`cover`).
//! 4. Order, side-steps and moves are those of tool path I ([`super::order`]). Between the loops of one area the tool takes
//!    a straight way that is clear of the walls, or lifts (`across`). It ramps in along its first loop. Loops along chords of arcs become
//!    few arcs again.
//!
//! The first loops lie nearer to the walls than the tool's radius by what a channel may be narrower than the tool: so
//! channels just as wide as it need no paths of their own.

mod across;
mod cover;
mod curves;
mod fibres;
mod links;
mod nearby;
mod nesting;
mod ranges;

use super::cleanup::Gathered;
use super::order::Orderer;
use super::{MOST_LEVELS, Plan, PlanError, Strategy, clamped_stepover, cleanup, moves};
use crate::job::PocketJob;
use crate::link::fitted;
use across::StraightWays;
use pocketry_geom::offset::{Offset, OffsetError, PairwiseEngine, PairwiseOffsetter, degenerate_slack};
use pocketry_geom::{Region, Segment};

/// Halvings of the search for the largest tool that fits.
const HALVINGS: usize = 40;

/// How far arcs of a loop may lie from its chords, as a share of how far those may lie from arcs of the region.
const FIT_SHARE: f64 = 0.25;

/// How often an offset that contradicts itself is tried at another distance.
const SHIFTS: u32 = 8;

/// The least shift of a distance, as a share of the slack.
const SHIFT: f64 = 1.0 / 16.0;

/// The same for the first distance: all of them stay within half of the slack.
const FIRST_SHIFT: f64 = 1.0 / 256.0;

/// Plans a job in a region from the pair-wise engine's offsets ([`Strategy::Contour`]).
///
/// # Errors
/// When the job asks for the impossible, the tool fits nowhere in the region, or the engine fails.
pub fn plan_pairwise(region: &Region, job: &PocketJob) -> Result<Plan, PlanError> {
    job.check()?;
    let mut warnings = Vec::new();
    let stepover = clamped_stepover(job, &mut warnings);
    let size = region.bbox().size();
    if size > MOST_LEVELS * stepover {
        return Err(PlanError::Job { what: "stepover", value: stepover });
    }
    if job.stock.depth > MOST_LEVELS * job.stepdown {
        return Err(PlanError::Job { what: "stepdown", value: job.stepdown });
    }
    let first = job.first_distance() - degenerate_slack(job.first_distance());
    let straight = PairwiseEngine::straightened(region, first);
    let offsetter = PairwiseOffsetter::new(straight.as_ref().unwrap_or(region));
    let offsets = offsets(&offsetter, first, stepover)?;
    if offsets.is_empty() {
        let largest = 2.0 * (largest_clearance(&offsetter, first)? - job.stock_to_leave);
        return Err(PlanError::DoesNotFit { diameter: job.tool.diameter, largest: largest.max(0.0) });
    }
    let mut levels = nesting::levels(&offsets);
    let ways = StraightWays::new(&offsetter);
    let radius = job.tool.radius();
    let mut gathered = Gathered::default();
    if job.cleanup && stepover > radius {
        let orderer = Orderer::new(&ways, &levels);
        let found = ranges::ranges(&offsetter, &offsets, &levels, stepover, radius)?;
        gathered = cleanup::gather(&found.pieces, &orderer, radius);
        cover::complete(&mut gathered, &found.grounds, &offsetter, &orderer, radius);
        cleanup::mark_entrances(&mut levels, &gathered, job, first);
    }
    let mut chains = Orderer::new(&ways, &levels).chains();
    let cleanups = cleanup::hang(&mut chains, gathered, &levels, job, first);
    if straight.is_some() {
        let tolerance = FIT_SHARE * PairwiseEngine::chord_tolerance(radius);
        chains.iter_mut().flat_map(|c| &mut c.steps).for_each(|s| s.cut.segments = rounded(&s.cut.segments, tolerance));
    }
    let mut plan = moves::write(&levels, &chains, job, first);
    warnings.append(&mut plan.warnings);
    Ok(Plan { strategy: Strategy::Contour, warnings, stepover, cleanups, ..plan })
}

/// A loop along chords of arcs with few arcs again. What rises above its chord by less than the tolerance counts as that.
fn rounded(cut: &[Segment], tolerance: f64) -> Vec<Segment> {
    let flat = |s: &Segment| match s {
        Segment::Arc(a) if a.sweep().abs() < 1.0 && a.height() < tolerance => Segment::line(a.start, a.end),
        _ => *s,
    };
    fitted(&cut.iter().map(flat).collect::<Vec<_>>(), tolerance)
}

/// The offsets at the first distance and in steps of the stepover, as long as there are loops. Where an offset contradicts
/// itself, the first one keeps a little more of the slack below the tool's radius, and the others lie a little nearer together.
fn offsets(offsetter: &PairwiseOffsetter<'_>, first: f64, stepover: f64) -> Result<Vec<Offset>, OffsetError> {
    let slack = degenerate_slack(first);
    let mut offsets: Vec<Offset> = Vec::new();
    loop {
        let offset = match offsets.last() {
            None => offset_near(offsetter, first, slack * FIRST_SHIFT)?,
            Some(last) => offset_near(offsetter, last.distance + stepover, -slack * SHIFT)?,
        };
        if offset.loops.is_empty() {
            return Ok(offsets);
        }
        offsets.push(offset);
    }
}

/// The offset at a distance or, where it contradicts itself, at the nearest one in shifts that double.
fn offset_near(offsetter: &PairwiseOffsetter<'_>, distance: f64, shift: f64) -> Result<Offset, OffsetError> {
    let mut found = offsetter.offset(distance);
    let mut by = shift;
    for _ in 0..SHIFTS {
        if found.is_ok() {
            break;
        }
        found = offsetter.offset(distance + by);
        by *= 2.0;
    }
    found
}

/// The largest clearance, which is below `most`.
fn largest_clearance(offsetter: &PairwiseOffsetter<'_>, most: f64) -> Result<f64, OffsetError> {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if offsetter.offset(middle)?.loops.is_empty() {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(low)
}
