//! Interfering ranges of the pair-wise engine as pieces for clean-up: section 3 of the paper.
//!
//! Let loops lie at `d` and `d + w`, and the *outer tool envelope*, the offset at `d + r`, between them.
//!
//! 1. The *clean-up curve* of an interfering range is the part of the envelope that the inner loops do not follow (`curves`).
//! 2. A curve that comes back to the degenerate vertex it starts from, nowhere farther from it than `r`, leaves nothing:
//!    what it encloses lies within `r`, too.
//! 3. From places along the others fibres lead away from the walls to the skeleton (`fibres`), so densely that it is
//!    nowhere farther from the ways between their ends than what the reach of places allows for. Each
//!    stretch of the skeleton is met from two sides; one of them counts.
//! 4. Curves, and the two sides of a neck, are joined where their ends come close (`links`).
//! 5. What the paths made from these pieces leave is found and cut (`cover`).

#[cfg(test)]
mod tests;

use super::cover::Ground;
use super::curves::{CleanupCurve, Stretch, cleanup_curves};
use super::fibres::{Fibre, Fibres};
use super::links::{Builder, Curve};
use super::{SHIFT, offset_near};
use crate::plan::cleanup::{Piece, trusted};
use crate::plan::levels::Levels;
use pocketry_geom::offset::{Offset, OffsetError, PairwiseOffsetter, degenerate_slack};
use pocketry_geom::tolerance::OFFSET_DROP;
use pocketry_geom::{Point, Segment};
use std::collections::HashMap;

/// How far apart places may lie, as a share of the tool's radius.
const SPACING: f64 = 0.5;

/// Share of what reaches leave of the radius that the ways may stray from the skeleton.
const STRAY_SHARE: f64 = 0.0625;

/// So many times that is added to reaches: ways stray, places are merged, and clearance is not linear between them.
const SHARED: f64 = 4.0;

/// Most halvings of a stretch of the envelope.
const HALVINGS: u32 = 14;

/// The interfering ranges between and inside all loops.
#[derive(Default)]
pub(super) struct Ranges {
    /// Each with the level of the loops around it.
    pub(super) pieces: Vec<(usize, Piece)>,
    /// The ground they answer for.
    pub(super) grounds: Vec<Ground>,
}

/// The ranges that may leave something.
pub(super) fn ranges(
    offsetter: &PairwiseOffsetter<'_>,
    offsets: &[Offset],
    levels: &Levels,
    stepover: f64,
    radius: f64,
) -> Result<Ranges, OffsetError> {
    let radius = trusted(radius);
    let nothing = Offset::default();
    let negligible = OFFSET_DROP * offsetter.size();
    let mut ranges = Ranges::default();
    for (level, outer) in offsets.iter().enumerate() {
        let inner = offsets.get(level + 1).unwrap_or(&nothing);
        let base = outer.distance;
        let high = offsets.get(level + 1).map_or(base + stepover, |inner| inner.distance);
        let envelope = offset_near(offsetter, base + radius, -SHIFT * degenerate_slack(radius))?;
        let low = envelope.distance;
        let mut curves = cleanup_curves(&envelope, inner, negligible);
        curves.retain(|c| !is_within_reach(c, radius));
        let range = Range {
            fibres: Fibres::new(offsetter, low, high),
            radius,
            stray: 0.5 * degenerate_slack(radius) + STRAY_SHARE * (2.0 * radius - stepover).max(0.0),
        };
        // What ways, places and reaches may be off, each.
        let mut builder = Builder::new(low, SHARED * range.stray, radius);
        for curve in &curves {
            builder.add(&range.curve(curve), high);
        }
        ranges.pieces.extend(builder.pieces(base, &starts(levels, level + 1, &curves)).into_iter().map(|p| (level, p)));
        ranges.grounds.push(Ground { level, base, low, high, curves });
    }
    Ok(ranges)
}

/// Which segments of a level's tracks start at the degenerate vertices of some curves: track and segment.
fn starts(levels: &Levels, level: usize, curves: &[CleanupCurve]) -> HashMap<(u64, u64), (u32, u32)> {
    let mut wanted: Vec<(u64, u64)> = curves.iter().filter_map(|c| c.roots).flatten().map(bits).collect();
    wanted.sort_unstable();
    let tracks = (0..).zip(&levels.tracks).filter(|(_, t)| t.level == level);
    let segments =
        tracks.flat_map(|(t, track)| (0..).zip(&track.segments).map(move |(k, s)| (bits(s.start()), (t, k))));
    segments.filter(|(at, _)| wanted.binary_search(at).is_ok()).collect()
}

pub(super) fn bits(p: Point) -> (u64, u64) {
    (p.x.to_bits(), p.y.to_bits())
}

/// Whether a clean-up curve starts from and comes back to one degenerate vertex, nowhere farther from it than the tool's radius.
fn is_within_reach(curve: &CleanupCurve, radius: f64) -> bool {
    let Some([degenerate, _]) = curve.roots.filter(|[a, b]| a == b) else { return false };
    let within = |p: Point| p.distance(degenerate) <= radius;
    let farthest = |s: &Segment| match s {
        Segment::Arc(a) if a.spans(a.center - degenerate) => {
            within(a.center + (a.center - degenerate).normalized() * a.radius)
        }
        _ => true,
    };
    let mut segments = curve.stretches.iter().map(|s| &s.segment);
    segments.all(|s| within(s.start()) && within(s.end()) && farthest(s))
}

/// What lies between two distances.
struct Range<'a> {
    fibres: Fibres<'a>,
    radius: f64,
    /// How far ways may lie from the skeleton.
    stray: f64,
}

impl Range<'_> {
    /// Fibres along a clean-up curve.
    fn curve(&self, curve: &CleanupCurve) -> Curve {
        let mut fibres: Vec<Fibre> = Vec::new();
        for s in &curve.stretches {
            let from = self.fibres.through(s.segment.start(), s.site, fibres.last());
            let to = self.fibres.through(s.segment.end(), s.site, Some(&from));
            fibres.push(from);
            self.refine(s, from, to, HALVINGS, &mut fibres);
        }
        Curve { fibres, roots: curve.roots }
    }

    /// Adds fibres after `from` up to `to`. Halves of a stretch are refined until no way through them is wider than ways
    /// may stray: about chords of circles, which touch the same disks, rounding may move ends along the fibres for ever.
    fn refine(&self, s: &Stretch, from: Fibre, to: Fibre, halvings: u32, fibres: &mut Vec<Fibre>) {
        let apart = from.end.distance(to.end);
        let is_narrow = halvings == 0 || s.segment.length() <= self.stray;
        // Both ends of a short stretch may be corners, and what is between far away from them.
        if halvings == HALVINGS || (apart > self.stray && !is_narrow) {
            let middle = self.fibres.through(s.segment.at(0.5), s.site, Some(&from));
            let off = Segment::line(from.end, to.end).distance(middle.end);
            if apart > SPACING * self.radius || off > self.stray || from.first != to.first {
                let (before, after) = s.segment.split_at(s.segment.at(0.5));
                self.refine(&Stretch { segment: before, ..*s }, from, middle, halvings - 1, fibres);
                self.refine(&Stretch { segment: after, ..*s }, middle, to, halvings - 1, fibres);
                return;
            }
        }
        fibres.push(to);
    }
}
