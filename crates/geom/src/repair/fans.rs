//! The pieces at each vertex in angular order.

use super::arrangement::Piece;
use crate::around::side_by_side;
use crate::segment::Segment;
use crate::tolerance::TANGENT;
use std::f64::consts::TAU;

/// A piece as it leaves a vertex: `2k` is piece `k` from its start, `2k + 1` from its end.
pub(super) type Dart = u32;

/// The piece itself, or reversed, so that it starts at the dart's vertex.
pub(super) fn outgoing(pieces: &[Piece], dart: Dart) -> Segment {
    let segment = pieces[dart as usize / 2].segment;
    if dart & 1 == 0 { segment } else { segment.reversed() }
}

/// The darts of every vertex.
#[derive(Debug, Default)]
pub(super) struct Fans {
    first: Vec<u32>,
    darts: Vec<Dart>,
    /// Each dart's place in `darts`.
    place: Vec<u32>,
}

impl Fans {
    pub(super) fn new(pieces: &[Piece], vertices: usize) -> Self {
        let mut first = vec![0_u32; vertices + 1];
        let ends = || pieces.iter().flat_map(|p| [p.from, p.to]);
        ends().for_each(|v| first[v as usize + 1] += 1);
        for v in 0..vertices {
            first[v + 1] += first[v];
        }
        let mut fill = first.clone();
        let mut darts = vec![0; 2 * pieces.len()];
        for (dart, v) in (0..).zip(ends()) {
            darts[fill[v as usize] as usize] = dart;
            fill[v as usize] += 1;
        }
        for v in 0..vertices {
            let fan = &mut darts[first[v] as usize..first[v + 1] as usize];
            if fan.len() > 2 {
                sort_around(pieces, fan);
            }
        }
        let mut place = vec![0; darts.len()];
        (0..).zip(&darts).for_each(|(k, &d)| place[d as usize] = k);
        Self { first, darts, place }
    }

    /// The darts that leave a vertex; more than two are ordered counter-clockwise.
    pub(super) fn at(&self, vertex: u32) -> &[Dart] {
        &self.darts[self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize]
    }

    /// The last dart of a vertex counter-clockwise: the gap from it to the first one holds the direction −x unless nearly
    /// tangent darts lie on both sides of it.
    pub(super) fn last(&self, pieces: &[Piece], vertex: u32) -> Dart {
        let mut fan = self.at(vertex).to_vec();
        sort_around(pieces, &mut fan);
        fan[fan.len() - 1]
    }

    /// The place of a dart among those of its vertex.
    pub(super) fn place(&self, dart: Dart, vertex: u32) -> usize {
        (self.place[dart as usize] - self.first[vertex as usize]) as usize
    }

    /// Vertices at which more than two pieces end.
    pub(super) fn touches(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.first.len() as u32 - 1).filter(|&v| self.at(v).len() > 2)
    }
}

/// Sorts by direction; nearly tangent pieces by the side of each other that they lead to.
fn sort_around(pieces: &[Piece], fan: &mut [Dart]) {
    let mut keyed: Vec<(f64, Dart, Segment)> = fan
        .iter()
        .map(|&d| {
            let s = outgoing(pieces, d);
            (s.start_tangent().angle(), d, s)
        })
        .collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let n = keyed.len();
    let gap = |k: usize| if k == 0 { keyed[0].0 + TAU - keyed[n - 1].0 } else { keyed[k].0 - keyed[k - 1].0 };
    if gap(0) < TANGENT {
        let widest = (0..n).max_by(|&i, &j| gap(i).total_cmp(&gap(j))).unwrap_or(0);
        keyed.rotate_left(widest);
    }
    let mut from = 0;
    while from < n {
        let mut to = from + 1;
        while to < n && (keyed[to].0 - keyed[to - 1].0).rem_euclid(TAU) < TANGENT {
            to += 1;
        }
        keyed[from..to].sort_by(|a, b| side_by_side(&a.2, &b.2));
        from = to;
    }
    fan.iter_mut().zip(keyed).for_each(|(d, k)| *d = k.1);
}
