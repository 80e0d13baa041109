//! Arcs as the control runs them.
//!
//! The control takes the centre as written, turns from the start's direction to the end's and lets the radius run evenly
//! from the one to the other: rounding makes a slight spiral of nearly every arc. Here the spiral is replaced by arcs of
//! at most half a turn that pass through its ends exactly; it stays within an eighth of the radii's difference of them
//! (the two differ by half of it times x − sin(φx/2) / sin(φ/2) for some x in [−1, 1] and a turn φ ≤ π, which is
//! largest for φ = π: 0.1053 times the difference).

use super::ProgramError;
use pocketry_geom::tolerance::proof::{ARC_RADII, ARC_RADII_RELATIVE, FULL_TURN};
use pocketry_geom::{Arc, Point, Segment, Vec2};
use std::f64::consts::{PI, TAU};

/// An arc move in the plane.
#[derive(Clone, Copy)]
pub(super) struct ArcMove {
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) center: Point,
    pub(super) ccw: bool,
    /// Full turns beyond the first.
    pub(super) extra_turns: u32,
    pub(super) line: u32,
}

/// What an arc move adds to the trace.
pub(super) struct Swept {
    /// How far the control's path may be from the curves, mm.
    pub(super) slack: f64,
    /// Length in the plane, mm.
    pub(super) length: f64,
}

impl ArcMove {
    /// The centre from an R word: the shorter way round where `radius` is positive.
    pub(super) fn center_of_radius(
        start: Point,
        end: Point,
        radius: f64,
        ccw: bool,
        line: u32,
    ) -> Result<Point, ProgramError> {
        let failed = |reason: &str| ProgramError::Arc { line, reason: reason.into() };
        let chord = end - start;
        let length = chord.length();
        if length == 0.0 {
            return Err(failed("R needs an end that differs from the start"));
        }
        let squared = radius * radius - length * length / 4.0;
        if squared < 0.0 && length / 2.0 - radius.abs() > ARC_RADII {
            return Err(failed("R is less than half the distance to the end"));
        }
        let side = if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
        Ok(start.midpoint(end) + chord.left() * (side * squared.max(0.0).sqrt() / length))
    }

    /// Adds the curves of this move to `out`.
    pub(super) fn sweep(&self, out: &mut Vec<Segment>) -> Result<Swept, ProgramError> {
        let (from, to) = (self.start - self.center, self.end - self.center);
        let (r0, r1) = (from.length(), to.length());
        let apart = (r1 - r0).abs();
        let failed = |reason: String| ProgramError::Arc { line: self.line, reason };
        if !(r0 > 0.0 && r1 > 0.0) {
            return Err(failed("its centre is its start or end".into()));
        }
        if apart > ARC_RADII.max(ARC_RADII_RELATIVE * r0) || apart > 0.25 * r0 {
            return Err(failed(format!("its radius is {r0:.6} mm at the start and {r1:.6} mm at the end")));
        }
        let turn = self.turn(from, to);
        let middle_radius = 0.5 * (r0 + r1);
        if self.extra_turns > 0 {
            let opposite = self.center - from;
            out.extend([self.through(self.start, opposite), self.through(opposite, self.start)]);
        }
        if turn > PI {
            let half = if self.ccw { 0.5 * turn } else { -0.5 * turn };
            let middle = self.center + from.rotated(half) * (middle_radius / r0);
            out.extend([self.through(self.start, middle), self.through(middle, self.end)]);
        } else {
            out.push(self.through(self.start, self.end));
        }
        // Every extra turn lies between the first turn's radius and the last one's.
        let slack = if self.extra_turns > 0 { apart } else { apart / 8.0 };
        Ok(Swept { slack, length: middle_radius * (turn + TAU * f64::from(self.extra_turns)) })
    }

    /// How far it turns, radians, in (0, 2π]; next to nothing counts as the full turn, as it does for the control.
    fn turn(&self, from: Vec2, to: Vec2) -> f64 {
        let angle = if self.ccw { from.angle_to(to) } else { to.angle_to(from) };
        let ahead = if angle < 0.0 { angle + TAU } else { angle };
        if ahead < FULL_TURN { ahead + TAU } else { ahead }
    }

    /// The arc of at most half a turn through two points whose centre is the nearest to the written one.
    fn through(&self, start: Point, end: Point) -> Segment {
        let across = (end - start).left().normalized();
        let middle = start.midpoint(end);
        let center = middle + across * across.dot(self.center - middle);
        Segment::Arc(Arc { start, end, center, radius: start.distance(center), ccw: self.ccw })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    fn arc(start: Point, end: Point, center: Point, ccw: bool) -> ArcMove {
        ArcMove { start, end, center, ccw, extra_turns: 0, line: 1 }
    }

    #[test]
    fn a_full_circle_comes_in_two_halves() {
        let mut out = Vec::new();
        let p = point(3.0, 0.0);
        let swept = arc(p, p, Point::ORIGIN, true).sweep(&mut out).unwrap();
        assert_eq!(out.len(), 2);
        assert!((swept.length - 3.0 * TAU).abs() < 1e-12 && swept.slack == 0.0);
        assert_eq!((out[0].start(), out[1].end()), (p, p));
    }

    #[test]
    fn the_spiral_of_a_rounded_arc_stays_within_the_slack() {
        for turn in [0.01, 0.5, 2.0, 3.1, 3.2, 4.5, 6.2] {
            let (r0, r1): (f64, f64) = (5.0, 5.004);
            let end = (Vec2::from_angle(-turn) * r1).to_point();
            let mut out = Vec::new();
            let swept = arc(point(r0, 0.0), end, Point::ORIGIN, false).sweep(&mut out).unwrap();
            for k in 0..=1000 {
                let t = f64::from(k) / 1000.0;
                let p = (Vec2::from_angle(-turn * t) * (r0 + t * (r1 - r0))).to_point();
                let away = out.iter().map(|c| c.distance(p)).fold(f64::INFINITY, f64::min);
                assert!(away <= swept.slack, "{turn} {t}: {away} {}", swept.slack);
            }
        }
    }

    #[test]
    fn radii_that_differ_are_refused() {
        let wrong = arc(point(5.0, 0.0), point(0.0, 5.1), Point::ORIGIN, true).sweep(&mut Vec::new());
        assert!(matches!(wrong, Err(ProgramError::Arc { line: 1, .. })));
    }
}
