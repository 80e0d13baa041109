//! Steps 4 and 5: global interfering ranges go, and what remains joins to loops.
//!
//! Crossings part raw curves into runs, and no run changes its validity on the way: one question to the boundary settles
//! it. At a crossing the curve from which the other turns left goes below; a valid run that ends there must be one that
//! does, and go on along the other. Where that fails, the crossings are wrong.

use super::crossings::{Crossing, crossings};
use super::local::LocalRange;
use super::raw::RawCurves;
use super::{Interference, PairwiseOffset, PairwiseOffsetter};
use crate::contour::Contour;
use crate::offset::{Offset, OffsetLoop};
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::NONE;
use crate::tolerance::OFFSET_DROP;
use crate::tolerance::pairwise::{CLEARANCE, SHORTEST_RUN, STRAYED};
use std::iter::Chain;
use std::ops::Range;

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

/// The valid loops of raw curves, with those of the ranges, if any are given, that collapsed to vertices of theirs.
pub(super) fn loops(
    curves: &RawCurves,
    d: f64,
    source: &PairwiseOffsetter<'_>,
    ranges: Option<&[LocalRange]>,
) -> Result<PairwiseOffset, String> {
    let crossings = crossings(curves);
    let events = events(curves, &crossings);
    let [shortest, tolerance] = [SHORTEST_RUN, CLEARANCE].map(|share| share * source.size);
    let tolerance = tolerance + STRAYED * source.strayed;
    let judge = Judge { curves, crossings: &crossings, events: &events, d, source, shortest, tolerance };
    let runs = judge.runs();
    let drop = OFFSET_DROP * source.size;
    let whole = runs.whole.iter().map(|pieces| {
        let pieces = pieces.clone().map(|k| (*curves.segment(k), curves.elements[k as usize]));
        assemble(pieces, drop)
    });
    let mut loops: Vec<OffsetLoop> = whole.flatten().collect();
    judge.trace(&runs.valid, drop, &mut loops)?;
    let interferences = ranges.map_or_else(Vec::new, |ranges| judge.interferences(&runs, ranges));
    Ok(PairwiseOffset { offset: Offset { distance: d, loops, degenerate: Vec::new() }, interferences })
}

/// The events in order of travel, curve by curve.
fn events(curves: &RawCurves, crossings: &[Crossing]) -> Vec<Event> {
    let mut events = Vec::with_capacity(2 * crossings.len());
    for (k, c) in crossings.iter().enumerate() {
        for (piece, below) in [(c.below, true), (c.above, false)] {
            let along = curves.segment(piece).start().distance_squared(c.at);
            events.push(Event { piece, along, crossing: k as u32, below });
        }
    }
    events.sort_unstable_by(|a, b| a.piece.cmp(&b.piece).then(a.along.total_cmp(&b.along)));
    events
}

struct Judge<'a> {
    curves: &'a RawCurves,
    crossings: &'a [Crossing],
    events: &'a [Event],
    d: f64,
    source: &'a PairwiseOffsetter<'a>,
    /// Runs no longer are not asked about, mm.
    shortest: f64,
    /// By how much less than the distance the clearance of an offset may be, mm.
    tolerance: f64,
}

/// What of the raw curves is valid.
struct Runs {
    /// Curves that cross nothing, as ranges of pieces.
    whole: Vec<Range<u32>>,
    /// For each event whether the run after it is.
    valid: Vec<bool>,
}

impl Judge<'_> {
    fn runs(&self) -> Runs {
        let (mut whole, mut verdicts) = (Vec::new(), Vec::with_capacity(self.events.len()));
        // For each crossing the event before that of the curve which goes below.
        let mut before = vec![0; self.crossings.len()];
        for curve in self.curves.curves() {
            let of_curve = self.events_of(&curve);
            if of_curve.is_empty() && self.is_whole(&curve) {
                whole.push(curve);
            }
            for k in of_curve.clone() {
                let next = if k + 1 == of_curve.end { of_curve.start } else { k + 1 };
                verdicts.push(self.verdict(k, next));
                if self.events[k].below {
                    let last = if k == of_curve.start { of_curve.end } else { k } - 1;
                    before[self.events[k].crossing as usize] = last;
                }
            }
        }
        Runs { whole, valid: self.settle(&verdicts, &before) }
    }

    /// The events on a curve.
    fn events_of(&self, curve: &Range<u32>) -> Range<usize> {
        let first = |piece| self.events.partition_point(|e| e.piece < piece);
        first(curve.start)..first(curve.end)
    }

    /// What the boundary says of the run between two successive events of a curve; `None` where that is too short to ask.
    fn verdict(&self, from: usize, to: usize) -> Option<bool> {
        if self.pieces_between(from, to).any(|k| self.curves.is_bridge(k)) {
            return Some(false);
        }
        let length = |s: &Segment| s.start().distance_squared(s.end());
        let longest = self.run(from, to).map(|r| r.0).max_by(|a, b| length(a).total_cmp(&length(b)))?;
        if length(&longest) <= self.shortest * self.shortest { None } else { self.is_valid(longest.at(0.5)) }
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

    /// Whether a point of a raw curve is clear of the boundary; `None` where that is too close to tell. One that is clear lies
    /// inside: there is no wall between it and its foot.
    fn is_valid(&self, p: Point) -> Option<bool> {
        match self.source.walls.distance_below(p, self.d - 0.5 * self.tolerance) {
            None => Some(true),
            Some(clearance) if clearance < self.d - self.tolerance => Some(false),
            Some(_) => None,
        }
    }

    /// Whether a curve that crosses nothing is valid: all of it is, or nothing.
    fn is_whole(&self, curve: &Range<u32>) -> bool {
        let bridged = curve.clone().any(|k| self.curves.is_bridge(k));
        let longest = self.curves.longest(curve.clone());
        !bridged && longest.is_some_and(|s| self.is_valid(s.at(0.5)) == Some(true))
    }

    /// The pieces of the run between two successive events of a curve.
    fn pieces_between(&self, from: usize, to: usize) -> Chain<Range<u32>, Range<u32>> {
        let (first, last) = (self.events[from].piece, self.events[to].piece);
        let after = last + 1;
        if first < last || (first == last && from < to) {
            return (first..after).chain(0..0);
        }
        let curve = self.curves.curve_of(first);
        (first..curve.end).chain(curve.start..after)
    }

    /// The same, cut at the events, with their elements.
    fn run(&self, from: usize, to: usize) -> impl Iterator<Item = (Segment, u32)> + '_ {
        let [p, q] = [from, to].map(|e| self.crossings[self.events[e].crossing as usize].at);
        let pieces = self.pieces_between(from, to);
        let count = pieces.clone().count();
        pieces.enumerate().map(move |(i, k)| {
            let (cut_start, cut_end) = (Some(p).filter(|_| i == 0), Some(q).filter(|_| i + 1 == count));
            (self.curves.segment(k).part(cut_start, cut_end), self.curves.elements[k as usize])
        })
    }

    /// The event after another on its curve.
    fn next(&self, event: usize) -> usize {
        let curve = self.curves.curve_of(self.events[event].piece);
        match self.events.get(event + 1) {
            Some(e) if e.piece < curve.end => event + 1,
            _ => self.events_of(&curve).start,
        }
    }

    /// Step 5: valid runs joined to loops.
    fn trace(&self, valid: &[bool], drop: f64, loops: &mut Vec<OffsetLoop>) -> Result<(), String> {
        let mut up = vec![usize::MAX; self.crossings.len()];
        for (k, e) in self.events.iter().enumerate().filter(|(_, e)| !e.below) {
            up[e.crossing as usize] = k;
        }
        let mut visited = vec![false; self.events.len()];
        let mut runs = Vec::new();
        for start in 0..self.events.len() {
            if !valid[start] || visited[start] {
                continue;
            }
            let mut at = start;
            runs.clear();
            while !std::mem::replace(&mut visited[at], true) {
                let end = self.next(at);
                runs.push((at, end));
                let turn = up[self.events[end].crossing as usize];
                if !self.events[end].below || !valid[turn] {
                    return Err("a valid run leads nowhere".to_owned());
                }
                at = turn;
            }
            if at != start {
                return Err("a loop does not come back".to_owned());
            }
            loops.extend(assemble(runs.iter().flat_map(|&(a, b)| self.run(a, b)), drop));
        }
        Ok(())
    }

    /// The ranges that collapsed to vertices of valid runs.
    fn interferences(&self, runs: &Runs, ranges: &[LocalRange]) -> Vec<Interference> {
        let elements = &self.source.elements;
        let interference = |local: bool, degenerate: Point, between: [u32; 2]| {
            let [from, to] = between.map(|e| elements[e as usize].foot(degenerate));
            Interference { local, degenerate, from, to, elements: between }
        };
        let local = ranges.iter().filter(|r| self.is_valid_after(runs, r.piece));
        let local = local.map(|r| interference(true, self.curves.segment(r.piece).end(), r.elements));
        let valid = self.events.iter().zip(&runs.valid).filter(|&(e, &valid)| !e.below && valid);
        let global = valid.map(|(e, _)| {
            let c = &self.crossings[e.crossing as usize];
            interference(false, c.at, [c.below, c.above].map(|k| self.curves.elements[k as usize]))
        });
        local.chain(global).collect()
    }

    /// Whether the end of a piece is on a valid run.
    fn is_valid_after(&self, runs: &Runs, piece: u32) -> bool {
        let after = self.events.partition_point(|e| e.piece <= piece);
        let curve = || self.curves.curve_of(piece);
        if let Some(last) = after.checked_sub(1).filter(|&k| self.events[k].piece >= curve().start) {
            return runs.valid[last];
        }
        let of_curve = self.events_of(&curve());
        if of_curve.is_empty() {
            runs.whole.binary_search_by(|w| w.start.cmp(&curve().start)).is_ok()
        } else {
            runs.valid[of_curve.end - 1]
        }
    }
}

/// A loop of pieces with their elements; those shorter than `drop` go. None without extent.
fn assemble(pieces: impl Iterator<Item = (Segment, u32)>, drop: f64) -> Option<OffsetLoop> {
    let room = pieces.size_hint().0;
    let (mut segments, mut sites): (Vec<Segment>, Vec<u32>) = (Vec::with_capacity(room), Vec::with_capacity(room));
    for (segment, element) in pieces {
        let begun = segments.last().map_or(segment.start(), Segment::end);
        if segment.end().distance_squared(begun) > drop * drop {
            segments.push(with_start(segment, begun));
            sites.push(element);
        }
    }
    let end = segments.last()?.end();
    segments[0] = with_start(segments[0], end);
    (segments.len() > 1).then(|| OffsetLoop {
        crossings: vec![NONE; segments.len()],
        sites,
        contour: Contour::new(segments),
    })
}

fn with_start(s: Segment, start: Point) -> Segment {
    match s {
        Segment::Line(l) => Segment::line(start, l.end),
        Segment::Arc(a) => Segment::Arc(crate::segment::Arc { start, ..a }),
    }
}
