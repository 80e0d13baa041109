//! Arcs of a region as chords that keep to the pocket's side of them: coarse ones, and fine ones where a channel may be just as wide as the
//! tool.
//!
//! Chords make channels narrower. Where the largest disk that touches the arc there is about as large as the tool, that must be far less than
//! drawings are wrong by, for a tool that just fits is to pass. Elsewhere nothing but the cut depends on them.

use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::point::Point;
use crate::region::Region;
use crate::segment::{Arc, Segment};
use crate::tolerance::skeleton::CUSP;
use std::f64::consts::FRAC_PI_3;

/// How far disks of about the tool's radius may be from it, as a share.
const ABOUT: f64 = 0.02;

/// How far the chords may lie from arcs, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fineness {
    /// Where the largest disk is about as large as this.
    pub(super) radius: f64,
    pub(super) fine: f64,
    /// Elsewhere.
    pub(super) coarse: f64,
}

/// The region with chords for arcs, nowhere larger, and smaller by no more than the tolerances; `None` where it has no arcs.
pub(super) fn chorded(region: &Region, fineness: Fineness) -> Option<Region> {
    let walls: Vec<Segment> = region.segments().copied().collect();
    walls.iter().any(|s| matches!(s, Segment::Arc(_))).then(|| {
        let chords = Chords { walls: SegmentIndex::new(&walls), fineness };
        let contours = region.contours().iter().map(|c| chords.straight(c)).collect();
        Region::from_parts_unchecked(contours, region.parents().to_vec())
    })
}

struct Chords {
    walls: SegmentIndex,
    fineness: Fineness,
}

impl Chords {
    fn straight(&self, contour: &Contour) -> Contour {
        let mut points = Vec::new();
        let segments = &contour.segments;
        for (k, s) in segments.iter().enumerate() {
            let begun = points.len();
            match s {
                Segment::Line(l) => points.push(l.start),
                Segment::Arc(a) => self.add(a, &mut points),
            }
            if is_thorn(&segments[if k == 0 { segments.len() } else { k } - 1], s) {
                points.remove(begun);
            }
        }
        points.dedup();
        let lines = (0..points.len()).map(|k| Segment::line(points[k], points[(k + 1) % points.len()]));
        Contour::new(lines.filter(|l| l.start() != l.end()).collect())
    }

    /// Points for an arc, its start included and its end left out: fine or coarse for each part of it that a coarse chord spans.
    fn add(&self, arc: &Arc, points: &mut Vec<Point>) {
        let Fineness { fine, coarse, .. } = self.fineness;
        let count = pieces(arc, coarse);
        let (turn, spoke) = (arc.sweep() / count as f64, arc.start - arc.center);
        let at = |k: usize| match k {
            0 => arc.start,
            k if k == count => arc.end,
            k => arc.center + spoke.rotated(turn * k as f64),
        };
        let is_fine: Vec<bool> =
            (0..count).map(|k| self.is_just_as_wide(&Arc { start: at(k), end: at(k + 1), ..*arc })).collect();
        let mut first = 0;
        for alike in is_fine.chunk_by(|a, b| a == b) {
            let end = first + alike.len();
            let tolerance = if alike[0] { fine } else { coarse };
            add(&Arc { start: at(first), end: at(end), ..*arc }, tolerance, points);
            first = end;
        }
    }

    /// Whether a disk of about the tool's radius is the largest that touches a part of an arc: one that is smaller is free of
    /// walls, and one that is larger is not.
    fn is_just_as_wide(&self, part: &Arc) -> bool {
        let radius = self.fineness.radius;
        let slack = 0.5 * ABOUT * radius;
        let s = Segment::Arc(*part);
        [0.0, 0.5, 1.0].into_iter().any(|t| {
            let p = s.at(t);
            let outwards = (p - part.center) / part.radius;
            let inwards = if part.ccw { -outwards } else { outwards };
            let meets = |radius: f64, by: f64| self.walls.nearest_within(p + inwards * radius, radius - by).is_some();
            !meets((1.0 - ABOUT) * radius, slack) && meets((1.0 + ABOUT) * radius, slack)
        })
    }
}

/// Whether the pocket ends between two tangent curves, at a corner of no angle. The chords of one that bends away lie on the other's tangent there and
/// would enclose a thorn of no width.
fn is_thorn(before: &Segment, after: &Segment) -> bool {
    let (u, v) = (before.end_tangent(), after.start_tangent());
    u.dot(v) < 0.0 && u.cross(v).abs() < CUSP && before.curvature() + after.curvature() < 0.0
}

/// How many chords within a tolerance an arc needs.
fn pieces(arc: &Arc, tolerance: f64) -> usize {
    // A chord lies within R (1 - cos h) of an arc of half its angle h, a tangent within R (1 / cos h - 1).
    let share = (tolerance / arc.radius).min(1.0);
    let half = if arc.ccw { (1.0 - share).acos() } else { (1.0 / (1.0 + share)).acos() };
    (arc.sweep().abs() / (2.0 * half).min(FRAC_PI_3)).ceil().max(1.0) as usize
}

/// Points for an arc, its start included and its end left out.
fn add(arc: &Arc, tolerance: f64, points: &mut Vec<Point>) {
    let (sweep, spoke) = (arc.sweep(), arc.start - arc.center);
    let count = pieces(arc, tolerance) as f64;
    points.push(arc.start);
    if arc.ccw {
        points.extend((1..count as usize).map(|k| arc.center + spoke.rotated(sweep * k as f64 / count)));
    } else {
        // The pocket is outside: tangents, met in the middle of each part.
        let out = 1.0 / (0.5 * sweep / count).cos();
        let middle = |k: usize| arc.center + spoke.rotated(sweep * (k as f64 + 0.5) / count) * out;
        points.extend((0..count as usize).map(middle));
    }
}
