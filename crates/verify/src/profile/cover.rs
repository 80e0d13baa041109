//! Is all of the inside swept? A subdivision of the plane.

use super::places::Places;
use super::pose::Part;
use super::shape::Shape;
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::{BBox, Point, Segment, Vec2};

/// Cells are divided until their half diagonal is below this share of the tube about the path.
const FINEST: f64 = 0.1;

/// Cells that are not swept as a whole are divided until their half diagonal is below this share of the radius of the profile's largest
/// circle, for the area's sake.
const COARSEST: f64 = 0.1;

/// A square cell.
#[derive(Clone, Copy)]
struct Cell {
    center: Point,
    half: f64,
    /// Known not to be asked for: only its area counts.
    missing: bool,
}

/// What is out of reach; or a point that may be left uncut though every place that covers it is admissible.
pub(crate) fn uncovered(walls: &Walls, places: &Places, sweep: &Sweep, bbox: BBox) -> Result<Beyond, Point> {
    let samples = samples(places.shape);
    let missing = |p: Point, around: f64| samples.iter().any(|b| places.exclude(p - *b, around));
    divided(walls, sweep, bbox, true, missing)
}

/// A point that may be left uncut though the profile, turning about it, keeps clear of the walls.
pub(crate) fn uncovered_free(walls: &Walls, sweep: &Sweep, bbox: BBox) -> Option<Point> {
    let missing = |p: Point, around: f64| walls.tree.any_within(p, sweep.shape.reach - around);
    divided(walls, sweep, bbox, false, missing).err()
}

/// What of the region is out of reach.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Beyond {
    /// mm².
    pub(crate) area: f64,
    /// By how much that may be wrong, estimated: the cells on walls and on the edge of what is swept, mm².
    pub(crate) error: f64,
}

impl Beyond {
    /// Adds a small cell as its middle is: all that must be swept is known to be, and so what is not is out of reach.
    fn add(&mut self, walls: &Walls, sweep: &Sweep, cell: Cell, on_wall: bool) {
        let area = 4.0 * cell.half * cell.half;
        let is_out = walls.contain(cell.center) && !sweep.comes_within(cell.center, 0.0);
        if is_out {
            self.area += area;
        }
        if on_wall {
            self.error += area;
        } else if is_out && sweep.comes_within(cell.center, cell.half * std::f64::consts::SQRT_2) {
            // As many middles lie on the other side of the edge.
            self.error += 2.0 * area;
        }
    }
}

/// What is `missing` among what must be swept, where that is to be `measured`; or a point of the region that is neither that nor known to be
/// swept.
fn divided(
    walls: &Walls,
    sweep: &Sweep,
    bbox: BBox,
    measured: bool,
    missing: impl Fn(Point, f64) -> bool,
) -> Result<Beyond, Point> {
    let mut beyond = Beyond::default();
    let size = sweep.shape.depth_within;
    let (columns, rows) = ((bbox.width() / size).ceil().max(1.0), (bbox.height() / size).ceil().max(1.0));
    let mut cells: Vec<Cell> = Vec::new();
    for row in 0..rows as u32 {
        for column in 0..columns as u32 {
            let center = bbox.min + Vec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * size;
            cells.push(Cell { center, half: 0.5 * size, missing: false });
        }
    }
    while let Some(cell) = cells.pop() {
        let around = cell.half * std::f64::consts::SQRT_2;
        let on_wall = walls.tree.any_within(cell.center, around);
        if !on_wall && !walls.contain(cell.center) || !cell.missing && sweep.holds(cell.center, around) {
            continue;
        }
        let missing = cell.missing || missing(cell.center, around);
        if missing && !measured {
            continue;
        }
        if missing && around < COARSEST * size {
            beyond.add(walls, sweep, cell, on_wall);
            continue;
        }
        if !missing && around < FINEST * sweep.tube {
            return Err(cell.center);
        }
        let half = 0.5 * cell.half;
        let quarters = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        cells.extend(quarters.map(|(i, j)| Cell { center: cell.center + Vec2::new(i, j) * half, half, missing }));
    }
    Ok(beyond)
}

/// What the profile sweeps, widened by the tube.
pub(crate) struct Sweep<'a> {
    pub(crate) tree: &'a Tree,
    /// The pieces of the path, in the tree's order.
    pub(crate) parts: &'a [Part],
    pub(crate) shape: &'a Shape,
    pub(crate) tube: f64,
    /// Whether the profile keeps its direction.
    pub(crate) fixed: bool,
}

impl Sweep<'_> {
    /// Whether what is swept may come so near to a point.
    fn comes_within(&self, p: Point, distance: f64) -> bool {
        let mut near = self.fixed && self.tree.any_within(p - self.shape.deepest.to_vec(), self.shape.depth_within);
        if near {
            return true;
        }
        self.tree.near_by_id(&Segment::line(p, p), self.shape.reach + distance, |k, _| {
            let seen = self.parts[k as usize].seen(p);
            let touches = |edge: &Segment| crate::distance::between(edge, &seen) <= distance;
            near = near || self.shape.depth_along(&seen) >= 0.0 || self.shape.segments.iter().any(touches);
            !near
        });
        near
    }

    /// Whether one place of the path covers all within `around` of a point.
    fn holds(&self, p: Point, around: f64) -> bool {
        let needed = around - self.tube;
        if needed > self.shape.depth_within {
            return false;
        }
        // With the deepest point of the profile as near as can be.
        let middle = p - self.shape.deepest.to_vec();
        if self.fixed && self.tree.any_within(middle, self.shape.depth_within - needed) {
            return true;
        }
        let mut held = false;
        self.tree.near_by_id(&Segment::line(p, p), self.shape.reach, |k, _| {
            held = held || self.shape.depth_along(&self.parts[k as usize].seen(p)) >= needed;
            !held
        });
        held
    }
}

/// Points of the profile's outline that a cell is tried with: ends and middles of its edges.
fn samples(shape: &Shape) -> Vec<Vec2> {
    shape.segments.iter().flat_map(|s| [s.start().to_vec(), s.at(0.5).to_vec()]).collect()
}
