//! The outline of what is left in a zone, and its area in closed form.
//!
//! All disks have one radius and none enters a wall, so that the outline consists of the zone's walls and, of each mouth's
//! circle between its two feet, what no other mouth's disk covers. Its area is a sum over these lines and arcs
//! (Green's theorem); which kinds of sites meet plays no part.

use super::Mouth;
use super::mouths::Mouths;
use super::zones::Zone;
use crate::point::{Point, Vec2};
use crate::segment::{Arc, Segment};
use std::f64::consts::{PI, TAU};

/// The outline of what the disks at the mouths leave of a zone, the material to the left.
pub(super) fn outline(zone: &Zone, mouths: &Mouths<'_>) -> Vec<Segment> {
    let mut out = zone.walls.clone();
    for mouth in &zone.mouths {
        exposed(mouth, mouths, &mut out);
    }
    out
}

/// Area within an outline, mm².
pub(super) fn area(outline: &[Segment]) -> f64 {
    let Some(origin) = outline.first().map(Segment::start) else { return 0.0 };
    (0.5 * outline.iter().map(|s| s.area_twice(origin)).sum::<f64>()).max(0.0)
}

impl Mouth {
    /// The arc of its circle that faces the zone, from one foot clockwise to the other; none at a spoke, whose two feet
    /// are one.
    pub(super) fn facing(&self) -> Option<Arc> {
        let [start, end] = self.feet;
        let arc = Arc { start, end, center: self.at, radius: self.radius, ccw: false };
        // The feet lie to both sides of an edge that clearance falls along: more than half a turn is less than none.
        (start != end && arc.sweep().abs() <= PI.midpoint(TAU)).then_some(arc)
    }

    /// The turn from its first foot clockwise to a direction, in [0, 2π).
    fn turn_to(&self, direction: Vec2) -> f64 {
        let turn = direction.angle_to(self.feet[0] - self.at);
        if turn < 0.0 { turn + TAU } else { turn }
    }

    /// The turns between which another disk covers its circle, if they meet.
    fn covered_by(&self, other: &Self) -> Option<[f64; 2]> {
        let way = other.at - self.at;
        let apart = way.length();
        let cosine =
            (apart * apart + (self.radius - other.radius) * (self.radius + other.radius)) / (2.0 * apart * self.radius);
        // Also excludes the same disk, and one within the other but for the slack of channels just too narrow.
        (cosine.abs() < 1.0).then(|| {
            let (middle, half) = (self.turn_to(way), cosine.acos());
            [middle - half, middle + half]
        })
    }

    fn on_circle(&self, turn: f64) -> Point {
        self.at + (self.feet[0] - self.at).rotated(-turn)
    }
}

fn exposed(mouth: &Mouth, mouths: &Mouths<'_>, out: &mut Vec<Segment>) {
    let Some(arc) = mouth.facing() else { return };
    let sweep = arc.sweep().abs();
    let mut covered: Vec<[f64; 2]> = Vec::new();
    mouths.visit(mouth.at, 2.0 * mouth.radius, |other| {
        if let Some([from, to]) = mouth.covered_by(other) {
            covered.extend([[from, to], [from - TAU, to - TAU]]);
        }
    });
    covered.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    covered.push([sweep, sweep]);
    let mut at = 0.0;
    for [from, to] in covered {
        if from > at {
            let start = if at == 0.0 { arc.start } else { mouth.on_circle(at) };
            let end = if from >= sweep { arc.end } else { mouth.on_circle(from) };
            let piece = Arc { start, end, ..arc };
            // Where disks touch the same foot rounding leaves pieces without extent, or turns them round.
            let is_real = start != end && piece.sweep().abs() <= PI.midpoint(TAU);
            out.push(if is_real { Segment::Arc(piece) } else { Segment::line(start, end) });
        }
        at = at.max(to);
        if at >= sweep {
            break;
        }
    }
}
