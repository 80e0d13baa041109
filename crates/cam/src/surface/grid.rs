//! The CL-surface at the nodes of a grid.

use super::ClSurface;
use pocketry_geom::{BBox, Point, point};
use rayon::prelude::*;

/// Heights of a CL-surface at the nodes of a square grid; every node exact.
#[derive(Clone, Debug)]
pub struct HeightGrid {
    origin: Point,
    step: f64,
    columns: usize,
    rows: usize,
    /// Row by row, mm; minus infinity where the cutter meets nothing.
    heights: Vec<f64>,
}

impl HeightGrid {
    /// The surface over a box, nodes `step` (mm) apart; the last column and row may lie beyond the box. Rows are made in parallel.
    pub fn new(surface: &ClSurface, bounds: BBox, step: f64) -> Self {
        let count = |extent: f64| (extent / step).ceil().max(1.0) as usize + 1;
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        let mut grid = Self { origin: bounds.min, step, columns, rows, heights: vec![0.0; columns * rows] };
        let place = |i: usize, j: usize| bounds.min + pocketry_geom::vec2(i as f64 * step, j as f64 * step);
        grid.heights.par_chunks_mut(columns).enumerate().for_each(|(j, row)| {
            for (i, height) in row.iter_mut().enumerate() {
                *height = surface.height(place(i, j));
            }
        });
        grid
    }

    /// Number of columns.
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows.
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Distance of nodes, mm.
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// The place of a node; columns and rows beyond the grid have one, too.
    pub fn place(&self, column: isize, row: isize) -> Point {
        point(self.origin.x + column as f64 * self.step, self.origin.y + row as f64 * self.step)
    }

    /// The height at a node of the grid, mm.
    pub fn height(&self, column: usize, row: usize) -> f64 {
        self.heights[row * self.columns + column]
    }
}
