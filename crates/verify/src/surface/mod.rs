//! Judges a roughing program against its model.
//!
//! Nothing of the planner is used: the text is read back, the cutter and its contacts with the model are worked out anew. Shown
//! are
//!
//! - *gouges*, along the surface's normal (a height error means nothing on a wall): the tip is led along every move below the stock's
//!   top, and at each place the cutter's depth in the model is found exactly ([`clearance`]). Depth changes no faster than the tip
//!   moves, so where the cutter has room, the next place may be that much farther on, and nothing is missed between.
//!   Nearer to the model than a step, places are a step apart: what may be missed there is that a cutter of radius `R` dips
//!   `step²/8R` deeper between two places past a sharp feature;
//! - *leftovers*: a height field of what the moves leave, against what a tool with the same levels could leave ([`field`]);
//! - straight descents into material that no move before has cleared, in the same height field;
//! - rapid moves below the stock's top, as for pockets.

mod body;
mod clearance;
mod field;
mod report;
#[cfg(test)]
mod tests;

pub use report::{LevelReport, RoughDescent, RoughGouge, RoughLeftover, RoughReport};

use crate::gcode::{self, Motion, ProgramError, Trace};
use crate::limits::Limits;
use body::Body;
use clearance::Clearance;
use field::Nodes;
use pocketry_geom::mesh::{Corner, Mesh, above};
use pocketry_geom::tolerance::proof::ROUGH_GOUGE;
use pocketry_geom::{BBox, Point, Segment};
use pocketry_motion::Cutter;
use rayon::prelude::*;
use serde::Serialize;

/// How to judge a roughing program. Lengths in millimetres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoughOptions {
    /// The shape of the cutter.
    pub cutter: Cutter,
    /// Its radius.
    pub tool_radius: f64,
    /// Material that must stay on the model.
    pub stock_to_leave: f64,
    /// The lowest corner of the stock.
    pub stock_low: Corner,
    /// The highest corner of the stock.
    pub stock_high: Corner,
    /// The heights of the levels that were asked for, from the top.
    pub levels: Vec<f64>,
    /// Distance between loops that was asked for: what the cutter's shape leaves between them is no fault.
    pub stepover: f64,
    /// How deep the cutter may enter the model. Default: [`ROUGH_GOUGE`].
    pub gouge_tolerance: f64,
    /// The tool is expected where it has this much room at all sides. Default: a tenth of its radius.
    pub detail: f64,
    /// Distance of places along moves near the model. Default: a twentieth of the radius.
    pub step: f64,
    /// Distance of the height field's nodes. Default: a sixth of the radius.
    pub cell: f64,
}

impl RoughOptions {
    /// The defaults for a tool of this radius over this stock.
    pub fn new(cutter: Cutter, tool_radius: f64, stock_low: Corner, stock_high: Corner) -> Self {
        Self {
            cutter,
            tool_radius,
            stock_to_leave: 0.0,
            stock_low,
            stock_high,
            levels: Vec::new(),
            stepover: tool_radius,
            gouge_tolerance: ROUGH_GOUGE,
            detail: tool_radius / 10.0,
            step: tool_radius / 20.0,
            cell: tool_radius / 6.0,
        }
    }
}

/// Judges a roughing program.
///
/// # Errors
/// Where the text can't be read for certain; the error names the line.
pub fn verify_rough(mesh: &Mesh, program: &str, options: &RoughOptions) -> Result<RoughReport, ProgramError> {
    let trace = gcode::read(program)?;
    let limits = Limits::new(&trace, options.stock_high[2]);
    let body = Body::new(options.cutter, options.tool_radius);
    let horizon = options.stock_to_leave + 0.5 * options.tool_radius;
    let clearance = Clearance::new(mesh, body, horizon);
    let gouges = gouges(&trace, &clearance, options);

    let nodes = Nodes::new(BBox::of(above(options.stock_low), above(options.stock_high)), options.cell);
    let (left, descent) = field::left(&trace, &nodes, &body, options);
    let possible = field::possible(&nodes, mesh, &body, options);
    let mut levels: Vec<LevelReport> = options.levels.iter().map(|&z| LevelReport::at(z)).collect();
    for g in &gouges {
        let level = levels.iter_mut().find(|l| l.z <= g.z + options.gouge_tolerance);
        if let Some(level) = level {
            level.deepen(*g);
        }
    }
    for (k, (&height, &(least, level))) in left.iter().zip(&possible).enumerate() {
        if let Some(level) = levels.get_mut(level as usize) {
            level
                .leave(RoughLeftover { height: height - least, at: nodes.place(k % nodes.columns, k / nodes.columns) });
        }
    }
    Ok(RoughReport {
        gouge: gouges.into_iter().max_by(|a, b| a.depth.total_cmp(&b.depth)),
        leftover: levels.iter().filter_map(|l| l.leftover).max_by(|a, b| a.height.total_cmp(&b.height)),
        descent,
        levels,
        gouge_tolerance: options.gouge_tolerance,
        scallop: body.floor(options.stepover.min(options.tool_radius)),
        rapids_below: limits.rapids_below,
        unknown_height: limits.unknown_height,
        unbounded_blending: trace.unbounded_blending,
        ended: trace.ended,
        figures: limits.figures,
    })
}

/// Motions that one thread walks in a row; fixed, so that the result does not hang on the number of threads.
const CHUNK: usize = 256;

/// For every motion below the stock's top that enters the model (or what must stay on it) the place where it does so deepest.
fn gouges(trace: &Trace, clearance: &Clearance, options: &RoughOptions) -> Vec<RoughGouge> {
    let walk = |chunk: &[Motion]| {
        let mut walker = Walker { trace, clearance, options, room: 0.0, found: Vec::new() };
        for m in chunk {
            walker.follow(m);
        }
        walker.found
    };
    trace.motions.par_chunks(CHUNK).flat_map_iter(walk).collect()
}

/// Leads the tip along motions in a row.
struct Walker<'a> {
    trace: &'a Trace,
    clearance: &'a Clearance,
    options: &'a RoughOptions,
    /// How far the tip may still go before it could touch, mm.
    room: f64,
    found: Vec<RoughGouge>,
}

impl Walker<'_> {
    fn follow(&mut self, m: &Motion) {
        if m.low() >= self.options.stock_high[2] {
            self.room = 0.0;
            return;
        }
        let curves = self.trace.curves_of(m);
        let total: f64 = curves.iter().map(Segment::length).sum();
        // From the air, only the lower end of a straight descent counts.
        let from = if m.from.z.is_finite() { m.from.z } else { m.to.z };
        let fall = m.to.z - from;
        let length = total.hypot(fall);
        let mut worst: Option<RoughGouge> = None;
        let mut run = self.room;
        let mut judge = |p: Point, z: f64| {
            let depth = self.clearance.depth(p, z) + m.slack;
            let into = depth + self.options.stock_to_leave;
            if into > 0.0 && worst.is_none_or(|w| into > w.into) {
                worst = Some(RoughGouge { depth, into, at: p, z, line: m.line });
            }
            into
        };
        if m.is_vertical() {
            run = length - judge(m.to.xy(), m.low()).min(0.0);
        }
        while run <= length {
            let share = if length > 0.0 { run / length } else { 1.0 };
            let (p, z) = place(curves, total, share, from, fall);
            run += self.options.step.max(-judge(p, z));
        }
        self.room = run - length;
        self.found.extend(worst);
    }
}

/// The place at a share of a motion's way.
fn place(curves: &[Segment], total: f64, share: f64, from: f64, fall: f64) -> (Point, f64) {
    let mut rest = share * total;
    let z = from + share * fall;
    for (k, curve) in curves.iter().enumerate() {
        let length = curve.length();
        if rest <= length || k + 1 == curves.len() {
            return (curve.at(if length > 0.0 { (rest / length).min(1.0) } else { 0.0 }), z);
        }
        rest -= length;
    }
    (Point::ORIGIN, z)
}
