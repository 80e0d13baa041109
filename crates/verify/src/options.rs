//! What a program is judged by.

use crate::gcode::Trace;
use pocketry_geom::tolerance::GOUGE;
use pocketry_geom::tolerance::proof::{COVER_PER_RADIUS, FLATNESS, GOUGE_PER_RADIUS, ROUNDING};
use pocketry_geom::{BBox, Point, Region, Segment};
use serde::Serialize;

/// What the proof may take for granted about the control's path mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum PathControl {
    /// Only what the program says: cutting under a plain G64, or under no path mode at all (LinuxCNC then blends freely),
    /// can't be proven; G61 is exact, and G64 P Q may leave the path by P + Q.
    #[default]
    AsWritten,
    /// The control is known to follow the path exactly where the program says nothing.
    Exact,
}

/// How to judge a program. Lengths in millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VerifyOptions {
    /// Radius of the tool.
    pub tool_radius: f64,
    /// Material that must stay on the walls; default 0.
    pub stock_to_leave: f64,
    /// Height of the stock's upper face; default 0. What happens at or above it cuts nothing.
    pub top: f64,
    /// How far below the top the floor must lie; `None` (the default) takes the program's own lowest height.
    pub depth: Option<f64>,
    /// How deep the tool may enter a wall; `None` (the default) is the lesser of 0.002 mm and a hundredth of the tool's
    /// radius, to which the rounding of the program's decimals may add but not beyond 0.002 mm, and of the region's
    /// coordinates (256 units in the last place of the largest) without bound.
    pub gouge_tolerance: Option<f64>,
    /// How far beyond the tool's edge reachable material may lie and still count as cut; `None` (the default) is the
    /// gouge tolerance, or 0.0002 of the tool's radius where that is more. It also is how much wider than the tool a
    /// place must be before the tool is expected there (but not more than the gouge tolerance).
    pub cover_tolerance: Option<f64>,
    /// What is taken for granted about the control's path mode.
    pub path_control: PathControl,
}

impl VerifyOptions {
    /// The defaults for a tool of this radius.
    pub fn new(tool_radius: f64) -> Self {
        Self {
            tool_radius,
            stock_to_leave: 0.0,
            top: 0.0,
            depth: None,
            gouge_tolerance: None,
            cover_tolerance: None,
            path_control: PathControl::default(),
        }
    }
}

/// The tolerances of one proof, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Budget {
    /// How deep the tool may enter a wall.
    pub gouge: f64,
    /// How far beyond the tool's edge reachable material may lie.
    pub cover: f64,
    /// By how much a place must be wider than the tool, on either side, before the tool is expected there.
    pub reach: f64,
    /// Bound of the rounding in one computed distance, the misfit of the region's arcs included; always taken to the
    /// program's disadvantage.
    pub rounding: f64,
    /// How far arcs that are judged as their chords may lie from them; taken to the program's disadvantage.
    pub flat: f64,
}

impl Budget {
    pub(crate) fn new(region: &Region, trace: &Trace, options: &VerifyOptions) -> Self {
        let curves = trace.curves.iter().fold(region.bbox(), |b, c| b.union(c.bbox()));
        let rounding = ROUNDING * largest(curves).max(options.tool_radius) + misfit(region);
        let precision = ROUNDING * largest(region.bbox());
        let per_radius = GOUGE_PER_RADIUS * options.tool_radius;
        let written = if trace.resolution.is_finite() { trace.resolution } else { 0.0 };
        let gouge = options.gouge_tolerance.unwrap_or_else(|| GOUGE.min(per_radius + written) + precision);
        let cover = options.cover_tolerance.unwrap_or_else(|| gouge.max(COVER_PER_RADIUS * options.tool_radius));
        Self { gouge, cover, reach: gouge.min(cover), rounding, flat: FLATNESS * gouge.min(cover) }
    }
}

/// Bound of the rounding in a distance computed from coordinates in this box.
pub(crate) fn rounding_of(bbox: BBox) -> f64 {
    ROUNDING * largest(bbox)
}

/// How far ends of the region's arcs lie off their circles: drawings round their numbers.
fn misfit(region: &Region) -> f64 {
    let of = |s: &Segment| match s {
        Segment::Line(_) => 0.0,
        Segment::Arc(a) => {
            let off = |p: Point| (p.distance(a.center) - a.radius).abs();
            off(a.start).max(off(a.end))
        }
    };
    region.segments().map(of).fold(0.0, f64::max)
}

/// The largest coordinate of a box, in absolute value.
fn largest(b: BBox) -> f64 {
    [b.min.x, b.min.y, b.max.x, b.max.y].into_iter().filter(|c| c.is_finite()).fold(0.0, |m, c| m.max(c.abs()))
}
