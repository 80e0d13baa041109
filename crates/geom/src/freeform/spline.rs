//! Cubic B-splines as Bézier curves.
//!
//! The control points of the Bézier curve over a span `[a, b]` of the knots are the polar values `f(a, a, a)`, `f(a, a, b)`, `f(a, b, b)`
//! and `f(b, b, b)` of the spline there, each by de Boor's scheme with a parameter of its own for every step.

use super::Cubic;
use crate::point::Point;

/// Why knots and control points make no cubic spline.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// The numbers don't fit.
    #[error("a cubic spline of {points} control points has {} knots, not {knots}; at least 4 points", .points + 4)]
    Count {
        /// How many control points.
        points: usize,
        /// How many knots.
        knots: usize,
    },
    /// Knots fall, or are not finite.
    #[error("knot {index} is less than the one before it, or no number")]
    Knots {
        /// Which, from 0.
        index: usize,
    },
}

/// The Bézier curves of a cubic B-spline, one for each span of its knots that is not empty.
///
/// # Errors
/// When there are not four more knots than control points, or the knots fall.
pub fn bspline(knots: &[f64], points: &[Point]) -> Result<Vec<Cubic>, SplineError> {
    if points.len() < 4 || knots.len() != points.len() + 4 {
        return Err(SplineError::Count { points: points.len(), knots: knots.len() });
    }
    let rises = |k: &usize| knots[*k].is_finite() && (*k == 0 || knots[*k] >= knots[k - 1]);
    if let Some(index) = (0..knots.len()).find(|k| !rises(k)) {
        return Err(SplineError::Knots { index });
    }
    let spans = (3..points.len()).filter(|&k| knots[k] < knots[k + 1]);
    let cubic = |k: usize| {
        let (a, b) = (knots[k], knots[k + 1]);
        let polar = |u: [f64; 3]| polar_value(&knots[k - 2..k + 4], &points[k - 3..=k], u);
        Cubic::new([polar([a, a, a]), polar([a, a, b]), polar([a, b, b]), polar([b, b, b])])
    };
    Ok(spans.map(cubic).collect())
}

/// The closed uniform cubic B-spline of at least three control points.
///
/// # Errors
/// When there are fewer points.
pub fn closed_bspline(points: &[Point]) -> Result<Vec<Cubic>, SplineError> {
    if points.len() < 3 {
        return Err(SplineError::Count { points: points.len(), knots: points.len() + 4 });
    }
    let around: Vec<Point> = points.iter().chain(&points[..3]).copied().collect();
    let knots: Vec<f64> = (0..around.len() as u32 + 4).map(f64::from).collect();
    let mut cubics = bspline(&knots, &around)?;
    // Joints are computed twice; once is what makes a contour of them.
    for k in 0..cubics.len() {
        let next = cubics[(k + 1) % cubics.len()].control[0];
        cubics[k].control[3] = next;
    }
    Ok(cubics)
}

/// De Boor's scheme on the six knots and four points of a span, with a parameter for every step.
fn polar_value(knots: &[f64], points: &[Point], u: [f64; 3]) -> Point {
    let mut level = [points[0], points[1], points[2], points[3]];
    for (step, &u) in u.iter().enumerate() {
        for k in 0..3 - step {
            let (low, high) = (knots[k + step], knots[k + 3]);
            level[k] = level[k] + (level[k + 1] - level[k]) * ((u - low) / (high - low));
        }
    }
    level[0]
}
