//! Affine maps of the plane: block insertions, SVG transforms, units.

use pocketry_geom::{Point, Vec2, point, vec2};

/// The map `(x, y) -> (a x + c y + e, b x + d y + f)`, the coefficients named as in SVG's `matrix`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    /// x of the image of the first axis.
    pub(crate) a: f64,
    /// y of the image of the first axis.
    pub(crate) b: f64,
    /// x of the image of the second axis.
    pub(crate) c: f64,
    /// y of the image of the second axis.
    pub(crate) d: f64,
    /// x of the image of the origin.
    pub(crate) e: f64,
    /// y of the image of the origin.
    pub(crate) f: f64,
}

impl Affine {
    /// Every point stays.
    pub(crate) const IDENTITY: Self = Self { a: 1.0, b: 0.0, c: 0.0, d: 1.0, e: 0.0, f: 0.0 };

    /// Scaled about the origin.
    pub(crate) const fn scale(x: f64, y: f64) -> Self {
        Self { a: x, d: y, ..Self::IDENTITY }
    }

    /// Moved.
    pub(crate) const fn translate(by: Vec2) -> Self {
        Self { e: by.x, f: by.y, ..Self::IDENTITY }
    }

    /// Turned about the origin by an angle in degrees; multiples of a right angle are exact.
    pub(crate) fn rotate_degrees(degrees: f64) -> Self {
        let axis = direction_degrees(degrees);
        Self { a: axis.x, b: axis.y, c: -axis.y, d: axis.x, e: 0.0, f: 0.0 }
    }

    /// First `inner`, then `self`.
    pub(crate) fn after(&self, inner: &Self) -> Self {
        let (x, y) = (self.vector(vec2(inner.a, inner.b)), self.vector(vec2(inner.c, inner.d)));
        let origin = self.point(point(inner.e, inner.f));
        Self { a: x.x, b: x.y, c: y.x, d: y.y, e: origin.x, f: origin.y }
    }

    /// The image of a point.
    pub(crate) fn point(&self, p: Point) -> Point {
        point(self.a * p.x + self.c * p.y + self.e, self.b * p.x + self.d * p.y + self.f)
    }

    /// The image of a displacement.
    pub(crate) fn vector(&self, v: Vec2) -> Vec2 {
        vec2(self.a * v.x + self.c * v.y, self.b * v.x + self.d * v.y)
    }

    /// Signed area of the image of a unit square: negative where the map mirrors.
    pub(crate) fn determinant(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }

    /// Whether the plane is squeezed onto a line or a point, or to something that is no number.
    pub(crate) fn is_singular(&self) -> bool {
        let longest = self.a.hypot(self.b).max(self.c.hypot(self.d));
        let determinant = self.determinant().abs();
        let finite = [self.a, self.b, self.c, self.d, self.e, self.f].iter().all(|k| k.is_finite());
        !finite || determinant <= f64::MIN_POSITIVE || determinant <= f64::EPSILON * longest * longest
    }
}

/// The unit vector at an angle in degrees, exact at multiples of a right angle.
pub(crate) fn direction_degrees(degrees: f64) -> Vec2 {
    let turn = degrees.rem_euclid(360.0);
    if turn == 0.0 {
        vec2(1.0, 0.0)
    } else if turn == 90.0 {
        vec2(0.0, 1.0)
    } else if turn == 180.0 {
        vec2(-1.0, 0.0)
    } else if turn == 270.0 {
        vec2(0.0, -1.0)
    } else {
        Vec2::from_angle(turn.to_radians())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn composition_applies_the_inner_map_first() {
        let turned = Affine::rotate_degrees(90.0).after(&Affine::translate(vec2(1.0, 0.0)));
        assert_eq!(turned.point(Point::ORIGIN), point(0.0, 1.0));
        let moved = Affine::translate(vec2(1.0, 0.0)).after(&Affine::rotate_degrees(90.0));
        assert_eq!(moved.point(Point::ORIGIN), point(1.0, 0.0));
    }

    #[test]
    fn squeezed_maps_are_singular() {
        assert!(Affine::scale(1.0, 0.0).is_singular());
        assert!(Affine::scale(f64::NAN, 1.0).is_singular());
        assert!(!Affine::scale(1e-6, -1e-6).is_singular());
    }
}
