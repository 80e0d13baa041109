//! Arcs of a region as chords that keep to the pocket's side of them.

use crate::contour::Contour;
use crate::point::Point;
use crate::region::Region;
use crate::segment::{Arc, Segment};
use std::f64::consts::FRAC_PI_3;

/// The region with chords for arcs, nowhere larger, and smaller by no more than `tolerance` (mm); `None` where it has no arcs.
pub(super) fn chorded(region: &Region, tolerance: f64) -> Option<Region> {
    region.segments().any(|s| matches!(s, Segment::Arc(_))).then(|| {
        let contours = region.contours().iter().map(|c| straight(c, tolerance)).collect();
        Region::from_parts_unchecked(contours, region.parents().to_vec())
    })
}

fn straight(contour: &Contour, tolerance: f64) -> Contour {
    let mut points = Vec::new();
    for s in &contour.segments {
        match s {
            Segment::Line(l) => points.push(l.start),
            Segment::Arc(a) => add(a, tolerance, &mut points),
        }
    }
    points.dedup();
    let lines = (0..points.len()).map(|k| Segment::line(points[k], points[(k + 1) % points.len()]));
    Contour::new(lines.filter(|l| l.start() != l.end()).collect())
}

/// Points for an arc, its start included and its end left out.
fn add(arc: &Arc, tolerance: f64, points: &mut Vec<Point>) {
    let sweep = arc.sweep();
    // A chord lies within R (1 - cos h) of an arc of half its angle h, a tangent within R (1 / cos h - 1).
    let share = (tolerance / arc.radius).min(1.0);
    let half = if arc.ccw { (1.0 - share).acos() } else { (1.0 / (1.0 + share)).acos() };
    let count = (sweep.abs() / (2.0 * half).min(FRAC_PI_3)).ceil().max(1.0);
    let spoke = arc.start - arc.center;
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
