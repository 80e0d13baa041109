//! The boundary, asked how far it is.

use crate::distance::Boundary;
use crate::point::Point;
use crate::region::Region;
use std::cell::{Cell, OnceCell};

/// So many questions cost less than an index.
const UNINDEXED: u32 = 12;

/// A region's boundary; its index is built when it pays.
#[derive(Clone, Debug)]
pub(super) struct Walls<'a> {
    region: &'a Region,
    asked: Cell<u32>,
    index: OnceCell<Boundary>,
}

impl<'a> Walls<'a> {
    pub(super) fn new(region: &'a Region) -> Self {
        Self { region, asked: Cell::new(0), index: OnceCell::new() }
    }

    /// Distance of a point, mm, where it is below `bound`.
    pub(super) fn distance_below(&self, p: Point, bound: f64) -> Option<f64> {
        self.asked.set(self.asked.get() + 1);
        if self.asked.get() > UNINDEXED {
            return self.boundary().index().nearest_within(p, bound).map(|n| n.1);
        }
        let distance = self.region.segments().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        Some(distance).filter(|&d| d < bound)
    }

    /// The boundary with its index.
    pub(super) fn boundary(&self) -> &Boundary {
        self.index.get_or_init(|| Boundary::new(self.region))
    }
}
