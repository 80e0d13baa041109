//! Material that successive mitred loops leave at reflex corners.
//!
//! Around a reflex vertex that turns by φ, the corner of each loop lies ω/cos(φ/2) farther out than that of the loop before, for an
//! interval ω. There the tool of radius r clears a disk around the inner corner and, on the outer loop, all up to
//! the lines at ω − r from the inner one's edges. Where these meet, at a = (ω − r)/cos(φ/2) from the inner corner, material is left if a > r, or
//!
//! ω > r (1 + cos(φ/2)),
//!
//! which is 1.707 r at 90°; outside of all interfering ranges, which are at convex corners. A straight move
//! from the corner outwards along the bisector, by a − r, takes it away. The point
//! that the tool misses most lies at (r + a cos(φ/2))/(1 + cos(φ/2)) from the corner, as far from there as from the outer loop.

use crate::distance::Boundary;
use crate::index::SegmentIndex;
use crate::offset::Offset;
use crate::point::Point;
use crate::region::Region;
use crate::segment::{Line, Segment};
use crate::tolerance::bisector::STRIP_SLACK;

use super::profile::half_turn;

/// A place beside a reflex corner that no loop of a family clears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MitreLeftover {
    /// The offset (its place in the family) and the loop to which the corner belongs.
    pub offset: u32,
    /// The loop's place in the offset.
    pub contour: u32,
    /// The corner's place in the loop: that of the segment that starts there.
    pub corner: u32,
    /// The turn at the corner, radians, positive.
    pub turn: f64,
    /// The point that the tool misses most.
    pub farthest: Point,
    /// By how much the tool misses it, mm.
    pub miss: f64,
    /// The tool's move that clears it, from the loop's corner and back; `None` where it would come nearer to the wall than
    /// the first offset.
    pub cleanup: Option<Line>,
}

/// What the loops of a family leave uncut at reflex corners. The offsets are of `region`, in order of growing distance.
pub fn mitre_leftovers(region: &Region, family: &[Offset], tool_radius: f64) -> Vec<MitreLeftover> {
    let Some(first) = family.first() else { return Vec::new() };
    let slack = STRIP_SLACK * region.bbox().size();
    let loops = family.iter().flat_map(|o| o.loops.iter().flat_map(|l| l.contour.segments.iter().copied()));
    let paths = SegmentIndex::new(&loops.collect::<Vec<Segment>>());
    let walls = Boundary::new(region);
    let mut found = Vec::new();
    for (k, pair) in family.windows(2).enumerate() {
        let interval = pair[1].distance - pair[0].distance;
        for (contour, l) in pair[0].loops.iter().enumerate() {
            for (corner, mut leftover) in corners(&l.contour.segments, interval, tool_radius) {
                let Some((_, nearest)) = paths.nearest(leftover.farthest) else { continue };
                if nearest <= tool_radius + slack || !walls.contains(leftover.farthest) {
                    continue;
                }
                (leftover.offset, leftover.contour, leftover.corner) = (k as u32, contour as u32, corner);
                leftover.miss = nearest - tool_radius;
                leftover.cleanup =
                    leftover.cleanup.filter(|c| walls.distance_to(&Segment::Line(*c)) >= first.distance - slack);
                found.push(leftover);
            }
        }
    }
    found
}

/// The corners of a loop that may leave something, were the next loop `interval` farther out.
fn corners(segments: &[Segment], interval: f64, radius: f64) -> impl Iterator<Item = (u32, MitreLeftover)> + '_ {
    (0..segments.len()).filter_map(move |k| {
        let before = &segments[(k + segments.len() - 1) % segments.len()];
        let (came, goes) = (before.end_tangent(), segments[k].start_tangent());
        let half = half_turn(came.cross(goes), came.dot(goes));
        let lengthening = half.hypot(1.0);
        if half >= 0.0 || interval <= radius * (1.0 + 1.0 / lengthening) || !lengthening.is_finite() {
            return None;
        }
        let corner = segments[k].start();
        let outwards = came.left() - came * half;
        let out = (interval - radius) * lengthening;
        let to = |length: f64| corner + outwards * (length / lengthening);
        let cleanup = Some(Line::new(corner, to(out - radius)));
        let cos = 1.0 / lengthening;
        let farthest = to((radius + out * cos) / (1.0 + cos));
        let turn = 2.0 * half.abs().atan();
        let leftover = MitreLeftover { offset: 0, contour: 0, corner: 0, turn, farthest, miss: 0.0, cleanup };
        Some((k as u32, leftover))
    })
}
