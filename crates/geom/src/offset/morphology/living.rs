//! What of the pieces may bound the erosion, and where it crosses.
//!
//! A piece whose profile reaches into a wall by more than half its length is buried as a whole. Where edges of the profile are far longer than
//! those of the walls, pieces that slide along them are hardly ever, and cross one another by the million. So as long as there are far more
//! crossings than pieces, long pieces are halved, and halves that are buried go: what is left soon follows the erosion, and
//! the time stays about linear in the number of pieces.

use super::collision::Collider;
use super::crossings::{crossings, fraction};
use super::pieces::Piece;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::NONE;
use crate::tolerance::profile::DECIDED;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// More close pairs than this per piece are a crowd.
const CROWD: usize = 12;

/// How often long pieces are halved at most.
const HALVINGS: usize = 12;

/// A crossing as one of its pieces meets it.
#[derive(Clone, Copy)]
pub(super) struct Event {
    pub(super) piece: u32,
    pub(super) along: f64,
    pub(super) crossing: u32,
    pub(super) below: bool,
    pub(super) at: Point,
}

/// Pieces that are not buried.
pub(super) struct Living {
    pub(super) pieces: Vec<Piece>,
}

impl Living {
    pub(super) fn new(pieces: &[Piece], collider: &Collider) -> Self {
        let alive: Vec<bool> = pieces.iter().map(|p| !is_buried(&p.segment, collider)).collect();
        Self { pieces: kept(pieces, &alive) }
    }

    /// Their crossings, in order along each piece. Pieces are halved until they are no crowd.
    pub(super) fn uncrowded(&mut self, collider: &Collider) -> Vec<Event> {
        for _ in 0..HALVINGS {
            if let Some(events) = self.events(CROWD * self.pieces.len()) {
                return events;
            }
            self.halve(collider);
        }
        self.events(usize::MAX).unwrap_or_default()
    }

    /// The crossings of pieces that do not follow one another; none of more than `most` close pairs.
    fn events(&self, most: usize) -> Option<Vec<Event>> {
        let pieces = &self.pieces;
        let segments: Vec<Segment> = pieces.iter().map(|p| p.segment).collect();
        let mut events = Vec::new();
        let (mut count, mut pairs) = (0, 0);
        let crowd = SegmentIndex::new(&segments).visit_pairs(0.0, |i, j| {
            pairs += 1;
            let (a, b) = (i as u32, j as u32);
            if pieces[i].next != b && pieces[j].next != a {
                crossings(&segments[i], &segments[j], |at, left| {
                    for (piece, segment, below) in [(a, &segments[i], left), (b, &segments[j], !left)] {
                        events.push(Event { piece, along: fraction(segment, at), crossing: count, below, at });
                    }
                    count += 1;
                });
            }
            if pairs > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if crowd.is_break() {
            return None;
        }
        events.sort_unstable_by(|a, b| a.piece.cmp(&b.piece).then(a.along.total_cmp(&b.along)));
        Some(events)
    }

    /// Halves pieces that are longer than others and drops what is buried.
    fn halve(&mut self, collider: &Collider) {
        let mean = self.pieces.iter().map(|p| p.segment.length()).sum::<f64>() / self.pieces.len() as f64;
        let is_long = |p: &Piece| p.segment.length() > mean;
        // Where each piece begins among the halves.
        let mut first = Vec::with_capacity(self.pieces.len());
        let mut count = 0;
        for p in &self.pieces {
            first.push(count);
            count += if is_long(p) { 2 } else { 1 };
        }
        let (mut halves, mut alive) = (Vec::with_capacity(count as usize), Vec::with_capacity(count as usize));
        for p in &self.pieces {
            let next = if p.next == NONE { NONE } else { first[p.next as usize] };
            if is_long(p) {
                let (before, after) = p.segment.split_at(p.segment.at(0.5));
                halves
                    .extend([Piece { segment: before, next: halves.len() as u32 + 1 }, Piece { segment: after, next }]);
                alive.extend([before, after].map(|s| !is_buried(&s, collider)));
            } else {
                halves.push(Piece { segment: p.segment, next });
                alive.push(true);
            }
        }
        self.pieces = kept(&halves, &alive);
    }
}

/// Pieces that are alive, with their new numbers.
fn kept(pieces: &[Piece], alive: &[bool]) -> Vec<Piece> {
    let mut names = vec![NONE; pieces.len()];
    for (name, (k, _)) in (0..).zip(alive.iter().enumerate().filter(|(_, a)| **a)) {
        names[k] = name;
    }
    let living = pieces.iter().zip(alive).filter(|(_, a)| **a).map(|(p, _)| p);
    living
        .map(|p| Piece { segment: p.segment, next: if p.next == NONE { NONE } else { names[p.next as usize] } })
        .collect()
}

/// Whether the profile is so deep in a wall that no point of the piece is free.
fn is_buried(s: &Segment, collider: &Collider) -> bool {
    let middle = s.at(0.5);
    let reach = match s {
        Segment::Arc(a) if a.sweep().abs() > PI => 2.0 * a.radius,
        _ => middle.distance(s.start()).max(middle.distance(s.end())),
    };
    collider.is_deeper(middle, reach * (1.0 + DECIDED))
}
