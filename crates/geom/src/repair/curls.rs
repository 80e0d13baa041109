//! Curls: where a loop crosses itself and comes back to the same place at once, as careless paths of icons do.
//!
//! A curl is small, or it runs along what stays of the loop: a path drawn a little past its start, say. Cutting it off moves
//! no wall by more than a tolerance.

use super::report::Note;
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::intersect::{Closeness, Contact, contacts};
use crate::point::Point;
use crate::segment::Segment;
use std::ops::ControlFlow;

/// A stretch of a loop that begins and ends where it crosses itself.
struct Curl {
    at: Point,
    /// The edge on which it begins.
    first: usize,
    /// How many edges further it ends.
    count: usize,
    /// The larger extent of its box, mm.
    size: f64,
}

/// What counts as a curl.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// The larger extent of its box, mm.
    pub(super) extent: f64,
    /// How far it may lie from what stays, mm.
    pub(super) stray: f64,
}

/// Cuts off every curl; says whether there was one.
pub(super) fn cut_off(
    loops: &mut [(u32, Contour)],
    limits: Limits,
    closeness: Closeness,
    notes: &mut Vec<Note>,
) -> bool {
    let mut any = false;
    for (name, contour) in loops {
        // Each round cuts one of any that overlap, and makes the loop shorter.
        loop {
            let curls = find(contour, limits, closeness);
            if curls.is_empty() {
                break;
            }
            any = true;
            notes.extend(remove(contour, &curls).map(|c| Note::Curl { contour: *name, at: c.at, size: c.size }));
        }
    }
    any
}

/// All curls, by where they begin.
fn find(contour: &Contour, limits: Limits, closeness: Closeness) -> Vec<Curl> {
    let edges = &contour.segments;
    let index = SegmentIndex::new(edges);
    let mut curls = Vec::new();
    let ControlFlow::Continue(()) = index.visit_pairs(closeness.touch, |i, j| {
        contacts(&edges[i], &edges[j], closeness, |contact| {
            if let Contact::Crossing { at, shallow: false } = contact {
                let between = |first, last| Curl::new(edges, first, last, at, limits.extent);
                let slight = |c: &Curl| c.size <= limits.stray || c.runs_along(edges, &index, limits.stray);
                let either = [between(i, j), between(j, i)];
                curls.extend(either.into_iter().flatten().find(slight));
            }
        });
        ControlFlow::<std::convert::Infallible>::Continue(())
    });
    curls.sort_by(|a, b| a.first.cmp(&b.first).then(a.count.cmp(&b.count)).then(a.size.total_cmp(&b.size)));
    curls
}

impl Curl {
    /// The stretch from a crossing on one edge to the same crossing on another, where it is no larger than `extent`.
    fn new(edges: &[Segment], first: usize, last: usize, at: Point, extent: f64) -> Option<Self> {
        let count = (last + edges.len() - first) % edges.len();
        let mut curl = Self { at, first, count, size: 0.0 };
        let mut bbox = BBox::EMPTY;
        for piece in (0..=count).map(|k| curl.piece(edges, k)) {
            bbox = bbox.union(piece.bbox());
            if bbox.size() > extent {
                return None;
            }
        }
        curl.size = bbox.size();
        Some(curl)
    }

    /// Its pieces: the end of its first edge, whole edges, the beginning of its last one.
    fn piece(&self, edges: &[Segment], k: usize) -> Segment {
        let edge = edges[(self.first + k) % edges.len()];
        match k {
            0 => edge.split_at(self.at).1,
            k if k == self.count => edge.split_at(self.at).0,
            _ => edge,
        }
    }

    /// Whether every piece lies within `stray` of what stays, as far as its ends and quarters tell.
    fn runs_along(&self, edges: &[Segment], index: &SegmentIndex, stray: f64) -> bool {
        let n = edges.len();
        let is_near = |p: Point| {
            let mut near = p.distance(self.at) <= stray;
            index.visit(BBox::of(p, p), stray, |k, s| {
                let stays = match (k + n - self.first) % n {
                    0 => s.split_at(self.at).0,
                    j if j == self.count => s.split_at(self.at).1,
                    j if j < self.count => return,
                    _ => *s,
                };
                near |= stays.distance(p) <= stray;
            });
            near
        };
        (0..=self.count).map(|k| self.piece(edges, k)).all(|s| (0..4).all(|q| is_near(s.at(0.25 * f64::from(q)))))
    }
}

/// What becomes of an edge.
#[derive(Clone, Copy)]
enum Fate {
    Stays,
    EndsAt(Point),
    StartsAt(Point),
    Goes,
}

/// Takes curls out of a contour, of those that share edges the first; tells which.
fn remove<'a>(contour: &mut Contour, curls: &'a [Curl]) -> impl Iterator<Item = &'a Curl> {
    let n = contour.segments.len();
    let mut fates = vec![Fate::Stays; n];
    let mut taken = Vec::new();
    for curl in curls {
        let edge = |k: usize| (curl.first + k) % n;
        if (0..=curl.count).any(|k| !matches!(fates[edge(k)], Fate::Stays)) {
            continue;
        }
        fates[edge(0)] = Fate::EndsAt(curl.at);
        (1..curl.count).for_each(|k| fates[edge(k)] = Fate::Goes);
        fates[edge(curl.count)] = Fate::StartsAt(curl.at);
        taken.push(curl);
    }
    let kept = |(s, fate): (&Segment, &Fate)| match *fate {
        Fate::Stays => Some(*s),
        Fate::EndsAt(p) => Some(s.split_at(p).0),
        Fate::StartsAt(p) => Some(s.split_at(p).1),
        Fate::Goes => None,
    };
    contour.segments = contour.segments.iter().zip(&fates).filter_map(kept).collect();
    taken.into_iter()
}

#[cfg(test)]
mod tests;
