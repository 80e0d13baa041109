//! Which ends are one place.

use super::ChainNote;
use crate::point::Point;
use crate::segment::Segment;
use std::collections::HashMap;

/// No place.
const NOWHERE: u32 = u32::MAX;

/// Each round of joining looks this many times farther than the one before.
const WIDENING: f64 = 32.0;

/// Rounds: the first one looks as far as rounding may have moved an end, the last one as far as the tolerance.
const ROUNDS: i32 = 7;

/// A square grid that finds what was put within one cell's side of a point.
pub(super) struct Grid {
    side: f64,
    cells: HashMap<[i64; 2], Vec<u32>>,
}

impl Grid {
    pub(super) fn new(side: f64, expected: usize) -> Self {
        Self { side: side.max(f64::MIN_POSITIVE), cells: HashMap::with_capacity(expected) }
    }

    fn cell(&self, p: Point) -> [i64; 2] {
        [(p.x / self.side).floor() as i64, (p.y / self.side).floor() as i64]
    }

    pub(super) fn put(&mut self, p: Point, what: u32) {
        self.cells.entry(self.cell(p)).or_default().push(what);
    }

    /// Everything in the cell of `p` and the eight around it.
    pub(super) fn near(&self, p: Point) -> impl Iterator<Item = u32> + '_ {
        let [x, y] = self.cell(p);
        let around = (-1..=1).flat_map(move |i| (-1..=1).map(move |j| [x.saturating_add(i), y.saturating_add(j)]));
        around.filter_map(|c| self.cells.get(&c)).flatten().copied()
    }
}

/// Clusters of ends; end `2k` is the start of piece `k`, `2k + 1` its end.
pub(super) struct Places {
    points: Vec<Point>,
    ends: Vec<Vec<usize>>,
    of: Vec<u32>,
}

impl Places {
    /// Equal ends are one place. Then loose ends, those that no other end meets, are joined two by two, the nearest
    /// first, as far as the tolerance: so fine polylines stay whole, however short their pieces.
    pub(super) fn new(pieces: &[Segment], kept: &[usize], tolerance: f64) -> Self {
        let mut places = Self::exact(pieces, kept);
        for round in (0..ROUNDS).rev() {
            let reach = tolerance * WIDENING.powi(-round);
            let loose: Vec<usize> = (0..places.len()).filter(|&p| places.ends[p].len() == 1).collect();
            if loose.len() < 2 {
                break;
            }
            places.join(pieces, &loose, reach);
        }
        places
    }

    fn exact(pieces: &[Segment], kept: &[usize]) -> Self {
        let mut places = Self { points: Vec::new(), ends: Vec::new(), of: vec![NOWHERE; 2 * pieces.len()] };
        let mut known: HashMap<[u64; 2], u32> = HashMap::with_capacity(kept.len());
        for end in kept.iter().flat_map(|&k| [2 * k, 2 * k + 1]) {
            let p = point_of(pieces, end);
            // Adding zero makes one zero of the two.
            let key = [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
            let place = *known.entry(key).or_insert_with(|| {
                places.points.push(p);
                places.ends.push(Vec::with_capacity(2));
                places.points.len() as u32 - 1
            });
            places.ends[place as usize].push(end);
            places.of[end] = place;
        }
        places
    }

    /// Joins loose places that lie within reach of each other, the nearest pairs first.
    fn join(&mut self, pieces: &[Segment], loose: &[usize], reach: f64) {
        let mut grid = Grid::new(reach, loose.len());
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for &p in loose {
            for q in grid.near(self.points[p]).map(|q| q as usize) {
                let distance = self.points[p].distance(self.points[q]);
                let (a, b) = (self.ends[p][0], self.ends[q][0]);
                let shrinks = a == b ^ 1 && pieces[a / 2].length() <= 4.0 * reach;
                if distance <= reach && !shrinks {
                    pairs.push((distance, q, p));
                }
            }
            grid.put(self.points[p], p as u32);
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, p, q) in pairs {
            if let ([_], &[end]) = (&self.ends[p][..], &self.ends[q][..]) {
                self.ends[q].clear();
                self.ends[p].push(end);
                self.of[end] = p as u32;
            }
        }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    pub(super) fn ends(&self, place: usize) -> &[usize] {
        &self.ends[place]
    }

    pub(super) fn point(&self, place: usize) -> Point {
        self.points[place]
    }

    pub(super) fn of(&self, end: usize) -> usize {
        self.of[end] as usize
    }

    /// Takes a piece's ends away.
    pub(super) fn remove(&mut self, piece: usize) {
        for end in [2 * piece, 2 * piece + 1] {
            let place = self.of(end);
            self.ends[place].retain(|&e| e != end);
        }
    }

    /// What moving the ends to their places came to.
    pub(super) fn joined(&self, pieces: &[Segment], kept: &[usize]) -> Option<ChainNote> {
        let moves = kept.iter().flat_map(|&k| [2 * k, 2 * k + 1]).map(|end| {
            let at = self.point(self.of(end));
            (at.distance(point_of(pieces, end)), end / 2, at)
        });
        let moves: Vec<_> = moves.filter(|m| m.0 > 0.0).collect();
        let widest = moves.iter().max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        Some(ChainNote::Joined { count: moves.len(), widest: widest.0, at: widest.2, piece: widest.1 })
    }
}

fn point_of(pieces: &[Segment], end: usize) -> Point {
    if end.is_multiple_of(2) { pieces[end / 2].start() } else { pieces[end / 2].end() }
}
