//! Pieces of the path on which a profile moves as a rigid body: shifted, or turned about a point.
//!
//! A rotary axis follows linearly along a line or an arc. Where it keeps still, or turns as the arc does, the profile moves as a
//! rigid body, within a small angle that counts as slack. Anything else is divided until it is such a piece within a given distance.

use super::shape::reflected;
use super::sum;
use crate::gcode::{Motion, Trace};
use pocketry_geom::{Arc, Point, Segment, Vec2};

/// More parts of one curve are not made: a rotary axis that spins so fast is left with a large slack, and so refused.
const MOST_PARTS: f64 = 100_000.0;

/// A piece of the path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// The way of the reference point.
    pub(crate) curve: Segment,
    /// Direction of the profile's x axis at the start, radians.
    pub(crate) angle: f64,
    pub(crate) body: Body,
    /// Line of the program.
    pub(crate) line: u32,
    /// How far points of the profile may be from where this piece says, mm.
    pub(crate) slack: f64,
}

/// How the profile moves.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Body {
    /// Its direction stays.
    Shift,
    /// It turns about a point by an angle, radians counter-clockwise.
    About { center: Point, by: f64 },
}

impl Part {
    /// A curve along which the profile's direction stays.
    pub(crate) fn shifted(motion: &Motion, curve: Segment) -> Self {
        Self { curve, angle: 0.0, body: Body::Shift, line: motion.line, slack: motion.slack }
    }

    /// The direction after a share of the piece.
    pub(crate) fn angle_at(&self, share: f64) -> f64 {
        match self.body {
            Body::Shift => self.angle,
            Body::About { by, .. } => self.angle + share * by,
        }
    }

    /// A curve of the profile where the piece starts.
    pub(crate) fn placed(&self, own: &Segment) -> Segment {
        own.rotated(self.angle).translated(self.curve.start().to_vec())
    }

    /// The way of a fixed point as the profile sees it in its own axes.
    pub(crate) fn seen(&self, q: Point) -> Segment {
        match self.body {
            Body::Shift => reflected(&self.curve, q).rotated(-self.angle),
            Body::About { center, by } => {
                let own = |p: Point| (p - self.curve.start()).rotated(-self.angle).to_point();
                turned(own(q), own(center), -by)
            }
        }
    }

    /// Adds curves that hold the outline of what an edge of the profile sweeps.
    pub(crate) fn outline(&self, edge: &Segment, out: &mut Vec<Segment>) {
        let first = self.placed(edge);
        out.push(first);
        match self.body {
            Body::Shift if self.curve.start() == self.curve.end() => {}
            Body::Shift => {
                let by = self.curve.end() - self.curve.start();
                let own = edge.rotated(self.angle);
                out.extend([first.translated(by), self.curve.translated(own.start().to_vec())]);
                sum::envelopes(&self.curve, &own, out);
            }
            Body::About { center, by } => {
                let about = -center.to_vec();
                out.push(first.translated(about).rotated(by).translated(-about));
                // A point of the outline moves along it: it is an end of the edge, or nearest to or farthest from the centre.
                out.push(turned(first.start(), center, by));
                out.extend(extremes(&first, center).into_iter().flatten().map(|p| turned(p, center, by)));
            }
        }
    }
}

/// The way of a point that turns about another one; a line of no length where it stays.
fn turned(p: Point, center: Point, by: f64) -> Segment {
    let end = center + (p - center).rotated(by);
    if p == end {
        return Segment::line(p, p);
    }
    Segment::Arc(Arc { start: p, end, center, radius: p.distance(center), ccw: by > 0.0 })
}

/// The points of a curve, apart from its ends, that are locally nearest to or farthest from a point.
fn extremes(curve: &Segment, from: Point) -> [Option<Point>; 2] {
    match curve {
        Segment::Line(l) => [Some(l.nearest(from)), None],
        Segment::Arc(a) => {
            let out = (a.center - from).normalized();
            let at = |d: Vec2| a.spans(d).then(|| a.center + d * a.radius);
            if out.x.is_finite() { [at(out), at(-out)] } else { [None, None] }
        }
    }
}

/// All curves of some motions in parts, each within `fine` (mm) of a rigid motion of a profile that reaches so far (mm).
pub(crate) fn parts<'a>(trace: &Trace, motions: impl Iterator<Item = &'a Motion>, reach: f64, fine: f64) -> Vec<Part> {
    let mut out = Vec::new();
    for motion in motions {
        let curves = trace.curves_of(motion);
        let length: f64 = curves.iter().map(Segment::length).sum();
        let [from, to] = motion.turn;
        let mut run = 0.0;
        for (k, curve) in curves.iter().enumerate() {
            let at = |run: f64, k: usize| {
                let share = if length > 0.0 { run / length } else { k as f64 / curves.len() as f64 };
                from + share * (to - from)
            };
            let before = at(run, k);
            run += curve.length();
            divide(motion, *curve, [before, at(run, k + 1)], (reach, fine), &mut out);
        }
    }
    out
}

fn divide(motion: &Motion, curve: Segment, [from, to]: [f64; 2], (reach, fine): (f64, f64), out: &mut Vec<Part>) {
    let by = to - from;
    let rest = Part { curve, angle: from, body: Body::Shift, line: motion.line, slack: motion.slack };
    if by.abs() * reach <= fine {
        return out.push(Part { slack: motion.slack + by.abs() * reach, ..rest });
    }
    match curve {
        Segment::Line(l) if l.start == l.end => {
            // On the spot, in parts of no more than half a turn.
            let count = (by.abs() / std::f64::consts::PI).ceil().min(MOST_PARTS);
            for k in 0..count as u32 {
                let angle = from + by * f64::from(k) / count;
                let body = Body::About { center: l.start, by: by / count };
                out.push(Part { angle, body, ..rest });
            }
        }
        Segment::Arc(a) if (by - a.sweep()).abs() <= 0.5 * by.abs() => {
            // It turns a little more or less than the arc, as the program's decimals have it.
            let off = (by - a.sweep()).abs() * reach;
            let count = (off / fine).ceil().clamp(1.0, MOST_PARTS);
            let (body, slack) = (Body::About { center: a.center, by: a.sweep() / count }, motion.slack + off / count);
            for (piece, share) in equal_parts(curve, count) {
                out.push(Part { curve: piece, angle: from + by * share, body, slack, ..rest });
            }
        }
        _ => {
            // The middle's direction is off by half a part's turn at most.
            let count = (0.5 * by.abs() * reach / fine).ceil().clamp(1.0, MOST_PARTS);
            let slack = motion.slack + 0.5 * by.abs() / count * reach;
            for (piece, share) in equal_parts(curve, count) {
                out.push(Part { curve: piece, angle: from + by * (share + 0.5 / count), slack, ..rest });
            }
        }
    }
}

/// A curve in so many parts of one length, each with the share of the curve before it.
fn equal_parts(curve: Segment, count: f64) -> impl Iterator<Item = (Segment, f64)> {
    let mut left = curve;
    (0..count as u32).map(move |k| {
        let end = curve.at(f64::from(k + 1) / count);
        let piece = if f64::from(k + 1) < count { left.split_at(end) } else { (left, left) };
        left = piece.1;
        (piece.0, f64::from(k) / count)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    /// Decimals of a small arc's ends are some ten-thousandths of its sweep: it took thousands of parts, as if it were askew.
    #[test]
    fn an_arc_whose_decimals_are_rounded_stays_whole_or_nearly() {
        let text =
            "G21 G90 G17 G61\nM3 S1000\nG0 Z5\nG0 X0.5 Y0 C90\nG1 Z-1 F100\nG3 X0 Y0.5001 I-0.5 J0 C180\nG0 Z5\nM2\n";
        let trace = crate::gcode::read(text).unwrap();
        let parts = parts(&trace, crate::final_motions(&trace, 0.0), 2.0, 1e-4);
        let turning: Vec<&Part> = parts.iter().filter(|p| matches!(p.body, Body::About { .. })).collect();
        assert!((1..=10).contains(&turning.len()), "{} parts", turning.len());
        assert!(turning.iter().all(|p| p.slack < 1.1e-4 + 1e-9));
        assert!((turning[0].curve.start().distance(point(0.5, 0.0))).abs() < 1e-9);
        let total: f64 = turning.iter().map(|p| if let Body::About { by, .. } = p.body { by } else { 0.0 }).sum();
        assert!((total - 0.5 * std::f64::consts::PI).abs() < 1e-3);
    }
}
