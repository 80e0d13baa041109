//! A tree of boxes over places in a row.

use super::boxes::Oriented;
use std::ops::ControlFlow;

/// An implicit binary tree: node `k` has the children `2k` and `2k + 1`, place `j` is node `places + j`.
#[derive(Clone, Debug, Default)]
pub(crate) struct BoxTree {
    places: usize,
    nodes: Vec<Oriented>,
}

impl BoxTree {
    /// The tree over these boxes; in whose order neighbours should lie close together.
    pub(crate) fn new(boxes: Vec<Oriented>) -> Self {
        if boxes.is_empty() {
            return Self::default();
        }
        let places = boxes.len().next_power_of_two();
        let mut nodes = vec![Oriented::EMPTY; places];
        nodes.reserve_exact(places);
        nodes.extend(boxes);
        nodes.resize(2 * places, Oriented::EMPTY);
        for node in (1..places).rev() {
            nodes[node] = Oriented::merged(&nodes[2 * node], &nodes[2 * node + 1]);
        }
        Self { places, nodes }
    }

    #[inline]
    pub(super) fn node(&self, node: usize) -> &Oriented {
        &self.nodes[node]
    }

    /// Calls `found` once for every pair of places whose boxes come within `margin` of each other, and for each place with
    /// itself.
    pub(crate) fn visit_pairs<B>(
        &self,
        margin: f64,
        mut found: impl FnMut(usize, usize) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let mut stack = if self.nodes.is_empty() { Vec::new() } else { vec![(1, 1)] };
        while let Some((a, b)) = stack.pop() {
            if a != b && !self.nodes[a].comes_within(&self.nodes[b], margin) {
                continue;
            }
            if a >= self.places {
                if !self.nodes[a].is_empty() {
                    found(a - self.places, b - self.places)?;
                }
            } else if a == b {
                stack.extend([(2 * a, 2 * a), (2 * a + 1, 2 * a + 1), (2 * a, 2 * a + 1)]);
            } else {
                stack.extend([(2 * a, 2 * b), (2 * a + 1, 2 * b), (2 * a, 2 * b + 1), (2 * a + 1, 2 * b + 1)]);
            }
        }
        ControlFlow::Continue(())
    }
}
