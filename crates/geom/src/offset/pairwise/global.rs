//! Steps 4 and 5: global interfering ranges go, and what remains joins to loops.
//!
//! Crossings part raw curves into runs, and no run changes its validity on the way: one question to the boundary settles
//! it. At a crossing the curve from which the other turns left goes below; a valid run that ends there must be one that
//! does, and go on along the other. Where that fails, the crossings are wrong.

use super::crossings::{Crossing, Pieces};
use super::local::{BRIDGE, RawPiece};
use super::{Interference, PairwiseOffset};
use crate::contour::Contour;
use crate::distance::Boundary;
use crate::offset::{Offset, OffsetLoop};
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::NONE;
use crate::tolerance::OFFSET_DROP;
use crate::tolerance::pairwise::CLEARANCE;
use std::collections::HashSet;

/// Short runs that follow one another.
const SETTLINGS: usize = 3;

/// A crossing as one of its two curves meets it.
#[derive(Clone, Copy, Debug)]
struct Event {
    piece: u32,
    /// Distance from the piece's start, squared: pieces turn by less than half.
    along: f64,
    crossing: u32,
    below: bool,
}

/// The valid loops of raw curves.
pub(super) fn loops(
    curves: &[Vec<RawPiece>],
    d: f64,
    walls: &Boundary,
    size: f64,
    mut interferences: Vec<Interference>,
) -> Result<PairwiseOffset, String> {
    let pieces = Pieces::new(curves);
    let crossings = pieces.crossings();
    let events = events(&pieces, &crossings);
    let judge =
        Judge { pieces: &pieces, crossings: &crossings, events: &events, d, walls, tolerance: CLEARANCE * size };
    let runs = judge.runs();
    let mut traced: Vec<Vec<(Segment, u32)>> = Vec::new();
    for closed in &runs.whole {
        traced.push(pieces.all[closed.clone()].iter().map(|p| (p.segment, p.element)).collect());
    }
    traced.extend(judge.trace(&runs.valid)?);
    for (e, _) in events.iter().zip(&runs.valid).filter(|&(e, &valid)| !e.below && valid) {
        let c = &crossings[e.crossing as usize];
        let foot = |piece: u32| pieces.all[piece as usize].source.foot(c.at);
        interferences.push(Interference { local: false, degenerate: c.at, from: foot(c.below), to: foot(c.above) });
    }
    // A range is one of this offset only if a loop has the vertex that it collapsed to.
    let bits = |p: Point| (p.x.to_bits(), p.y.to_bits());
    let kept: HashSet<_> = traced.iter().flatten().map(|(s, _)| bits(s.end())).collect();
    interferences.retain(|i| kept.contains(&bits(i.degenerate)));
    let loops = traced.into_iter().filter_map(|t| assemble(t, OFFSET_DROP * size)).collect();
    Ok(PairwiseOffset { offset: Offset { distance: d, loops, degenerate: Vec::new() }, interferences })
}

/// The events in order of travel, curve by curve.
fn events(pieces: &Pieces, crossings: &[Crossing]) -> Vec<Event> {
    let mut events = Vec::with_capacity(2 * crossings.len());
    for (k, c) in crossings.iter().enumerate() {
        for (piece, below) in [(c.below, true), (c.above, false)] {
            let along = pieces.all[piece as usize].segment.start().distance_squared(c.at);
            events.push(Event { piece, along, crossing: k as u32, below });
        }
    }
    events.sort_unstable_by(|a, b| a.piece.cmp(&b.piece).then(a.along.total_cmp(&b.along)));
    events
}

struct Judge<'a> {
    pieces: &'a Pieces,
    crossings: &'a [Crossing],
    events: &'a [Event],
    d: f64,
    walls: &'a Boundary,
    tolerance: f64,
}

/// What of the raw curves is valid.
struct Runs {
    /// Curves that cross nothing, as ranges of pieces.
    whole: Vec<std::ops::Range<usize>>,
    /// For each event whether the run after it is.
    valid: Vec<bool>,
}

impl Judge<'_> {
    fn runs(&self) -> Runs {
        let (mut whole, mut verdicts) = (Vec::new(), Vec::with_capacity(self.events.len()));
        // For each crossing the event before that of the curve which goes below.
        let mut before = vec![0; self.crossings.len()];
        for bounds in self.pieces.bounds.windows(2) {
            let first = self.events.partition_point(|e| e.piece < bounds[0]);
            let last = self.events.partition_point(|e| e.piece < bounds[1]);
            let range = bounds[0] as usize..bounds[1] as usize;
            if first == last && self.is_whole(range.clone()) {
                whole.push(range);
            }
            verdicts.extend(self.verdicts(first..last));
            for k in (first..last).filter(|&k| self.events[k].below) {
                before[self.events[k].crossing as usize] = if k == first { last - 1 } else { k - 1 };
            }
        }
        Runs { whole, valid: self.settle(&verdicts, &before) }
    }

    /// What the boundary says of the runs of one curve.
    fn verdicts(&self, range: std::ops::Range<usize>) -> impl Iterator<Item = Option<bool>> + '_ {
        range.clone().map(move |k| {
            let next = if k + 1 == range.end { range.start } else { k + 1 };
            let run = self.run(k, next);
            if run.iter().any(|r| r.1 == BRIDGE) {
                return Some(false);
            }
            let longest = run.iter().max_by(|a, b| a.0.length().total_cmp(&b.0.length()))?;
            if longest.0.length() <= self.tolerance { None } else { self.is_valid(longest.0.at(0.5)) }
        })
    }

    /// Runs that are too short to be asked about follow from the one that leads to their crossing.
    fn settle(&self, verdicts: &[Option<bool>], before: &[usize]) -> Vec<bool> {
        let mut settled = verdicts.to_vec();
        for _ in 0..SETTLINGS {
            for (k, event) in self.events.iter().enumerate().filter(|(k, _)| verdicts[*k].is_none()) {
                let lead = before[event.crossing as usize];
                settled[k] = if event.below { Some(false) } else { settled[lead] };
            }
        }
        settled.into_iter().map(|v| v.unwrap_or(false)).collect()
    }

    /// Whether a point is clear of the boundary; `None` where that is too close to tell.
    fn is_valid(&self, p: Point) -> Option<bool> {
        let clearance = self.walls.distance(p);
        if clearance < self.d - self.tolerance {
            Some(false)
        } else {
            Some(self.walls.contains(p)).filter(|_| clearance >= self.d - 0.5 * self.tolerance)
        }
    }

    /// Whether a curve that crosses nothing is valid: all of it is, or nothing.
    fn is_whole(&self, range: std::ops::Range<usize>) -> bool {
        let pieces = &self.pieces.all[range];
        let longest = pieces.iter().max_by(|a, b| a.segment.length().total_cmp(&b.segment.length()));
        let bridged = pieces.iter().any(|p| p.element == BRIDGE);
        !bridged && longest.is_some_and(|p| self.is_valid(p.segment.at(0.5)) == Some(true))
    }

    /// The pieces of the run between two successive events of a curve, with their elements.
    fn run(&self, from: usize, to: usize) -> Vec<(Segment, u32)> {
        let (a, b) = (&self.events[from], &self.events[to]);
        let [p, q] = [a, b].map(|e| self.crossings[e.crossing as usize].at);
        let of = |k: u32| &self.pieces.all[k as usize];
        if a.piece == b.piece && from < to {
            let s = of(a.piece).segment.split_at(p).1.split_at(q).0;
            return vec![(s, of(a.piece).element)];
        }
        let mut run = vec![(of(a.piece).segment.split_at(p).1, of(a.piece).element)];
        let curve = self.pieces.curve(a.piece);
        let (first, last) = (self.pieces.bounds[curve], self.pieces.bounds[curve + 1]);
        let mut k = a.piece;
        loop {
            k = if k + 1 == last { first } else { k + 1 };
            if k == b.piece {
                run.push((of(k).segment.split_at(q).0, of(k).element));
                return run;
            }
            run.push((of(k).segment, of(k).element));
        }
    }

    /// The event after another on its curve.
    fn next(&self, event: usize) -> usize {
        let curve = self.pieces.curve(self.events[event].piece);
        let (first, last) = (self.pieces.bounds[curve], self.pieces.bounds[curve + 1]);
        match self.events.get(event + 1) {
            Some(e) if e.piece < last => event + 1,
            _ => self.events.partition_point(|e| e.piece < first),
        }
    }

    /// Step 5: valid runs joined to loops.
    fn trace(&self, valid: &[bool]) -> Result<Vec<Vec<(Segment, u32)>>, String> {
        let mut up = vec![usize::MAX; self.crossings.len()];
        for (k, e) in self.events.iter().enumerate().filter(|(_, e)| !e.below) {
            up[e.crossing as usize] = k;
        }
        let mut visited = vec![false; self.events.len()];
        let mut loops = Vec::new();
        for start in 0..self.events.len() {
            if !valid[start] || visited[start] {
                continue;
            }
            let (mut traced, mut at) = (Vec::new(), start);
            while !std::mem::replace(&mut visited[at], true) {
                let end = self.next(at);
                traced.extend(self.run(at, end));
                let turn = up[self.events[end].crossing as usize];
                if !self.events[end].below || !valid[turn] {
                    return Err("a valid run leads nowhere".to_owned());
                }
                at = turn;
            }
            if at != start {
                return Err("a loop does not come back".to_owned());
            }
            loops.push(traced);
        }
        Ok(loops)
    }
}

/// A loop of pieces; those shorter than `drop` go. None without extent.
fn assemble(traced: Vec<(Segment, u32)>, drop: f64) -> Option<OffsetLoop> {
    let mut kept: Vec<(Segment, u32)> = Vec::with_capacity(traced.len());
    for (segment, element) in traced {
        match kept.last() {
            Some(last) if segment.end().distance(last.0.end()) <= drop => {}
            Some(last) => kept.push((with_start(segment, last.0.end()), element)),
            None if segment.start().distance(segment.end()) <= drop => {}
            None => kept.push((segment, element)),
        }
    }
    let end = kept.last()?.0.end();
    kept[0].0 = with_start(kept[0].0, end);
    (kept.len() > 1).then(|| OffsetLoop {
        crossings: vec![NONE; kept.len()],
        sites: kept.iter().map(|k| k.1).collect(),
        contour: Contour::new(kept.into_iter().map(|k| k.0).collect()),
    })
}

fn with_start(s: Segment, start: Point) -> Segment {
    match s {
        Segment::Line(l) => Segment::line(start, l.end),
        Segment::Arc(a) => Segment::Arc(crate::segment::Arc { start, ..a }),
    }
}
