//! Points and vectors of the plane.

use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A place in the plane, in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Abscissa, mm.
    pub x: f64,
    /// Ordinate, mm.
    pub y: f64,
}

/// A displacement between two places, or a direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Vec2 {
    /// Component along x.
    pub x: f64,
    /// Component along y.
    pub y: f64,
}

/// Shorthand for [`Point::new`].
#[inline]
pub const fn point(x: f64, y: f64) -> Point {
    Point { x, y }
}

/// Shorthand for [`Vec2::new`].
#[inline]
pub const fn vec2(x: f64, y: f64) -> Vec2 {
    Vec2 { x, y }
}

impl Point {
    /// The origin.
    pub const ORIGIN: Self = point(0.0, 0.0);

    /// The point with these coordinates.
    #[inline]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The displacement from the origin to this point.
    #[inline]
    pub const fn to_vec(self) -> Vec2 {
        vec2(self.x, self.y)
    }

    /// Euclidean distance to `other`, without overflow or underflow of the squares.
    #[inline]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// Squared distance to `other`.
    #[inline]
    pub fn distance_squared(self, other: Self) -> f64 {
        (self - other).length_squared()
    }

    /// The point half-way to `other`.
    #[inline]
    pub fn midpoint(self, other: Self) -> Self {
        point(0.5 * (self.x + other.x), 0.5 * (self.y + other.y))
    }

    /// The point at fraction `t` of the way to `other`; exact at `t = 0` and `t = 1`.
    #[inline]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        point((1.0 - t) * self.x + t * other.x, (1.0 - t) * self.y + t * other.y)
    }

    /// Whether both coordinates are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Vec2 {
    /// The zero vector.
    pub const ZERO: Self = vec2(0.0, 0.0);

    /// The vector with these components.
    #[inline]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The unit vector at `angle` radians from the x axis, counter-clockwise.
    #[inline]
    pub fn from_angle(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        vec2(cos, sin)
    }

    /// The point that this displacement leads to from the origin.
    #[inline]
    pub const fn to_point(self) -> Point {
        point(self.x, self.y)
    }

    /// Scalar product.
    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Signed area of the parallelogram: positive where `other` lies to the left of `self`.
    #[inline]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Squared length.
    #[inline]
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    #[inline]
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// Direction angle in (−π, π].
    #[inline]
    pub fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }

    /// The signed angle in (−π, π] that turns the direction of `self` into that of `other`.
    #[inline]
    pub fn angle_to(self, other: Self) -> f64 {
        self.cross(other).atan2(self.dot(other))
    }

    /// The same direction at length 1; NaN components for the zero vector.
    #[inline]
    pub fn normalized(self) -> Self {
        self / self.length()
    }

    /// Turned by +90°: the left normal of a direction.
    #[inline]
    pub const fn left(self) -> Self {
        vec2(-self.y, self.x)
    }

    /// Turned by −90°: the right normal of a direction.
    #[inline]
    pub const fn right(self) -> Self {
        vec2(self.y, -self.x)
    }

    /// Turned by `angle` radians counter-clockwise.
    #[inline]
    pub fn rotated(self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        vec2(cos * self.x - sin * self.y, sin * self.x + cos * self.y)
    }
}

impl Sub for Point {
    type Output = Vec2;
    #[inline]
    fn sub(self, other: Self) -> Vec2 {
        vec2(self.x - other.x, self.y - other.y)
    }
}

impl Add<Vec2> for Point {
    type Output = Self;
    #[inline]
    fn add(self, v: Vec2) -> Self {
        point(self.x + v.x, self.y + v.y)
    }
}

impl Sub<Vec2> for Point {
    type Output = Self;
    #[inline]
    fn sub(self, v: Vec2) -> Self {
        point(self.x - v.x, self.y - v.y)
    }
}

impl AddAssign<Vec2> for Point {
    #[inline]
    fn add_assign(&mut self, v: Vec2) {
        *self = *self + v;
    }
}

impl Add for Vec2 {
    type Output = Self;
    #[inline]
    fn add(self, v: Self) -> Self {
        vec2(self.x + v.x, self.y + v.y)
    }
}

impl AddAssign for Vec2 {
    #[inline]
    fn add_assign(&mut self, v: Self) {
        *self = *self + v;
    }
}

impl Sub for Vec2 {
    type Output = Self;
    #[inline]
    fn sub(self, v: Self) -> Self {
        vec2(self.x - v.x, self.y - v.y)
    }
}

impl SubAssign for Vec2 {
    #[inline]
    fn sub_assign(&mut self, v: Self) {
        *self = *self - v;
    }
}

impl Neg for Vec2 {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        vec2(-self.x, -self.y)
    }
}

impl Mul<f64> for Vec2 {
    type Output = Self;
    #[inline]
    fn mul(self, k: f64) -> Self {
        vec2(self.x * k, self.y * k)
    }
}

impl Mul<Vec2> for f64 {
    type Output = Vec2;
    #[inline]
    fn mul(self, v: Vec2) -> Vec2 {
        v * self
    }
}

impl Div<f64> for Vec2 {
    type Output = Self;
    #[inline]
    fn div(self, k: f64) -> Self {
        vec2(self.x / k, self.y / k)
    }
}
