//! A profile, ready for questions.

use crate::distance;
use crate::walls::{Walls, push_halves};
use pocketry_geom::{Arc, BBox, Contour, Point, Region, Segment, Vec2};

/// Points on a side of the grid on which the deepest point of a profile is sought, and how often the grid is refined.
const GRID: (i32, usize) = (16, 6);

/// A profile about its reference point, the origin.
pub(crate) struct Shape {
    /// Its outline, arcs in parts of at most half a turn.
    pub(crate) segments: Vec<Segment>,
    outline: Walls,
    /// Largest distance of a point of it from the reference point.
    pub(crate) reach: f64,
    /// The point of it farthest from its outline, and how far that is.
    pub(crate) deepest: Point,
    pub(crate) depth_within: f64,
    pub(crate) bbox: BBox,
}

impl Shape {
    pub(crate) fn new(contour: &Contour) -> Self {
        let mut segments = Vec::with_capacity(contour.segments.len());
        contour.segments.iter().for_each(|s| push_halves(s, &mut segments));
        let outline = Walls::new(&Region::from_parts_unchecked(vec![contour.clone()], vec![None]), 0.0);
        let bbox = contour.bbox();
        let reach = segments.iter().map(farthest).fold(0.0, f64::max);
        let mut shape = Self { segments, outline, reach, deepest: Point::ORIGIN, depth_within: 0.0, bbox };
        (shape.deepest, shape.depth_within) = shape.find_deepest();
        shape
    }

    /// How far it reaches on its −y side.
    pub(crate) fn below(&self) -> f64 {
        -self.bbox.min.y
    }

    /// How deep a place relative to the reference point lies in the profile; negative outside.
    pub(crate) fn depth(&self, p: Point) -> f64 {
        let apart = self.segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        if self.outline.contain(p) { apart } else { -apart }
    }

    /// A bound from below of how deep the deepest point of a curve (relative to the reference point) lies in the profile: its
    /// ends, and the middles between where it crosses the outline, are looked at.
    pub(crate) fn depth_along(&self, curve: &Segment) -> f64 {
        if !curve.bbox().intersects(self.bbox) {
            return f64::NEG_INFINITY;
        }
        let mut cuts = vec![curve.start(), curve.end()];
        self.segments.iter().for_each(|s| distance::crossings(curve, s, &mut cuts));
        let length = curve.length();
        let along = |p: &Point| match curve {
            Segment::Line(l) => p.distance(l.start),
            Segment::Arc(a) => {
                let turned = (a.start - a.center).angle_to(*p - a.center);
                let ahead = if a.ccw { turned } else { -turned };
                a.radius * if ahead < 0.0 { ahead + std::f64::consts::TAU } else { ahead }
            }
        };
        let mut marks: Vec<f64> = cuts[2..].iter().map(along).chain([0.0, length]).collect();
        marks.sort_by(f64::total_cmp);
        let middles = marks.windows(2).filter(|w| w[1] > w[0]).map(|w| curve.at(0.5 * (w[0] + w[1]) / length));
        middles.chain([curve.start(), curve.end()]).map(|p| self.depth(p)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The outline moved inwards so that no point between the two is deeper than `depth`: corners are mitred and keep the bulges
    /// of the edges between them. A point of an edge then moves by no more than the root of 2 times its ends do.
    pub(crate) fn shrunk(&self, depth: f64) -> Vec<Segment> {
        let count = self.segments.len();
        let joint = |k: usize| {
            let (before, after) = (&self.segments[(k + count - 1) % count], &self.segments[k]);
            let (m, n) = (before.end_tangent().left(), after.start_tangent().left());
            (after.start(), (m + n) / (1.0 + m.dot(n)))
        };
        let longest = (0..count).map(|k| joint(k).1.length()).fold(1.0, f64::max);
        let step = depth * std::f64::consts::FRAC_1_SQRT_2 / longest;
        let moved = |k: usize| {
            let (p, mitre) = joint(k % count);
            p + mitre * step
        };
        (0..count).map(|k| Segment::from_bulge(moved(k), moved(k + 1), self.segments[k].bulge())).collect()
    }

    fn find_deepest(&self) -> (Point, f64) {
        let mut best = (self.bbox.center(), self.depth(self.bbox.center()));
        let (points, rounds) = GRID;
        let mut step = (self.bbox.max - self.bbox.min) / f64::from(points);
        let mut middle = best.0;
        for _ in 0..rounds {
            for (i, j) in (-points / 2..=points / 2).flat_map(|i| (-points / 2..=points / 2).map(move |j| (i, j))) {
                let p = middle + Vec2::new(step.x * f64::from(i), step.y * f64::from(j));
                let depth = self.depth(p);
                if depth > best.1 {
                    best = (p, depth);
                }
            }
            middle = best.0;
            step = step * (4.0 / f64::from(points));
        }
        best
    }
}

fn farthest(s: &Segment) -> f64 {
    let ends = s.start().to_vec().length().max(s.end().to_vec().length());
    match s {
        Segment::Arc(a) => ends.max(a.center.to_vec().length() + a.radius),
        Segment::Line(_) => ends,
    }
}

/// The curve of all `p − c` for points `c` of a curve.
pub(crate) fn reflected(curve: &Segment, p: Point) -> Segment {
    let flip = |q: Point| (p - q).to_point();
    match *curve {
        Segment::Line(l) => Segment::line(flip(l.start), flip(l.end)),
        Segment::Arc(a) => Segment::Arc(Arc { start: flip(a.start), end: flip(a.end), center: flip(a.center), ..a }),
    }
}
