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

/// Classify the joint between `before` and `after`, which meet at a point.
pub(super) fn classify(before: &Segment, after: &Segment) -> Joint {
    let (t0, t1) = (before.end_tangent(), after.start_tangent());
    let (sin, cos) = (t0.cross(t1), t0.dot(t1));
    let reflex = Joint::Reflex(t0.left(), t1.left());
    if cos > 0.0 && sin.abs() <= tol::SMOOTH {
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
