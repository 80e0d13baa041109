//! Proves a program for a tool of any cross-section, which keeps its direction or turns with a rotary axis (C).
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
//!    cover it is certainly not admissible, so that it holds no point of the second kind. What it holds is out of reach.
//!
//! A profile that turns (`turning.rs`) moves as a rigid body on each piece of the path (`pose.rs`): its sweep is as closed a form. What it
//! must cut is said in another way.

mod cover;
mod gouge;
mod places;
mod pose;
mod shape;
mod sum;
#[cfg(test)]
mod tests;
mod turning;

use crate::gcode::{self, ProgramError, Trace};
use crate::limits::Limits;
use crate::options::{Budget, PathControl, VerifyOptions};
use crate::report::{Report, Spot};
use crate::tree::Tree;
use crate::walls::{Walls, straightened};
use cover::{Beyond, Sweep};
use places::Places;
use pocketry_geom::tolerance::proof::PROFILE_REACH_SHARE;
use pocketry_geom::{Contour, Point, Region, Segment};
use pose::Part;
use shape::Shape;

/// How far a turning profile may be from a rigid motion, as a share of the gouge tolerance.
const RIGID_SHARE: f64 = 1.0 / 32.0;

/// Judges the program of a tool whose cross-section is `profile`, a counter-clockwise contour about the tool's reference point,
/// against its region. The tool keeps its direction.
///
/// Of the options the tool's radius is not used. [`Report::tool_radius`] is the radius of the largest circle in the profile.
/// Stock to leave is not allowed for: grow the profile. Areas are measured where all is proven to be cut.
///
/// # Errors
///
/// Where the text can't be read for certain or turns the tool; the error names the line.
pub fn verify_profile(
    region: &Region,
    program: &str,
    profile: &Contour,
    options: &VerifyOptions,
) -> Result<Report, ProgramError> {
    let trace = gcode::read(program)?;
    if let Some(line) = trace.turned {
        return Err(ProgramError::Turns { line });
    }
    let job = Job::new(region, &trace, profile, options);
    let below = crate::gouge::below(&trace, options.top);
    let below: Vec<Part> = below.iter().map(|(motion, curve)| Part::shifted(motion, *curve)).collect();
    let path: Vec<Part> = crate::final_motions(&trace, options.top)
        .flat_map(|m| trace.curves_of(m).iter().map(|c| Part::shifted(m, straightened(c, job.budget.flat))))
        .collect();
    let curves: Vec<Segment> = path.iter().map(|part| part.curve).collect();
    let tube = job.tube(&path) - 2.0 * job.budget.flat;
    let tree = Tree::new(&curves);
    let sweep = Sweep { tree: &tree, parts: &path, shape: &job.shape, tube, fixed: true };
    let places = Places::new(&job.walls, &job.shape, job.budget.reach);
    let left = match places.off_the_path(&curves, tube) {
        Some(at) => Err(at),
        None => cover::uncovered(&job.walls, &places, &sweep, region.bbox()),
    };
    Ok(job.report(&below, left.map(Some)))
}

/// The same for a tool that turns about its reference point with the rotary axis C: its x axis along the nearest wall, which lies to its
/// right. What must be cut: all that it covers where it touches a wall, and all places about which it can turn freely.
///
/// # Errors
///
/// Where the text can't be read for certain, or cuts before it has set C; the error names the line.
pub fn verify_turning(
    region: &Region,
    program: &str,
    profile: &Contour,
    options: &VerifyOptions,
) -> Result<Report, ProgramError> {
    let trace = gcode::read(program)?;
    if let Some(motion) = trace.motions.iter().find(|m| m.low() < options.top && !m.turn_known) {
        return Err(ProgramError::UnknownStart { line: motion.line });
    }
    let job = Job::new(region, &trace, profile, options);
    let (reach, fine) = (job.shape.reach, RIGID_SHARE * job.budget.gouge);
    let below = pose::parts(&trace, trace.motions.iter().filter(|m| m.low() < options.top), reach, fine);
    let path = pose::parts(&trace, crate::final_motions(&trace, options.top), reach, fine);
    let tree = Tree::new(&path.iter().map(|part| part.curve).collect::<Vec<_>>());
    let tube = job.tube(&path);
    let places = Places::new(&job.walls, &job.shape, job.budget.reach);
    let touch = job.shape.below() + job.budget.reach;
    let followed = turning::Path { parts: &path, tree: &tree, tube };
    let sweep = Sweep { tree: &tree, parts: &path, shape: &job.shape, tube, fixed: false };
    let left = turning::off_the_path(&job.walls, &places, &followed, touch)
        .or_else(|| cover::uncovered_free(&job.walls, &sweep, region.bbox()));
    Ok(job.report(&below, left.map_or(Ok(None), Err)))
}

/// What both kinds of tools share.
struct Job<'a> {
    trace: &'a Trace,
    walls: Walls,
    shape: Shape,
    options: VerifyOptions,
    budget: Budget,
    region_area: f64,
}

impl<'a> Job<'a> {
    fn new(region: &Region, trace: &'a Trace, profile: &Contour, options: &VerifyOptions) -> Self {
        let shape = Shape::new(profile);
        let options = VerifyOptions { tool_radius: shape.depth_within, ..*options };
        let mut budget = Budget::new(region, trace, &options);
        budget.rounding += crate::options::rounding_of(profile.bbox());
        budget.reach *= PROFILE_REACH_SHARE;
        Self { trace, walls: Walls::new(region, 0.0), shape, options, budget, region_area: region.area() }
    }

    /// How far beyond what the path covers counts as covered.
    fn tube(&self, path: &[Part]) -> f64 {
        self.budget.cover - path.iter().map(|part| part.slack).fold(0.0, f64::max) - self.budget.rounding
    }

    /// The report: a point that may be left, or what is out of reach where that is measured.
    fn report(self, below: &[Part], left: Result<Option<Beyond>, Point>) -> Report {
        let (trace, options, area) = (self.trace, &self.options, self.region_area);
        let judged = gouge::judge(&self.walls, below, &self.shape, &self.budget);
        let limits = Limits::new(trace, options.top);
        let beyond = left.ok().flatten().unwrap_or(Beyond { area: 0.0, error: area });
        Report {
            tool_radius: options.tool_radius,
            budget: self.budget,
            gouge: judged.gouge,
            outside: judged.outside.map_or(0.0, |o| o.0),
            outside_line: judged.outside.map(|o| o.1),
            covered: left.is_ok(),
            uncut_area: 0.0,
            uncut_spots: left.err().map(|at| Spot { at, ..Spot::default() }).into_iter().collect(),
            region_area: area,
            reachable_area: area - beyond.area,
            unreachable_area: beyond.area,
            area_error: beyond.error.min(area),
            rapids_below: limits.rapids_below,
            unknown_height: limits.unknown_height,
            unbounded_blending: trace.unbounded_blending.filter(|_| options.path_control == PathControl::AsWritten),
            spindle_stopped: trace.spindle_stopped,
            ended: trace.ended,
            floor: options.depth.map(|d| options.top - d),
            figures: limits.figures,
        }
    }
}
