//! Clean-up curves: the parts of the outer tool envelope that the inner loops do not follow.
//!
//! Every segment of an offset is parallel to one wall (or runs about one reflex vertex), and what a wall has of the inner
//! loops, it has of the envelope, too. So the interfering ranges are found wall by wall, as differences of intervals: none can
//! be missed, wherever loops part, vanish or touch.

use pocketry_geom::offset::{Offset, OffsetLoop};
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
    let inner = BySite::new(inner);
    let (mut curves, mut parts, mut followed) = (Vec::new(), Vec::new(), Vec::new());
    for l in &envelope.loops {
        parts.clear();
        for (&segment, &site) in l.contour.segments.iter().zip(&l.sites) {
            followed.clear();
            followed.extend(inner.along(site).filter_map(|s| Followed::new(&segment, s)));
            add_parts(&Stretch { segment, site }, &mut followed, negligible, &mut parts);
        }
        add_curves(&parts, &mut curves);
    }
    curves
}

/// The segments of an offset in the order of the walls that they are parallel to.
struct BySite<'a> {
    offset: &'a Offset,
    /// Wall, loop and segment.
    order: Vec<(SiteId, u32, u32)>,
}

impl<'a> BySite<'a> {
    fn new(offset: &'a Offset) -> Self {
        let of_loop = |(l, found): (u32, &'a OffsetLoop)| (0..).zip(&found.sites).map(move |(k, &site)| (site, l, k));
        let mut order: Vec<(SiteId, u32, u32)> = (0..).zip(&offset.loops).flat_map(of_loop).collect();
        order.sort_unstable();
        Self { offset, order }
    }

    fn along(&self, site: SiteId) -> impl Iterator<Item = &'a Segment> + '_ {
        let first = self.order.partition_point(|s| s.0 < site);
        let of_site = self.order[first..].iter().take_while(move |s| s.0 == site);
        of_site.map(|&(_, l, k)| &self.offset.loops[l as usize].contour.segments[k as usize])
    }
}

/// What a segment of an inner loop follows of one of the envelope, as shares of that.
struct Followed<'a> {
    from: f64,
    to: f64,
    segment: &'a Segment,
}

impl<'a> Followed<'a> {
    fn new(whole: &Segment, segment: &'a Segment) -> Option<Self> {
        let [from, to] = [segment.start(), segment.end()].map(|p| share(whole, p).clamp(0.0, 1.0));
        (from < to).then_some(Self { from, to, segment })
    }
}

/// Adds a segment of the envelope less what inner loops follow.
fn add_parts(whole: &Stretch, followed: &mut [Followed<'_>], negligible: f64, parts: &mut Vec<Part>) {
    followed.sort_by(|a, b| a.from.total_cmp(&b.from));
    let least = negligible / whole.segment.length();
    let skip = |from: f64, to: f64, parts: &mut Vec<Part>| {
        if to - from > least {
            parts.push(Part::Interfering(Stretch { segment: whole.segment.between([from, to]), ..*whole }));
        }
    };
    let mut done = 0.0;
    for f in followed {
        skip(done, f.from, parts);
        parts.push(Part::Followed(f.segment.start(), f.segment.end()));
        done = f.to.max(done);
    }
    skip(done, 1.0, parts);
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
