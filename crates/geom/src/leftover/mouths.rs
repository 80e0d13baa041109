//! The mouths of one zone as a set of points: the nearest, and those near by.

use super::Mouth;
use crate::bbox::BBox;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::segment::Segment;

/// More are kept in an index.
const MOST_LISTED: usize = 8;

/// Mouths, in an index where there are many.
pub(super) struct Mouths<'a> {
    list: &'a [Mouth],
    index: Option<SegmentIndex>,
}

impl<'a> Mouths<'a> {
    pub(super) fn new(list: &'a [Mouth]) -> Self {
        let point = |m: &Mouth| Segment::line(m.at, m.at);
        let index = || SegmentIndex::new(&list.iter().map(point).collect::<Vec<_>>());
        Self { list, index: (list.len() > MOST_LISTED).then(index) }
    }

    pub(super) fn list(&self) -> &'a [Mouth] {
        self.list
    }

    /// The nearest one and its distance; there must be one.
    pub(super) fn nearest(&self, p: Point) -> (usize, f64) {
        if let Some(index) = &self.index {
            return index.nearest(p).unwrap_or((0, f64::INFINITY));
        }
        let nearer = |best: (usize, f64), (k, m): (usize, &Mouth)| {
            let d = m.at.distance(p);
            if d < best.1 { (k, d) } else { best }
        };
        self.list.iter().enumerate().fold((0, f64::INFINITY), nearer)
    }

    /// Calls `found` for all within a distance, and for some farther off.
    pub(super) fn visit(&self, p: Point, distance: f64, mut found: impl FnMut(&Mouth)) {
        match &self.index {
            Some(index) => index.visit(BBox::EMPTY.with(p), distance, |k, _| found(&self.list[k])),
            None => self.list.iter().for_each(found),
        }
    }
}
