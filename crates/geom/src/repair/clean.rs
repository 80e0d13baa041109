//! Sane numbers, closed loops, edges of some length, no full circles.

use super::bbox_of;
use super::report::{Note, RegionError};
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::point::Point;
use crate::segment::{Arc, Segment};
use crate::tolerance::{ABSURD, SMALLEST_SIZE};

/// Refuses numbers that no drawing of a part has; returns the box of all loops.
pub(super) fn check_numbers(loops: &[Contour]) -> Result<BBox, RegionError> {
    for (contour, c) in (0..).zip(loops) {
        if let Some(k) = c.segments.iter().position(|s| !s.is_finite()) {
            return Err(RegionError::NotFinite { contour, vertex: k as u32 });
        }
        let bbox = c.bbox();
        if !bbox.is_empty()
            && let Some(at) = [bbox.min, bbox.max].into_iter().find(|p| p.x.abs().max(p.y.abs()) > ABSURD)
        {
            return Err(RegionError::Absurd { contour, at });
        }
    }
    let bbox = bbox_of(loops);
    if bbox.is_empty() {
        return Err(RegionError::Nothing { loops: loops.len(), at: Point::ORIGIN });
    }
    if bbox.size() < SMALLEST_SIZE {
        return Err(RegionError::TooSmall { size: bbox.size(), at: bbox.center() });
    }
    Ok(bbox)
}

/// Each loop with its place in the input, closed exactly, without edges shorter than `touch` and without full circles;
/// empty loops are left out. Arcs as flat as `touch` become lines.
pub(super) fn clean(
    loops: Vec<Contour>,
    touch: f64,
    notes: &mut Vec<Note>,
) -> Result<Vec<(u32, Contour)>, RegionError> {
    let mut kept = Vec::with_capacity(loops.len());
    for (name, contour) in (0..).zip(loops) {
        let mut segments = contour.segments;
        close(&mut segments, name, touch, notes)?;
        drop_short(&mut segments, name, touch, notes);
        let segments: Vec<Segment> = segments.into_iter().flat_map(|s| sound(s, touch)).collect();
        if !segments.is_empty() {
            kept.push((name, Contour::new(segments)));
        }
    }
    Ok(kept)
}

/// Makes every edge start exactly where the one before it ends; gaps above `touch` are an error.
fn close(segments: &mut [Segment], contour: u32, touch: f64, notes: &mut Vec<Note>) -> Result<(), RegionError> {
    let n = segments.len();
    for k in 0..n {
        let at = segments[(k + n - 1) % n].end();
        let gap = at.distance(segments[k].start());
        if gap > touch {
            return Err(RegionError::Open { contour, at, gap });
        }
        if gap > 0.0 {
            notes.push(Note::Closed { contour, at, gap });
            segments[k] = with_ends(segments[k], at, segments[k].end());
        }
    }
    Ok(())
}

/// Leaves out edges shorter than `touch`; the next edge then starts where the dropped one did.
fn drop_short(segments: &mut Vec<Segment>, contour: u32, touch: f64, notes: &mut Vec<Note>) {
    let is_short = |s: &Segment| s.length() <= touch;
    let Some(first) = segments.iter().position(is_short) else { return };
    let at = segments[first].start();
    let before = segments.len();
    segments.retain(|s| !is_short(s));
    notes.push(Note::ZeroLength { contour, count: before - segments.len(), at });
    let n = segments.len();
    for k in 0..n {
        let from = segments[(k + n - 1) % n].end();
        segments[k] = with_ends(segments[k], from, segments[k].end());
    }
}

/// The same curve with its ends moved by next to nothing.
pub(super) const fn with_ends(segment: Segment, start: Point, end: Point) -> Segment {
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(a) => Segment::Arc(Arc { start, end, ..a }),
    }
}

/// Halves of a full circle, a line for an arc that is flat, else the edge itself.
fn sound(segment: Segment, touch: f64) -> impl Iterator<Item = Segment> {
    let [first, second] = match segment {
        Segment::Arc(a) if a.start.distance(a.end) <= touch => {
            let opposite = a.center + (a.center - a.start);
            let halves = (Arc { end: opposite, ..a }, Arc { start: opposite, ..a });
            [Some(Segment::Arc(halves.0)), Some(Segment::Arc(halves.1))]
        }
        Segment::Arc(a) if segment.at(0.5).distance(a.start.midpoint(a.end)) <= touch => {
            [Some(Segment::line(a.start, a.end)), None]
        }
        s => [Some(s), None],
    };
    first.into_iter().chain(second)
}
