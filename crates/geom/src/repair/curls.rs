//! Curls: where a loop crosses itself and comes back to the same place at once, as careless paths of icons do.

use super::report::Note;
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

/// Cuts off every curl up to a size, mm; says whether there was one.
pub(super) fn cut_off(loops: &mut [(u32, Contour)], largest: f64, closeness: Closeness, notes: &mut Vec<Note>) -> bool {
    let mut any = false;
    for (name, contour) in loops {
        // Each round cuts one of any that overlap, and makes the loop shorter.
        loop {
            let curls = find(contour, largest, closeness);
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
fn find(contour: &Contour, largest: f64, closeness: Closeness) -> Vec<Curl> {
    let edges = &contour.segments;
    let mut curls = Vec::new();
    let ControlFlow::Continue(()) = SegmentIndex::new(edges).visit_pairs(closeness.touch, |i, j| {
        contacts(&edges[i], &edges[j], closeness, |contact| {
            if let Contact::Crossing { at, shallow: false } = contact {
                curls.extend(curl(edges, i, j, at, largest).or_else(|| curl(edges, j, i, at, largest)));
            }
        });
        ControlFlow::<std::convert::Infallible>::Continue(())
    });
    curls.sort_by(|a, b| a.first.cmp(&b.first).then(a.count.cmp(&b.count)).then(a.size.total_cmp(&b.size)));
    curls
}

/// The stretch from a crossing on one edge to the same crossing on another, where it is small.
fn curl(edges: &[Segment], first: usize, last: usize, at: Point, largest: f64) -> Option<Curl> {
    let count = (last + edges.len() - first) % edges.len();
    let mut bbox = edges[first].split_at(at).1.bbox().union(edges[last].split_at(at).0.bbox());
    for k in 1..count {
        if bbox.size() > largest {
            break;
        }
        bbox = bbox.union(edges[(first + k) % edges.len()].bbox());
    }
    (bbox.size() <= largest).then_some(Curl { at, first, count, size: bbox.size() })
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
