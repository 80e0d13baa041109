//! Which parts of a curve lie farther than a radius from every one of many segments.

use crate::distance;
use crate::tree::Tree;
use pocketry_geom::{Arc, Point, Segment, Vec2};
use std::f64::consts::TAU;

/// A stretch of a curve, as fractions of its length.
pub(crate) type Span = (f64, f64);

/// The parts of `curve` (an arc of at most half a turn, or a line) no nearer than `radius` to any segment of the tree.
///
/// The curve is cut where it crosses the outline of what lies within `radius` of a segment (its parallels and the
/// circles about its ends), and every part between two cuts is judged at its middle.
pub(crate) fn exposed(curve: &Segment, tree: &Tree, radius: f64) -> Vec<Span> {
    let mut open = vec![(0.0, 1.0)];
    let mut next = Vec::new();
    tree.near(curve, radius, |segment| {
        if distance::between(curve, segment) < radius {
            for &span in &open {
                subtract(span, &covered(curve, span, segment, radius), &mut next);
            }
            std::mem::swap(&mut open, &mut next);
            next.clear();
        }
        !open.is_empty()
    });
    open
}

/// The stretch of a curve, `None` where it is too short to have two different ends.
pub(crate) fn sub(curve: &Segment, span: Span) -> Option<Segment> {
    if span == (0.0, 1.0) {
        return (curve.start() != curve.end()).then_some(*curve);
    }
    let (start, end) = (curve.at(span.0), curve.at(span.1));
    (start != end && span.0 < span.1).then(|| match *curve {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(a) => Segment::Arc(Arc { start, end, ..a }),
    })
}

/// What is left of `span` without the covered stretches (in ascending order).
fn subtract(span: Span, covered: &[Span], out: &mut Vec<Span>) {
    let mut from = span.0;
    for &(a, b) in covered {
        if a > from {
            out.push((from, a));
        }
        from = from.max(b);
    }
    if from < span.1 {
        out.push((from, span.1));
    }
}

/// The stretches of `span` nearer than `radius` to one segment, ascending.
fn covered(curve: &Segment, span: Span, segment: &Segment, radius: f64) -> Vec<Span> {
    let mut cuts = Cuts::new(curve, span);
    cuts.circle(segment.start(), radius);
    cuts.circle(segment.end(), radius);
    match segment {
        Segment::Line(l) => {
            let normal = l.direction().left();
            if normal.x.is_finite() {
                cuts.parallel(l.start, normal, radius);
                cuts.parallel(l.start, normal, -radius);
            }
        }
        Segment::Arc(a) => {
            cuts.circle(a.center, a.radius + radius);
            if a.radius > radius {
                cuts.circle(a.center, a.radius - radius);
            }
        }
    }
    cuts.judged(|p| segment.distance(p) < radius)
}

/// Fractions at which a curve is cut.
struct Cuts<'a> {
    curve: &'a Segment,
    span: Span,
    at: [f64; 10],
    count: usize,
}

impl<'a> Cuts<'a> {
    fn new(curve: &'a Segment, span: Span) -> Self {
        let mut at = [0.0; 10];
        at[0] = span.0;
        Self { curve, span, at, count: 1 }
    }

    fn add(&mut self, t: f64) {
        if t > self.span.0 && t < self.span.1 {
            self.at[self.count] = t;
            self.count += 1;
        }
    }

    /// Cuts at a circle.
    fn circle(&mut self, center: Point, radius: f64) {
        match self.curve {
            Segment::Line(l) => {
                let along = l.end - l.start;
                let from = l.start - center;
                let squared = along.length_squared();
                let height = along.cross(from);
                let inside = squared * radius * radius - height * height;
                if inside > 0.0 {
                    let root = inside.sqrt();
                    self.add((-along.dot(from) - root) / squared);
                    self.add((-along.dot(from) + root) / squared);
                }
            }
            Segment::Arc(a) => {
                let towards = center - a.center;
                let apart = towards.length();
                let along = 0.5 * (apart + (a.radius - radius) * (a.radius + radius) / apart);
                self.directions(a, towards, along / a.radius);
            }
        }
    }

    /// Cuts at the points whose height over the line through `origin` is `height`.
    fn parallel(&mut self, origin: Point, normal: Vec2, height: f64) {
        match self.curve {
            Segment::Line(l) => {
                let rise = normal.dot(l.end - l.start);
                if rise != 0.0 {
                    self.add((height - normal.dot(l.start - origin)) / rise);
                }
            }
            Segment::Arc(a) => self.directions(a, normal, (height - normal.dot(a.center - origin)) / a.radius),
        }
    }

    /// Cuts an arc at the two points whose direction from its centre has this cosine to `axis`.
    fn directions(&mut self, a: &Arc, axis: Vec2, cosine: f64) {
        if cosine.abs() <= 1.0 {
            let sweep = a.sweep();
            let base = (a.start - a.center).angle_to(axis);
            let turn = cosine.acos();
            for angle in [base - turn, base + turn] {
                let ahead = (angle * sweep.signum()).rem_euclid(TAU);
                self.add(ahead / sweep.abs());
            }
        }
    }

    /// The parts between cuts whose middles are hit, joined where they follow one another.
    fn judged(mut self, hit: impl Fn(Point) -> bool) -> Vec<Span> {
        self.at[self.count] = self.span.1;
        let at = &mut self.at[..=self.count];
        at.sort_unstable_by(f64::total_cmp);
        let mut out: Vec<Span> = Vec::new();
        for pair in at.windows(2).filter(|p| p[0] < p[1]) {
            if hit(self.curve.at(0.5 * (pair[0] + pair[1]))) {
                match out.last_mut() {
                    Some(last) if last.1 == pair[0] => last.1 = pair[1],
                    _ => out.push((pair[0], pair[1])),
                }
            }
        }
        out
    }
}
