//! Where a horizontal line meets segments: the ground of point location, parity and nesting.
//!
//! The rule is half-open in y, so that a line through a vertex counts every crossing of a closed curve exactly once.

use crate::around::before;
use crate::point::{Point, point, vec2};
use crate::predicates::orientation;
use crate::segment::{Arc, Line, Segment};

/// A place where a horizontal line crosses a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Abscissa of the crossing.
    pub x: f64,
    /// Whether the segment runs upwards there.
    pub upward: bool,
    /// The end of the segment that it lies at; the segment leads upwards from there.
    pub end: Option<End>,
}

/// An end of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where it begins.
    Start,
    /// Where it ends.
    End,
}

/// Whether the first of two hits lies to the right of the second one. Hits in one vertex are told apart by where the
/// segments lead upwards from there.
pub fn lies_right((a, hit_a): (&Segment, Hit), (b, hit_b): (&Segment, Hit)) -> bool {
    let from = |s: &Segment, end: End| if end == End::Start { *s } else { s.reversed() };
    match (hit_a.end, hit_b.end) {
        (Some(end_a), Some(end_b)) if hit_a.x == hit_b.x => before(&from(a, end_a), &from(b, end_b)).is_lt(),
        _ => hit_a.x > hit_b.x,
    }
}

/// Calls `found` for every crossing of `segment` with the horizontal line through `p` that lies strictly to the left of `p`.
pub fn crossings_left(segment: &Segment, p: Point, mut found: impl FnMut(Hit)) {
    match segment {
        Segment::Line(l) => line_crossing(l, p).into_iter().for_each(&mut found),
        Segment::Arc(a) => arc_crossings(a, p, &mut found),
    }
}

fn line_crossing(l: &Line, p: Point) -> Option<Hit> {
    let upward = l.end.y > p.y;
    if (l.start.y > p.y) == upward {
        return None;
    }
    let side = orientation(l.start, l.end, p);
    let to_the_right = if upward { side < 0.0 } else { side > 0.0 };
    let t = (p.y - l.start.y) / (l.end.y - l.start.y);
    to_the_right.then(|| match end_at(l.start, l.end, p.y) {
        Some((x, end)) => Hit { x, upward, end: Some(end) },
        None => Hit { x: l.start.x + t * (l.end.x - l.start.x), upward, end: None },
    })
}

/// The end that lies on the horizontal line, if the crossing with it does.
fn end_at(start: Point, end: Point, y: f64) -> Option<(f64, End)> {
    if start.y == y {
        Some((start.x, End::Start))
    } else if end.y == y {
        Some((end.x, End::End))
    } else {
        None
    }
}

/// Splits the arc where its direction turns from up to down: between those points each piece crosses at most once.
fn arc_crossings(a: &Arc, p: Point, found: &mut impl FnMut(Hit)) {
    if p.x < a.center.x - a.radius && p.x < a.start.x.min(a.end.x) {
        return;
    }
    let mut from = (a.start.y, Some(End::Start));
    let (mut on_right, passes) = halves(a);
    for _ in 0..passes {
        let rises = on_right == a.ccw;
        let to = (if rises { a.center.y + a.radius } else { a.center.y - a.radius }, None);
        piece_crossing(a, from, to, on_right, p, found);
        from = to;
        on_right = !on_right;
    }
    piece_crossing(a, from, (a.end.y, Some(End::End)), on_right, p, found);
}

/// The crossing with a monotone piece between two heights, each perhaps an end of the arc.
fn piece_crossing(
    a: &Arc,
    from: (f64, Option<End>),
    to: (f64, Option<End>),
    on_right: bool,
    p: Point,
    found: &mut impl FnMut(Hit),
) {
    let upward = to.0 > p.y;
    if (from.0 > p.y) == upward {
        return;
    }
    let end = [from, to].into_iter().filter(|e| e.0 == p.y).find_map(|e| e.1);
    let height = p.y - a.center.y;
    let half = ((a.radius - height) * (a.radius + height)).max(0.0).sqrt();
    let x = match end {
        Some(End::Start) => a.start.x,
        Some(End::End) => a.end.x,
        None if on_right => a.center.x + half,
        None => a.center.x - half,
    };
    if x < p.x {
        found(Hit { x, upward, end });
    }
}

/// Whether the arc begins in the right half of its circle, and how many times it passes the circle's top or bottom
/// on its way (ends that lie there don't count). Decided by signs of exact differences.
fn halves(a: &Arc) -> (bool, usize) {
    let (s, e) = (a.start - a.center, a.end - a.center);
    let starts_right = s.x > 0.0 || (s.x == 0.0 && (s.y < 0.0) == a.ccw);
    let ends_right = e.x > 0.0 || (e.x == 0.0 && (e.y > 0.0) == a.ccw);
    let turn = s.cross(e);
    let passes = match (starts_right == ends_right, turn == 0.0 || (turn > 0.0) == a.ccw) {
        (false, _) => 1,
        (true, true) => 0,
        (true, false) => 2,
    };
    (starts_right, passes)
}

/// The point of the segment with the smallest abscissa.
pub fn leftmost(segment: &Segment) -> Point {
    let ends = if segment.start().x <= segment.end().x { segment.start() } else { segment.end() };
    match segment {
        Segment::Arc(a) if a.spans(vec2(-1.0, 0.0)) && a.center.x - a.radius < ends.x => {
            point(a.center.x - a.radius, a.center.y)
        }
        _ => ends,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(segments: &[Segment], p: Point) -> usize {
        let mut n = 0;
        for s in segments {
            crossings_left(s, p, |_| n += 1);
        }
        n
    }

    #[test]
    fn parity_of_a_circle_at_its_extremes_and_joints() {
        let circle = |k: usize| {
            let at = |j: usize| Point::ORIGIN + crate::Vec2::from_angle(std::f64::consts::TAU * j as f64 / k as f64);
            let b = (std::f64::consts::FRAC_PI_2 / k as f64).tan();
            (0..k).map(|j| Segment::from_bulge(at(j), at((j + 1) % k), b)).collect::<Vec<_>>()
        };
        for k in 2..9 {
            for s in [circle(k), circle(k).iter().rev().map(Segment::reversed).collect()] {
                for y in [-2.0, -1.0, -0.7, 0.0, 0.3, 1.0, 1.5] {
                    assert_eq!(count(&s, point(5.0, y)) % 2, 0, "{k} {y}");
                    if y.abs() < 0.9 {
                        assert_eq!(count(&s, point(0.0, y)) % 2, 1, "{k} {y}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_half_circle_between_its_extremes_is_crossed_once() {
        let (top, bottom) = (point(3.125, 53.125), point(3.125, 46.875));
        for (arc, x) in [(Segment::from_bulge(top, bottom, 1.0), 0.0), (Segment::from_bulge(bottom, top, 1.0), 6.25)] {
            for s in [arc, arc.reversed()] {
                let mut hits = Vec::new();
                crossings_left(&s, point(12.5, 50.0), |h| hits.push(h.x));
                assert_eq!(hits, [x]);
            }
        }
    }

    #[test]
    fn a_line_through_a_vertex_counts_once() {
        let (a, b, c) = (point(0.0, 0.0), point(1.0, 1.0), point(0.0, 2.0));
        let chain = [Segment::line(a, b), Segment::line(b, c)];
        assert_eq!(count(&chain, point(3.0, 1.0)), 1);
        assert_eq!(count(&chain, point(0.5, 1.0)), 0);
    }
}
