//! Raw offset lines: validity of edges, cases I and II, and the closed curve that remains.
//!
//! An offset edge is invalid when its length l − l' − l'' is not positive (the paper's figure 4). Where both of its ends are convex,
//! it is left out, and the backward and the forward edge are extended to where they meet (case I). The edge between them may
//! itself be extended already: so consecutive invalid edges (case II) go one after the other.
//!
//! Leaving out is allowed where the backward and the forward edge together turn by at most 90°: then whatever the extensions'
//! strips take away lies nearer than d to the wall that was left out, and was never part of the offset. So nothing is lost;
//! but the strip of the edge left out must still be covered. It is, if backward and forward edge are at
//! least d sin α and d sin β long, for the turns α and β at the invalid edge's ends. Else it is [`Raw::unproven`] and checked
//! against the result.

use super::corner::Joint;
use super::profile::{Edge, half_turn};
use crate::point::Point;
use crate::tolerance::bisector::EXTENDED_TURN;

/// Closed raw curves, and the edges that were left out without proof.
#[derive(Clone, Debug, Default)]
pub(super) struct Raw {
    /// Corners of all loops, one after the other.
    pub(super) points: Vec<Point>,
    /// Where each loop ends in `points`.
    pub(super) ends: Vec<u32>,
    /// Edges whose strip must turn out to be covered.
    /// They are named by their places among all edges of all loops.
    pub(super) unproven: Vec<(u32, Edge)>,
}

/// Whether edges may be left out before it is certain that others cover their strips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trust<'a> {
    /// They may, and are checked afterwards; but for those marked here by their names (none, where it is empty).
    Check(&'a [bool]),
    /// They may not.
    Prove,
}

impl Trust<'_> {
    fn allows(self, name: usize) -> bool {
        match self {
            Self::Check(marked) => !marked.get(name).is_some_and(|&m| m),
            Self::Prove => false,
        }
    }
}

impl Raw {
    /// The raw curves of these loops.
    pub(super) fn new(loops: &[Vec<Edge>], joint: &Joint, trust: Trust<'_>) -> Self {
        let mut raw = Self::default();
        let mut first = 0;
        for edges in loops {
            let mut chain = Chain::new(edges, first);
            chain.leave_out_invalid(joint, trust, &mut raw.unproven);
            chain.emit(joint, &mut raw);
            first += edges.len();
        }
        raw
    }

    fn close(&mut self, begin: usize) {
        let mut kept = begin;
        for k in begin..self.points.len() {
            if kept == begin || self.points[k] != self.points[kept - 1] {
                self.points[kept] = self.points[k];
                kept += 1;
            }
        }
        while kept > begin + 1 && self.points[kept - 1] == self.points[begin] {
            kept -= 1;
        }
        self.points.truncate(if kept - begin < 3 { begin } else { kept });
        if self.points.len() > begin {
            self.ends.push(self.points.len() as u32);
        }
    }
}

/// A closed chain of edges from which some are taken out.
struct Chain {
    edges: Vec<Edge>,
    before: Vec<u32>,
    after: Vec<u32>,
    alive: Vec<bool>,
    count: usize,
    /// Name of the first edge.
    first: usize,
}

impl Chain {
    fn new(edges: &[Edge], first: usize) -> Self {
        let n = edges.len();
        Self {
            edges: edges.to_vec(),
            before: (0..n).map(|k| ((k + n - 1) % n) as u32).collect(),
            after: (0..n).map(|k| ((k + 1) % n) as u32).collect(),
            alive: vec![true; n],
            count: n,
            first,
        }
    }

    fn neighbours(&self, k: usize) -> (usize, usize) {
        (self.before[k] as usize, self.after[k] as usize)
    }

    /// Length of the offset edge: negative where its direction is reversed.
    fn offset_length(&self, k: usize, joint: &Joint) -> f64 {
        let next = self.after[k] as usize;
        self.edges[k].length - joint.trim(&self.edges[k]) - joint.trim(&self.edges[next])
    }

    /// Cases I and II.
    fn leave_out_invalid(&mut self, joint: &Joint, trust: Trust<'_>, unproven: &mut Vec<(u32, Edge)>) {
        let mut waiting: Vec<usize> = (0..self.edges.len()).rev().collect();
        while let Some(k) = waiting.pop() {
            if !self.alive[k] || self.count < 4 {
                continue;
            }
            let (backward, forward) = self.neighbours(k);
            let convex = self.edges[k].half_turn > 0.0 && self.edges[forward].half_turn > 0.0;
            if !convex || self.offset_length(k, joint) > 0.0 {
                continue;
            }
            let proven = self.covers(k, joint);
            if !proven && !trust.allows(self.first + k) {
                continue;
            }
            let left_out = self.edges[k];
            if self.leave_out(k) {
                waiting.extend([forward, backward]);
                if !proven {
                    unproven.push(((self.first + k) as u32, left_out));
                }
            }
        }
    }

    /// Whether the neighbours' strips surely cover that of an invalid edge.
    fn covers(&self, k: usize, joint: &Joint) -> bool {
        let (backward, forward) = self.neighbours(k);
        let [a, e, b] = [backward, k, forward].map(|j| &self.edges[j]);
        let (at_start, at_end) = (a.direction.cross(e.direction), e.direction.cross(b.direction));
        a.length >= joint.distance * at_start && b.length >= joint.distance * at_end
    }

    /// Extends the backward and the forward edge to where they meet; `false` where they turn by too much or too little.
    fn leave_out(&mut self, k: usize) -> bool {
        let (backward, forward) = self.neighbours(k);
        let (a, b) = (self.edges[backward], self.edges[forward]);
        let (sine, cosine) = (a.direction.cross(b.direction), a.direction.dot(b.direction));
        if sine <= EXTENDED_TURN || cosine < 0.0 {
            return false;
        }
        let gap = b.start - a.start;
        let (along_a, along_b) = (gap.cross(b.direction) / sine, gap.cross(a.direction) / sine);
        if along_a < a.length || along_b > 0.0 {
            return false;
        }
        let meeting = a.start + a.direction * along_a;
        self.edges[backward].length = along_a;
        let half_turn = half_turn(sine, cosine);
        self.edges[forward] = Edge { start: meeting, length: b.length - along_b, half_turn, ..b };
        self.alive[k] = false;
        self.count -= 1;
        self.after[backward] = forward as u32;
        self.before[forward] = backward as u32;
        true
    }

    /// Appends the raw curve.
    fn emit(&self, joint: &Joint, raw: &mut Raw) {
        let begin = raw.points.len();
        let all: Vec<usize> = (0..self.edges.len()).filter(|&k| self.alive[k]).collect();
        // Kites all the way round could add up to a winding number of 1 where all strips overlap: one is left out.
        let inverted = all.iter().any(|&k| self.offset_length(k, joint) <= 0.0);
        let ring = inverted && all.iter().all(|&k| self.edges[k].half_turn > 0.0);
        for (place, &k) in all.iter().enumerate() {
            let (before, after) = (&self.edges[self.before[k] as usize], &self.edges[k]);
            if after.half_turn <= 0.0 {
                joint.mitre(before, after, &mut raw.points);
            } else if joint.kite_is_covered(before, after) && !(ring && place == 0) {
                raw.points.push(joint.on_bisector(before, after));
            } else {
                joint.pair_wise(before, after, &mut raw.points);
            }
        }
        raw.close(begin);
    }
}
