//! Rational Bézier curves of any degree: the one form that every free-form curve takes before it becomes arcs.

use super::affine::Affine;
use pocketry_geom::{Point, Vec2, point, tolerance, vec2};

/// A control point in homogeneous form: the place times its weight, and the weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weighted {
    /// The place, multiplied by the weight.
    pub(crate) xy: Vec2,
    /// The weight, positive.
    pub(crate) w: f64,
}

impl Weighted {
    /// A control point at `p` with weight `w`.
    pub(crate) fn new(p: Point, w: f64) -> Self {
        Self { xy: p.to_vec() * w, w }
    }

    /// The place itself.
    pub(crate) fn place(self) -> Point {
        (self.xy / self.w).to_point()
    }

    /// The point at fraction `t` of the way to `other`, all three components alike.
    pub(crate) fn lerp(self, other: Self, t: f64) -> Self {
        Self { xy: self.xy * (1.0 - t) + other.xy * t, w: self.w * (1.0 - t) + other.w * t }
    }
}

/// A rational Bézier curve with positive weights: it stays inside the hull of its control points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bezier {
    /// Control points, at least two.
    pub(crate) points: Vec<Weighted>,
}

impl Bezier {
    /// A polynomial curve with these control points.
    pub(crate) fn polynomial(points: &[Point]) -> Self {
        Self { points: points.iter().map(|&p| Weighted::new(p, 1.0)).collect() }
    }

    /// Where it begins.
    pub(crate) fn start(&self) -> Point {
        self.points[0].place()
    }

    /// Where it ends.
    pub(crate) fn end(&self) -> Point {
        self.points[self.points.len() - 1].place()
    }

    /// The control points as places.
    pub(crate) fn places(&self) -> impl DoubleEndedIterator<Item = Point> + '_ {
        self.points.iter().map(|p| p.place())
    }

    /// The point at parameter `t` in [0, 1] (de Casteljau).
    pub(crate) fn at(&self, t: f64) -> Point {
        let mut row = self.points.clone();
        for last in (1..row.len()).rev() {
            for k in 0..last {
                row[k] = row[k].lerp(row[k + 1], t);
            }
        }
        row[0].place()
    }

    /// The parts before and after parameter `t`.
    pub(crate) fn split(&self, t: f64) -> (Self, Self) {
        let mut row = self.points.clone();
        let count = row.len();
        let (mut left, mut right) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for last in (0..count).rev() {
            left.push(row[0]);
            right.push(row[last]);
            for k in 0..last {
                row[k] = row[k].lerp(row[k + 1], t);
            }
        }
        right.reverse();
        (Self { points: left }, Self { points: right })
    }

    /// The part between parameters `from < to`.
    pub(crate) fn part(&self, from: f64, to: f64) -> Self {
        let tail = if from > 0.0 { self.split(from).1 } else { self.clone() };
        if to < 1.0 { tail.split((to - from) / (1.0 - from)).0 } else { tail }
    }

    /// Unit direction of travel at the start; `None` for a curve that is one point.
    pub(crate) fn start_tangent(&self) -> Option<Vec2> {
        direction(self.start(), self.places().skip(1), self.extent())
    }

    /// Unit direction of travel at the end; `None` for a curve that is one point.
    pub(crate) fn end_tangent(&self) -> Option<Vec2> {
        direction(self.end(), self.places().rev().skip(1), self.extent()).map(|d| -d)
    }

    /// How far the control points reach from the start.
    pub(crate) fn extent(&self) -> f64 {
        let start = self.start();
        self.places().map(|p| p.distance(start)).fold(0.0, f64::max)
    }

    /// The image under an affine map.
    pub(crate) fn transformed(&self, map: &Affine) -> Self {
        let image = |p: &Weighted| Weighted { xy: map.vector(p.xy) + vec2(map.e, map.f) * p.w, w: p.w };
        Self { points: self.points.iter().map(image).collect() }
    }

    /// The piece of the ellipse `center + u cos t + v sin t` for `t` between two angles at most a right angle apart.
    pub(crate) fn elliptic(center: Point, u: Vec2, v: Vec2, from: f64, to: f64) -> Self {
        let on = |t: f64| center + u * t.cos() + v * t.sin();
        let half = 0.5 * (to - from);
        let weight = half.cos();
        let apex = point(0.0, 0.0) + (on(from + half) - center) / weight;
        let middle = center + apex.to_vec();
        Self { points: vec![Weighted::new(on(from), 1.0), Weighted::new(middle, weight), Weighted::new(on(to), 1.0)] }
    }
}

/// Direction from `from` to the first of `others` that is not the same place but for rounding.
fn direction(from: Point, others: impl Iterator<Item = Point>, extent: f64) -> Option<Vec2> {
    others
        .map(|p| p - from)
        .find(|v| v.length() > tolerance::COINCIDENT_CONTROL * extent)
        .map(Vec2::normalized)
        .filter(|d| d.x.is_finite() && d.y.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_rational_quarter_circle_lie_on_the_circle() {
        let quarter =
            Bezier::elliptic(point(1.0, 2.0), vec2(3.0, 0.0), vec2(0.0, 3.0), 0.0, std::f64::consts::FRAC_PI_2);
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            assert!((quarter.at(t).distance(point(1.0, 2.0)) - 3.0).abs() < 1e-14);
        }
        let part = quarter.part(0.25, 0.75);
        assert!(part.start().distance(quarter.at(0.25)) < 1e-14);
        assert!(part.at(0.5).distance(quarter.at(0.5)) < 1e-14);
        assert!(part.end().distance(quarter.at(0.75)) < 1e-14);
    }

    #[test]
    fn tangent_skips_control_points_that_coincide() {
        let p = point(0.0, 0.0);
        let curve = Bezier::polynomial(&[p, p, point(0.0, 2.0), point(1.0, 2.0)]);
        assert_eq!(curve.start_tangent(), Some(vec2(0.0, 1.0)));
        assert_eq!(Bezier::polynomial(&[p, p]).start_tangent(), None);
    }
}
