//! Offset points on bisectors.
//!
//! With e the unit directions of the edges before and after a vertex P, n their left normals, φ the turn from one to the
//! other and h = tan(φ/2), all three of the paper's equations,
//!
//! - (1) Q = P + (e₂ − e₁)/|e₂ − e₁| · R/sin(θ/2) at a convex vertex,
//! - (2) Q = P + (e₁ − e₂)/|e₁ − e₂| · R/cos((π − θ)/2) at a reflex one,
//! - (3) Q = P + n·R at a parallel one (the paper defines n by Q itself: the left normal is meant),
//!
//! are Q = P + R (n₁ − h e₁). In this form nothing cancels near θ = π, where the printed directions become 0/0, and
//! h keeps its digits down to θ = 0, where sin(θ/2) from unit vectors has none: it comes from an exact orientation.

use super::profile::Edge;
use crate::point::Point;

/// What the corners of one offset have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// Offset distance R, mm.
    pub(super) distance: f64,
    /// Largest distance of a corner from its reflex vertex, in multiples of the offset distance.
    pub(super) limit: f64,
    /// Beyond this distance from any vertex lies nothing of the region, mm.
    pub(super) far: f64,
}

impl Joint {
    /// The offset point on the bisector between two edges: equations (1) to (3).
    pub(super) fn on_bisector(&self, before: &Edge, after: &Edge) -> Point {
        let n = before.direction.left();
        after.start + (n - before.direction * after.half_turn) * self.distance // (1), (2), (3)
    }

    /// By how much a convex corner shortens the offsets of its two edges, mm.
    pub(super) fn trim(&self, after: &Edge) -> f64 {
        self.distance * after.half_turn
    }

    /// Whether what the bisector cuts off the strips of two edges at a convex vertex lies in both: the ends of the strips, as far as
    /// they overlap. Their feet reach d sin φ from the vertex, or d tan(φ/2) in an acute corner.
    pub(super) fn kite_is_covered(&self, before: &Edge, after: &Edge) -> bool {
        let h = after.half_turn;
        let reach = self.distance * h.max(2.0 * h / (1.0 + h * h));
        reach <= before.length && reach <= after.length
    }

    /// The corner at a parallel or reflex vertex: one point, or two where it is cut.
    pub(super) fn mitre(&self, before: &Edge, after: &Edge, out: &mut Vec<Point>) {
        let h = after.half_turn.abs();
        let reach = h.hypot(1.0);
        let cut = if reach > self.limit { Some(1.0) } else { None };
        let cut = cut.or_else(|| (reach * self.distance > self.far).then_some(self.far / self.distance));
        let Some(cut) = cut else {
            out.push(self.on_bisector(before, after));
            return;
        };
        // The line square to the bisector at `cut` distances from the vertex meets the offset line of each edge at
        // x from the vertex's foot: cos(φ/2) + x sin(φ/2) = cut.
        let (cos, sin) = if h.is_finite() { (1.0 / reach, h / reach) } else { (0.0, 1.0) };
        let x = (cut - cos) / sin;
        let [a, b] = [before.direction, after.direction];
        out.push(after.start + (a.left() + a * x) * self.distance);
        out.push(after.start + (b.left() - b * x) * self.distance);
    }

    /// The ends of both offset edges at a vertex and the vertex itself between: the pair-wise connection.
    pub(super) fn pair_wise(&self, before: &Edge, after: &Edge, out: &mut Vec<Point>) {
        let foot = after.start;
        out.push(foot + before.direction.left() * self.distance);
        out.push(foot);
        out.push(foot + after.direction.left() * self.distance);
    }
}
