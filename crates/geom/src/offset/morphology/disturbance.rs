//! Region and profile as they are computed with: about the origin, the profile grown and turned by a trifle, and the region's contours
//! or corners moved by another one where an attempt before contradicted itself.
//!
//! Turning the profile parts whatever coincides because walls are parallel to its edges, and leaves smooth joints smooth. Moving
//! corners parts what walls alone make coincide, but bends smooth joints; so the two alternate.

use crate::contour::Contour;
use crate::point::{Point, Vec2, vec2};
use crate::segment::{Arc, Segment};
use crate::tolerance::profile::{FIRST_TURN, RANGE_GROWTH, SHORTEST, TURN_GROWTH};
use std::f64::consts::PI;

/// By how much an attempt moves things.
pub(super) struct Disturbance {
    attempt: i32,
    /// The length that walls are moved by at most, and that tolerances are multiples of, mm.
    pub(super) range: f64,
    /// The angle that the profile is turned by, radians.
    turn: f64,
}

impl Disturbance {
    /// The disturbance of an attempt, from 0; `unit` is the least range, mm.
    pub(super) fn new(attempt: i32, unit: f64) -> Self {
        let pair = attempt / 2;
        Self { attempt, range: unit * RANGE_GROWTH.powi(pair), turn: FIRST_TURN * TURN_GROWTH.powi(pair) }
    }

    /// Contours seen from `origin`: as they are at first, then every other time corners or whole contours moved along x and y, edges
    /// too short for that left out.
    pub(super) fn moved(&self, contours: &[Contour], origin: Vec2) -> Vec<Contour> {
        let mut state = u64::from(self.attempt.unsigned_abs());
        let mut shift = move || shift(&mut state) * self.range;
        let mut contour = |c: &Contour| {
            let kept: Vec<&Segment> = c.segments.iter().filter(|s| s.length() > SHORTEST * self.range).collect();
            let all = if self.attempt > 0 { shift() } else { Vec2::default() };
            let mut corner = || if self.attempt % 2 == 1 { shift() } else { all };
            let corners: Vec<Point> = kept.iter().map(|s| s.start() - origin + corner()).collect();
            let mut segments = Vec::with_capacity(corners.len());
            for (k, s) in kept.iter().enumerate() {
                let (start, end) = (corners[k], corners[(k + 1) % corners.len()]);
                if is_flat(s, 2.0 * self.range) {
                    segments.push(Segment::line(start, end));
                } else {
                    push(s, start, end, &mut segments);
                }
            }
            Contour::new(segments)
        };
        contours.iter().map(&mut contour).filter(|c| c.segments.len() > 1).collect()
    }

    /// The profile turned about a point within it to the left, and grown by more than that and moved walls take; arcs of
    /// more than half a turn as halves.
    pub(super) fn grown(&self, profile: &Contour, inside: Point) -> Contour {
        let bbox = profile.bbox();
        let by = 4.0 * self.range + self.turn * bbox.size();
        let scale = 1.0 + by / (0.5 * bbox.width().min(bbox.height()));
        let place = |p: Point| inside + ((p - inside) * scale).rotated(self.turn);
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
        for s in profile.segments.iter().map(resized) {
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
}

/// Whether an arc is hardly more than its chord: no higher than `height`.
fn is_flat(s: &Segment, height: f64) -> bool {
    matches!(s, Segment::Arc(a) if a.start != a.end && a.height() <= height)
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
