//! Region and profile as they are computed with: about the origin, the profile grown by a trifle, and corners moved by another one where
//! the first attempt contradicts itself.

use crate::contour::Contour;
use crate::point::{Point, Vec2, vec2};
use crate::segment::{Arc, Segment};
use std::f64::consts::PI;

/// Contours seen from `origin`, each corner moved by up to `by` along x and y (mm), edges shorter than `least` left out. The same for
/// the same seed.
pub(super) fn moved(contours: &[Contour], origin: Vec2, by: f64, least: f64, seed: u64) -> Vec<Contour> {
    let mut state = seed;
    let contour = |c: &Contour| {
        let kept: Vec<&Segment> = c.segments.iter().filter(|s| s.length() > least).collect();
        let corners: Vec<Point> = kept.iter().map(|s| s.start() - origin + shift(&mut state) * by).collect();
        let mut segments = Vec::with_capacity(corners.len());
        for (k, s) in kept.iter().enumerate() {
            push(s, corners[k], corners[(k + 1) % corners.len()], &mut segments);
        }
        Contour::new(segments)
    };
    contours.iter().map(contour).filter(|c| c.segments.len() > 1).collect()
}

/// A segment with the same bulge between other ends; arcs of more than half a turn as halves.
fn push(s: &Segment, start: Point, end: Point, out: &mut Vec<Segment>) {
    match s {
        Segment::Arc(a) if start == end || a.sweep().abs() > PI => {
            // Where only one end has moved far, the halves' radii differ.
            let middle = s.at(0.5) + (start - a.start);
            let bulge = (a.sweep() / 8.0).tan();
            out.extend([Segment::from_bulge(start, middle, bulge), Segment::from_bulge(middle, end, bulge)]);
        }
        _ => out.push(Segment::from_bulge(start, end, s.bulge())),
    }
}

/// The profile grown about a point within it by `by` (mm) where it is narrowest; arcs of more than half a turn as halves.
pub(super) fn grown(profile: &Contour, inside: Point, by: f64) -> Contour {
    let bbox = profile.bbox();
    let scale = 1.0 + by / (0.5 * bbox.width().min(bbox.height()));
    let place = |p: Point| inside + (p - inside) * scale;
    let resized = |s: &Segment| match *s {
        Segment::Line(l) => Segment::line(place(l.start), place(l.end)),
        Segment::Arc(a) => Segment::Arc(Arc {
            start: place(a.start),
            end: place(a.end),
            center: place(a.center),
            radius: a.radius * scale,
            ccw: a.ccw,
        }),
    };
    let mut segments = Vec::with_capacity(profile.segments.len() + 1);
    for s in &profile.segments {
        let s = resized(s);
        match s {
            Segment::Arc(a) if a.sweep().abs() > PI => {
                let (before, after) = s.split_at(s.at(0.5));
                segments.extend([before, after]);
            }
            _ => segments.push(s),
        }
    }
    Contour::new(segments)
}

/// Components in [-1, 1), by the splitmix64 sequence.
fn shift(state: &mut u64) -> Vec2 {
    let mut component = || {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    vec2(component(), component())
}
