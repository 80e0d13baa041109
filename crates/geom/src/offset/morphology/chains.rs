//! What of the trajectory bounds the erosion: parts of pieces between crossings, one after the other.
//!
//! At a crossing the piece from which the other turns left goes below: the erosion lies to the left of both. So the part before
//! the crossing on that piece is followed by the part after it on the other; the remaining two lead nowhere. Every part has one
//! successor at most and one predecessor at most, whatever the rounding: what comes back is a closed loop.

use super::collision::Collider;
use super::living::{Event, Living};
use super::pieces::Piece;
use crate::contour::Contour;
use crate::point::Point;
use crate::segment::{Arc, Segment};
use crate::skeleton::NONE;
use crate::tolerance::profile::{DECIDED, LEAST_LENGTH};
use std::f64::consts::PI;

/// Parts of a loop that are asked about collisions.
const WITNESSES: usize = 8;

/// The loops that bound the erosion, or a place where the pieces contradict the collisions. `unit` is the length that all
/// tolerances are multiples of, mm.
pub(super) fn loops(pieces: &[Piece], collider: &Collider, unit: f64) -> Result<Vec<Contour>, Point> {
    let mut living = Living::new(pieces, collider);
    let events = living.uncrowded(collider);
    let parts = Parts::new(&living.pieces, events);
    let mut entered = vec![false; parts.next.len()];
    parts.next.iter().filter(|&&n| n != NONE).for_each(|&n| entered[n as usize] = true);
    let mut seen = vec![false; parts.next.len()];
    let open: Vec<u32> = (0..parts.next.len() as u32).filter(|&k| !entered[k as usize]).collect();
    for start in open {
        let chain = parts.chain(start, &mut seen);
        parts.contradicts(&chain, collider, unit)?;
    }
    let mut found = Vec::new();
    for start in 0..parts.next.len() as u32 {
        if !seen[start as usize] {
            let chain = parts.chain(start, &mut seen);
            if parts.is_clear(&chain, collider, unit)? {
                found.extend(assemble(chain.iter().map(|&k| parts.segment(k)), 16.0 * unit));
            }
        }
    }
    Ok(found)
}

/// The parts of all pieces: those of one piece in a row, between its events.
struct Parts<'a> {
    pieces: &'a [Piece],
    events: Vec<Event>,
    /// For each piece its first part and its first event; one more at the end.
    first: Vec<(u32, u32)>,
    owner: Vec<u32>,
    next: Vec<u32>,
}

impl<'a> Parts<'a> {
    fn new(pieces: &'a [Piece], events: Vec<Event>) -> Self {
        let (mut first, mut owner) = (vec![(0, 0)], Vec::new());
        let mut event = 0;
        for k in 0..pieces.len() as u32 {
            let before = event;
            while events.get(event).is_some_and(|e| e.piece == k) {
                event += 1;
            }
            owner.extend((before..=event).map(|_| k));
            first.push((owner.len() as u32, event as u32));
        }
        let mut after = vec![NONE; events.len()];
        for (k, e) in events.iter().enumerate().filter(|(_, e)| !e.below) {
            let (part, event) = first[e.piece as usize];
            after[e.crossing as usize] = part + (k as u32 - event) + 1;
        }
        let mut next = Vec::with_capacity(owner.len());
        for (k, piece) in pieces.iter().enumerate() {
            let own = &events[first[k].1 as usize..first[k + 1].1 as usize];
            next.extend(own.iter().map(|e| if e.below { after[e.crossing as usize] } else { NONE }));
            next.push(if piece.next == NONE { NONE } else { first[piece.next as usize].0 });
        }
        Self { pieces, events, first, owner, next }
    }

    fn segment(&self, part: u32) -> Segment {
        let piece = self.owner[part as usize] as usize;
        let (first, event) = self.first[piece];
        let place = (part - first + event) as usize;
        let s = self.pieces[piece].segment;
        let start = if part == first { s.start() } else { self.events[place - 1].at };
        let last = part + 1 == self.first[piece + 1].0;
        between(s, start, if last { s.end() } else { self.events[place].at })
    }

    /// The parts from one on, until there is none or the first comes again.
    fn chain(&self, start: u32, seen: &mut [bool]) -> Vec<u32> {
        let (mut chain, mut at) = (Vec::new(), start);
        while at != NONE && !std::mem::replace(&mut seen[at as usize], true) {
            chain.push(at);
            at = self.next[at as usize];
        }
        chain
    }

    /// An open chain that is free somewhere is a contradiction.
    fn contradicts(&self, chain: &[u32], collider: &Collider, unit: f64) -> Result<(), Point> {
        free_place(&self.longest(chain), collider, unit).map_or(Ok(()), Err)
    }

    /// Whether a closed chain is free. One that is free here and buried there is a contradiction: a crossing was missed.
    fn is_clear(&self, chain: &[u32], collider: &Collider, unit: f64) -> Result<bool, Point> {
        let witnesses = self.longest(chain);
        let buried = witnesses.iter().filter(|s| collider.is_deeper(s.at(0.5), unit)).count();
        if buried == 0 || buried == witnesses.len() {
            return Ok(buried == 0);
        }
        free_place(&witnesses, collider, unit).map_or(Ok(false), Err)
    }

    /// The longest parts of a chain: those whose middles are asked about collisions.
    fn longest(&self, chain: &[u32]) -> Vec<Segment> {
        let mut segments: Vec<Segment> = chain.iter().map(|&k| self.segment(k)).collect();
        segments.sort_by(|a, b| b.length().total_cmp(&a.length()));
        segments.truncate(WITNESSES);
        segments
    }
}

/// A middle that is free beyond doubt, of a segment that is not too short to tell: pieces that touch along bends of a radius `r` part by a
/// decided depth only where they are longer than the root of eight times that depth and `r`. The profile's size stands for radii
/// that are not the segment's own.
fn free_place(witnesses: &[Segment], collider: &Collider, unit: f64) -> Option<Point> {
    let depth = DECIDED * unit;
    let least = |s: &Segment| {
        let radius = if let Segment::Arc(a) = s { a.radius } else { 0.0 };
        LEAST_LENGTH * unit + (unit * collider.size()).max(8.0 * depth * radius).sqrt()
    };
    let long = witnesses.iter().filter(|s| s.length() > least(s));
    long.map(|s| s.at(0.5)).find(|&p| !collider.is_deeper(p, depth))
}

/// A part of a segment; its chord where rounding has put its ends in the wrong order.
fn between(s: Segment, start: Point, end: Point) -> Segment {
    match s {
        Segment::Arc(whole) if start != end => {
            let part = Arc { start, end, ..whole };
            if part.sweep().abs() < whole.sweep().abs() + PI { Segment::Arc(part) } else { Segment::line(start, end) }
        }
        _ => Segment::line(start, end),
    }
}

/// A loop without segments shorter than `drop`, its joints closed; arcs parted at the cut are one again. None without extent.
fn assemble(segments: impl Iterator<Item = Segment>, drop: f64) -> Option<Contour> {
    let mut kept: Vec<Segment> = Vec::new();
    for s in segments.filter(|s| s.length() > drop) {
        match kept.last_mut() {
            Some(Segment::Arc(a)) if matches!(s, Segment::Arc(b) if continues(a, &b)) => a.end = s.end(),
            Some(last) => {
                let start = last.end();
                kept.extend(from(&s, start));
            }
            None => kept.push(s),
        }
    }
    let end = kept.last()?.end();
    while let Some(first) = kept.first() {
        if let Some(closed) = from(first, end) {
            kept[0] = closed;
            break;
        }
        kept.remove(0);
    }
    let contour = Contour::new(kept);
    (contour.segments.len() > 1 && contour.bbox().size() > drop).then_some(contour)
}

/// The rest of a segment from a point near its start on; none where that lies beyond its end: after a bend passed over, the next
/// pieces begin a trifle further back.
fn from(s: &Segment, start: Point) -> Option<Segment> {
    let end = s.end();
    let rest = between(*s, start, end);
    let is_ahead = matches!(rest, Segment::Arc(_)) || (end - start).dot(end - s.start()) > 0.0;
    is_ahead.then_some(rest)
}

fn continues(a: &Arc, b: &Arc) -> bool {
    a.center == b.center && a.radius == b.radius && a.ccw == b.ccw && a.sweep().abs() + b.sweep().abs() < PI
}
