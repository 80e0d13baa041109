//! Clean-up curves: the parts of the outer tool envelope that the inner loops do not follow.
//!
//! Every segment of an offset is parallel to one wall (or runs about one reflex vertex), and what a wall has of the inner
//! loops, it has of the envelope, too. So the interfering ranges are found wall by wall, as differences of intervals: none can
//! be missed, wherever loops part, vanish or touch.

use pocketry_geom::offset::Offset;
use pocketry_geom::skeleton::SiteId;
use pocketry_geom::{Arc, Point, Segment};

/// A part of a segment of the envelope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) segment: Segment,
    pub(super) site: SiteId,
}

/// The envelope along an interfering range.
#[derive(Clone, Debug)]
pub(super) struct CleanupCurve {
    pub(super) stretches: Vec<Stretch>,
    /// The degenerate vertices between which it lies; none where no inner loop follows any of it, and it is closed.
    pub(super) roots: Option<[Point; 2]>,
}

/// What follows on a loop of the envelope.
enum Part {
    /// No inner loop.
    Interfering(Stretch),
    /// An inner loop from here to there.
    Followed(Point, Point),
}

/// The clean-up curves between an envelope and the inner loops; what is no longer than `negligible` (mm) is none.
pub(super) fn cleanup_curves(envelope: &Offset, inner: &Offset, negligible: f64) -> Vec<CleanupCurve> {
    let mut of_site: Vec<(SiteId, Segment)> =
        inner.loops.iter().flat_map(|l| l.sites.iter().copied().zip(l.contour.segments.iter().copied())).collect();
    of_site.sort_by_key(|s| s.0);
    let mut curves = Vec::new();
    for l in &envelope.loops {
        let stretches = l.contour.segments.iter().zip(&l.sites).map(|(&segment, &site)| Stretch { segment, site });
        let parts: Vec<Part> = stretches.flat_map(|s| parts(&s, of_site_among(&of_site, s.site), negligible)).collect();
        add_curves(&parts, &mut curves);
    }
    curves
}

fn of_site_among(all: &[(SiteId, Segment)], site: SiteId) -> &[(SiteId, Segment)] {
    let first = all.partition_point(|s| s.0 < site);
    let count = all[first..].partition_point(|s| s.0 == site);
    &all[first..first + count]
}

/// A segment of the envelope less what inner loops follow.
fn parts(whole: &Stretch, inner: &[(SiteId, Segment)], negligible: f64) -> Vec<Part> {
    let share = |p: Point| share(&whole.segment, p).clamp(0.0, 1.0);
    let mut followed: Vec<(f64, f64, &Segment)> =
        inner.iter().map(|(_, s)| (share(s.start()), share(s.end()), s)).filter(|f| f.0 < f.1).collect();
    followed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let least = negligible / whole.segment.length();
    let (mut parts, mut done) = (Vec::with_capacity(2 * followed.len() + 1), 0.0);
    let skip = |from: f64, to: f64, parts: &mut Vec<Part>| {
        if to - from > least {
            parts.push(Part::Interfering(Stretch { segment: whole.segment.between([from, to]), ..*whole }));
        }
    };
    for (from, to, segment) in followed {
        skip(done, from, &mut parts);
        parts.push(Part::Followed(segment.start(), segment.end()));
        done = to.max(done);
    }
    skip(done, 1.0, &mut parts);
    parts
}

/// The runs of parts of a closed loop that no inner loop follows.
fn add_curves(parts: &[Part], curves: &mut Vec<CleanupCurve>) {
    let Some(first) = parts.iter().position(|p| matches!(p, Part::Followed(..))) else {
        let all = parts.iter().filter_map(|p| if let Part::Interfering(s) = p { Some(*s) } else { None });
        curves.push(CleanupCurve { stretches: all.collect(), roots: None });
        return;
    };
    let (mut stretches, mut left) = (Vec::new(), None);
    for part in parts[first..].iter().chain(&parts[..=first]) {
        match part {
            Part::Interfering(s) => stretches.push(*s),
            Part::Followed(start, end) => {
                if let Some(from) = left.replace(*end).filter(|_| !stretches.is_empty()) {
                    let stretches = std::mem::take(&mut stretches);
                    curves.push(CleanupCurve { stretches, roots: Some([from, *start]) });
                }
            }
        }
    }
}

/// Where along a segment's wall a point is, 0 at the segment's start and 1 at its end.
fn share(s: &Segment, p: Point) -> f64 {
    match s {
        Segment::Line(l) => {
            let along = l.end - l.start;
            (p - l.start).dot(along) / along.length_squared()
        }
        Segment::Arc(a) => 0.5 + (middle(a) - a.center).angle_to(p - a.center) / a.sweep(),
    }
}

fn middle(a: &Arc) -> Point {
    Segment::Arc(*a).at(0.5)
}
