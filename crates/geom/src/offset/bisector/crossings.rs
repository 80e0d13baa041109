//! Where raw offset edges cross.
//!
//! Whether two edges cross is decided exactly. Anything degenerate (a corner on an edge, edges that overlap, two crossings of an
//! edge too near to one another to be told apart) is reported, not guessed: see [`super::solve`].

use super::covered::Covered;
use super::grid::Grid;
use super::raw::Raw;
use crate::bbox::BBox;
use crate::index::SegmentIndex;
use crate::point::{Point, Vec2};
use crate::predicates::orientation;
use crate::segment::Segment;
use crate::tolerance::COORDINATE_ROUNDOFF;
use std::ops::ControlFlow;

/// With more pairs of neighbours than this for one edge, covered edges are looked for.
const CROWD: usize = 24;

/// So few edges need no help.
const FEW: usize = 256;

/// The passing of one edge through a crossing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    /// The edge.
    pub(super) edge: u32,
    /// Fraction of the edge's length at which it crosses, and how far that may be off.
    at: f64,
    doubt: f64,
    /// The crossing's number.
    crossing: u32,
    /// The other passage of the same crossing.
    pub(super) partner: u32,
    /// Whether the other edge crosses towards the left.
    pub(super) other_to_left: bool,
}

/// Edges that cannot be told to cross or not, or in which order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Undecided(pub(super) Point);

/// Raw edges, their loops and their crossings.
#[derive(Debug)]
pub(super) struct Arrangement<'a> {
    pub(super) raw: &'a Raw,
    /// For each corner the one after it; edge `k` runs from corner `k` to corner `next[k]`.
    pub(super) next: Vec<u32>,
    /// All passages, in order along the loops.
    pub(super) passages: Vec<Passage>,
    /// Edges that surely are no part of the offset: they have no passages. Empty where none was looked for.
    pub(super) dead: Vec<bool>,
    finder: Finder,
}

/// How edges are found.
#[derive(Debug)]
enum Finder {
    Grid(Grid),
    Tree(SegmentIndex, f64),
}

impl Finder {
    fn tree(segments: &[Segment], bbox: BBox) -> Self {
        Self::Tree(SegmentIndex::new(segments), bbox.max.y)
    }
}

/// Tests all pairs of segments near one another, until one is undecided.
fn try_pairs(
    index: &SegmentIndex,
    mut test: impl FnMut(usize, usize) -> Result<(), Undecided>,
) -> Result<(), Undecided> {
    match index.visit_pairs(0.0, |a, b| test(a, b).map_or_else(ControlFlow::Break, ControlFlow::Continue)) {
        ControlFlow::Break(undecided) => Err(undecided),
        ControlFlow::Continue(()) => Ok(()),
    }
}

impl<'a> Arrangement<'a> {
    /// Finds all crossings.
    pub(super) fn new(raw: &'a Raw) -> Result<Self, Undecided> {
        let next = successors(raw);
        let edge = |k: usize| [raw.points[k], raw.points[next[k] as usize]];
        let bbox = raw.points.iter().fold(BBox::EMPTY, |b, &p| b.with(p));
        let finder =
            Grid::new(next.len(), bbox, edge).map_or_else(|| Finder::tree(&segments(raw, &next), bbox), Finder::Grid);
        Self { raw, next, passages: Vec::new(), dead: Vec::new(), finder }.completed()
    }

    /// Whether so many edges lie beside one another that finding the covered ones first pays.
    pub(super) fn is_crowded(raw: &Raw) -> bool {
        let next = successors(raw);
        let bbox = raw.points.iter().fold(BBox::EMPTY, |b, &p| b.with(p));
        next.len() > FEW
            && Grid::new(next.len(), bbox, |k| [raw.points[k], raw.points[next[k] as usize]])
                .is_none_or(|grid| grid.pair_count() > CROWD * next.len())
    }

    /// Finds the crossings of edges that are not covered.
    pub(super) fn of_uncovered(raw: &'a Raw, covered: &Covered) -> Result<Self, Undecided> {
        let next = successors(raw);
        let all = segments(raw, &next);
        let dead: Vec<bool> = all.iter().map(|s| covered.holds([s.start(), s.end()])).collect();
        let bbox = raw.points.iter().fold(BBox::EMPTY, |b, &p| b.with(p));
        Self { raw, next, passages: Vec::new(), dead, finder: Finder::tree(&all, bbox) }.completed()
    }

    fn completed(mut self) -> Result<Self, Undecided> {
        let pairs = if self.dead.is_empty() { self.crossing_pairs()? } else { self.living_pairs()? };
        self.passages = pairs.iter().enumerate().flat_map(|(k, &(a, b))| self.passages_of(k as u32, a, b)).collect();
        self.sort()?;
        Ok(self)
    }

    fn living_pairs(&self) -> Result<Vec<(u32, u32)>, Undecided> {
        let living: Vec<usize> = (0..self.next.len()).filter(|&k| !self.dead[k]).collect();
        let segments: Vec<Segment> = living.iter().map(|&k| Segment::line(self.edge(k)[0], self.edge(k)[1])).collect();
        let mut pairs = Vec::new();
        try_pairs(&SegmentIndex::new(&segments), |a, b| self.crosses(living[a], living[b], &mut pairs))?;
        pairs.sort_unstable();
        pairs.dedup();
        Ok(pairs)
    }

    /// Notes two edges if they cross.
    fn crosses(&self, a: usize, b: usize, pairs: &mut Vec<(u32, u32)>) -> Result<(), Undecided> {
        if self.next[a] as usize != b && self.next[b] as usize != a && cross(self.edge(a), self.edge(b))? {
            pairs.push((a.min(b) as u32, a.max(b) as u32));
        }
        Ok(())
    }

    /// The two ends of an edge.
    #[inline]
    pub(super) fn edge(&self, k: usize) -> [Point; 2] {
        [self.raw.points[k], self.raw.points[self.next[k] as usize]]
    }

    fn crossing_pairs(&self) -> Result<Vec<(u32, u32)>, Undecided> {
        let mut pairs = Vec::new();
        let test = |a: usize, b: usize| self.crosses(a, b, &mut pairs);
        match &self.finder {
            Finder::Grid(grid) => grid.pairs(test)?,
            Finder::Tree(tree, _) => try_pairs(tree, test)?,
        }
        pairs.sort_unstable();
        pairs.dedup();
        Ok(pairs)
    }

    fn passages_of(&self, crossing: u32, a: u32, b: u32) -> [Passage; 2] {
        let (of_a, of_b) = (self.edge(a as usize), self.edge(b as usize));
        let (at, doubt) = parameter(of_a, of_b);
        // a's end lies to the right of b where b comes from a's left to a's left again: b's end decides.
        let to_left = orientation(of_a[0], of_a[1], of_b[1]) > 0.0;
        let first = Passage { edge: a, at, doubt, crossing, partner: 0, other_to_left: to_left };
        let (at, doubt) = parameter(of_b, of_a);
        [first, Passage { edge: b, at, doubt, crossing, partner: 0, other_to_left: !to_left }]
    }

    /// Orders the passages along the loops and joins partners.
    fn sort(&mut self) -> Result<(), Undecided> {
        self.passages.sort_unstable_by(|p, q| p.edge.cmp(&q.edge).then(p.at.total_cmp(&q.at)));
        let close = |p: &Passage, q: &Passage| {
            p.edge == q.edge && (q.at - p.at).partial_cmp(&(p.doubt + q.doubt)) != Some(std::cmp::Ordering::Greater)
        };
        if let Some(pair) = self.passages.windows(2).find(|w| close(&w[0], &w[1])) {
            let [a, b] = self.edge(pair[0].edge as usize);
            return Err(Undecided(a.lerp(b, pair[0].at)));
        }
        let mut other = vec![u32::MAX; self.passages.len() / 2];
        for k in 0..self.passages.len() {
            let crossing = self.passages[k].crossing as usize;
            if other[crossing] == u32::MAX {
                other[crossing] = k as u32;
            } else {
                self.passages[k].partner = other[crossing];
                self.passages[other[crossing] as usize].partner = k as u32;
            }
        }
        Ok(())
    }

    /// Where a passage is: the same for both of a crossing.
    pub(super) fn place(&self, p: &Passage) -> Point {
        let other = &self.passages[p.partner as usize];
        let p = if p.edge < other.edge { p } else { other };
        let [a, b] = self.edge(p.edge as usize);
        a.lerp(b, p.at)
    }

    /// The curves' winding number at a corner, without the edges that end there.
    pub(super) fn winding_at(&self, corner: usize) -> i32 {
        self.winding_above(self.raw.points[corner], |k| k == corner || self.next[k] as usize == corner)
    }

    /// The winding number just above a point, without some edges.
    pub(super) fn winding_above(&self, p: Point, without: impl Fn(usize) -> bool) -> i32 {
        let mut above: Vec<(u32, i32)> = Vec::new();
        let mut look = |k: usize| {
            let [c, d] = self.edge(k);
            let (rightwards, leftwards) = (c.x <= p.x && p.x < d.x, d.x <= p.x && p.x < c.x);
            if without(k) || !(rightwards || leftwards) {
                return;
            }
            let side = orientation(c, d, p);
            if rightwards && side < 0.0 {
                above.push((k as u32, -1));
            } else if leftwards && side > 0.0 {
                above.push((k as u32, 1));
            }
        };
        match &self.finder {
            Finder::Grid(grid) => grid.above(p, look),
            Finder::Tree(tree, top) => tree.visit(BBox::of(p, Point::new(p.x, *top)), 0.0, |k, _| look(k)),
        }
        above.sort_unstable();
        above.dedup();
        above.iter().map(|a| a.1).sum()
    }
}

fn segments(raw: &Raw, next: &[u32]) -> Vec<Segment> {
    next.iter().zip(&raw.points).map(|(&n, &p)| Segment::line(p, raw.points[n as usize])).collect()
}

fn successors(raw: &Raw) -> Vec<u32> {
    let mut next: Vec<u32> = (1..=raw.points.len() as u32).collect();
    let mut begin = 0;
    for &end in &raw.ends {
        next[end as usize - 1] = begin;
        begin = end;
    }
    next
}

/// Whether two edges that share no corner cross; undecided where a corner lies on the other edge's line and
/// no line separates them.
#[inline]
fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Result<bool, Undecided> {
    let apart = |p: f64, q: f64, r: f64, s: f64| p.max(q) < r.min(s) || r.max(s) < p.min(q);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return Ok(false);
    }
    let (of_c, of_d) = (orientation(a, b, c), orientation(a, b, d));
    if (of_c > 0.0 && of_d > 0.0) || (of_c < 0.0 && of_d < 0.0) {
        return Ok(false);
    }
    let (of_a, of_b) = (orientation(c, d, a), orientation(c, d, b));
    if (of_a > 0.0 && of_b > 0.0) || (of_a < 0.0 && of_b < 0.0) {
        return Ok(false);
    }
    if [of_a, of_b, of_c, of_d].contains(&0.0) {
        return Err(Undecided(if of_c == 0.0 || of_d == 0.0 { c } else { a }));
    }
    Ok(true)
}

/// At which fraction of its length an edge crosses another, and how far that may be off.
fn parameter([a, b]: [Point; 2], [c, d]: [Point; 2]) -> (f64, f64) {
    let size = |v: Vec2| v.x.abs() + v.y.abs();
    let (of_a, of_b) = (orientation(c, d, a), orientation(c, d, b));
    let spread = of_a.abs() + of_b.abs();
    let rounding = COORDINATE_ROUNDOFF * size(d - c) * (size(a - c) + size(b - c));
    (of_a.abs() / spread, rounding / spread + f64::EPSILON)
}
