//! The grid method: candidates for intersections from a grid of cells, each with the edges that pass through it.

use crate::bbox::BBox;
use crate::point::Point;
use crate::tolerance::bisector::GRID_PAD;

/// Cells for one edge.
const CELLS_PER_EDGE: f64 = 2.0;

/// With more entries than this for one edge, a grid does not pay.
const ENTRIES_PER_EDGE: usize = 12;

/// A uniform grid over straight edges.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    origin: Point,
    per_length: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's entries begin; one more at the end.
    first: Vec<u32>,
    entries: Vec<u32>,
}

impl Grid {
    /// The grid of `count` edges; `None` where they are too long for one.
    pub(super) fn new(count: usize, bbox: BBox, edge: impl Fn(usize) -> [Point; 2]) -> Option<Self> {
        let cells = (CELLS_PER_EDGE * count as f64).max(1.0);
        let (width, height) = (bbox.width(), bbox.height());
        let side = (width * height / cells).sqrt().max((width + height) / cells);
        if !(side > 0.0 && side.is_finite()) {
            return None;
        }
        let number = |extent: f64| (extent / side) as usize + 1;
        let mut grid = Self {
            origin: bbox.min,
            per_length: 1.0 / side,
            columns: number(width),
            rows: number(height),
            first: Vec::new(),
            entries: Vec::new(),
        };
        grid.first = vec![0; grid.columns * grid.rows + 1];
        let mut total = 0;
        for k in 0..count {
            let mut first = std::mem::take(&mut grid.first);
            grid.pass(edge(k), |cell| {
                first[cell] += 1;
                total += 1;
            });
            grid.first = first;
            if total > ENTRIES_PER_EDGE * count {
                return None;
            }
        }
        grid.fill(count, total, edge);
        Some(grid)
    }

    /// From counts to entries.
    fn fill(&mut self, count: usize, total: usize, edge: impl Fn(usize) -> [Point; 2]) {
        let mut sum = 0;
        for f in &mut self.first {
            sum += *f;
            *f = sum;
        }
        let (mut first, mut entries) = (std::mem::take(&mut self.first), vec![0; total]);
        for k in (0..count).rev() {
            self.pass(edge(k), |cell| {
                first[cell] -= 1;
                entries[first[cell] as usize] = k as u32;
            });
        }
        (self.first, self.entries) = (first, entries);
    }

    fn column(&self, x: f64) -> f64 {
        (x - self.origin.x) * self.per_length
    }

    fn row(&self, y: f64) -> f64 {
        (y - self.origin.y) * self.per_length
    }

    /// Calls `found` for every cell that an edge passes through, and for some beside it.
    #[inline]
    fn pass(&self, [a, b]: [Point; 2], mut found: impl FnMut(usize)) {
        let (l, r) = if a.x <= b.x { (a, b) } else { (b, a) };
        let (x0, x1, y0, y1) = (self.column(l.x), self.column(r.x), self.row(l.y), self.row(r.y));
        let clamp = |v: f64, n: usize| (v.max(0.0) as usize).min(n - 1);
        let (c0, c1) = (clamp(x0 - GRID_PAD, self.columns), clamp(x1 + GRID_PAD, self.columns));
        let slope = (y1 - y0) / (x1 - x0).max(f64::MIN_POSITIVE);
        for c in c0..=c1 {
            let at = |x: f64| if c0 == c1 { None } else { Some(y0 + slope * (x - x0)) };
            let enter = if c == c0 { y0 } else { at(c as f64 - GRID_PAD).unwrap_or(y0) };
            let leave = if c == c1 { y1 } else { at(c as f64 + 1.0 + GRID_PAD).unwrap_or(y1) };
            let (low, high) = (enter.min(leave).max(y0.min(y1)), enter.max(leave).min(y0.max(y1)));
            for row in clamp(low - GRID_PAD, self.rows)..=clamp(high + GRID_PAD, self.rows) {
                found(row * self.columns + c);
            }
        }
    }

    fn cell(&self, k: usize) -> &[u32] {
        &self.entries[self.first[k] as usize..self.first[k + 1] as usize]
    }

    /// Calls `found` for every two edges that share a cell, the smaller name first; some pairs come more than once.
    pub(super) fn pairs<E>(&self, mut found: impl FnMut(usize, usize) -> Result<(), E>) -> Result<(), E> {
        for k in 0..self.first.len() - 1 {
            let cell = self.cell(k);
            for (i, &a) in cell.iter().enumerate() {
                for &b in &cell[i + 1..] {
                    found(a as usize, b as usize)?;
                }
            }
        }
        Ok(())
    }

    /// Calls `found` for every edge that may lie above a point; some come more than once.
    pub(super) fn above(&self, p: Point, mut found: impl FnMut(usize)) {
        let (column, row) = (self.column(p.x), self.row(p.y) - GRID_PAD);
        let column = (column.max(0.0) as usize).min(self.columns - 1);
        let row = (row.max(0.0) as usize).min(self.rows - 1);
        for r in row..self.rows {
            self.cell(r * self.columns + column).iter().for_each(|&k| found(k as usize));
        }
    }
}
