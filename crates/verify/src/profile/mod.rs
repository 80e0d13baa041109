//! Proves a program for a tool of any cross-section that keeps its orientation.
//!
//! Write `B` for the profile about its reference point, `R` for the region, `A` for the admissible places `{y : B + y ⊆ R}`, `P` for
//! the path at the final depth. Two things are shown, and what can't be decided within a stated resolution is decided
//! against the program.
//!
//! **Gouge** (`gouge.rs`): no wall comes into the sweep of a slightly smaller profile, every point of the profile outside
//! which lies within the gouge tolerance of its outline. The outline of a sweep is made of lines and arcs, in closed form (`sum.rs`).
//!
//! **Uncut** (`places.rs`, `cover.rs`): what must be cut is `A + B`, taken for places `A` with the reach tolerance to spare. Its points
//! are of two kinds, for `B` is connected: those that some place on the outline of `A` covers, and those around which *every*
//! place that covers them is admissible.
//!
//! 1. Every point of the outline of `A` lies within the cover tolerance of the path, so that all of the first kind are cut. The
//!    outline is part of curves known in closed form; the parts of these that are far from the path are shown not to belong
//!    to it by bounds of the profile's clearance.
//! 2. The plane is divided into cells until each lies in the profile at a place of the path as a whole, or some place that would
//!    cover it is certainly not admissible, so that it holds no point of the second kind.

mod cover;
mod gouge;
mod places;
mod shape;
mod sum;
#[cfg(test)]
mod tests;

use crate::gcode::{self, ProgramError};
use crate::limits::Limits;
use crate::options::{Budget, PathControl, VerifyOptions};
use crate::report::{Report, Spot};
use crate::walls::{Walls, straightened};
use places::Places;
use pocketry_geom::tolerance::proof::PROFILE_REACH_SHARE;
use pocketry_geom::{Contour, Region, Segment};
use shape::Shape;

/// Judges the program of a tool whose cross-section is `profile`, a counter-clockwise contour about the tool's reference point,
/// against its region.
///
/// Of the options the tool's radius is not used. [`Report::tool_radius`] is the radius of the largest circle in the profile;
/// areas are not measured: [`Report::area_error`] is the region's area. Stock to leave is not allowed for: grow the profile.
///
/// # Errors
///
/// Where the text can't be read for certain; the error names the line.
pub fn verify_profile(
    region: &Region,
    program: &str,
    profile: &Contour,
    options: &VerifyOptions,
) -> Result<Report, ProgramError> {
    let trace = gcode::read(program)?;
    let shape = Shape::new(profile);
    let options = VerifyOptions { tool_radius: shape.depth_within, ..*options };
    let mut budget = Budget::new(region, &trace, &options);
    budget.rounding += crate::options::rounding_of(profile.bbox());
    budget.reach *= PROFILE_REACH_SHARE;
    let walls = Walls::new(region, 0.0);
    let limits = Limits::new(&trace, options.top);

    let below = crate::gouge::below(&trace, options.top);
    let judged = gouge::judge(&walls, &below, &shape, &budget);

    let path = crate::final_path(&trace, options.top);
    let curves: Vec<Segment> = path.curves.iter().map(|c| straightened(c, budget.flat)).collect();
    let tube = budget.cover - path.slack - 2.0 * budget.flat - budget.rounding;
    let places = Places::new(&walls, &shape, budget.reach);
    let left = places
        .off_the_path(&curves, tube)
        .or_else(|| cover::uncovered(&walls, &places, &curves, tube, region.bbox()))
        .map(|at| Spot { at, ..Spot::default() });
    let region_area = region.area();
    Ok(Report {
        tool_radius: options.tool_radius,
        budget,
        gouge: judged.gouge,
        outside: judged.outside.map_or(0.0, |o| o.0),
        outside_line: judged.outside.map(|o| o.1),
        covered: left.is_none(),
        uncut_area: 0.0,
        uncut_spots: left.into_iter().collect(),
        region_area,
        reachable_area: region_area,
        unreachable_area: 0.0,
        area_error: region_area,
        rapids_below: limits.rapids_below,
        unknown_height: limits.unknown_height,
        unbounded_blending: trace.unbounded_blending.filter(|_| options.path_control == PathControl::AsWritten),
        spindle_stopped: trace.spindle_stopped,
        ended: trace.ended,
        floor: options.depth.map(|d| options.top - d),
        figures: limits.figures,
    })
}
