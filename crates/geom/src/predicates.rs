//! Exact decisions about points: the only place that asks for the sign of a determinant.

use crate::point::Point;
use robust::{Coord, orient2d};

const fn coord(p: Point) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Positive where `c` lies to the left of the line from `a` to `b`, negative to the right, zero exactly on it.
///
/// The sign is exact (Shewchuk's adaptive arithmetic), the value approximates twice the triangle's area.
#[inline]
pub fn orientation(a: Point, b: Point, c: Point) -> f64 {
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether the open segments `a`–`b` and `c`–`d` cross at a point inside both. Exact.
#[inline]
pub fn lines_cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let straddles = |p: f64, q: f64| (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0);
    straddles(orientation(a, b, c), orientation(a, b, d)) && straddles(orientation(c, d, a), orientation(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::point;

    #[test]
    fn orientation_is_exact_where_rounding_would_decide() {
        let (a, b) = (point(12.0, 12.0), point(24.0, 24.0));
        assert_eq!(orientation(a, b, point(0.5, 0.5)), 0.0);
        assert!(orientation(a, b, point(0.5, 0.5 + f64::EPSILON)) > 0.0);
        assert!(orientation(a, b, point(0.5 + f64::EPSILON, 0.5)) < 0.0);
    }

    #[test]
    fn crossing_needs_both_interiors() {
        let o = point(0.0, 0.0);
        assert!(lines_cross(o, point(2.0, 2.0), point(0.0, 2.0), point(2.0, 0.0)));
        assert!(!lines_cross(o, point(2.0, 2.0), point(1.0, 1.0), point(2.0, 0.0)));
        assert!(!lines_cross(o, point(2.0, 2.0), point(3.0, 3.0), point(4.0, 4.0)));
    }
}
