//! Facets and edges by where they lie seen from above: square bins, each sorted from the highest item down, so that a search
//! for the highest contact soon finds that nothing in a bin can be higher.

use pocketry_geom::mesh::{Corner, above};
use pocketry_geom::{BBox, Point};

/// A facet or an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    /// Its highest z, mm.
    pub(super) top: f64,
    pub(super) bbox: BBox,
    pub(super) index: u32,
    pub(super) is_edge: bool,
}

/// All items, bin by bin.
#[derive(Clone, Debug)]
pub(super) struct Bins {
    bounds: BBox,
    size: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    items: Vec<Item>,
}

/// More bins than this a side are of no use.
const MOST: f64 = 2000.0;

impl Bins {
    pub(super) fn new(facets: &[[Corner; 3]], edges: &[[Corner; 2]], bounds: BBox, radius: f64) -> Self {
        let item = |corners: &[Corner], index: usize, is_edge| Item {
            top: corners.iter().map(|c| c[2]).fold(f64::NEG_INFINITY, f64::max),
            bbox: corners.iter().fold(BBox::EMPTY, |b, &c| b.with(above(c))),
            index: index as u32,
            is_edge,
        };
        let all = facets.iter().enumerate().map(|(k, c)| item(c, k, false));
        let mut all: Vec<Item> = all.chain(edges.iter().enumerate().map(|(k, c)| item(c, k, true))).collect();
        all.sort_by(|a, b| b.top.total_cmp(&a.top));
        let size = (0.5 * radius).max(bounds.size() / MOST);
        let count = |extent: f64| (extent / size).floor() as usize + 1;
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        let mut bins = Self { bounds, size, columns, rows, starts: vec![0; columns * rows + 1], items: Vec::new() };
        for i in &all {
            bins.cells(i.bbox).for_each(|c| bins.starts[c + 1] += 1);
        }
        for c in 1..bins.starts.len() {
            bins.starts[c] += bins.starts[c - 1];
        }
        let mut next = bins.starts.clone();
        if let Some(&first) = all.first() {
            bins.items = vec![first; bins.starts.last().copied().unwrap_or(0) as usize];
        }
        for i in &all {
            for c in bins.cells(i.bbox) {
                bins.items[next[c] as usize] = *i;
                next[c] += 1;
            }
        }
        bins
    }

    /// The numbers of the bins that a box touches.
    fn cells(&self, bbox: BBox) -> impl Iterator<Item = usize> + use<> {
        let (size, columns, min) = (self.size, self.columns, self.bounds.min);
        let index = |x: f64, count: usize| (x / size).floor().clamp(0.0, count as f64 - 1.0) as usize;
        let (left, right) = (index(bbox.min.x - min.x, columns), index(bbox.max.x - min.x, columns));
        let (low, high) = (index(bbox.min.y - min.y, self.rows), index(bbox.max.y - min.y, self.rows));
        (low..=high).flat_map(move |j| (left..=right).map(move |i| j * columns + i))
    }

    /// Calls for items within `radius` of `p` and perhaps some more, each perhaps more than once; where the answer is false,
    /// the rest of the bin, which is no higher, is passed over.
    pub(super) fn visit(&self, p: Point, radius: f64, mut wanted: impl FnMut(&Item) -> bool) {
        let reach = BBox::of(p, p).inflated(radius);
        if !reach.intersects(self.bounds) {
            return;
        }
        for c in self.cells(reach) {
            for item in &self.items[self.starts[c] as usize..self.starts[c + 1] as usize] {
                if !wanted(item) {
                    break;
                }
            }
        }
    }
}
