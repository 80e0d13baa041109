//! Which edges span a distance: an interval tree over the clearances of the vertices.
//!
//! Edge `[low, high)` belongs to the topmost node of the tree whose key lies in it. On the way down to a distance every
//! node met gives a prefix of its edges, in order of their lower ends (the distance lies below the key) or of their upper
//! ends (above): O(log n + k) for k edges, whatever the lengths of the ranges.

use super::crossing::upward;
use crate::skeleton::{EdgeId, Skeleton};
use std::cmp::Ordering;

/// The clearance ranges of all edges. Ranges are kept as indices of the sorted clearances.
#[derive(Debug)]
pub(super) struct EdgeIntervals {
    /// All clearances in increasing order. The tree is implicit: the root of `keys[a..b]` is its middle.
    keys: Vec<f64>,
    /// Where each node's edges begin in the two lists; one more than keys.
    first: Vec<u32>,
    /// `(lower end, edge going up)`, node by node, lowest first.
    by_low: Vec<(u32, EdgeId)>,
    /// `(upper end, edge going up)`, node by node, highest first.
    by_high: Vec<(u32, EdgeId)>,
}

impl EdgeIntervals {
    pub(super) fn new(skeleton: &Skeleton) -> Self {
        let mut keys: Vec<f64> = skeleton.vertices().iter().map(|v| v.clearance).collect();
        keys.sort_unstable_by(f64::total_cmp);
        keys.dedup();
        let index = |clearance: f64| keys.partition_point(|&k| k < clearance) as u32;
        let place: Vec<u32> = skeleton.vertices().iter().map(|v| index(v.clearance)).collect();
        let mut edges: Vec<(u32, u32, u32, EdgeId)> = (0..skeleton.edge_count() as EdgeId)
            .map(|k| upward(skeleton, 2 * k))
            .map(|e| (place[skeleton.origin(e) as usize], place[skeleton.target(e) as usize], e))
            .filter(|(low, high, _)| low < high)
            .map(|(low, high, e)| (node(keys.len() as u32, low, high), low, high, e))
            .collect();
        edges.sort_unstable();
        let by_low = edges.iter().map(|&(_, low, _, e)| (low, e)).collect();
        edges.sort_unstable_by_key(|&(node, _, high, e)| (node, u32::MAX - high, e));
        let by_high = edges.iter().map(|&(_, _, high, e)| (high, e)).collect();
        let mut first = vec![0; keys.len() + 1];
        for e in &edges {
            first[e.0 as usize + 1] += 1;
        }
        for k in 0..keys.len() {
            first[k + 1] += first[k];
        }
        Self { keys, first, by_low, by_high }
    }

    /// The half-edges going up with `low <= d < high`.
    pub(super) fn spanning(&self, d: f64) -> Vec<EdgeId> {
        let mut found = Vec::new();
        let Some(place) = self.keys.partition_point(|&k| k <= d).checked_sub(1) else { return found };
        let (mut from, mut to) = (0, self.keys.len());
        while from < to {
            let middle = from.midpoint(to);
            let edges = self.first[middle] as usize..self.first[middle + 1] as usize;
            match place.cmp(&middle) {
                Ordering::Less => {
                    let spans = |&&(low, _): &&(u32, EdgeId)| low as usize <= place;
                    found.extend(self.by_low[edges].iter().take_while(spans).map(|e| e.1));
                    to = middle;
                }
                Ordering::Equal => {
                    found.extend(self.by_low[edges].iter().map(|e| e.1));
                    break;
                }
                Ordering::Greater => {
                    let spans = |&&(high, _): &&(u32, EdgeId)| high as usize > place;
                    found.extend(self.by_high[edges].iter().take_while(spans).map(|e| e.1));
                    from = middle + 1;
                }
            }
        }
        found
    }
}

/// The topmost node of a tree of this size with `low <= node < high`.
fn node(size: u32, low: u32, high: u32) -> u32 {
    let (mut from, mut to) = (0_u32, size);
    loop {
        let middle = from.midpoint(to);
        if high <= middle {
            to = middle;
        } else if low > middle {
            from = middle + 1;
        } else {
            return middle;
        }
    }
}
