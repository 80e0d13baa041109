//! Tracing: closed loops along the direction of travel.
//!
//! At every intersection the trace changes over to the other edge (the paper's tracing rule). The curves fall apart
//! into loops that neither cross themselves nor one another: such a loop turns by ±360° in all, and the winding number is
//! constant along each of its sides. At an intersection the winding numbers of the two loops that part there
//! differ by one; from one of them, counted at a corner that nothing of its own lies above, follow all of a connected part.
//! A loop bounds the offset where the winding number is 1 on its left and so 0 on its right.
//!
//! Where the order of crossings were wrong, winding numbers would contradict each other: that is checked at every crossing.

use super::covered::Covered;
use super::crossings::{Arrangement, Undecided};
use crate::point::Point;
use crate::predicates::orientation;
use std::ops::Range;

/// The loops with winding number 1 on their left.
pub(super) fn loops(curves: &Arrangement) -> Result<Vec<Vec<Point>>, Undecided> {
    let mut tracer = Tracer::new(curves);
    tracer.wind()?;
    tracer.selected()
}

/// The same where edges that are surely covered have no passages: a loop of the offset has no such edge, and its winding number
/// is counted at a place of it.
pub(super) fn uncovered_loops(curves: &Arrangement, covered: &Covered) -> Result<Vec<Vec<Point>>, Undecided> {
    let tracer = Tracer::new(curves);
    let mut out = Vec::new();
    for part in (0..tracer.parts.len()).filter(|&p| tracer.parts[p].1.is_empty()) {
        let corners = tracer.parts[part].0.clone();
        if !curves.dead[corners.clone()].contains(&true) && tracer.left_of_topmost(tracer.topmost(part))? == 1 {
            out.push(curves.raw.points[corners].to_vec());
        }
    }
    for traced in 0..tracer.firsts.len() {
        if let Some(loop_) = tracer.uncovered(traced, covered) {
            out.push(loop_);
        }
    }
    Ok(out)
}

struct Tracer<'a> {
    curves: &'a Arrangement<'a>,
    /// For each raw loop its corners and its passages.
    parts: Vec<(Range<usize>, Range<usize>)>,
    /// For each passage the raw loop that it lies on.
    part_of: Vec<u32>,
    /// For each passage the next one on its raw loop.
    following: Vec<u32>,
    /// For each passage the traced loop that leaves there.
    traced: Vec<u32>,
    /// For each traced loop one of its passages and its winding number on the left; then raw loops without passages.
    firsts: Vec<u32>,
    winding: Vec<Option<i32>>,
}

impl<'a> Tracer<'a> {
    /// All loops of the curves, not yet wound.
    fn new(curves: &'a Arrangement<'a>) -> Self {
        let n = curves.passages.len();
        let (part_of, following) = (Vec::with_capacity(n), Vec::with_capacity(n));
        let mut tracer = Self {
            curves,
            parts: Vec::new(),
            part_of,
            following,
            traced: vec![u32::MAX; n],
            firsts: Vec::new(),
            winding: Vec::new(),
        };
        let mut begin = 0;
        for (number, &end) in curves.raw.ends.iter().enumerate() {
            tracer.split(number, begin..end as usize);
            begin = end as usize;
        }
        tracer.follow();
        tracer
    }

    /// The passages of one raw loop.
    fn split(&mut self, number: usize, corners: Range<usize>) {
        let begin = self.following.len();
        let passages = &self.curves.passages[begin..];
        let count = passages.partition_point(|p| (p.edge as usize) < corners.end);
        self.following.extend((1..=count).map(|k| (begin + k % count) as u32));
        self.part_of.extend((0..count).map(|_| number as u32));
        self.parts.push((corners, begin..begin + count));
    }

    /// Where the trace goes on from passage `k`: along the edge to the next passage, there over to the other edge.
    fn onward(&self, k: usize) -> usize {
        self.curves.passages[self.following[k] as usize].partner as usize
    }

    fn follow(&mut self) {
        for first in 0..self.traced.len() {
            let name = self.firsts.len() as u32;
            if self.traced[first] != u32::MAX {
                continue;
            }
            self.firsts.push(first as u32);
            let mut k = first;
            while self.traced[k] == u32::MAX {
                self.traced[k] = name;
                k = self.onward(k);
            }
        }
        self.winding = vec![None; self.firsts.len()];
    }

    /// The winding number on the left of every traced loop.
    fn wind(&mut self) -> Result<(), Undecided> {
        let mut parts: Vec<(usize, usize)> =
            (0..self.parts.len()).filter(|&p| !self.parts[p].1.is_empty()).map(|p| (self.topmost(p), p)).collect();
        // From the top down, so that nothing of a connected part lies above its first corner.
        let points = &self.curves.raw.points;
        let key = |c: usize| (points[c].y, points[c].x);
        parts.sort_by(|a, b| key(b.0).0.total_cmp(&key(a.0).0).then(key(b.0).1.total_cmp(&key(a.0).1)));
        for (corner, part) in parts {
            let passage = self.before(corner, part);
            let traced = self.traced[passage] as usize;
            if self.winding[traced].is_none() {
                self.winding[traced] = Some(self.left_of_topmost(corner)?);
                self.spread(traced)?;
            }
        }
        Ok(())
    }

    /// The corner of a raw loop that lies highest, of several the rightmost.
    fn topmost(&self, part: usize) -> usize {
        let points = &self.curves.raw.points;
        let higher = |a: usize, b: usize| (points[b].y, points[b].x) > (points[a].y, points[a].x);
        let range = self.parts[part].0.clone();
        range.clone().fold(range.start, |best, k| if higher(best, k) { k } else { best })
    }

    /// The passage after which a corner comes.
    fn before(&self, corner: usize, part: usize) -> usize {
        let range = self.parts[part].1.clone();
        let ahead = self.curves.passages[range.clone()].partition_point(|p| (p.edge as usize) < corner);
        if ahead == 0 { range.end - 1 } else { range.start + ahead - 1 }
    }

    /// The winding number to the left of the edges at a corner with nothing of its own part above.
    fn left_of_topmost(&self, corner: usize) -> Result<i32, Undecided> {
        let (points, next) = (&self.curves.raw.points, &self.curves.next);
        let part = self.parts.partition_point(|p| p.0.end <= corner);
        let range = &self.parts[part].0;
        let before = if corner == range.start { range.end - 1 } else { corner - 1 };
        let turn = orientation(points[before], points[corner], points[next[corner] as usize]);
        if turn == 0.0 {
            return Err(Undecided(points[corner]));
        }
        Ok(self.curves.winding_at(corner) + i32::from(turn > 0.0))
    }

    /// Carries the winding number to all loops of a connected part.
    fn spread(&mut self, start: usize) -> Result<(), Undecided> {
        let mut waiting = vec![start];
        while let Some(traced) = waiting.pop() {
            let first = self.firsts[traced] as usize;
            let here = self.winding[traced].unwrap_or_default();
            let mut k = first;
            loop {
                let passage = &self.curves.passages[k];
                let other = self.traced[passage.partner as usize] as usize;
                let expected = if passage.other_to_left { here + 1 } else { here - 1 };
                match self.winding[other] {
                    None => {
                        self.winding[other] = Some(expected);
                        waiting.push(other);
                    }
                    Some(w) if w != expected => return Err(Undecided(self.curves.place(passage))),
                    Some(_) => {}
                }
                k = self.onward(k);
                if k == first {
                    break;
                }
            }
        }
        Ok(())
    }

    fn selected(&self) -> Result<Vec<Vec<Point>>, Undecided> {
        let mut out = Vec::new();
        for part in (0..self.parts.len()).filter(|&p| self.parts[p].1.is_empty()) {
            if self.left_of_topmost(self.topmost(part))? == 1 {
                out.push(self.curves.raw.points[self.parts[part].0.clone()].to_vec());
            }
        }
        out.extend((0..self.firsts.len()).filter(|&t| self.winding[t] == Some(1)).map(|t| self.points(t)));
        Ok(out)
    }

    /// A traced loop if it is one of the offset.
    fn uncovered(&self, traced: usize, covered: &Covered) -> Option<Vec<Point>> {
        let (points, edges) = self.points_and_edges(traced);
        if edges.iter().any(|&e| self.curves.dead[e as usize]) || points.iter().any(|&p| covered.holds([p, p])) {
            return None;
        }
        // The straight piece that is widest seen from above: a ray along one that stands upright would graze its neighbours.
        let next = |k: usize| points[(k + 1) % points.len()];
        let width = |k: usize| (points[k].x - next(k).x).abs();
        let widest = (0..points.len()).max_by(|&a, &b| width(a).total_cmp(&width(b)))?;
        let [a, b] = self.curves.edge(edges[widest] as usize);
        let middle = points[widest].lerp(next(widest), 0.5);
        let above = self.curves.winding_above(middle, |k| k == edges[widest] as usize);
        // Above lies to the right of an edge that leads left, or straight up.
        let right_is_above = b.x < a.x || (b.x == a.x && b.y > a.y);
        (above + i32::from(right_is_above) == 1).then_some(points)
    }

    /// The corners of a traced loop.
    fn points(&self, traced: usize) -> Vec<Point> {
        self.points_and_edges(traced).0
    }

    /// The corners of a traced loop, and the edges on which it goes on from them.
    fn points_and_edges(&self, traced: usize) -> (Vec<Point>, Vec<u32>) {
        let (passages, next) = (&self.curves.passages, &self.curves.next);
        let first = self.firsts[traced] as usize;
        let (mut k, mut out, mut edges) = (first, Vec::new(), Vec::new());
        loop {
            let (from, to) = (passages[k], passages[self.following[k] as usize]);
            out.push(self.curves.place(&from));
            edges.push(from.edge);
            let wraps = self.following[k] as usize <= k;
            let mut corner = from.edge;
            while corner != to.edge || (wraps && corner == from.edge) {
                corner = next[corner as usize];
                out.push(self.curves.raw.points[corner as usize]);
                edges.push(corner);
                if corner == to.edge {
                    break;
                }
            }
            k = self.onward(k);
            if k == first {
                return (out, edges);
            }
        }
    }
}
