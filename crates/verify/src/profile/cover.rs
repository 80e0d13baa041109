//! Is all of the inside swept? A subdivision of the plane.

use super::places::Places;
use super::shape::{Shape, reflected};
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::{BBox, Point, Segment, Vec2};

/// Cells are divided until their half diagonal is below this share of the tube about the path.
const FINEST: f64 = 0.1;

/// A square cell.
#[derive(Clone, Copy)]
struct Cell {
    center: Point,
    half: f64,
}

/// A point that may be left uncut though every place that covers it is admissible. `tube` widens the profile.
pub(crate) fn uncovered(walls: &Walls, places: &Places, path: &[Segment], tube: f64, bbox: BBox) -> Option<Point> {
    let sweep = Sweep { tree: Tree::new(path), shape: places.shape, tube };
    let samples = samples(places.shape);
    let size = places.shape.depth_within;
    let (columns, rows) = ((bbox.width() / size).ceil().max(1.0), (bbox.height() / size).ceil().max(1.0));
    let mut cells: Vec<Cell> = Vec::new();
    for row in 0..rows as u32 {
        for column in 0..columns as u32 {
            let center = bbox.min + Vec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * size;
            cells.push(Cell { center, half: 0.5 * size });
        }
    }
    while let Some(cell) = cells.pop() {
        let around = cell.half * std::f64::consts::SQRT_2;
        let missing = || samples.iter().any(|b| places.exclude(cell.center - *b, around));
        let outside = || !walls.tree.any_within(cell.center, around) && !walls.contain(cell.center);
        if outside() || sweep.holds(cell.center, around) || missing() {
            continue;
        }
        if around < FINEST * tube {
            return Some(cell.center);
        }
        let half = 0.5 * cell.half;
        let quarters = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        cells.extend(quarters.map(|(i, j)| Cell { center: cell.center + Vec2::new(i, j) * half, half }));
    }
    None
}

/// What the profile sweeps, widened by the tube.
struct Sweep<'a> {
    tree: Tree,
    shape: &'a Shape,
    tube: f64,
}

impl Sweep<'_> {
    /// Whether one place of the path covers all within `around` of a point.
    fn holds(&self, p: Point, around: f64) -> bool {
        let needed = around - self.tube;
        if needed > self.shape.depth_within {
            return false;
        }
        // With the deepest point of the profile as near as can be.
        let middle = p - self.shape.deepest.to_vec();
        if self.tree.any_within(middle, self.shape.depth_within - needed) {
            return true;
        }
        let mut held = false;
        self.tree.near(&Segment::line(p, p), self.shape.reach, |curve| {
            held = held || self.shape.depth_along(&reflected(curve, p)) >= needed;
            !held
        });
        held
    }
}

/// Points of the profile's outline that a cell is tried with: ends and middles of its edges.
fn samples(shape: &Shape) -> Vec<Vec2> {
    shape.segments.iter().flat_map(|s| [s.start().to_vec(), s.at(0.5).to_vec()]).collect()
}
