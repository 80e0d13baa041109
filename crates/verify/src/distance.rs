//! Distances between lines and arcs in closed form.
//!
//! The least distance of two curves is 0 where they cross, or is taken at an end of one of them, or where both have the
//! same normal: between two arcs on the line of their centres, between a line and an arc at the line's point nearest the
//! centre. Every such place is looked at, nothing is sampled.

use pocketry_geom::{Arc, Line, Point, Segment, Vec2};

/// The least distance between two closed segments.
pub(crate) fn between(a: &Segment, b: &Segment) -> f64 {
    let ends = b.distance(a.start()).min(b.distance(a.end())).min(a.distance(b.start())).min(a.distance(b.end()));
    match (a, b) {
        (Segment::Line(k), Segment::Line(l)) if lines_cross(k, l) => 0.0,
        (Segment::Line(_), Segment::Line(_)) => ends,
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => ends.min(line_to_arc(l, c)),
        (Segment::Arc(c), Segment::Arc(d)) => ends.min(arc_to_arc(c, d)),
    }
}

/// The point of `a` nearest to `b`.
pub(crate) fn place(a: &Segment, b: &Segment) -> Point {
    let mut candidates = vec![a.start(), a.end(), a.nearest(b.start()), a.nearest(b.end())];
    crossings(a, b, &mut candidates);
    if let Segment::Arc(arc) = b {
        candidates.push(a.nearest(arc.center));
    }
    if let Segment::Arc(own) = a {
        candidates.push(own.nearest(b.nearest(own.center)));
        if let Segment::Arc(arc) = b {
            candidates.push(own.center + (own.center - arc.center).normalized() * own.radius);
        }
    }
    candidates.retain(|p| p.is_finite() && a.distance(*p) <= own_rounding(a));
    candidates.into_iter().min_by(|p, q| b.distance(*p).total_cmp(&b.distance(*q))).unwrap_or_else(|| a.start())
}

/// How far a computed point of `a` may lie from it by rounding alone.
fn own_rounding(a: &Segment) -> f64 {
    let b = a.bbox();
    let largest = [b.min.x, b.min.y, b.max.x, b.max.y].into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    pocketry_geom::tolerance::proof::ROUNDING * largest
}

/// Adds the points that two segments have in common (overlapping stretches have none).
pub(crate) fn crossings(a: &Segment, b: &Segment, out: &mut Vec<Point>) {
    match (a, b) {
        (Segment::Line(k), Segment::Line(l)) => {
            if lines_cross(k, l) {
                let (u, v) = (k.end - k.start, l.end - l.start);
                out.push(k.start + u * ((l.start - k.start).cross(v) / u.cross(v)));
            }
        }
        (Segment::Line(l), Segment::Arc(c)) | (Segment::Arc(c), Segment::Line(l)) => {
            out.extend(line_circle(l, c).into_iter().flatten().filter(|&p| c.spans(p - c.center)));
        }
        (Segment::Arc(c), Segment::Arc(d)) => {
            let points = circle_circle(c, d).into_iter().flatten();
            out.extend(points.filter(|&p| c.spans(p - c.center) && d.spans(p - d.center)));
        }
    }
}

/// Whether two segments cross in a point inside both.
fn lines_cross(k: &Line, l: &Line) -> bool {
    let (u, v) = (k.end - k.start, l.end - l.start);
    let sides = |along: Vec2, p: Vec2, q: Vec2| (along.cross(p) > 0.0) != (along.cross(q) > 0.0);
    u.cross(v) != 0.0 && sides(u, l.start - k.start, l.end - k.start) && sides(v, k.start - l.start, k.end - l.start)
}

/// The distance at the line's foot of the arc's centre, 0 where they cross, infinite where neither happens.
fn line_to_arc(l: &Line, c: &Arc) -> f64 {
    let foot = l.nearest(c.center);
    let outward = foot - c.center;
    let gap = outward.length() - c.radius;
    if gap > 0.0 {
        return if c.spans(outward) { c.radial_distance(foot) } else { f64::INFINITY };
    }
    let crosses = line_circle(l, c).into_iter().flatten().any(|p| c.spans(p - c.center));
    if crosses { 0.0 } else { f64::INFINITY }
}

/// The points of the closed segment `l` on the circle of `c`.
fn line_circle(l: &Line, c: &Arc) -> [Option<Point>; 2] {
    let along = l.end - l.start;
    let from = l.start - c.center;
    let (qa, qb) = (along.length_squared(), along.dot(from));
    let height = along.cross(from);
    let inside = qa * c.radius * c.radius - height * height;
    if inside < 0.0 || qa == 0.0 {
        return [None; 2];
    }
    let root = inside.sqrt();
    [(-qb - root) / qa, (-qb + root) / qa].map(|t| (0.0..=1.0).contains(&t).then(|| l.start + along * t))
}

/// The distance along the line of centres, 0 where the arcs cross, infinite where neither happens.
fn arc_to_arc(c: &Arc, d: &Arc) -> f64 {
    let between = d.center - c.center;
    let apart = between.length();
    if apart == 0.0 {
        return f64::INFINITY;
    }
    if apart >= c.radius + d.radius {
        let faces = c.spans(between) && d.spans(-between);
        return if faces { apart - c.radius - d.radius } else { f64::INFINITY };
    }
    if apart <= (c.radius - d.radius).abs() {
        let towards = if c.radius > d.radius { between } else { -between };
        let faces = c.spans(towards) && d.spans(towards);
        return if faces { (c.radius - d.radius).abs() - apart } else { f64::INFINITY };
    }
    let mut points = circle_circle(c, d).into_iter().flatten();
    if points.any(|p| c.spans(p - c.center) && d.spans(p - d.center)) { 0.0 } else { f64::INFINITY }
}

/// The points that the circles of two arcs share.
fn circle_circle(c: &Arc, d: &Arc) -> [Option<Point>; 2] {
    let between = d.center - c.center;
    let apart = between.length();
    if apart == 0.0 || apart > c.radius + d.radius || apart < (c.radius - d.radius).abs() {
        return [None; 2];
    }
    let along = 0.5 * (apart + (c.radius - d.radius) * (c.radius + d.radius) / apart);
    let across = (c.radius * c.radius - along * along).max(0.0).sqrt();
    let unit = between / apart;
    let middle = c.center + unit * along;
    [Some(middle + unit.left() * across), Some(middle - unit.left() * across)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;
    use proptest::prelude::*;

    fn segment() -> impl Strategy<Value = Segment> {
        let c = || -10.0..10.0;
        (c(), c(), c(), c(), prop_oneof![Just(0.0), -2.0..2.0])
            .prop_filter("no tiny bulge", |s| s.4 == 0.0 || f64::abs(s.4) > 1e-3)
            .prop_map(|(a, b, c, d, bulge)| Segment::from_bulge(point(a, b), point(c, d), bulge))
    }

    fn sampled(a: &Segment, b: &Segment) -> f64 {
        (0..=2000).map(|k| b.distance(a.at(f64::from(k) / 2000.0))).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        #[test]
        fn never_above_and_hardly_below_what_sampling_finds(a in segment(), b in segment()) {
            let exact = between(&a, &b);
            let found = sampled(&a, &b);
            let step = a.length() / 2000.0;
            prop_assert!(exact <= found + 1e-9, "{exact} {found}");
            prop_assert!(exact >= found - step, "{exact} {found}");
            prop_assert!((exact - between(&b, &a)).abs() < 1e-9);
            prop_assert!((b.distance(place(&a, &b)) - exact).abs() < 1e-7);
        }
    }
}
