//! Where two segments meet: ends on one another, tangencies, crossings.
//!
//! Everything closer than a given touch length is one place. Between two contacts whose curves stay that close (a shallow
//! lens at a tangency, a stretch that both share) only the ends of segments count, or the middle of the lens.

use crate::point::{Point, Vec2};
use crate::predicates::lines_cross;
use crate::segment::{Arc, Line, Segment};

/// Where on a segment a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// At its start.
    Start,
    /// At its end.
    End,
    /// Between.
    Inside,
}

/// A place where two segments meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// An end of the first segment (its start if `start`) lies on the second one.
    FirstEnd {
        /// Whether it is the first segment's start.
        start: bool,
        /// Where it lies on the second one.
        on: Position,
    },
    /// An end of the second segment (its start if `start`) lies inside the first one.
    SecondEnd {
        /// Whether it is the second segment's start.
        start: bool,
    },
    /// Both touch here in their insides without crossing.
    Tangent(Point),
    /// Both cross here in their insides.
    Crossing {
        /// Where.
        at: Point,
        /// Whether between here and another contact of the two they stay within the lens length of each other.
        shallow: bool,
    },
}

/// How close is close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closeness {
    /// What lies closer than this is one place, mm.
    pub touch: f64,
    /// Crossings are shallow where the lens that they bound is no wider than this, mm.
    pub lens: f64,
}

/// Points on both segments within the touch length, at most one for each end.
#[derive(Default)]
struct Ends {
    points: [Point; 4],
    count: usize,
}

impl Ends {
    fn push(&mut self, p: Point) {
        self.points[self.count] = p;
        self.count += 1;
    }

    fn iter(&self) -> impl Iterator<Item = Point> + '_ {
        self.points[..self.count].iter().copied()
    }
}

/// Calls `found` for every contact of two segments.
pub fn contacts(a: &Segment, b: &Segment, closeness: Closeness, mut found: impl FnMut(Contact)) {
    let touch = closeness.touch;
    let ends = end_contacts(a, b, touch, &mut found);
    match (a, b) {
        (Segment::Line(l), Segment::Line(m)) => {
            if ends.count == 0 && lines_cross(l.start, l.end, m.start, m.end) {
                found(Contact::Crossing { at: crossing_of_lines(l, m), shallow: false });
            }
        }
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => {
            report(a, b, &line_and_circle(l, c, touch), &ends, closeness, &mut found);
        }
        (Segment::Arc(c), Segment::Arc(d)) => {
            report(a, b, &circle_and_circle(c, d, touch), &ends, closeness, &mut found);
        }
    }
}

/// Whether two segments cross or touch in their insides, to rounding.
pub fn meet(a: &Segment, b: &Segment) -> bool {
    let on_both = |p: Point| lies_inside(a, p) && lies_inside(b, p);
    let common = match (a, b) {
        (Segment::Line(l), Segment::Line(m)) => return lines_cross(l.start, l.end, m.start, m.end),
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => line_and_circle(l, c, 0.0),
        (Segment::Arc(c), Segment::Arc(d)) => circle_and_circle(c, d, 0.0),
    };
    match common {
        Common::None => false,
        Common::One(p) => on_both(p),
        Common::Two(p, q) => on_both(p) || on_both(q),
    }
}

fn end_contacts(a: &Segment, b: &Segment, touch: f64, found: &mut impl FnMut(Contact)) -> Ends {
    let mut ends = Ends::default();
    let mut met = [false; 2];
    for start in [true, false] {
        let p = if start { a.start() } else { a.end() };
        let on = if p.distance(b.start()) <= touch {
            met[0] = true;
            Position::Start
        } else if p.distance(b.end()) <= touch {
            met[1] = true;
            Position::End
        } else if b.distance(p) <= touch {
            Position::Inside
        } else {
            continue;
        };
        ends.push(p);
        found(Contact::FirstEnd { start, on });
    }
    for (start, met) in [(true, met[0]), (false, met[1])] {
        let p = if start { b.start() } else { b.end() };
        if !met && a.distance(p) <= touch {
            ends.push(p);
            found(Contact::SecondEnd { start });
        }
    }
    ends
}

/// What the whole line and circle, or two whole circles, have in common.
enum Common {
    /// Nothing, or all.
    None,
    /// A tangency.
    One(Point),
    /// Two crossings.
    Two(Point, Point),
}

fn report(
    a: &Segment,
    b: &Segment,
    common: &Common,
    ends: &Ends,
    closeness: Closeness,
    found: &mut impl FnMut(Contact),
) {
    let counts = |p: Point| {
        let apart = |e: Point| !stay_close(a, b, p, e, closeness.touch);
        lies_inside(a, p) && lies_inside(b, p) && ends.iter().all(apart)
    };
    match *common {
        Common::None => {}
        Common::One(p) => {
            if counts(p) {
                found(Contact::Tangent(p));
            }
        }
        Common::Two(p, q) => {
            let crossings = [p, q].map(|p| Some(p).filter(|&p| counts(p)));
            for (k, at) in (0..).zip(crossings).filter_map(|(k, p)| Some((k, p?))) {
                let mut others = ends.iter().chain(crossings[1 - k]);
                let shallow = others.any(|other| stay_close(a, b, at, other, closeness.lens));
                found(Contact::Crossing { at, shallow });
            }
        }
    }
}

/// Whether the two stay within reach of each other between two points on both.
fn stay_close(a: &Segment, b: &Segment, p: Point, q: Point, reach: f64) -> bool {
    p.distance(q) <= 4.0 * reach || leads_along(a, b, p, q, reach) || leads_along(b, a, p, q, reach)
}

/// Whether the middle of `a` between two points lies within reach of `b`.
fn leads_along(a: &Segment, b: &Segment, p: Point, q: Point, reach: f64) -> bool {
    let middle = match a {
        Segment::Line(_) => p.midpoint(q),
        Segment::Arc(arc) => middle_of_arc(arc, p, q),
    };
    b.distance(middle) <= 2.0 * reach
}

/// The middle of the shorter way from `p` to `q` on the arc's circle; accurate for any radius.
fn middle_of_arc(arc: &Arc, p: Point, q: Point) -> Point {
    let chord_middle = p.midpoint(q);
    let half = 0.5 * p.distance(q);
    let rest = ((arc.radius - half) * (arc.radius + half)).max(0.0).sqrt();
    let outward = chord_middle - arc.center;
    let length = outward.length();
    if length > 0.0 {
        chord_middle + outward * (half * half / (arc.radius + rest) / length)
    } else {
        Segment::Arc(*arc).at(0.5)
    }
}

/// Whether a point of the segment's line or circle lies between its ends.
fn lies_inside(s: &Segment, p: Point) -> bool {
    match s {
        Segment::Line(l) => {
            let along = l.end - l.start;
            (p - l.start).dot(along) > 0.0 && (p - l.end).dot(along) < 0.0
        }
        Segment::Arc(a) => a.spans(p - a.center),
    }
}

fn crossing_of_lines(l: &Line, m: &Line) -> Point {
    let (along, other) = (l.end - l.start, m.end - m.start);
    let t = (m.start - l.start).cross(other) / along.cross(other);
    l.start.lerp(l.end, t.clamp(0.0, 1.0))
}

/// All is seen from the arc's start, a point of the circle, so that huge radii don't cost accuracy.
fn line_and_circle(l: &Line, arc: &Arc, touch: f64) -> Common {
    let along = (l.end - l.start).normalized();
    common_of_line(l.start - arc.start, along, arc, touch)
}

/// Line through `from` (seen from the arc's start) along a unit direction.
fn common_of_line(from: Vec2, along: Vec2, arc: &Arc, touch: f64) -> Common {
    let to_center = arc.center - arc.start;
    let b = (from - to_center).dot(along);
    let c = from.dot(from - to_center * 2.0);
    let height = along.cross(to_center - from).abs();
    let square = (arc.radius - height) * (arc.radius + height);
    let place = |t: f64| arc.start + from + along * t;
    if (arc.radius - height).abs() <= touch {
        Common::One(place(-b))
    } else if square < 0.0 {
        Common::None
    } else {
        let far = -(b + square.sqrt().copysign(b));
        Common::Two(place(far), place(c / far))
    }
}

fn circle_and_circle(a: &Arc, b: &Arc, touch: f64) -> Common {
    let between = b.center - a.center;
    let distance = between.length();
    if distance <= touch {
        return Common::None;
    }
    let outside = distance - (a.radius + b.radius);
    let inside = distance - (a.radius - b.radius).abs();
    let axis = between / distance;
    if outside > touch || inside < -touch {
        Common::None
    } else if outside >= -touch {
        Common::One(a.center + axis * (a.radius + 0.5 * outside))
    } else if inside <= touch {
        let (large, axis) = if a.radius >= b.radius { (a, axis) } else { (b, -axis) };
        Common::One(large.center + axis * (large.radius + 0.5 * inside))
    } else {
        let to_second = b.start - a.start;
        let offset = to_second.dot(to_second + (b.center - b.start) * 2.0) / (2.0 * distance);
        common_of_line(axis * offset, axis.left(), a, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::point;

    fn all(a: &Segment, b: &Segment) -> Vec<Contact> {
        let mut out = Vec::new();
        contacts(a, b, Closeness { touch: 1e-9, lens: 1e-3 }, |c| out.push(c));
        out
    }

    fn arc(x: f64, y: f64, u: f64, v: f64, bulge: f64) -> Segment {
        Segment::from_bulge(point(x, y), point(u, v), bulge)
    }

    #[test]
    fn a_line_tangent_to_an_arc_touches_once() {
        let a = arc(-10.0, 10.0, 10.0, 10.0, 1.0);
        for dy in [0.0, 3e-10, -3e-10] {
            let found = all(&Segment::line(point(-30.0, dy), point(40.0, dy)), &a);
            assert!(matches!(found[..], [Contact::Tangent(p)] if p.distance(point(0.0, 0.0)) < 1e-8), "{found:?}");
        }
        assert!(all(&Segment::line(point(-30.0, -1e-8), point(40.0, -1e-8)), &a).is_empty());
        let shallow = all(&Segment::line(point(-30.0, 1e-8), point(40.0, 1e-8)), &a);
        assert!(matches!(
            shallow[..],
            [Contact::Crossing { shallow: true, .. }, Contact::Crossing { shallow: true, .. }]
        ));
        let deep = all(&Segment::line(point(-30.0, 0.1), point(40.0, 0.1)), &a);
        assert!(matches!(
            deep[..],
            [Contact::Crossing { shallow: false, .. }, Contact::Crossing { shallow: false, .. }]
        ));
    }

    #[test]
    fn tangent_joints_meet_only_at_the_joint() {
        let l = Segment::line(point(-30.0, 1e-12), point(0.0, 0.0));
        for far in [arc(0.0, 0.0, 10.0, 10.0, (std::f64::consts::PI / 8.0).tan()), arc(0.0, 0.0, 0.0, 20.0, 1.0)] {
            assert_eq!(all(&l, &far), [Contact::FirstEnd { start: false, on: Position::Start }]);
        }
    }

    #[test]
    fn arcs_touch_from_outside_and_inside() {
        let big = arc(0.0, -50.0, 0.0, 50.0, 1.0);
        for small in [arc(60.0, -10.0, 60.0, 10.0, -1.0), arc(40.0, -10.0, 40.0, 10.0, 1.0)] {
            for (a, b) in [(&big, &small), (&small, &big)] {
                let found = all(a, b);
                assert!(matches!(found[..], [Contact::Tangent(p)] if p.distance(point(50.0, 0.0)) < 1e-9), "{found:?}");
            }
        }
        let crossing = all(&big, &arc(45.0, -10.0, 45.0, 10.0, 1.0));
        assert_eq!(crossing.len(), 2);
        for c in crossing {
            assert!(matches!(c, Contact::Crossing { at: p, .. } if (p.to_vec().length() - 50.0).abs() < 1e-12));
        }
    }

    #[test]
    fn nearly_flat_arcs_cross_where_they_should() {
        let flat = arc(0.0, 0.0, 100.0, 0.0, 1e-8);
        let found = all(&flat, &Segment::line(point(30.0, -1.0), point(30.0, 1.0)));
        assert!(
            matches!(found[..], [Contact::Crossing { at: p, .. }] if p.distance(point(30.0, 0.0)) < 1e-6),
            "{found:?}"
        );
    }

    #[test]
    fn pieces_of_one_circle_meet_only_at_ends() {
        let half = arc(10.0, 0.0, -10.0, 0.0, 1.0);
        let Segment::Arc(circle) = half else { unreachable!() };
        let part = Segment::Arc(Arc { start: point(0.0, 10.0), end: point(0.0, -10.0), ..circle });
        let expected = [Contact::FirstEnd { start: false, on: Position::Inside }, Contact::SecondEnd { start: true }];
        assert_eq!(all(&half, &part), expected);
    }
}
