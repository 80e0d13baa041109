//! Does the tool enter a wall? The exact least distance of every cutting curve to the walls, and where the centre line runs.

use crate::distance;
use crate::gcode::{Motion, Trace};
use crate::report::Gouge;
use crate::walls::Walls;
use pocketry_geom::Segment;
use rayon::prelude::*;

/// How many curves are looked at with one running bound; fixed, so that the result does not hang on the thread count.
const CHUNK: usize = 256;

/// Curves below the stock's top, each with its motion.
pub(crate) type Below<'a> = Vec<(&'a Motion, Segment)>;

/// All curves of motions that come below the stock's top.
pub(crate) fn below(trace: &Trace, top: f64) -> Below<'_> {
    let low = trace.motions.iter().filter(|m| m.low() < top);
    low.flat_map(|m| trace.curves_of(m).iter().map(move |c| (m, *c))).collect()
}

/// The deepest gouge into the walls, each held to be `keep` thick; `None` where every curve keeps its distance.
pub(crate) fn deepest(walls: &Walls, below: &Below, keep: f64) -> Option<Gouge> {
    let worst = |chunk: &[(&Motion, Segment)]| {
        let mut worst: Option<(f64, usize, u32)> = None;
        let mut limit = keep;
        for (k, (motion, curve)) in chunk.iter().enumerate() {
            // The slack counts as if the curve were that much nearer.
            if let Some((apart, wall)) = walls.tree.nearest_to_curve(curve, limit + motion.slack)
                && apart - motion.slack < limit
            {
                limit = apart - motion.slack;
                worst = Some((limit, k, wall));
            }
        }
        worst
    };
    let found: Vec<_> = below.par_chunks(CHUNK).map(worst).collect();
    let (chunk, (apart, k, wall)) = found
        .into_iter()
        .enumerate()
        .filter_map(|(chunk, worst)| worst.map(|w| (chunk, w)))
        .min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    let (motion, curve) = &below[chunk * CHUNK + k];
    let at = distance::place(curve, walls.tree.segment(wall));
    Some(Gouge { depth: keep - apart, at, line: motion.line })
}

/// Length of the centre line outside the region, and the first line of the program where it leaves.
///
/// A curve that keeps clear of the walls lies on one side of them as a whole, so that without a touch one point of
/// every unbroken run of motions decides.
pub(crate) fn outside(walls: &Walls, below: &Below, touches: bool) -> Option<(f64, u32)> {
    let breaks = |k: usize| k == 0 || below[k].1.start() != below[k - 1].1.end();
    let suspicious = touches || (0..below.len()).any(|k| breaks(k) && !walls.contain(below[k].1.start()));
    if !suspicious {
        return None;
    }
    let lengths: Vec<f64> = below
        .par_iter()
        .map(|(_, curve)| if curve.start() == curve.end() { 0.0 } else { walls.length_outside(curve) })
        .collect();
    let first = below
        .iter()
        .zip(&lengths)
        .find(|(b, length)| **length > 0.0 || b.1.start() == b.1.end() && !walls.contain(b.1.start()));
    first.map(|((motion, _), _)| (lengths.iter().sum(), motion.line))
}
