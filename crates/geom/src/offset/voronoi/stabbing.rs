//! Which edges span a distance.

use super::crossing::upward;
use crate::skeleton::{EdgeId, Skeleton};

/// The clearance ranges of all edges, by lower end, under an implicit tree of maxima of their upper ends.
#[derive(Debug)]
pub(super) struct EdgeIntervals {
    /// Lower clearance and half-edge going up, in increasing order.
    by_low: Vec<(f64, EdgeId)>,
    /// A binary heap-shaped tree: node `k` has children `2k` and `2k + 1`, leaf `i` is node `leaves + i`.
    max_high: Vec<f64>,
    leaves: usize,
}

impl EdgeIntervals {
    pub(super) fn new(skeleton: &Skeleton) -> Self {
        let mut by_low: Vec<(f64, EdgeId)> = (0..skeleton.edge_count() as EdgeId)
            .map(|k| upward(skeleton, 2 * k))
            .filter(|&e| skeleton.origin_clearance(e) < skeleton.target_clearance(e))
            .map(|e| (skeleton.origin_clearance(e), e))
            .collect();
        by_low.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let leaves = by_low.len().next_power_of_two();
        let mut max_high = vec![f64::NEG_INFINITY; 2 * leaves];
        for (leaf, &(_, e)) in max_high[leaves..].iter_mut().zip(&by_low) {
            *leaf = skeleton.target_clearance(e);
        }
        for k in (1..leaves).rev() {
            max_high[k] = max_high[2 * k].max(max_high[2 * k + 1]);
        }
        Self { by_low, max_high, leaves }
    }

    /// The half-edges going up with `low <= d < high`, in increasing order of their numbers.
    pub(super) fn spanning(&self, d: f64) -> Vec<EdgeId> {
        let below = self.by_low.partition_point(|&(low, _)| low <= d);
        let mut found = Vec::new();
        let mut stack = vec![(1, 0, self.leaves)];
        while let Some((node, first, width)) = stack.pop() {
            if first >= below || self.max_high[node] <= d {
                continue;
            }
            if width == 1 {
                found.push(self.by_low[first].1);
            } else {
                let half = width / 2;
                stack.push((2 * node + 1, first + half, half));
                stack.push((2 * node, first, half));
            }
        }
        found.sort_unstable();
        found
    }
}
