//! The grid method: candidates for intersections from a grid of cells, each with the edges that pass through it.

use crate::bbox::BBox;
use crate::point::Point;
use crate::tolerance::bisector::GRID_PAD;

/// Side of a cell in mean lengths of an edge.
const SIDE: f64 = 1.5;

/// Bits of a column's and of a row's number in an entry; the rest is the edge's name.
const PLACE_BITS: u32 = 20;
const NAME_BITS: u32 = 64 - 2 * PLACE_BITS;

/// With more pairs in cells than this for one edge, a grid does not pay.
const PAIRS_PER_EDGE: usize = 400;

/// A uniform grid over straight edges, of which only cells that are passed through exist.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    origin: Point,
    per_length: f64,
    columns: usize,
    rows: usize,
    /// Column, row and name of the edge, in this order.
    entries: Vec<u64>,
}

impl Grid {
    /// The grid of `count` edges; `None` where many of them crowd in the same cells.
    pub(super) fn new(count: usize, bbox: BBox, edge: impl Fn(usize) -> [Point; 2]) -> Option<Self> {
        let total: f64 = (0..count).map(&edge).map(|[a, b]| a.distance(b)).sum();
        let most = f64::from(1_u32 << PLACE_BITS) - 2.0;
        let side = (SIDE * total / count as f64).max(bbox.size() / most);
        if !(side > 0.0 && side.is_finite()) || count >> NAME_BITS > 0 {
            return None;
        }
        let number = |extent: f64| (extent / side) as usize + 1;
        let (columns, rows) = (number(bbox.width()), number(bbox.height()));
        let mut grid = Self { origin: bbox.min, per_length: 1.0 / side, columns, rows, entries: Vec::new() };
        let mut entries = Vec::with_capacity(4 * count);
        for k in 0..count {
            grid.pass(edge(k), |column, row| entries.push(entry(column, row, k)));
        }
        entries.sort_unstable();
        grid.entries = entries;
        (grid.pair_count() <= PAIRS_PER_EDGE * count).then_some(grid)
    }

    /// Pairs of edges that share a cell; some are counted more than once.
    pub(super) fn pair_count(&self) -> usize {
        self.cells().map(|c| c.len() * c.len() / 2).sum()
    }

    fn cells(&self) -> impl Iterator<Item = &[u64]> {
        self.entries.chunk_by(|a, b| a >> NAME_BITS == b >> NAME_BITS)
    }

    fn column(&self, x: f64) -> f64 {
        (x - self.origin.x) * self.per_length
    }

    fn row(&self, y: f64) -> f64 {
        (y - self.origin.y) * self.per_length
    }

    /// Calls `found` for every cell that an edge passes through, and for some beside it.
    #[inline]
    fn pass(&self, [a, b]: [Point; 2], mut found: impl FnMut(usize, usize)) {
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
                found(c, row);
            }
        }
    }

    /// Calls `found` for every two edges that share a cell; some pairs come more than once.
    pub(super) fn pairs<E>(&self, mut found: impl FnMut(usize, usize) -> Result<(), E>) -> Result<(), E> {
        for cell in self.cells() {
            for (i, &a) in cell.iter().enumerate() {
                for &b in &cell[i + 1..] {
                    found(name(a), name(b))?;
                }
            }
        }
        Ok(())
    }

    /// Calls `found` for every edge that may lie above a point; some come more than once.
    pub(super) fn above(&self, p: Point, mut found: impl FnMut(usize)) {
        let place = |v: f64, n: usize| (v.max(0.0) as usize).min(n - 1);
        let column = place(self.column(p.x), self.columns);
        let first = entry(column, place(self.row(p.y) - GRID_PAD, self.rows), 0);
        let begin = self.entries.partition_point(|&e| e < first);
        let above = self.entries[begin..].iter().take_while(|&&e| (e >> (NAME_BITS + PLACE_BITS)) as usize == column);
        above.for_each(|&e| found(name(e)));
    }
}

fn entry(column: usize, row: usize, name: usize) -> u64 {
    (column as u64) << (NAME_BITS + PLACE_BITS) | (row as u64) << NAME_BITS | name as u64
}

fn name(entry: u64) -> usize {
    (entry & ((1 << NAME_BITS) - 1)) as usize
}
