//! Step 2: the raw curves of all contours in one row of pieces.

use crate::segment::Segment;
use std::ops::Range;

/// The number of no element.
pub(super) const BRIDGE: u32 = u32::MAX;

/// Raw curves, piece after piece and curve after curve.
#[derive(Clone, Debug)]
pub(super) struct RawCurves {
    pub(super) segments: Vec<Segment>,
    /// For each piece the number of its element; [`BRIDGE`] for a bridge.
    pub(super) elements: Vec<u32>,
    /// For each curve its first piece; one more at the end.
    bounds: Vec<u32>,
}

impl RawCurves {
    /// No curves, with room for so many pieces.
    pub(super) fn with_capacity(pieces: usize) -> Self {
        Self { segments: Vec::with_capacity(pieces), elements: Vec::with_capacity(pieces), bounds: vec![0] }
    }

    pub(super) fn push(&mut self, segment: Segment, element: u32) {
        self.segments.push(segment);
        self.elements.push(element);
    }

    /// The pieces pushed since the last curve was closed.
    pub(super) fn open_pieces(&self) -> usize {
        self.segments.len() - self.bounds[self.bounds.len() - 1] as usize
    }

    /// The pieces pushed since the last curve was closed become a curve; fewer than two are dropped.
    pub(super) fn close(&mut self) -> bool {
        let whole = self.open_pieces() > 1;
        if whole {
            self.bounds.push(self.segments.len() as u32);
        } else {
            let begun = self.bounds[self.bounds.len() - 1] as usize;
            self.segments.truncate(begun);
            self.elements.truncate(begun);
        }
        whole
    }

    /// The pieces of each curve.
    pub(super) fn curves(&self) -> impl Iterator<Item = Range<u32>> + '_ {
        self.bounds.windows(2).map(|w| w[0]..w[1])
    }

    /// The pieces of the curve that a piece belongs to.
    pub(super) fn curve_of(&self, piece: u32) -> Range<u32> {
        let after = self.bounds.partition_point(|&b| b <= piece);
        self.bounds[after - 1]..self.bounds[after]
    }

    pub(super) fn is_bridge(&self, piece: u32) -> bool {
        self.elements[piece as usize] == BRIDGE
    }

    pub(super) fn segment(&self, piece: u32) -> &Segment {
        &self.segments[piece as usize]
    }

    /// The longest of some pieces.
    pub(super) fn longest(&self, pieces: Range<u32>) -> Option<&Segment> {
        pieces.map(|k| self.segment(k)).max_by(|a, b| chord_squared(a).total_cmp(&chord_squared(b)))
    }
}

/// Pieces turn by less than half, so that chords are in order of lengths well enough.
pub(super) fn chord_squared(s: &Segment) -> f64 {
    s.start().distance_squared(s.end())
}
