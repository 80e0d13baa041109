//! What happens where one boundary segment ends and the next begins.

use crate::point::Vec2;
use crate::segment::Segment;
use crate::tolerance::skeleton as tol;

/// A joint of two consecutive segments, seen from the pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Joint {
    /// Interior angle below π: one skeleton edge starts here with clearance 0.
    Convex,
    /// Smooth: the two cells meet along the common inner normal.
    Smooth(Vec2),
    /// Interior angle above π: the vertex is a site of its own, its cell fans from one normal to the other.
    Reflex(Vec2, Vec2),
}

/// Classify the joint between `before` and `after`, which meet at a point of a region of this size.
pub(super) fn classify(before: &Segment, after: &Segment, size: f64) -> Joint {
    let (t0, t1) = (before.end_tangent(), after.start_tangent());
    let (sin, cos) = (t0.cross(t1), t0.dot(t1));
    let reflex = Joint::Reflex(t0.left(), t1.left());
    if cos > 0.0 && sin.abs() <= smooth_turn(before.curvature() * size, after.curvature() * size) {
        return Joint::Smooth(smooth_normal(before, after, t0.left(), t1.left()));
    }
    if cos < 0.0 && sin.abs() <= tol::CUSP {
        // a cusp: of the two branches that leave the point together, the one that bends more to the left decides
        let (reversed, forward) = (-before.curvature(), after.curvature());
        if reversed != forward {
            return if reversed > forward { Joint::Convex } else { reflex };
        }
    }
    if sin > 0.0 { Joint::Convex } else { reflex }
}

/// The turn up to which a joint of two curvatures (of a region of size 1) counts as smooth: the largest disk on its
/// normal is then off by no more than the tolerance. With the normal of the tighter inside arc, of radius `1 / k`, a
/// disk as large as it misses the other curve by `turn² / 2 (k - k')`; without inside arcs it is no larger than the
/// region, and the mean normal leaves an eighth of the square.
fn smooth_turn(k0: f64, k1: f64) -> f64 {
    let (tight, wide) = (k0.max(k1), k0.min(k1));
    let square = if tight > 0.0 { 2.0 * (tight - wide) } else { 8.0 / (1.0 - wide) };
    (square * tol::SMOOTH_ERROR).sqrt().clamp(tol::SMOOTH_LEAST, tol::SMOOTH_MOST)
}

/// The normal of a smooth joint. Disks inside a small arc feel its normal most, so the tighter inside arc gives it;
/// two lines share their mean.
fn smooth_normal(before: &Segment, after: &Segment, n0: Vec2, n1: Vec2) -> Vec2 {
    let (k0, k1) = (before.curvature(), after.curvature());
    if k0 > k1 && k0 > 0.0 {
        n0
    } else if k1 > k0 && k1 > 0.0 {
        n1
    } else {
        (n0 + n1).normalized()
    }
}
