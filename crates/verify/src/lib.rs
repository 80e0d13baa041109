//! Reads a G-code program back and proves it against its region: an independent judge.
//!
//! Nothing of the planners, the skeleton or the offset engines is used. [`verify`] reads the text as the control would
//! (see [`gcode`]), and shows by distances of lines and arcs in closed form that
//!
//! - no move below the stock's top brings the tool's edge into a wall (or the stock to leave), and none leaves the region;
//! - nothing is left uncut that the tool can reach: the opening of the region by the tool lies within what the moves at
//!   the final depth sweep (how that is shown is told in `uncut.rs`);
//! - no rapid move runs below the stock's top, nothing moves before its height is known, and corners are not rounded
//!   beyond the proof's budget.
//!
//! Nothing is sampled or flattened: what can't be decided within rounding is decided against the program.

mod cells;
mod clip;
mod distance;
pub mod gcode;
mod gouge;
mod limits;
pub mod options;
mod outline;
mod profile;
mod reach;
pub mod report;
pub mod surface;
mod tree;
mod uncut;
mod walls;

pub use gcode::ProgramError;
pub use options::{Budget, PathControl, VerifyOptions};
pub use profile::{verify_profile, verify_turning};
pub use report::{Figures, Gouge, Report, Spot, Violation};
pub use surface::{RoughOptions, RoughReport, verify_rough};

use gcode::{Motion, Trace};
use limits::Limits;
use pocketry_geom::tolerance::proof::SAME_HEIGHT;
use pocketry_geom::{Region, Segment};
use reach::Centers;
use uncut::Sweep;
use walls::{Walls, straightened};

/// Judges a program against its region.
///
/// # Errors
///
/// Where the text can't be read for certain; the error names the line.
pub fn verify(region: &Region, program: &str, options: &VerifyOptions) -> Result<Report, ProgramError> {
    let trace = gcode::read(program)?;
    let budget = Budget::new(region, &trace, options);
    let walls = Walls::new(region, budget.flat);
    let limits = Limits::new(&trace, options.top);
    let keep = options.tool_radius + options.stock_to_leave;

    let below = gouge::below(&trace, options.top);
    let gouge = gouge::deepest(&walls, &below, keep).map(|g| Gouge { depth: g.depth + budget.flat, ..g });
    let touches = gouge.is_some_and(|g| g.depth >= keep - budget.rounding);
    let outside = gouge::outside(&walls, &below, touches);

    let centers = Centers::new(&walls, keep + budget.reach, budget.rounding);
    let path = final_path(&trace, options.top);
    let cover = Cover::new(&walls, &centers, &path, &budget, options.tool_radius);
    let reachable = centers.opening(keep + budget.reach);
    let region_area = region.area();
    let blending = trace.unbounded_blending.filter(|_| options.path_control == PathControl::AsWritten);
    Ok(Report {
        tool_radius: options.tool_radius,
        budget,
        gouge,
        outside: outside.map_or(0.0, |o| o.0),
        outside_line: outside.map(|o| o.1),
        covered: cover.spots.is_none(),
        uncut_area: cover.spots.iter().flatten().fold(0.0, |sum, s| sum + s.area),
        uncut_spots: cover.spots.unwrap_or_default(),
        region_area,
        reachable_area: reachable.area.min(region_area),
        unreachable_area: (region_area - reachable.area).max(0.0),
        area_error: (budget.reach * walls.length() + reachable.area_error).min(region_area),
        rapids_below: limits.rapids_below,
        unknown_height: limits.unknown_height,
        unbounded_blending: blending,
        spindle_stopped: trace.spindle_stopped,
        ended: trace.ended,
        floor: options.depth.map(|d| options.top - d),
        figures: limits.figures,
    })
}

/// The moves that cut the floor.
struct FinalPath {
    curves: Vec<Segment>,
    /// The largest slack among them.
    slack: f64,
}

/// The moves that lie at the lowest height of the program as a whole, below the stock's top.
fn final_path(trace: &Trace, top: f64) -> FinalPath {
    FinalPath {
        curves: final_motions(trace, top).flat_map(|m| trace.curves_of(m)).copied().collect(),
        slack: final_motions(trace, top).map(|m| m.slack).fold(0.0, f64::max),
    }
}

/// See [`final_path`].
fn final_motions(trace: &Trace, top: f64) -> impl Iterator<Item = &Motion> {
    let floor = trace.motions.iter().map(Motion::low).fold(f64::INFINITY, f64::min);
    trace.motions.iter().filter(move |m| m.low() < top && m.high() <= floor + SAME_HEIGHT)
}

/// Whether the final moves cover all that can be reached.
struct Cover {
    /// `None` where they are proven to.
    spots: Option<Vec<Spot>>,
}

impl Cover {
    fn new(walls: &Walls, centers: &Centers, path: &FinalPath, budget: &Budget, tool_radius: f64) -> Self {
        let curves: Vec<Segment> = path.curves.iter().map(|c| straightened(c, budget.flat)).collect();
        let swept = tool_radius + budget.cover - path.slack - 2.0 * budget.flat;
        let sweep = Sweep::new(&curves, swept, budget.rounding);
        let wanted = tool_radius + budget.reach;
        let covered = sweep.covers(centers, walls, wanted);
        let spots = || sweep.left_over(centers, walls, wanted, &centers.opening(wanted));
        Self { spots: (!covered).then(spots) }
    }
}
