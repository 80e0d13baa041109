//! Free-form curves become chains of lines and arcs.
//!
//! A chain of rational Bézier curves is walked greedily: the longest stretch whose biarc (two arcs that share a tangent
//! where they meet, and the curve's own tangents at the stretch's ends) stays within the tolerance is taken, and so on.
//! Where the curve is smooth so is the chain; corners stay corners.
//!
//! **The error is certified, not sampled.** With an arc about `c` of radius `r`, a point `P / w` of the curve satisfies
//! `(|P/w − c|² − r²) = N / w²`, where `N` and `w²` are polynomials whose Bernstein coefficients bound their ratio. The curve
//! is cut where it crosses the normal of the biarc's joint, so that each part runs within its arc's own sector; the
//! curve then meets every ray of the sector, and the bound holds both ways (Hausdorff distance).

use super::bezier::{Bezier, Weighted};
use pocketry_geom::{Arc, Point, Segment, Vec2, tolerance};

/// A chain of lines and arcs in place of a curve.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    /// The chain, from the curve's start to its end.
    pub(crate) segments: Vec<Segment>,
    /// No point of the chain lies farther than this from the curve, nor the other way round, mm.
    pub(crate) error: f64,
}

/// Lines and arcs within `tolerance` mm of a chain of curves, each of which starts where the one before ends.
///
/// A tolerance below what the numbers themselves can tell is raised to that.
pub(crate) fn fit(chain: &[Bezier], tolerance: f64) -> Fitted {
    let mut fitted = Fitted { segments: Vec::new(), error: 0.0 };
    let Some(first) = chain.first() else { return fitted };
    let origin = first.start().to_vec();
    let local: Vec<Bezier> = chain.iter().map(|b| shifted(b, -origin)).collect();
    let extent = local.iter().flat_map(Bezier::places).fold(0.0, |e: f64, p| e.max(p.to_vec().length()));
    let tolerance = tolerance.max(tolerance::COORDINATE_ROUNDOFF * extent / tolerance::STRAIGHT_SHARE);
    let mut from = 0;
    for k in 1..=local.len() {
        if k == local.len() || is_corner(&local[k - 1], &local[k]) {
            fit_smooth(&local[from..k], tolerance, &mut fitted);
            from = k;
        }
    }
    for segment in &mut fitted.segments {
        *segment = segment.translated(origin);
    }
    let end = chain[chain.len() - 1].end();
    weld(&mut fitted.segments, first.start(), end);
    fitted
}

/// Makes each segment start exactly where the one before ends, the first at `start` and the last end at `end`.
pub(crate) fn weld(segments: &mut [Segment], start: Point, end: Point) {
    let count = segments.len();
    let mut at = start;
    for (k, segment) in segments.iter_mut().enumerate() {
        let to = if k + 1 == count { end } else { segment.end() };
        *segment = match *segment {
            Segment::Line(_) => Segment::line(at, to),
            Segment::Arc(a) => Segment::Arc(Arc { start: at, end: to, ..a }),
        };
        at = to;
    }
}

fn shifted(curve: &Bezier, by: Vec2) -> Bezier {
    Bezier { points: curve.points.iter().map(|p| Weighted { xy: p.xy + by * p.w, w: p.w }).collect() }
}

fn is_corner(before: &Bezier, after: &Bezier) -> bool {
    match (before.end_tangent(), after.start_tangent()) {
        (Some(a), Some(b)) => a.angle_to(b).abs() > tolerance::KINK,
        _ => true,
    }
}

/// Greedy walk along a chain without corners; the position is the number of whole curves behind plus a parameter.
fn fit_smooth(chain: &[Bezier], tolerance: f64, out: &mut Fitted) {
    let end = chain.len() as f64;
    let (mut at, mut stride) = (0.0, 1.0_f64);
    while at < end {
        let (to, piece) = longest(chain, at, stride, tolerance);
        out.error = out.error.max(piece.error);
        out.segments.extend(piece.segments);
        stride = to - at;
        at = to;
    }
}

/// The farthest position that one biarc (or line) from `at` can reach, but for a small share, and that biarc.
fn longest(chain: &[Bezier], at: f64, stride: f64, tolerance: f64) -> (f64, Fitted) {
    const REFINEMENTS: usize = 7;
    let attempt = |to: f64| Some((to, approximate(&extract(chain, at, to), tolerance)?));
    let first = (at + stride).min(chain.len() as f64);
    let (mut best, mut bad) = match attempt(first) {
        Some(good) => grown(good, at, chain.len() as f64, attempt),
        None => shrunk(chain, at, first, attempt),
    };
    for _ in 0..REFINEMENTS {
        let low = best.0;
        if bad - low <= f64::EPSILON * bad {
            break;
        }
        match attempt(0.5 * (low + bad)) {
            Some(good) => best = good,
            None => bad = 0.5 * (low + bad),
        }
    }
    best
}

/// Doubles a stride that fits until it doesn't; the best that does, and where it doesn't.
fn grown(
    mut good: (f64, Fitted),
    at: f64,
    end: f64,
    attempt: impl Fn(f64) -> Option<(f64, Fitted)>,
) -> ((f64, Fitted), f64) {
    while good.0 < end {
        let to = (at + 2.0 * (good.0 - at)).min(end);
        match attempt(to) {
            Some(better) => good = better,
            None => return (good, to),
        }
    }
    (good, end)
}

/// Halves a stride that doesn't fit until it does; a step too small to be told from none is taken straight.
fn shrunk(
    chain: &[Bezier],
    at: f64,
    mut bad: f64,
    attempt: impl Fn(f64) -> Option<(f64, Fitted)>,
) -> ((f64, Fitted), f64) {
    let smallest = 2.0 * f64::EPSILON * chain.len() as f64;
    loop {
        let to = at + 0.5 * (bad - at);
        if to - at <= smallest {
            let to = (at + smallest).min(chain.len() as f64);
            return ((to, chord(&extract(chain, at, to))), to);
        }
        if let Some(good) = attempt(to) {
            return (good, bad);
        }
        bad = to;
    }
}

/// The stretch of a chain between two positions, as curves of their own.
fn extract(chain: &[Bezier], from: f64, to: f64) -> Vec<Bezier> {
    let last = (to.ceil() as usize).max(1) - 1;
    (from.floor() as usize..=last.min(chain.len() - 1))
        .filter_map(|k| {
            let (a, b) = ((from - k as f64).max(0.0), (to - k as f64).min(1.0));
            (a < b).then(|| chain[k].part(a, b))
        })
        .collect()
}

/// One line, one arc or one biarc for a stretch, if it stays within tolerance.
fn approximate(stretch: &[Bezier], tolerance: f64) -> Option<Fitted> {
    let (first, last) = (stretch.first()?, stretch.last()?);
    let straight = chord(stretch);
    if straight.error <= tolerance * tolerance::STRAIGHT_SHARE {
        return Some(straight);
    }
    biarc_of(stretch, first, last, tolerance).or((straight.error <= tolerance).then_some(straight))
}

fn biarc_of(stretch: &[Bezier], first: &Bezier, last: &Bezier, tolerance: f64) -> Option<Fitted> {
    let (p0, p1) = (first.start(), last.end());
    let (t0, t1) = (first.start_tangent()?, last.end_tangent()?);
    let joint = joint(p0, t0, p1, t1)?;
    let flat = tolerance * tolerance::STRAIGHT_SHARE;
    let before = from_tangent(p0, t0, joint, flat)?;
    let after = from_tangent(p1, -t1, joint, flat)?.reversed();
    if let Some(one) = merged(&before, &after, flat) {
        let error = stretch.iter().try_fold(0.0, |worst: f64, b| Some(worst.max(deviation(b, &one, tolerance, 3)?)))?;
        return Some(Fitted { segments: vec![one], error });
    }
    let (head, tail) = cut(stretch, joint, (before.end_tangent() + after.start_tangent()).normalized());
    let worst = |part: &[Bezier], segment: &Segment| {
        part.iter().try_fold(0.0, |worst: f64, b| Some(worst.max(deviation(b, segment, tolerance, 3)?)))
    };
    let error = worst(&head, &before)?.max(worst(&tail, &after)?);
    Some(Fitted { segments: vec![before, after], error })
}

/// The straight chord of a stretch, its error bounded by the control points' hull.
fn chord(stretch: &[Bezier]) -> Fitted {
    let (Some(first), Some(last)) = (stretch.first(), stretch.last()) else {
        return Fitted { segments: Vec::new(), error: 0.0 };
    };
    let (start, end) = (first.start(), last.end());
    let line = Segment::line(start, end);
    let error = stretch.iter().flat_map(Bezier::places).map(|p| line.distance(p)).fold(0.0, f64::max);
    let segments = if start == end { Vec::new() } else { vec![line] };
    Fitted { segments, error }
}

/// Where the two arcs of the biarc with equal tangent lengths meet.
fn joint(p0: Point, t0: Vec2, p1: Point, t1: Vec2) -> Option<Point> {
    let v = p1 - p0;
    let along = v.dot(t0 + t1);
    let spread = 2.0 * (1.0 - t0.dot(t1)).max(0.0);
    let reach = v.length_squared() / (along + (along * along + spread * v.length_squared()).sqrt());
    let joint = p0.midpoint(p1) + (t0 - t1) * (0.5 * reach);
    (reach > 0.0 && joint.is_finite() && joint != p0 && joint != p1).then_some(joint)
}

/// The arc from `start` in direction `tangent` to `end`; a line where it bows less than `flat`.
fn from_tangent(start: Point, tangent: Vec2, end: Point, flat: f64) -> Option<Segment> {
    let w = end - start;
    let bow = tangent.cross(w);
    if 0.5 * bow.abs() <= flat {
        return (tangent.dot(w) > 0.0).then_some(Segment::line(start, end));
    }
    let signed_radius = 0.5 * w.length_squared() / bow;
    let center = start + tangent.left() * signed_radius;
    let arc = Arc { start, end, center, radius: signed_radius.abs(), ccw: bow > 0.0 };
    (center.is_finite() && arc.sweep().abs() < std::f64::consts::PI).then_some(Segment::Arc(arc))
}

/// One arc in place of two of the same circle.
fn merged(before: &Segment, after: &Segment, flat: f64) -> Option<Segment> {
    let (Segment::Arc(a), Segment::Arc(b)) = (before, after) else { return None };
    let same = a.ccw == b.ccw && a.center.distance(b.center) + (a.radius - b.radius).abs() <= flat;
    let one = Arc { end: b.end, ..*a };
    (same && one.sweep().abs() < std::f64::consts::PI).then_some(Segment::Arc(one))
}

/// The parts of a stretch before and after it crosses the normal through the joint.
fn cut(stretch: &[Bezier], joint: Point, tangent: Vec2) -> (Vec<Bezier>, Vec<Bezier>) {
    const HALVINGS: usize = 40;
    let ahead = |p: Point| (p - joint).dot(tangent) >= 0.0;
    let k = stretch.iter().position(|b| ahead(b.end())).unwrap_or(stretch.len() - 1);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if ahead(stretch[k].at(middle)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    let (left, right) = stretch[k].split(0.5 * (low + high));
    let head = stretch[..k].iter().cloned().chain([left]).collect();
    let tail = std::iter::once(right).chain(stretch[k + 1..].iter().cloned()).collect();
    (head, tail)
}

/// A bound on the distance between a curve and the segment that stands for it, if it is within `tolerance`.
fn deviation(curve: &Bezier, segment: &Segment, tolerance: f64, depth: usize) -> Option<f64> {
    let slack = tolerance * tolerance::STRAIGHT_SHARE;
    let bound = match segment {
        Segment::Line(l) => {
            let direction = l.direction();
            let length = (l.end - l.start).length();
            let outside = curve.places().any(|p| {
                let along = (p - l.start).dot(direction);
                along < -slack || along > length + slack
            });
            let off = curve.places().map(|p| direction.cross(p - l.start).abs()).fold(0.0, f64::max);
            if outside { f64::INFINITY } else { off }
        }
        Segment::Arc(a) if !in_sector(curve, a, slack) => f64::INFINITY,
        Segment::Arc(a) => radial_bound(curve, a),
    };
    if bound + slack <= tolerance {
        return Some(bound + slack);
    }
    if depth == 0 || segment.distance(curve.at(0.5)) > tolerance {
        return None;
    }
    let (left, right) = curve.split(0.5);
    let left = deviation(&left, segment, tolerance, depth - 1)?;
    Some(left.max(deviation(&right, segment, tolerance, depth - 1)?))
}

/// Whether the control points lie between the rays from the centre to the arc's ends, but for `slack`.
fn in_sector(curve: &Bezier, arc: &Arc, slack: f64) -> bool {
    let (mut from, mut to) = ((arc.start - arc.center).normalized(), (arc.end - arc.center).normalized());
    if !arc.ccw {
        std::mem::swap(&mut from, &mut to);
    }
    curve.places().all(|p| {
        let spoke = p - arc.center;
        from.cross(spoke) >= -slack && spoke.cross(to) >= -slack
    })
}

/// A bound on the curve's distance from the arc's circle, by the Bernstein coefficients of `|P − c w|² − r² w²` and `w²`.
fn radial_bound(curve: &Bezier, arc: &Arc) -> f64 {
    let degree = curve.points.len() - 1;
    let spoke = arc.center - arc.start;
    let from_start: Vec<(Vec2, f64)> = curve.points.iter().map(|p| (p.xy - arc.start.to_vec() * p.w, p.w)).collect();
    let choose = binomials(degree);
    let mut excess = vec![0.0; 2 * degree + 1];
    let mut weight = vec![0.0; 2 * degree + 1];
    for (i, &(e, w)) in from_start.iter().enumerate() {
        for (j, &(f, v)) in from_start.iter().enumerate() {
            let c = choose[i] * choose[j];
            excess[i + j] += c * (e.dot(f) - (e.dot(spoke) * v + f.dot(spoke) * w));
            weight[i + j] += c * w * v;
        }
    }
    let power = excess.iter().zip(&weight).map(|(e, w)| (e / w).abs()).fold(0.0, f64::max);
    let square = arc.radius * arc.radius;
    if power < square { power / (arc.radius + (square - power).sqrt()) } else { f64::INFINITY }
}

fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for k in 0..n {
        row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
    }
    row
}

/// The whole ellipse arc `center + u cos t + v sin t`, `t` from `from` over `sweep`, as curves cut at its axes' ends.
pub(crate) fn ellipse(center: Point, u: Vec2, v: Vec2, from: f64, sweep: f64) -> Vec<Bezier> {
    let turn = 0.5 * (2.0 * u.dot(v)).atan2(u.length_squared() - v.length_squared());
    let (sin, cos) = turn.sin_cos();
    let (major, minor) = (u * cos + v * sin, v * cos - u * sin);
    let quarter = std::f64::consts::FRAC_PI_2;
    let (start, end) = (from - turn, from - turn + sweep);
    let (low, high) = (start.min(end), start.max(end));
    let first = (low / quarter).floor() as i64 + 1;
    let mut angles = vec![low];
    angles.extend(
        (first..first + 5)
            .map(|k| k as f64 * quarter)
            .filter(|&a| a - low > tolerance::ANGLE && high - a > tolerance::ANGLE),
    );
    angles.push(high);
    if sweep < 0.0 {
        angles.reverse();
    }
    angles.windows(2).map(|w| Bezier::elliptic(center, major, minor, w[0], w[1])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::nurbs::Spline;
    use pocketry_geom::{Contour, point, vec2};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// Checks the promise of [`fit`] by samples on both sides; returns the chain.
    fn checked(chain: &[Bezier], tolerance: f64) -> Vec<Segment> {
        let fitted = fit(chain, tolerance);
        assert!(fitted.error <= tolerance, "{} > {tolerance}", fitted.error);
        let segments = fitted.segments;
        assert_eq!(segments[0].start(), chain[0].start());
        assert_eq!(segments[segments.len() - 1].end(), chain[chain.len() - 1].end());
        assert!(segments.windows(2).all(|w| w[0].end() == w[1].start()));
        let samples: Vec<Point> = chain.iter().flat_map(|b| (0..=400).map(|k| b.at(f64::from(k) / 400.0))).collect();
        let slack = 1e-9;
        for &p in &samples {
            let off = segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
            assert!(off <= tolerance + slack, "the curve is {off} away at {p:?}");
        }
        let step = samples.windows(2).map(|w| w[0].distance(w[1])).fold(0.0, f64::max);
        for p in segments.iter().flat_map(|s| (0..=20).map(|k| s.at(f64::from(k) / 20.0))) {
            let off = samples.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            assert!(off <= tolerance + step, "the chain is {off} away at {p:?}");
        }
        segments
    }

    fn largest_kink(segments: &[Segment]) -> f64 {
        let kink = |w: &[Segment]| w[0].end_tangent().angle_to(w[1].start_tangent()).abs();
        segments.windows(2).map(kink).fold(0.0, f64::max)
    }

    #[test]
    fn an_ellipse_takes_few_arcs_that_join_smoothly() {
        let quarters = ellipse(point(3.0, -2.0), vec2(0.0, 40.0), vec2(-20.0, 0.0), 0.3, TAU);
        let mut all = Vec::new();
        for quarter in &quarters {
            all.extend(checked(std::slice::from_ref(quarter), 1e-3));
        }
        assert!(all.len() <= 72, "{} arcs", all.len());
        assert!(largest_kink(&all) < 1e-5, "{}", largest_kink(&all));
        assert!((Contour::new(all).area() - 800.0 * TAU / 2.0).abs() < 0.1);
    }

    #[test]
    fn a_circle_written_as_a_rational_spline_becomes_its_own_arcs() {
        let half = 0.5_f64.sqrt();
        let (points, weights): (Vec<Point>, Vec<f64>) = [
            (5.0, 0.0, 1.0),
            (5.0, 5.0, half),
            (0.0, 5.0, 1.0),
            (-5.0, 5.0, half),
            (-5.0, 0.0, 1.0),
            (-5.0, -5.0, half),
            (0.0, -5.0, 1.0),
            (5.0, -5.0, half),
            (5.0, 0.0, 1.0),
        ]
        .iter()
        .map(|&(x, y, w)| (point(x, y), w))
        .unzip();
        let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0].to_vec();
        let chain = Spline { degree: 2, knots, points, weights }.to_beziers().unwrap();
        let segments = checked(&chain, 1e-3);
        assert!(segments.len() <= 4, "{} arcs", segments.len());
        for segment in &segments {
            let Segment::Arc(arc) = segment else { panic!("{segment:?} is no arc") };
            assert!((arc.radius - 5.0).abs() < 1e-9 && arc.center.distance(Point::ORIGIN) < 1e-9);
        }
    }

    #[test]
    fn a_straight_curve_is_one_line() {
        let curve = Bezier::polynomial(&[point(0.0, 0.0), point(1.0, 2.0), point(2.0, 4.0), point(5.0, 10.0)]);
        assert_eq!(fit(&[curve], 1e-3).segments, [Segment::line(point(0.0, 0.0), point(5.0, 10.0))]);
    }

    #[test]
    fn cusps_loops_and_points_are_survived() {
        let cusp = [point(0.0, 0.0), point(100.0, 60.0), point(0.0, 60.0), point(100.0, 0.0)];
        checked(&[Bezier::polynomial(&cusp)], 1e-3);
        let there_and_back = [point(0.0, 0.0), point(10.0, 0.0), point(10.0, 0.0), point(0.0, 0.0)];
        checked(&[Bezier::polynomial(&there_and_back)], 1e-3);
        let spot = [point(1.0, 1.0); 4];
        assert!(fit(&[Bezier::polynomial(&spot)], 1e-3).segments.is_empty());
        assert!(fit(&[], 1e-3).segments.is_empty());
    }

    #[test]
    fn corners_stay_corners() {
        let up = Bezier::polynomial(&[point(0.0, 0.0), point(1.0, 4.0), point(5.0, 5.0)]);
        let down = Bezier::polynomial(&[point(5.0, 5.0), point(5.0, 1.0), point(9.0, 0.0)]);
        let segments = checked(&[up, down], 1e-3);
        assert!(segments.iter().any(|s| s.end() == point(5.0, 5.0)));
    }

    #[test]
    fn the_place_of_a_curve_does_not_matter() {
        let points = [point(0.0, 0.0), point(30.0, 40.0), point(60.0, -40.0), point(90.0, 10.0)];
        let near = fit(&[Bezier::polynomial(&points)], 1e-3).segments.len();
        let far = points.map(|p| p + vec2(1e7, -1e7));
        assert_eq!(fit(&[Bezier::polynomial(&far)], 1e-3).segments.len(), near);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn any_cubic_is_met_within_tolerance(c in prop::array::uniform8(-50.0..50.0_f64), fine in 0..3_i32) {
            let points = [point(c[0], c[1]), point(c[2], c[3]), point(c[4], c[5]), point(c[6], c[7])];
            checked(&[Bezier::polynomial(&points)], 0.1 * 0.1_f64.powi(fine));
        }

        #[test]
        fn any_ellipse_arc_is_met_within_tolerance(
            a in 0.5..50.0_f64, b in 0.5..50.0_f64, skew in -1.0..1.0_f64, from in -7.0..7.0_f64, sweep in 0.05..6.2_f64,
        ) {
            for piece in ellipse(point(1.0, 2.0), vec2(a, skew), vec2(-skew, b), from, sweep) {
                checked(&[piece], 1e-3);
            }
        }
    }
}
