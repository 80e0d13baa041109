//! Loose lines and arcs, in any order and direction, put together to closed contours.
//!
//! Ends within the join tolerance are one place; pieces drawn twice are used once; what can't be closed is told. Ends and
//! middles are looked up in a grid, so that the work is linear in the number of pieces.

mod duplicates;
mod ends;

use crate::contour::Contour;
use crate::point::Point;
use crate::segment::Segment;
use ends::Places;
use std::fmt;

/// What became of the pieces; they are known by their places in the input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chains {
    /// Closed contours, and for each of their segments the piece that it was made of.
    pub closed: Vec<(Contour, Vec<usize>)>,
    /// Chains that don't close.
    pub open: Vec<OpenChain>,
    /// Places where three, five, ... ends meet; the pieces there are not followed beyond them.
    pub branches: Vec<Branch>,
    /// What was changed.
    pub notes: Vec<ChainNote>,
}

/// A chain that doesn't close.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenChain {
    /// Its pieces in order.
    pub pieces: Vec<usize>,
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// How far these two lie apart, mm.
    pub gap: f64,
}

/// A place where an odd number of ends, three or more, meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Where it is.
    pub at: Point,
    /// The pieces that end there.
    pub pieces: Vec<usize>,
}

/// Something that was changed on the way.
#[derive(Clone, Debug, PartialEq)]
pub enum ChainNote {
    /// A piece without length was dropped.
    ZeroLength {
        /// The piece.
        piece: usize,
        /// Where.
        at: Point,
    },
    /// A piece that another one repeats was dropped.
    Duplicate {
        /// The piece that was dropped.
        piece: usize,
        /// The one that was kept.
        kept: usize,
        /// Where it begins.
        at: Point,
    },
    /// A piece that lies on another one, and leads nowhere else, was dropped.
    Covered {
        /// The piece that was dropped.
        piece: usize,
        /// The one that it lies on.
        by: usize,
        /// Where it begins.
        at: Point,
    },
    /// Ends were moved to meet.
    Joined {
        /// How many gaps were closed.
        count: usize,
        /// The widest of them, mm.
        widest: f64,
        /// Where that is.
        at: Point,
        /// One of the pieces there.
        piece: usize,
    },
}

impl fmt::Display for ChainNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = |p: &Point| format!("({:.4}, {:.4})", p.x, p.y);
        match self {
            Self::ZeroLength { at, .. } => write!(f, "a piece without length at {} was dropped", place(at)),
            Self::Duplicate { at, .. } => write!(f, "a piece drawn twice at {} is used once", place(at)),
            Self::Covered { at, .. } => write!(f, "a piece at {} lies on another one: dropped", place(at)),
            Self::Joined { count, widest, at, .. } => {
                write!(f, "{count} gap(s) closed by moving ends, the widest one of {widest:.3e} mm at {}", place(at))
            }
        }
    }
}

/// Puts pieces together to closed contours; ends up to `join_tolerance` apart are joined.
///
/// Full circles (arcs with equal ends) are contours by themselves. Where ends move, an arc keeps its bulge.
pub fn chain(pieces: &[Segment], join_tolerance: f64) -> Chains {
    let mut chains = Chains::default();
    let (usable, circles) = sort_out(pieces, &mut chains);
    for k in circles {
        chains.closed.push((Contour::new(vec![pieces[k]]), vec![k]));
    }
    let kept = duplicates::drop_repeated(pieces, usable, join_tolerance, &mut chains.notes);
    let mut places = Places::new(pieces, &kept, join_tolerance);
    let kept = duplicates::drop_covered(pieces, kept, &mut places, join_tolerance, &mut chains.notes);
    follow(pieces, &kept, &places, &mut chains);
    chains.notes.extend(places.joined(pieces, &kept));
    chains
}

/// Pieces to be chained and full circles; pieces without length are dropped.
fn sort_out(pieces: &[Segment], chains: &mut Chains) -> (Vec<usize>, Vec<usize>) {
    let mut usable = Vec::with_capacity(pieces.len());
    let mut circles = Vec::new();
    for (k, s) in pieces.iter().enumerate() {
        if !s.is_finite() || s.length() == 0.0 {
            chains.notes.push(ChainNote::ZeroLength { piece: k, at: s.start() });
        } else if s.start() == s.end() {
            circles.push(k);
        } else {
            usable.push(k);
        }
    }
    (usable, circles)
}

/// Walks from end to end: first the chains that start where an odd number of ends meet, then the closed ones.
fn follow(pieces: &[Segment], kept: &[usize], places: &Places, chains: &mut Chains) {
    let mut used = vec![false; pieces.len()];
    for place in (0..places.len()).filter(|&p| places.ends(p).len() % 2 == 1) {
        let ends = places.ends(place);
        if ends.len() > 2 {
            let mut there: Vec<usize> = ends.iter().map(|&e| e / 2).collect();
            there.dedup();
            chains.branches.push(Branch { at: places.point(place), pieces: there });
        }
        for &end in ends {
            if !used[end / 2] {
                walk(pieces, places, &mut used, end, chains);
            }
        }
    }
    for &k in kept {
        if !used[k] {
            walk(pieces, places, &mut used, 2 * k, chains);
        }
    }
}

/// Walks from an end (`2k` the start of piece `k`, `2k + 1` its end) as long as the number of ends that meet is even.
/// Where four or more do, contours touch: which ends are taken together there makes no difference to the even-odd fill.
fn walk(pieces: &[Segment], places: &Places, used: &mut [bool], from: usize, chains: &mut Chains) {
    let (mut segments, mut walked) = (Vec::new(), Vec::new());
    let mut end = from;
    while !std::mem::replace(&mut used[end / 2], true) {
        let piece = pieces[end / 2];
        let forward = if end.is_multiple_of(2) { piece } else { piece.reversed() };
        let (start, far) = (places.point(places.of(end)), places.point(places.of(end ^ 1)));
        segments.push(moved(forward, start, far));
        walked.push(end / 2);
        let there = places.ends(places.of(end ^ 1));
        let own = there.iter().position(|&e| e == end ^ 1);
        match own.and_then(|k| there.get(k ^ 1)) {
            Some(&other) if there.len().is_multiple_of(2) => end = other,
            _ => break,
        }
    }
    keep(chains, segments, walked);
}

fn keep(chains: &mut Chains, segments: Vec<Segment>, pieces: Vec<usize>) {
    let (Some(first), Some(last)) = (segments.first(), segments.last()) else { return };
    let (start, end) = (first.start(), last.end());
    if start == end {
        chains.closed.push((Contour::new(segments), pieces));
    } else {
        chains.open.push(OpenChain { pieces, start, end, gap: start.distance(end) });
    }
}

/// The segment with its ends moved; an arc gets the circle through them that keeps its bulge.
fn moved(segment: Segment, start: Point, end: Point) -> Segment {
    if segment.start() == start && segment.end() == end {
        return segment;
    }
    Segment::from_bulge(start, end, segment.bulge())
}

#[cfg(test)]
mod tests;
