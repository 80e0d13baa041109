//! Cubic Bézier curves.

use crate::point::{Point, Vec2};

/// A cubic Bézier curve by its control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// The first and the last are its ends.
    pub control: [Point; 4],
}

impl Cubic {
    /// The curve with these control points.
    pub const fn new(control: [Point; 4]) -> Self {
        Self { control }
    }

    /// Its point at a parameter in [0, 1], by de Casteljau's scheme; the ends are exact.
    pub fn at(&self, t: f64) -> Point {
        let mix = |a: Point, b: Point| a + (b - a) * t;
        let [a, b, c, d] = self.control;
        if t >= 1.0 {
            return d;
        }
        let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
        mix(mix(ab, bc), mix(bc, cd))
    }

    /// Its derivative by the parameter, mm.
    pub fn derivative(&self, t: f64) -> Vec2 {
        let [a, b, c, d] = self.control;
        let (ab, bc, cd) = (b - a, c - b, d - c);
        (ab * ((1.0 - t) * (1.0 - t)) + bc * (2.0 * t * (1.0 - t)) + cd * (t * t)) * 3.0
    }

    /// A bound of the derivative's length: that of its control polygon.
    pub fn speed_bound(&self) -> f64 {
        self.control.windows(2).map(|w| 3.0 * w[0].distance(w[1])).fold(0.0, f64::max)
    }

    /// A bound of how far a chord between two parameters `h` apart lies from the curve, mm: `h² max|C''| / 8`.
    pub fn chord_error(&self, h: f64) -> f64 {
        let bend = |w: &[Point]| 6.0 * ((w[2] - w[1]) - (w[1] - w[0])).length();
        let second = self.control.windows(3).map(bend).fold(0.0, f64::max);
        0.125 * h * h * second
    }
}
