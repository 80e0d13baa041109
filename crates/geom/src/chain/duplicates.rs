//! Pieces that are drawn more than once, whole or in part.

use super::ChainNote;
use super::ends::{Grid, Places};
use crate::index::SegmentIndex;
use crate::segment::Segment;

/// Leaves out every piece whose ends and middle coincide with those of an earlier one.
pub(super) fn drop_repeated(
    pieces: &[Segment],
    usable: Vec<usize>,
    tolerance: f64,
    notes: &mut Vec<ChainNote>,
) -> Vec<usize> {
    let mut grid = Grid::new(tolerance, usable.len());
    let mut kept = Vec::with_capacity(usable.len());
    for k in usable {
        let middle = pieces[k].at(0.5);
        let twin = grid.near(middle).find(|&j| same(&pieces[j as usize], &pieces[k], tolerance));
        if let Some(j) = twin {
            notes.push(ChainNote::Duplicate { piece: k, kept: j as usize, at: pieces[k].start() });
        } else {
            grid.put(middle, k as u32);
            kept.push(k);
        }
    }
    kept
}

/// Whether two pieces agree in ends and middle. Short ones must agree far better: neighbours in a fine polyline lie
/// within the tolerance of each other without being the same.
fn same(a: &Segment, b: &Segment, tolerance: f64) -> bool {
    let tolerance = tolerance.min(a.length().min(b.length()) / 8.0);
    let near = |p: crate::Point, q: crate::Point| p.distance(q) <= tolerance;
    let ends = (near(a.start(), b.start()) && near(a.end(), b.end()))
        || (near(a.start(), b.end()) && near(a.end(), b.start()));
    ends && near(a.at(0.5), b.at(0.5))
}

/// Leaves out pieces that have a loose end or end at a branch, and lie wholly on one other, longer piece.
pub(super) fn drop_covered(
    pieces: &[Segment],
    kept: Vec<usize>,
    places: &mut Places,
    tolerance: f64,
    notes: &mut Vec<ChainNote>,
) -> Vec<usize> {
    let odd = |places: &Places, k: usize| [2 * k, 2 * k + 1].into_iter().any(|e| places.ends(places.of(e)).len() != 2);
    let suspects: Vec<usize> = kept.iter().copied().filter(|&k| odd(places, k)).collect();
    if suspects.is_empty() {
        return kept;
    }
    let segments: Vec<Segment> = kept.iter().map(|&k| pieces[k]).collect();
    let index = SegmentIndex::new(&segments);
    let mut dropped = std::collections::HashSet::new();
    for k in suspects {
        let piece = &pieces[k];
        let mut by = None;
        index.visit(piece.bbox(), tolerance, |other, longer| {
            let other = kept[other];
            let covers = || (0..=4).all(|j| longer.distance(piece.at(f64::from(j) / 4.0)) <= tolerance);
            if other != k && !dropped.contains(&other) && longer.length() > piece.length() + tolerance && covers() {
                by = Some(by.map_or(other, |b: usize| b.min(other)));
            }
        });
        if let Some(by) = by {
            notes.push(ChainNote::Covered { piece: k, by, at: piece.start() });
            dropped.insert(k);
            places.remove(k);
        }
    }
    kept.into_iter().filter(|k| !dropped.contains(k)).collect()
}
