//! Pocketing with a tool that turns with the walls: trajectory-based erosions of R. Molina-Carmona, A. Jimeno and M. Davia,
//! *Contour pocketing computation using mathematical morphology*, section 2.
//!
//! 1. Parallels of the walls at the distance at which the profile touches them or, where it does not fit there, as near to them as it fits
//!    ([`Turning::wall_runs`]), and offsets further in by steps until nothing is left; one of them at the profile's reach, from where on it
//!    can turn freely (`distances`). They have the direction of the nearest wall.
//! 2. The parts of each along which the profile enters no wall ([`Turning::runs`]): innermost first, with a lift between. Where it is enough to
//!    back off from the walls and turn, they are joined without one.
//! 3. The moves, once a depth pass (`moves`), each with the direction that the rotary axis has at its end. From one run to the next it takes
//!    the shorter way round, in the air.
//!
//! **What is cut.** All that the profile covers at places where it touches a wall with its x axis along it, as those places are a
//! parallel's runs; and where it does not fit so near, at the nearest place straight in from there. All points so far from the
//! walls that the profile can turn freely about them: from such a point walk straight to its nearest wall; within a step one comes
//! upon a parallel, at the latest that at the profile's reach, where all directions are free; the point lies straight ahead on the
//! profile's y axis, within a step, and so in the profile. Places between are cut as far as the parallels lead there: straight in
//! from a nearest place, every piece of the way on which it fits and that crosses no parallel is shorter than a step. What only a
//! place can cut from which it fits no nearer nor farther, past an obstacle, may be left.

mod moves;

#[cfg(test)]
mod tests;

use super::profile::inscribed_circle;
use super::{Plan, PlanError, Warning};
use crate::job::PocketJob;
use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::{OffsetOptions, VoronoiOffsetter};
use pocketry_geom::profile::turning::{Run, Turning};
use pocketry_geom::ray::crossings_left;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::tolerance::GOUGE;
use pocketry_geom::tolerance::proof::{GOUGE_PER_RADIUS, PROFILE_REACH_SHARE};
use pocketry_geom::{Point, Region, ToolProfile};

/// What it keeps, as a share of what the proof gives it to spare.
const SPARE: f64 = 0.75;

/// More parallels than this are a slip of the finger.
const MOST_LEVELS: f64 = 10_000.0;

/// A run at one distance from the walls.
#[derive(Clone, Debug)]
struct Cut {
    run: Run,
    distance: f64,
    level: usize,
}

/// Plans a job in a region for a tool with this cross-section that turns with the walls: its x axis along the nearest one, which lies
/// to its right. Of the job's tool only the number is used, and the radius as a measure: let it be that of [`inscribed_circle`].
///
/// # Errors
/// When the job asks for the impossible, or the profile can be along no wall of the region.
pub fn plan_turning(region: &Region, profile: &ToolProfile, job: &PocketJob) -> Result<Plan, PlanError> {
    job.check()?;
    if job.stock_to_leave > 0.0 {
        return Err(PlanError::Job { what: "stock to leave with a tool profile", value: job.stock_to_leave });
    }
    let skeleton = Skeleton::build(region).map_err(|e| PlanError::Profile { reason: e.to_string() })?;
    let walls = Boundary::new(region);
    let (_, radius) = inscribed_circle(profile)?;
    let turning = Turning::new(&walls, profile, spare(radius));
    let ahead = ahead(profile);
    let least = radius.min(ahead);
    let (stepover, touch) = (job.stepover.min(least), turning.touch_distance());
    if !(ahead > 0.0 && touch > 0.0) {
        let reason = "a tool that turns with the walls needs its reference point within its outline, not on it".into();
        return Err(PlanError::Profile { reason });
    }
    let highest = skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
    let inner = distances(touch, stepover, profile.reach(), highest)?;
    let mut cuts = cuts(&skeleton, &turning, &inner)?;
    cuts.extend(turning.wall_runs(region).into_iter().map(|run| Cut {
        distance: nearest(&walls, &run),
        run,
        level: 0,
    }));
    let Some(widest) = cuts.iter().map(|c| c.distance).reduce(f64::max) else {
        let bbox = profile.contour().bbox();
        return Err(PlanError::ProfileDoesNotFit { width: bbox.width(), height: bbox.height() });
    };
    let mut plan = moves::write(&cuts, widest, job);
    if job.stepover > least {
        plan.warnings.push(Warning::ProfileStepoverClamped { asked: job.stepover, used: stepover });
    }
    plan.stepover = stepover;
    Ok(plan)
}

/// Where a run comes nearest to the walls, mm.
fn nearest(walls: &Boundary, run: &Run) -> f64 {
    run.courses.iter().map(|c| walls.distance(c.path.start())).fold(f64::INFINITY, f64::min)
}

/// How far from the wall that it follows a tool keeps, mm: so little that the wall counts as cut, and more than half of what the proof
/// gives it to spare at places that it asks for.
fn spare(radius: f64) -> f64 {
    SPARE * PROFILE_REACH_SHARE * GOUGE.min(GOUGE_PER_RADIUS * radius)
}

/// How far the profile reaches straight ahead of a wall: on its y axis from the reference point, mm.
fn ahead(profile: &ToolProfile) -> f64 {
    let mut nearest = profile.reach();
    for edge in &profile.contour().segments {
        // The y axis as the ray towards −x.
        let edge = edge.rotated(std::f64::consts::FRAC_PI_2);
        crossings_left(&edge, Point::ORIGIN, |hit| nearest = nearest.min(-hit.x));
    }
    nearest
}

/// In steps from the touching distance on, without that, and the reach.
fn distances(touch: f64, stepover: f64, reach: f64, highest: f64) -> Result<Vec<f64>, PlanError> {
    let count = ((highest - touch) / stepover).ceil().max(1.0);
    if count > MOST_LEVELS {
        return Err(PlanError::Job { what: "stepover", value: stepover });
    }
    let mut all: Vec<f64> = (1..=count as u32).map(|k| touch + stepover * f64::from(k)).collect();
    all.extend((reach > touch).then_some(reach));
    all.sort_by(f64::total_cmp);
    all.dedup();
    Ok(all)
}

/// The runs at all distances, innermost first.
fn cuts(skeleton: &Skeleton, turning: &Turning, distances: &[f64]) -> Result<Vec<Cut>, PlanError> {
    let offsetter = VoronoiOffsetter::new(skeleton);
    let mut cuts = Vec::new();
    for (inner, &distance) in distances.iter().enumerate().rev() {
        let level = inner + 1;
        let offset = offsetter.offset(distance, &OffsetOptions::default())?;
        for found in offset.loops {
            cuts.extend(turning.runs(&found.contour.segments).into_iter().map(|run| Cut { run, distance, level }));
        }
    }
    Ok(cuts)
}
