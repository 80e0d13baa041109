//! From space to the sheet: a parallel projection.

use pocketry_geom::{Point, point};

/// A view from the front, somewhat from the right and from above, without perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Turn about the vertical, radians.
    pub turn: f64,
    /// How far the viewer looks down, radians.
    pub tilt: f64,
}

impl Default for Projection {
    fn default() -> Self {
        Self { turn: 0.5, tilt: 0.8 }
    }
}

impl Projection {
    /// Where a place in space is seen.
    pub fn place(&self, [x, y, z]: [f64; 3]) -> Point {
        let (sin, cos) = self.turn.sin_cos();
        let (across, away) = (cos * x - sin * y, sin * x + cos * y);
        point(across, away * self.tilt.sin() + z * self.tilt.cos())
    }
}
