//! A smooth curve through given points, as CAD systems draw splines that carry fit points only.

use super::bezier::Bezier;
use pocketry_geom::{Point, Vec2};

/// The cubic spline with continuous curvature through `points`, its parameter the chord length: periodic where `closed`,
/// with free ends otherwise. Points that repeat the one before are left out.
pub(crate) fn through(points: &[Point], closed: bool) -> Vec<Bezier> {
    let mut knots: Vec<Point> = Vec::with_capacity(points.len());
    for &p in points {
        if knots.last() != Some(&p) {
            knots.push(p);
        }
    }
    let returns = knots.len() > 2 && knots.first() == knots.last();
    if returns {
        knots.pop();
    }
    let closes = knots.len() > 2 && (closed || returns);
    if knots.len() < 2 {
        return Vec::new();
    }
    let spans = if closes { knots.len() } else { knots.len() - 1 };
    let chords: Vec<f64> = (0..spans).map(|k| knots[k].distance(knots[(k + 1) % knots.len()])).collect();
    let slopes = if closes { periodic_slopes(&knots, &chords) } else { free_slopes(&knots, &chords) };
    (0..spans)
        .map(|k| {
            let next = (k + 1) % knots.len();
            let third = chords[k] / 3.0;
            let (a, b) = (knots[k], knots[next]);
            Bezier::polynomial(&[a, a + slopes[k] * third, b - slopes[next] * third, b])
        })
        .collect()
}

/// The right side of the condition that the second derivatives of two neighbouring spans agree at their knot.
fn pull(before: Vec2, after: Vec2, h0: f64, h1: f64) -> Vec2 {
    (before * (h1 / h0) + after * (h0 / h1)) * 3.0
}

/// Slopes at the knots where the second derivative vanishes at both ends.
fn free_slopes(knots: &[Point], chords: &[f64]) -> Vec<Vec2> {
    let n = knots.len();
    let step = |k: usize| knots[k + 1] - knots[k];
    let mut rows = Vec::with_capacity(n);
    rows.push(Row { below: 0.0, diagonal: 2.0, above: 1.0, right: step(0) * (3.0 / chords[0]) });
    for k in 1..n - 1 {
        let (h0, h1) = (chords[k - 1], chords[k]);
        rows.push(Row { below: h1, diagonal: 2.0 * (h0 + h1), above: h0, right: pull(step(k - 1), step(k), h0, h1) });
    }
    rows.push(Row { below: 1.0, diagonal: 2.0, above: 0.0, right: step(n - 2) * (3.0 / chords[n - 2]) });
    solve(&rows)
}

/// Slopes at the knots of a closed curve: the cyclic system by Sherman and Morrison's formula.
fn periodic_slopes(knots: &[Point], chords: &[f64]) -> Vec<Vec2> {
    let n = knots.len();
    let step = |k: usize| knots[(k + 1) % n] - knots[k % n];
    let mut rows: Vec<Row> = (0..n)
        .map(|k| {
            let (h0, h1) = (chords[(k + n - 1) % n], chords[k]);
            let right = pull(step(k + n - 1), step(k), h0, h1);
            Row { below: h1, diagonal: 2.0 * (h0 + h1), above: h0, right }
        })
        .collect();
    let (corner_top, corner_bottom) = (rows[0].below, rows[n - 1].above);
    let gamma = -rows[0].diagonal;
    rows[0].diagonal -= gamma;
    rows[n - 1].diagonal -= corner_top * corner_bottom / gamma;
    let plain = solve(&rows);
    for row in &mut rows {
        row.right = Vec2::ZERO;
    }
    rows[0].right = Vec2::new(gamma, 0.0);
    rows[n - 1].right = Vec2::new(corner_bottom, 0.0);
    let correction = solve(&rows);
    let ratio = corner_top / gamma;
    let share = 1.0 + correction[0].x + ratio * correction[n - 1].x;
    let excess = (plain[0] + plain[n - 1] * ratio) / share;
    plain.iter().zip(&correction).map(|(s, c)| *s - excess * c.x).collect()
}

/// A row of a tridiagonal system with a vector on the right.
struct Row {
    below: f64,
    diagonal: f64,
    above: f64,
    right: Vec2,
}

/// Thomas's elimination; the systems here are diagonally dominant.
fn solve(rows: &[Row]) -> Vec<Vec2> {
    let mut above = Vec::with_capacity(rows.len());
    let mut right: Vec<Vec2> = Vec::with_capacity(rows.len());
    for (k, row) in rows.iter().enumerate() {
        let (carried, pulled) = if k == 0 { (0.0, Vec2::ZERO) } else { (above[k - 1], right[k - 1]) };
        let pivot = row.diagonal - row.below * carried;
        above.push(row.above / pivot);
        right.push((row.right - pulled * row.below) / pivot);
    }
    for k in (0..rows.len() - 1).rev() {
        right[k] = right[k] - right[k + 1] * above[k];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    #[test]
    fn points_of_a_circle_give_nearly_a_circle() {
        let points: Vec<Point> =
            (0..16).map(|k| Vec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_8).to_point()).collect();
        let chain = through(&points, true);
        assert_eq!(chain.len(), 16);
        for curve in &chain {
            for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
                assert!((curve.at(t).distance(Point::ORIGIN) - 1.0).abs() < 2e-4);
            }
        }
    }

    #[test]
    fn points_of_a_line_give_the_line() {
        let points: Vec<Point> = [0.0, 1.0, 5.0, 6.0].iter().map(|&x| point(x, 2.0 * x)).collect();
        for curve in through(&points, false) {
            let p = curve.at(0.3);
            assert!((p.y - 2.0 * p.x).abs() < 1e-12);
        }
    }
}
