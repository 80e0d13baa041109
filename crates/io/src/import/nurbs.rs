//! B-splines, rational and unclamped ones too, cut into Bézier curves.

use super::bezier::{Bezier, Weighted};
use pocketry_geom::{Point, tolerance};

/// A spline as a drawing gives it.
#[derive(Clone, Debug)]
pub(crate) struct Spline {
    /// Polynomial degree.
    pub(crate) degree: usize,
    /// Knots, one a control point and one more than the degree besides.
    pub(crate) knots: Vec<f64>,
    /// Control points.
    pub(crate) points: Vec<Point>,
    /// Weights, one a control point, or none at all.
    pub(crate) weights: Vec<f64>,
}

/// Why a spline is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum SplineError {
    /// The degree is 0 or absurd.
    #[error("degree {0} is not between 1 and {MAX_DEGREE}")]
    Degree(usize),
    /// Too few control points.
    #[error("{0} control points are too few for degree {1}")]
    TooFew(usize, usize),
    /// The number of knots doesn't fit.
    #[error("{found} knots where {needed} are needed")]
    KnotCount {
        /// As many as there are.
        found: usize,
        /// As many as the control points and the degree ask for.
        needed: usize,
    },
    /// The knots go back, or none of them differ.
    #[error("the knots don't increase")]
    Knots,
    /// The number of weights doesn't fit.
    #[error("{found} weights for {needed} control points")]
    WeightCount {
        /// As many as there are.
        found: usize,
        /// As many as there are control points.
        needed: usize,
    },
    /// A weight is zero or negative, or next to nothing beside the others: the curve may run to infinity.
    #[error("a weight is not positive, or far below the others")]
    Weight,
}

/// Degrees above this don't come from CAD systems; the bound keeps the work per curve bounded.
pub(crate) const MAX_DEGREE: usize = 25;

impl Spline {
    fn check(&self) -> Result<(), SplineError> {
        let (p, n) = (self.degree, self.points.len());
        if !(1..=MAX_DEGREE).contains(&p) {
            return Err(SplineError::Degree(p));
        }
        if n <= p {
            return Err(SplineError::TooFew(n, p));
        }
        if self.knots.len() != n + p + 1 {
            return Err(SplineError::KnotCount { found: self.knots.len(), needed: n + p + 1 });
        }
        let increasing = self.knots.windows(2).all(|w| w[0] <= w[1]);
        if !increasing || self.knots[p] >= self.knots[n] {
            return Err(SplineError::Knots);
        }
        if !self.weights.is_empty() && self.weights.len() != n {
            return Err(SplineError::WeightCount { found: self.weights.len(), needed: n });
        }
        let largest = self.weights.iter().copied().fold(0.0, f64::max);
        if self.weights.iter().any(|&w| w.is_nan() || w <= tolerance::LEAST_WEIGHT * largest) {
            return Err(SplineError::Weight);
        }
        Ok(())
    }

    /// The same curve as Bézier curves, one for each span of the knots that is not empty.
    ///
    /// Their control points are values of the spline's blossom: `b_j = f(a, …, a, b, …, b)` with `j` times `b`.
    ///
    /// # Errors
    /// What the drawing says is no spline.
    pub(crate) fn to_beziers(&self) -> Result<Vec<Bezier>, SplineError> {
        self.check()?;
        let largest = self.weights.iter().copied().fold(0.0, f64::max);
        let weight = |k: usize| self.weights.get(k).map_or(1.0, |w| w / largest);
        let control: Vec<Weighted> =
            self.points.iter().enumerate().map(|(k, &p)| Weighted::new(p, weight(k))).collect();
        let p = self.degree;
        let mut curves: Vec<Bezier> = Vec::new();
        for span in p..self.points.len() {
            let (a, b) = (self.knots[span], self.knots[span + 1]);
            if a < b {
                let mut points: Vec<Weighted> = (0..=p).map(|j| self.blossom(&control, span, j)).collect();
                if let Some(before) = curves.last() {
                    points[0] = before.points[p];
                }
                curves.push(Bezier { points });
            }
        }
        Ok(curves)
    }

    /// De Boor's triangle with `upper` of its arguments at the span's end and the others at its start.
    fn blossom(&self, control: &[Weighted], span: usize, upper: usize) -> Weighted {
        let p = self.degree;
        let mut row: Vec<Weighted> = control[span - p..=span].to_vec();
        for level in 1..=p {
            let argument = if level <= upper { self.knots[span + 1] } else { self.knots[span] };
            for k in (level..=p).rev() {
                let (low, high) = (self.knots[span - p + k], self.knots[span + 1 + k - level]);
                row[k] = row[k - 1].lerp(row[k], (argument - low) / (high - low));
            }
        }
        row[p]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    fn cubic(knots: &[f64], points: &[Point]) -> Spline {
        Spline { degree: 3, knots: knots.to_vec(), points: points.to_vec(), weights: Vec::new() }
    }

    #[test]
    fn a_clamped_spline_starts_and_ends_at_its_control_points() {
        let points: Vec<Point> = (0..5).map(|k| point(f64::from(k), f64::from(k * k % 3))).collect();
        let curves = cubic(&[0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0], &points).to_beziers().unwrap();
        assert_eq!(curves.len(), 2);
        assert_eq!(curves[0].start(), points[0]);
        assert_eq!(curves[1].end(), points[4]);
        assert_eq!(curves[0].end(), curves[1].start());
    }

    #[test]
    fn uniform_knots_give_the_basis_function_values() {
        let points = [point(0.0, 0.0), point(6.0, 0.0), point(6.0, 6.0), point(0.0, 6.0)];
        let curves = cubic(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], &points).to_beziers().unwrap();
        assert_eq!(curves.len(), 1);
        assert!(curves[0].start().distance(point(5.0, 1.0)) < 1e-14);
        assert!(curves[0].end().distance(point(5.0, 5.0)) < 1e-14);
    }

    #[test]
    fn what_is_no_spline_is_said() {
        let points = [point(0.0, 0.0); 4];
        assert_eq!(cubic(&[0.0; 8], &points).to_beziers(), Err(SplineError::Knots));
        assert!(matches!(cubic(&[0.0; 7], &points).to_beziers(), Err(SplineError::KnotCount { .. })));
        let mut weighted = cubic(&[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0], &points);
        weighted.weights = vec![1.0, 0.0, 1.0, 1.0];
        assert_eq!(weighted.to_beziers(), Err(SplineError::Weight));
    }
}
