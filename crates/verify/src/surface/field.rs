//! The stock as a height field: what the moves leave, and what a tool with the same levels could leave.

use super::RoughOptions;
use super::body::Body;
use super::clearance::Clearance;
use super::report::RoughDescent;
use crate::gcode::{Motion, Trace};
use pocketry_geom::mesh::Mesh;
use pocketry_geom::{BBox, Point, Segment, point};
use rayon::prelude::*;

/// A grid of nodes over a box; the nodes lie in the middles of square cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nodes {
    bounds: BBox,
    pub(super) step: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Nodes {
    pub(super) fn new(bounds: BBox, step: f64) -> Self {
        let count = |extent: f64| (extent / step).ceil().max(1.0) as usize;
        Self { bounds, step, columns: count(bounds.width()), rows: count(bounds.height()) }
    }

    pub(super) fn place(&self, i: usize, j: usize) -> Point {
        let half = 0.5 * self.step;
        point(self.bounds.min.x + half + i as f64 * self.step, self.bounds.min.y + half + j as f64 * self.step)
    }

    /// The columns (or rows) from `low` to `high`, cut to those there are.
    fn range(low: f64, high: f64, start: f64, step: f64, count: usize) -> std::ops::Range<usize> {
        let first = ((low - start) / step - 0.5).ceil().max(0.0) as usize;
        let last = ((high - start) / step - 0.5).floor();
        if last < 0.0 { 0..0 } else { first.min(count)..(last as usize + 1).min(count) }
    }

    fn columns_in(&self, b: BBox) -> std::ops::Range<usize> {
        Self::range(b.min.x, b.max.x, self.bounds.min.x, self.step, self.columns)
    }

    fn rows_in(&self, b: BBox) -> std::ops::Range<usize> {
        Self::range(b.min.y, b.max.y, self.bounds.min.y, self.step, self.rows)
    }
}

/// A curve of the program, and the height it is judged at.
struct Sweep {
    curve: Segment,
    z: f64,
    reach: BBox,
    /// The line of a straight descent.
    descent: Option<u32>,
}

/// Rows that one thread works on at a time.
const BAND: usize = 16;

/// Heights of what the moves leave of the stock, row by row, mm; and the straight descent into the thickest material.
pub(super) fn left(
    trace: &Trace,
    nodes: &Nodes,
    body: &Body,
    options: &RoughOptions,
) -> (Vec<f64>, Option<RoughDescent>) {
    let sweeps: Vec<Sweep> = trace.motions.iter().flat_map(|m| sweeps_of(trace, m, body, options)).collect();
    let mut heights = vec![options.stock_high[2]; nodes.columns * nodes.rows];
    let bands = heights.par_chunks_mut(nodes.columns * BAND).enumerate();
    let work = |(band, heights): (usize, &mut [f64])| {
        let mut deepest: Option<RoughDescent> = None;
        for sweep in &sweeps {
            let depth = cut(sweep, nodes, body, band * BAND, heights);
            let Some(line) = sweep.descent else { continue };
            if depth > options.gouge_tolerance && deepest.is_none_or(|d| depth > d.depth) {
                deepest = Some(RoughDescent { depth, at: sweep.curve.start(), line });
            }
        }
        deepest
    };
    let descents: Vec<Option<RoughDescent>> = bands.map(work).collect();
    let deepest = descents.into_iter().flatten().max_by(|a, b| a.depth.total_cmp(&b.depth));
    (heights, deepest)
}

/// Takes from the rows of a band what a curve sweeps; how much at most, mm.
fn cut(sweep: &Sweep, nodes: &Nodes, body: &Body, first: usize, heights: &mut [f64]) -> f64 {
    let rows = first..first + heights.len() / nodes.columns;
    let own = nodes.rows_in(sweep.reach);
    let mut most = 0.0_f64;
    for j in own.start.max(rows.start)..own.end.min(rows.end) {
        for i in nodes.columns_in(sweep.reach) {
            let height = &mut heights[(j - first) * nodes.columns + i];
            if *height > sweep.z {
                let floor = sweep.z + body.floor(sweep.curve.distance(nodes.place(i, j)));
                most = most.max(*height - floor);
                *height = height.min(floor);
            }
        }
    }
    most
}

fn sweeps_of<'a>(
    trace: &'a Trace,
    m: &'a Motion,
    body: &'a Body,
    options: &'a RoughOptions,
) -> impl Iterator<Item = Sweep> + 'a {
    // Slopes are judged by their higher end: that can only leave more.
    let descends = m.is_vertical() && m.to.z < m.from.z;
    let z = if descends { m.low() } else { m.high() };
    let cuts = z < options.stock_high[2] && z.is_finite();
    let curves = if cuts { trace.curves_of(m) } else { &[] };
    let descent = descends.then_some(m.line);
    curves.iter().map(move |&curve| Sweep { curve, z, reach: curve.bbox().inflated(body.radius), descent })
}

/// For each node the height that a tool with these levels could leave at most, mm, and the number of the level that does.
///
/// A centre where a cutter that is `detail` wider keeps the stock to leave and the gouge tolerance could be cut at; every node
/// within the tool's reach of such a centre is at the level's height, or the cutter's own above it.
pub(super) fn possible(nodes: &Nodes, mesh: &Mesh, body: &Body, options: &RoughOptions) -> Vec<(f64, u32)> {
    let margin = body.radius;
    let centers = Nodes::new(nodes.bounds.inflated(margin), nodes.step);
    let room = options.stock_to_leave + options.gouge_tolerance;
    let clearance = Clearance::new(mesh, body.wider(options.detail), room);
    let deepest: Vec<u32> = (0..centers.rows * centers.columns)
        .into_par_iter()
        .map(|k| {
            let p = centers.place(k % centers.columns, k / centers.columns);
            // Levels from the top; what is clear at one is clear above it.
            options.levels.partition_point(|&z| clearance.is_clear(p, z, room)) as u32
        })
        .collect();
    let reach = (body.radius / nodes.step).ceil() as usize + 1;
    let offset = ((margin / nodes.step).floor() as usize).saturating_sub(1);
    let at = |i: usize, j: usize| {
        let p = nodes.place(i, j);
        let mut best = (options.stock_high[2], u32::MAX);
        for y in (j + offset).saturating_sub(reach)..(j + offset + reach + 3).min(centers.rows) {
            for x in (i + offset).saturating_sub(reach)..(i + offset + reach + 3).min(centers.columns) {
                let count = deepest[y * centers.columns + x];
                if count > 0 && options.levels[count as usize - 1] < best.0 {
                    let height = options.levels[count as usize - 1] + body.floor(p.distance(centers.place(x, y)));
                    if height < best.0 {
                        best = (height, count - 1);
                    }
                }
            }
        }
        best
    };
    (0..nodes.rows * nodes.columns).into_par_iter().map(|k| at(k % nodes.columns, k / nodes.columns)).collect()
}
