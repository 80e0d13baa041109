//! Interfering ranges of the pair-wise engine as pieces for clean-up: section 3 of the paper.
//!
//! Let loops lie at `d` and `d + w`, and the *outer tool envelope*, the offset at `d + r`, between them.
//!
//! 1. The *clean-up curve* of an interfering range is the part of the envelope between the places that belong to the range's
//!    two ends. A loop of the envelope where no range ends is one as a whole, unless the fibre from one
//!    of its places leads up to `d + w`.
//! 2. A curve that comes back to the degenerate vertex it starts from, nowhere farther from it than `r`, leaves nothing:
//!    what it encloses lies within `r`, too.
//! 3. From places along the others fibres lead away from the walls to the skeleton (`fibres`), so densely that it is
//!    nowhere farther from the ways between their ends than what the reach of places allows for. Each
//!    stretch of the skeleton is met from two sides; one of them counts.
//! 4. Curves, and the two sides of a neck, are joined where their ends come close (`links`).

use super::fibres::{Fibre, Fibres};
use super::links::{Builder, Curve};
use crate::plan::cleanup::{Piece, trusted};
use crate::plan::levels::Levels;
use pocketry_geom::offset::{OffsetError, PairwiseOffset, PairwiseOffsetter, degenerate_slack};
use pocketry_geom::skeleton::SiteId;
use pocketry_geom::{Point, Segment};
use std::collections::HashMap;

/// How far apart places may lie, as a share of the tool's radius.
const SPACING: f64 = 0.5;

/// Share of what reaches leave of the radius that the ways may stray from the skeleton.
const STRAY_SHARE: f64 = 0.0625;

/// So many times that is added to reaches: ways stray, places are merged, and clearance is not linear between them.
const SHARED: f64 = 4.0;

/// Halvings of a stretch of the envelope.
const HALVINGS: u32 = 14;

/// The pieces between and inside the loops, each with the level of the loops around it.
pub(super) fn pieces(
    offsetter: &PairwiseOffsetter<'_>,
    offsets: &[PairwiseOffset],
    levels: &Levels,
    stepover: f64,
    radius: f64,
) -> Result<Vec<(usize, Piece)>, OffsetError> {
    let radius = trusted(radius);
    let nothing = PairwiseOffset::default();
    let mut pieces = Vec::new();
    for (level, outer) in offsets.iter().enumerate() {
        let inner = offsets.get(level + 1).unwrap_or(&nothing);
        let (base, high) = (outer.offset.distance, outer.offset.distance + stepover);
        let low = base + radius;
        let envelope = Envelope::new(&offsetter.offset(low)?);
        let starts = starts(levels, level + 1);
        let range = Range {
            fibres: Fibres::new(offsetter, low, high),
            inner,
            low,
            high,
            radius,
            stray: 0.5 * degenerate_slack(radius) + STRAY_SHARE * (2.0 * radius - stepover).max(0.0),
        };
        // What ways, places and reaches may be off, each.
        let builder = range.build(&envelope, SHARED * range.stray);
        pieces.extend(builder.pieces(base, &starts).into_iter().map(|p| (level, p)));
    }
    Ok(pieces)
}

/// Where the segments of a level's tracks start: track and segment.
fn starts(levels: &Levels, level: usize) -> HashMap<(u64, u64), (u32, u32)> {
    let tracks = (0..).zip(&levels.tracks).filter(|(_, t)| t.level == level);
    let segments =
        tracks.flat_map(|(t, track)| (0..).zip(&track.segments).map(move |(k, s)| (bits(s.start()), (t, k))));
    segments.collect()
}

pub(super) fn bits(p: Point) -> (u64, u64) {
    (p.x.to_bits(), p.y.to_bits())
}

/// The outer tool envelope, segment by segment.
struct Envelope {
    segments: Vec<Segment>,
    sites: Vec<SiteId>,
    /// For each loop its first segment; one more at the end.
    bounds: Vec<usize>,
    /// The segments of each site.
    of_site: Vec<(SiteId, u32)>,
}

impl Envelope {
    fn new(offset: &PairwiseOffset) -> Self {
        let (mut segments, mut sites, mut bounds) = (Vec::new(), Vec::new(), vec![0]);
        for l in &offset.offset.loops {
            segments.extend_from_slice(&l.contour.segments);
            sites.extend_from_slice(&l.sites);
            bounds.push(segments.len());
        }
        let mut of_site: Vec<(SiteId, u32)> = sites.iter().copied().zip(0..).collect();
        of_site.sort_unstable();
        Self { segments, sites, bounds, of_site }
    }

    /// The segment of a site, and the place on it, nearest to a point.
    fn locate(&self, site: SiteId, p: Point) -> Option<(u32, Point)> {
        let first = self.of_site.partition_point(|s| s.0 < site);
        let own = self.of_site[first..].iter().take_while(|s| s.0 == site);
        let places = own.map(|&(_, k)| (k, self.segments[k as usize].nearest(p)));
        places.min_by(|a, b| a.1.distance(p).total_cmp(&b.1.distance(p)))
    }
}

/// Where an interfering range begins or ends on the envelope.
#[derive(Clone, Copy, Debug)]
struct Mark {
    segment: u32,
    /// Distance from the segment's start, squared.
    along: f64,
    at: Point,
    begins: bool,
    /// Number of the interference.
    range: u32,
}

/// A part of a segment of the envelope.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    segment: Segment,
    site: SiteId,
}

/// What lies between two distances.
struct Range<'a> {
    fibres: Fibres<'a>,
    inner: &'a PairwiseOffset,
    low: f64,
    high: f64,
    radius: f64,
    /// How far ways may lie from the skeleton.
    stray: f64,
}

impl Range<'_> {
    /// All curves that may leave something; `allowance` is added to every reach.
    fn build(&self, envelope: &Envelope, allowance: f64) -> Builder {
        let mut builder = Builder::new(self.low, allowance, self.radius);
        let marks = self.marks(envelope);
        for bounds in envelope.bounds.windows(2) {
            let first = marks.partition_point(|m| (m.segment as usize) < bounds[0]);
            let own = &marks[first..marks.partition_point(|m| (m.segment as usize) < bounds[1])];
            if own.is_empty() {
                let all = bounds[0]..bounds[1];
                let stretches: Vec<Stretch> = all.map(|k| stretch(envelope, k)).collect();
                if !self.is_regular(&stretches) {
                    builder.add(&self.curve(&stretches, [None, None], true));
                }
                continue;
            }
            for (k, mark) in own.iter().enumerate() {
                let end = &own[(k + 1) % own.len()];
                // Where nothing lies between two ranges, rounding may put the second one's begin before the first one's end.
                if !mark.begins && end.begins {
                    continue;
                }
                let stretches = between(envelope, bounds, mark, end);
                let ends = [mark, end].map(|m| &self.inner.interferences[m.range as usize]);
                if !(mark.range == end.range && self.is_within_reach(&stretches, ends[0].degenerate)) {
                    let roots = ends.map(|i| Some(i.degenerate));
                    builder.add(&self.curve(&stretches, roots, false));
                }
            }
        }
        for i in &self.inner.interferences {
            builder.add_root(i.degenerate, self.high);
        }
        builder
    }

    /// Whether a loop of the envelope on which no range ends has a loop at the higher distance all along.
    fn is_regular(&self, stretches: &[Stretch]) -> bool {
        let length = |s: &Segment| s.start().distance_squared(s.end());
        let longest = stretches.iter().max_by(|a, b| length(&a.segment).total_cmp(&length(&b.segment)));
        longest.is_none_or(|s| self.fibres.through(s.segment.at(0.5), s.site).clearance >= self.high)
    }

    /// The ends of all ranges in order along the envelope.
    fn marks(&self, envelope: &Envelope) -> Vec<Mark> {
        let mut marks = Vec::with_capacity(2 * self.inner.interferences.len());
        for (range, i) in (0..).zip(&self.inner.interferences) {
            for (begins, foot, site) in [(true, i.from, i.elements[0]), (false, i.to, i.elements[1])] {
                let expected = foot.lerp(i.degenerate, self.low / self.high);
                if let Some((segment, at)) = envelope.locate(site, expected) {
                    let along = envelope.segments[segment as usize].start().distance_squared(at);
                    marks.push(Mark { segment, along, at, begins, range });
                }
            }
        }
        marks.sort_by(|a, b| a.segment.cmp(&b.segment).then(a.along.total_cmp(&b.along)).then(a.begins.cmp(&b.begins)));
        marks
    }

    /// Whether no place of a clean-up curve is farther than the tool's radius from a degenerate vertex.
    fn is_within_reach(&self, stretches: &[Stretch], degenerate: Point) -> bool {
        let within = |p: Point| p.distance(degenerate) <= self.radius;
        let farthest = |s: &Segment| match s {
            Segment::Arc(a) if a.spans(a.center - degenerate) => {
                within(a.center + (a.center - degenerate).normalized() * a.radius)
            }
            _ => true,
        };
        stretches.iter().all(|s| within(s.segment.start()) && within(s.segment.end()) && farthest(&s.segment))
    }

    /// Fibres along a clean-up curve.
    fn curve(&self, stretches: &[Stretch], roots: [Option<Point>; 2], closed: bool) -> Curve {
        let mut fibres: Vec<Fibre> = Vec::new();
        for s in stretches {
            let [from, to] = [s.segment.start(), s.segment.end()].map(|p| self.fibres.through(p, s.site));
            fibres.push(from);
            self.refine(s, from, to, HALVINGS, &mut fibres);
        }
        Curve { fibres, roots, closed }
    }

    /// Adds fibres after `from` up to `to`.
    fn refine(&self, s: &Stretch, from: Fibre, to: Fibre, halvings: u32, fibres: &mut Vec<Fibre>) {
        let apart = from.end.distance(to.end);
        // Both ends of a short stretch may be corners, and what is between far away from them.
        if halvings == HALVINGS || (halvings > 0 && apart > self.stray) {
            let middle = self.fibres.through(s.segment.at(0.5), s.site);
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

fn stretch(envelope: &Envelope, k: usize) -> Stretch {
    Stretch { segment: envelope.segments[k], site: envelope.sites[k] }
}

/// The envelope from one mark to the next on its loop.
fn between(envelope: &Envelope, bounds: &[usize], from: &Mark, to: &Mark) -> Vec<Stretch> {
    let (a, b) = (from.segment as usize, to.segment as usize);
    let cut = |k: usize, from: Option<Point>, to: Option<Point>| {
        let Stretch { segment, site } = stretch(envelope, k);
        let rest = from.map_or(segment, |p| segment.split_at(p).1);
        Stretch { segment: to.map_or(rest, |p| rest.split_at(p).0), site }
    };
    if a == b && from.along <= to.along {
        return vec![cut(a, Some(from.at), Some(to.at))];
    }
    let mut stretches = vec![cut(a, Some(from.at), None)];
    let mut k = a;
    loop {
        k = if k + 1 == bounds[1] { bounds[0] } else { k + 1 };
        if k == b {
            stretches.push(cut(b, None, Some(to.at)));
            return stretches;
        }
        stretches.push(stretch(envelope, k));
    }
}
