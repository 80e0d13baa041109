//! On which side of each piece the interior lies.
//!
//! Around a vertex interior and exterior alternate, so one side decides a whole connected component. The one that decides
//! lies to the left of the component's leftmost point: it is that of the first piece further left, or exterior.

use super::arrangement::Piece;
use super::fans::{Dart, Fans};
use super::report::RegionError;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::ray::leftmost;
use crate::segment::Segment;
use crate::tolerance::TANGENT;

/// For each piece whether the interior lies to its left.
pub(super) fn interior_left(pieces: &[Piece], fans: &Fans, index: &SegmentIndex) -> Result<Vec<bool>, RegionError> {
    let (component, seeds) = components(pieces, fans);
    let mut left: Vec<Option<bool>> = vec![None; pieces.len()];
    for (at, seed) in seeds {
        let own = component[seed];
        let inside = index.first_left(at, |k, _| component[k] != own).is_some_and(|(k, hit)| {
            let left_is_inside = left[k].unwrap_or(false);
            if hit.upward { !left_is_inside } else { left_is_inside }
        });
        spread(pieces, fans, first_side(pieces, fans, at, seed, inside), &mut left)?;
    }
    Ok(left.into_iter().map(|l| l.unwrap_or(false)).collect())
}

/// The component of each piece, and a leftmost point and the piece that it lies on for each, from left to right.
fn components(pieces: &[Piece], fans: &Fans) -> (Vec<u32>, Vec<(Point, usize)>) {
    let mut component = vec![u32::MAX; pieces.len()];
    let mut seeds = Vec::new();
    for first in 0..pieces.len() {
        if component[first] != u32::MAX {
            continue;
        }
        let name = seeds.len() as u32;
        component[first] = name;
        let mut best = (leftmost(&pieces[first].segment), first);
        let mut stack = vec![first];
        while let Some(k) = stack.pop() {
            let p = leftmost(&pieces[k].segment);
            if p.x < best.0.x {
                best = (p, k);
            }
            for &dart in fans.at(pieces[k].from).iter().chain(fans.at(pieces[k].to)) {
                let other = dart as usize / 2;
                if component[other] == u32::MAX {
                    component[other] = name;
                    stack.push(other);
                }
            }
        }
        seeds.push(best);
    }
    seeds.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.cmp(&b.1)));
    (component, seeds)
}

/// A dart of the component and the side to its left, given the side to the left of the leftmost point `at` on `piece`.
fn first_side(pieces: &[Piece], fans: &Fans, at: Point, piece: usize, inside: bool) -> (Dart, bool) {
    let Piece { segment, from, to, .. } = pieces[piece];
    // Where an arc's leftmost point all but coincides with its end, the order around that vertex decides better.
    let near = if let Segment::Arc(a) = segment { TANGENT * a.radius } else { 0.0 };
    // Of a short arc of a large circle both ends may be near.
    let (to_start, to_end) = (at.distance(segment.start()), at.distance(segment.end()));
    if to_start.min(to_end) > near {
        // The leftmost point of an arc's inside: a counter-clockwise arc runs downwards there.
        let ccw = matches!(segment, Segment::Arc(a) if a.ccw);
        return (2 * piece as u32, inside != ccw);
    }
    let vertex = if to_start <= to_end { from } else { to };
    (fans.last(pieces, vertex), inside)
}

/// Carries a side through the whole component.
fn spread(pieces: &[Piece], fans: &Fans, seed: (Dart, bool), left: &mut [Option<bool>]) -> Result<(), RegionError> {
    let set = |left: &mut [Option<bool>], dart: Dart, side: bool| {
        let side = side ^ (dart & 1 == 1);
        let known = left[dart as usize / 2].replace(side);
        (known.is_none(), known.is_none_or(|k| k == side))
    };
    set(left, seed.0, seed.1);
    let mut stack = vec![seed.0 / 2];
    while let Some(k) = stack.pop() {
        let piece = &pieces[k as usize];
        for (dart, vertex) in [(2 * k, piece.from), (2 * k + 1, piece.to)] {
            let side = left[k as usize] == Some(dart & 1 == 0);
            let fan = fans.at(vertex);
            let own = fans.place(dart, vertex);
            for (place, &other) in fan.iter().enumerate().filter(|&(p, _)| p != own) {
                let (new, agrees) = set(left, other, side ^ ((place + own) & 1 == 1));
                if !agrees {
                    let second = pieces[other as usize / 2].contour;
                    let at = if dart & 1 == 0 { piece.segment.start() } else { piece.segment.end() };
                    return Err(RegionError::Crossing { first: piece.contour, second, at });
                }
                if new {
                    stack.push(other / 2);
                }
            }
        }
    }
    Ok(())
}
