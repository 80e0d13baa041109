//! The collision test: does the profile, placed somewhere, reach into a wall?

use super::crossings::{crossings, fraction};
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::point::{Point, Vec2};
use crate::ray::crossings_left;
use crate::segment::Segment;

/// Walls and a profile.
pub(super) struct Collider<'a> {
    pub(super) walls: &'a SegmentIndex,
    pub(super) profile: &'a Contour,
    bbox: BBox,
    /// Centre and radius of a circle in the profile.
    disk: (Vec2, f64),
    /// Whether that is all of it.
    is_round: bool,
}

impl<'a> Collider<'a> {
    /// `inside` is a point within the profile, best the middle of its largest circle.
    pub(super) fn new(walls: &'a SegmentIndex, profile: &'a Contour, inside: Point) -> Self {
        let round = match profile.segments[0] {
            Segment::Arc(first) if first.ccw => {
                let same = |s: &Segment| matches!(s, Segment::Arc(a) if a.center == first.center && a.radius == first.radius && a.ccw);
                profile.segments.iter().all(same).then(|| (first.center.to_vec(), first.radius))
            }
            _ => None,
        };
        let disk = round.unwrap_or_else(|| (inside.to_vec(), profile.distance(inside)));
        Self { walls, profile, bbox: profile.bbox(), disk, is_round: round.is_some() }
    }

    /// The profile's size, mm.
    pub(super) fn size(&self) -> f64 {
        self.bbox.size()
    }

    /// Whether a wall reaches into the profile with its reference at `p` by more than `depth`.
    pub(super) fn is_deeper(&self, p: Point, depth: f64) -> bool {
        let (center, radius) = self.disk;
        let meets_disk = radius > depth && self.walls.nearest_within(p + center, radius - depth).is_some();
        if meets_disk || self.is_round {
            return meets_disk;
        }
        let shift = p.to_vec();
        // What is deeper in the profile is as deep in its box.
        let inner = BBox { min: self.bbox.min + shift, max: self.bbox.max + shift }.inflated(-depth);
        !inner.is_empty() && self.walls.any(inner, 0.0, |_, wall| self.enters(&wall.translated(-shift), depth))
    }

    /// Whether a wall, seen from the reference, reaches deeper into the profile: at its start, or half-way between two places
    /// where it crosses the profile's contour.
    fn enters(&self, wall: &Segment, depth: f64) -> bool {
        if self.holds(wall.start(), depth) {
            return true;
        }
        let mut stops = vec![0.0, 1.0];
        for s in &self.profile.segments {
            crossings(wall, s, |p, _| stops.push(fraction(wall, p)));
        }
        stops.sort_unstable_by(f64::total_cmp);
        stops.windows(2).any(|w| self.holds(wall.at(0.5 * (w[0] + w[1])), depth))
    }

    /// Whether a point lies in the profile, farther from its contour.
    fn holds(&self, p: Point, depth: f64) -> bool {
        let mut crossings = 0;
        self.profile.segments.iter().for_each(|s| crossings_left(s, p, |_| crossings += 1));
        crossings % 2 == 1 && self.profile.distance(p) > depth
    }
}
