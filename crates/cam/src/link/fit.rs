//! Chains of short lines as few lines and arcs.
//!
//! Ways along curved edges of the skeleton come as chords, many more than a program needs: their number grows like the
//! square root of what the tolerance allows, that of arcs like its cube root. From the start of a chain the longest
//! stretch is taken that one line or arc (through the stretch's ends and its middle vertex) holds within tolerance, found
//! by doubling and halving, in O(n log n) for n chords; then from there. Arcs of one circle that follow each other become
//! one. Ends of the chain stay where they are.

use pocketry_geom::tolerance::{ARC_RADIUS_MIN, ARC_SWEEP_MIN};
use pocketry_geom::{Arc, Point, Segment};
use std::f64::consts::{FRAC_PI_4, PI};

/// Arcs of a larger radius than this many times their chord stay chords: few are spared, and control units limit radii.
const FLATTEST: f64 = 1e3;

/// The chain with its stretches of lines fitted: every vertex of theirs lies within `tolerance` (mm) of the result, which is
/// within twice that of every line's middle. Stretches of arcs of one circle become arcs of at most half a turn.
pub(crate) fn fitted(chain: &[Segment], tolerance: f64) -> Vec<Segment> {
    let mut out = Vec::with_capacity(chain.len().min(64));
    for run in chain.chunk_by(|a, b| a.end() == b.start() && alike(a, b)) {
        match run[0] {
            Segment::Arc(_) => join_arcs(run, &mut out),
            Segment::Line(_) => fit_lines(run, tolerance, &mut out),
        }
    }
    out
}

/// Whether both are lines, or arcs of one circle.
fn alike(a: &Segment, b: &Segment) -> bool {
    match (a, b) {
        (Segment::Line(_), Segment::Line(_)) => true,
        (Segment::Arc(a), Segment::Arc(b)) => (a.center, a.radius, a.ccw) == (b.center, b.radius, b.ccw),
        _ => false,
    }
}

fn join_arcs(run: &[Segment], out: &mut Vec<Segment>) {
    let mut joined: Option<Arc> = None;
    for arc in run.iter().filter_map(|s| if let Segment::Arc(a) = s { Some(a) } else { None }) {
        joined = Some(match joined {
            Some(before) if before.sweep().abs() + arc.sweep().abs() <= PI => Arc { end: arc.end, ..before },
            before => {
                out.extend(before.map(Segment::Arc));
                *arc
            }
        });
    }
    out.extend(joined.map(Segment::Arc));
}

fn fit_lines(run: &[Segment], tolerance: f64, out: &mut Vec<Segment>) {
    if run.len() == 1 {
        out.push(run[0]);
        return;
    }
    let points: Vec<Point> = std::iter::once(run[0].start()).chain(run.iter().map(Segment::end)).collect();
    let mut from = 0;
    while from + 1 < points.len() {
        let (count, fit) = longest(&points[from..], tolerance);
        out.push(fit);
        from += count;
    }
}

/// How many of the chords from the first point one segment holds, and that segment.
fn longest(points: &[Point], tolerance: f64) -> (usize, Segment) {
    let most = points.len() - 1;
    let mut best = (1, Segment::line(points[0], points[1]));
    let mut fails = most + 1;
    while best.0 < most && fails > most {
        let tried = (2 * best.0).min(most);
        match one(&points[..=tried], tolerance) {
            Some(fit) => best = (tried, fit),
            None => fails = tried,
        }
    }
    while fails - best.0 > 1 && best.0 < most {
        let tried = best.0.midpoint(fails);
        match one(&points[..=tried], tolerance) {
            Some(fit) => best = (tried, fit),
            None => fails = tried,
        }
    }
    best
}

/// The line or arc from the first of the points to the last that keeps to all of them, in their order.
fn one(points: &[Point], tolerance: f64) -> Option<Segment> {
    let (start, end, middle) = (points[0], *points.last()?, points[points.len() / 2]);
    let along = end - start;
    let straight = |w: &[Point]| (w[1] - w[0]).dot(along) > 0.0;
    let line = Segment::line(start, end);
    if points.windows(2).all(straight) && points.iter().all(|&p| line.distance(p) <= tolerance) {
        return Some(line);
    }
    // The angle at the middle vertex is half of the arc's sweep.
    let half_sweep = (middle - start).angle_to(end - middle);
    if start == end || half_sweep.abs() > FRAC_PI_4 || 2.0 * half_sweep.abs() < ARC_SWEEP_MIN {
        return None;
    }
    let arc = Arc::from_bulge(start, end, (0.5 * half_sweep).tan());
    let sound = arc.radius >= 2.0 * ARC_RADIUS_MIN && arc.radius <= FLATTEST * along.length();
    (sound && points.windows(2).all(|w| follows(&arc, w, tolerance))).then_some(Segment::Arc(arc))
}

/// Whether a chord leads along an arc, near to it.
fn follows(arc: &Arc, chord: &[Point], tolerance: f64) -> bool {
    let (from, to) = (chord[0], chord[1]);
    let turn = (from - arc.center).cross(to - arc.center);
    (turn > 0.0) == arc.ccw
        && turn != 0.0
        && arc.radial_distance(to).abs() <= tolerance
        && arc.radial_distance(from.midpoint(to)).abs() <= 2.0 * tolerance
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    const TOLERANCE: f64 = 1e-5;

    fn chain(points: &[Point]) -> Vec<Segment> {
        points.windows(2).map(|w| Segment::line(w[0], w[1])).collect()
    }

    fn parabola(n: u32) -> Vec<Point> {
        let at = |k: u32| 20.0 * f64::from(k) / f64::from(n) - 10.0;
        (0..=n).map(|k| point(at(k), 0.05 * at(k) * at(k))).collect()
    }

    #[test]
    fn a_parabola_takes_few_arcs_that_keep_to_it() {
        let points = parabola(4096);
        let fit = fitted(&chain(&points), TOLERANCE);
        assert!(fit.len() < 150, "{} segments", fit.len());
        assert!(fit.windows(2).all(|w| w[0].end() == w[1].start()));
        assert_eq!((fit[0].start(), fit[fit.len() - 1].end()), (points[0], points[4096]));
        for p in points {
            let off = fit.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
            assert!(off <= TOLERANCE, "{off} at {p:?}");
        }
    }

    #[test]
    fn lines_in_one_line_become_one() {
        let points: Vec<Point> = (0..=100).map(|k| point(f64::from(k), 2.0 * f64::from(k))).collect();
        assert_eq!(fitted(&chain(&points), TOLERANCE), vec![Segment::line(points[0], points[100])]);
    }

    #[test]
    fn arcs_of_one_circle_become_one() {
        let half = Arc::from_bulge(point(-1.0, 0.0), point(1.0, 0.0), 1.0);
        let mut rest = Segment::Arc(half);
        let mut parts = Vec::new();
        for k in 1..50 {
            let (part, after) = rest.split_at(Segment::Arc(half).at(f64::from(k) / 50.0));
            parts.push(part);
            rest = after;
        }
        parts.push(rest);
        let back: Vec<Segment> = parts.iter().rev().map(Segment::reversed).collect();
        parts.extend(&back);
        assert_eq!(fitted(&parts, TOLERANCE), [Segment::Arc(half), Segment::Arc(half).reversed()]);
    }

    #[test]
    fn there_and_back_and_corners_stay() {
        let there_and_back =
            chain(&[point(0.0, 0.0), point(1.0, 0.0), point(2.0, 0.0), point(1.0, 0.0), point(0.0, 0.0)]);
        let fit = fitted(&there_and_back, TOLERANCE);
        assert_eq!(fit, chain(&[point(0.0, 0.0), point(2.0, 0.0), point(0.0, 0.0)]));
        let corner = chain(&[point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)]);
        assert_eq!(fitted(&corner, TOLERANCE), corner);
        // Four corners of a square lie on one circle.
        let square = chain(&[point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0), point(0.0, 1.0)]);
        assert_eq!(fitted(&square, TOLERANCE), square);
    }
}
