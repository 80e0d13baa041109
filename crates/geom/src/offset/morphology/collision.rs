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
    /// Centre and radius of a profile that is a circle.
    circle: Option<(Vec2, f64)>,
}

impl<'a> Collider<'a> {
    pub(super) fn new(walls: &'a SegmentIndex, profile: &'a Contour) -> Self {
        let circle = match profile.segments[0] {
            Segment::Arc(first) if first.ccw => {
                let same = |s: &Segment| matches!(s, Segment::Arc(a) if a.center == first.center && a.radius == first.radius && a.ccw);
                profile.segments.iter().all(same).then(|| (first.center.to_vec(), first.radius))
            }
            _ => None,
        };
        Self { walls, profile, bbox: profile.bbox(), circle }
    }

    /// The profile's size, mm.
    pub(super) fn size(&self) -> f64 {
        self.bbox.size()
    }

    /// Whether a wall reaches into the profile with its reference at `p` by more than `depth`.
    pub(super) fn is_deeper(&self, p: Point, depth: f64) -> bool {
        if let Some((center, radius)) = self.circle {
            return radius > depth && self.walls.nearest_within(p + center, radius - depth).is_some();
        }
        let shift = p.to_vec();
        let mut hit = false;
        self.walls.visit(BBox { min: self.bbox.min + shift, max: self.bbox.max + shift }, 0.0, |_, wall| {
            hit = hit || self.enters(&wall.translated(-shift), depth);
        });
        hit
    }

    /// Whether a wall, seen from the reference, reaches deeper into the profile: at its start, or half-way between two places
    /// where it crosses the profile's contour.
    fn enters(&self, wall: &Segment, depth: f64) -> bool {
        let mut stops = vec![0.0, 1.0];
        for s in &self.profile.segments {
            crossings(wall, s, |p, _| stops.push(fraction(wall, p)));
        }
        stops.sort_unstable_by(f64::total_cmp);
        self.holds(wall.start(), depth) || stops.windows(2).any(|w| self.holds(wall.at(0.5 * (w[0] + w[1])), depth))
    }

    /// Whether a point lies in the profile, farther from its contour.
    fn holds(&self, p: Point, depth: f64) -> bool {
        let mut crossings = 0;
        self.profile.segments.iter().for_each(|s| crossings_left(s, p, |_| crossings += 1));
        crossings % 2 == 1 && self.profile.distance(p) > depth
    }
}
