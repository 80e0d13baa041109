//! Step 2: every place of a piece led to its nearest root.

use super::{Piece, Place, Way};
use pocketry_geom::Segment;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// No node.
pub(super) const NONE: u32 = u32::MAX;

/// A place with the way towards its root.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) place: Place,
    /// The next node on the way to the root; [`NONE`] at a root.
    pub(super) parent: u32,
    /// From the parent to here.
    pub(super) way: Option<Segment>,
}

/// Trees of shortest ways from the roots of a piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct Forest {
    pub(super) nodes: Vec<Node>,
    /// The nodes, every one after its parent.
    pub(super) order: Vec<u32>,
    /// The nodes of the roots, as they were given.
    pub(super) roots: Vec<u32>,
}

impl Forest {
    /// The trees from these places of a piece. Places that no root leads to are left out.
    pub(crate) fn new(piece: &Piece, roots: &[u32]) -> Self {
        let nodes = piece.places.iter().map(|&place| Node { place, parent: NONE, way: None }).collect();
        let mut forest = Self { nodes, order: Vec::new(), roots: roots.to_vec() };
        let around = around(piece);
        let mut cost = vec![f64::INFINITY; piece.places.len()];
        let mut heap = BinaryHeap::new();
        for &root in roots {
            cost[root as usize] = 0.0;
            heap.push(Reverse((0, root)));
        }
        let mut settled = vec![false; piece.places.len()];
        let mut in_tree = vec![false; piece.ways.len()];
        let mut way_of = vec![NONE; piece.places.len()];
        while let Some(Reverse((_, at))) = heap.pop() {
            if std::mem::replace(&mut settled[at as usize], true) {
                continue;
            }
            forest.order.push(at);
            if let Some(taken) = in_tree.get_mut(way_of[at as usize] as usize) {
                *taken = true;
            }
            for &(w, far) in &around[at as usize] {
                let way = &piece.ways[w as usize];
                let through = cost[at as usize] + way.segment.length();
                if !settled[far as usize] && through < cost[far as usize] {
                    cost[far as usize] = through;
                    way_of[far as usize] = w;
                    let segment = if way.ends[0] == at { way.segment } else { way.segment.reversed() };
                    forest.nodes[far as usize] = Node { parent: at, way: Some(segment), ..forest.nodes[far as usize] };
                    // The bits of a number that is not negative are ordered like the number.
                    heap.push(Reverse((through.to_bits(), far)));
                }
            }
        }
        for (w, way) in piece.ways.iter().enumerate().filter(|(w, _)| !in_tree[*w]) {
            let [a, b] = way.ends.map(|e| cost[e as usize]);
            if (a + b).is_finite() && w < piece.ways.len() {
                forest.part(way, a, b);
            }
        }
        forest
    }

    /// A way that is on no shortest one is parted where both ends are equally far from their roots.
    fn part(&mut self, way: &Way, a: f64, b: f64) {
        let length = way.segment.length();
        let share = if length > 0.0 { (0.5 * (length + b - a) / length).clamp(0.0, 1.0) } else { 0.5 };
        let middle = way.segment.at(share);
        let (first, second) = way.segment.split_at(middle);
        let reach = way.ends.map(|e| self.nodes[e as usize].place.reach);
        let place = Place { at: middle, reach: reach[0].max(reach[1]) };
        for (end, half) in [(way.ends[0], first), (way.ends[1], second.reversed())] {
            if half.start() != half.end() {
                self.order.push(self.nodes.len() as u32);
                self.nodes.push(Node { place, parent: end, way: Some(half) });
            }
        }
    }
}

/// For each place the ways that end there, and their other ends.
fn around(piece: &Piece) -> Vec<Vec<(u32, u32)>> {
    let mut around = vec![Vec::new(); piece.places.len()];
    for (w, way) in piece.ways.iter().enumerate() {
        let [a, b] = way.ends;
        around[a as usize].push((w as u32, b));
        around[b as usize].push((w as u32, a));
    }
    around
}
