//! Where the profile may be: bounds of its clearance, and the outline of its admissible places.

use super::shape::Shape;
use super::sum;
use crate::tree::Tree;
use crate::walls::Walls;
use crate::{clip, distance, outline};
use pocketry_geom::tolerance::proof::{CUSP, SMOOTH_JOINT};
use pocketry_geom::{Arc, Point, Segment, Vec2};
use rayon::prelude::*;
use std::f64::consts::PI;

/// A curve is divided until its parts are shorter than this share of the tube about the path.
const FINEST: f64 = 0.02;

/// The places at which the profile keeps this distance from the walls.
pub(crate) struct Places<'a> {
    walls: &'a Walls,
    pub(crate) shape: &'a Shape,
    /// mm, positive.
    pub(crate) distance: f64,
}

impl<'a> Places<'a> {
    pub(crate) fn new(walls: &'a Walls, shape: &'a Shape, distance: f64) -> Self {
        Self { walls, shape, distance }
    }

    /// Distance of the profile at a place, turned by an angle, to the walls; negative where it is not within the region, and then a bound from below of
    /// how far it must move to be. Looks no farther than `limit`, which is the answer where there is no wall.
    fn clearance(&self, at: Point, angle: f64, limit: f64) -> f64 {
        let mut apart = limit;
        let mut entered = 0.0_f64;
        let reached = self.shape.bbox;
        self.walls.tree.near(&Segment::line(at, at), self.shape.reach + limit, |wall| {
            let wall = wall.translated(-at.to_vec()).rotated(-angle);
            if wall.bbox().intersects(reached.inflated(apart)) {
                let nearest = self.shape.segments.iter().map(|s| distance::between(s, &wall)).fold(apart, f64::min);
                apart = nearest;
                entered = entered.max(self.shape.depth_along(&wall));
            }
            true
        });
        let inside = || self.walls.contain(at + self.shape.segments[0].start().to_vec().rotated(angle));
        match () {
            () if entered > 0.0 => -entered,
            () if apart > 0.0 && !inside() => -apart,
            () => apart,
        }
    }

    /// Whether no place within `around` of a place is admissible.
    pub(crate) fn exclude(&self, at: Point, around: f64) -> bool {
        self.exclude_turned(at, 0.0, around, 1.0)
    }

    /// Whether at all places at which no point of the profile, turned by an angle, is farther than `around` from where it would be here,
    /// it has less than this share of the distance to the walls.
    pub(crate) fn exclude_turned(&self, at: Point, angle: f64, around: f64, share: f64) -> bool {
        let distance = share * self.distance;
        self.clearance(at, angle, around + distance) + around < distance
    }

    /// Whether all places within `around` of a place are admissible, and none is on the outline.
    fn include(&self, at: Point, around: f64) -> bool {
        self.clearance(at, 0.0, 2.0 * around + 2.0 * self.distance) - around > self.distance
    }

    /// A place of the outline of the admissible places that is not known to lie within `tube` of the path, if any.
    pub(crate) fn off_the_path(&self, path: &[Segment], tube: f64) -> Option<Point> {
        let tree = Tree::new(path);
        let curves = self.outline_curves();
        curves.par_iter().find_map_first(|curve| {
            let far = clip::exposed(curve, &tree, tube);
            far.into_iter()
                .filter_map(|span| clip::sub(curve, span))
                .find_map(|part| self.on_outline(&part, &tree, tube))
        })
    }

    /// A place of a curve that may belong to the outline and does not lie in the tube about the path.
    fn on_outline(&self, curve: &Segment, path: &Tree, tube: f64) -> Option<Point> {
        let mut parts = vec![*curve];
        while let Some(part) = parts.pop() {
            let (middle, length) = (part.at(0.5), part.length());
            let half = 0.5 * length;
            if self.exclude(middle, half) || self.include(middle, half) {
                continue;
            }
            if length < FINEST * tube {
                // Ends of what was clipped away lie on the tube's rim.
                if path.any_within(middle, tube + half) {
                    continue;
                }
                return Some(middle);
            }
            let (first, second) = part.split_at(middle);
            parts.extend([second, first]);
        }
        None
    }

    /// Curves that hold the outline of the admissible places: where the profile, grown by the distance, touches a wall with
    /// one normal for both, or a reflex corner.
    fn outline_curves(&self) -> Vec<Segment> {
        let grown = self.grown();
        let mut curves = Vec::new();
        for (wall, &next) in self.walls.segments.iter().zip(&self.walls.next) {
            for edge in &grown {
                sum::facing(wall, edge, &mut curves);
            }
            let (arriving, leaving) = (wall.end_tangent(), self.walls.segments[next as usize].start_tangent());
            let turn = arriving.angle_to(leaving);
            if (-SMOOTH_JOINT..=PI - CUSP).contains(&turn) {
                continue;
            }
            let faces = |edge: &&Segment| match edge {
                // Along the sides of a cusp the normals say nothing.
                Segment::Line(l) if turn.abs() < PI - CUSP => {
                    let ahead = leaving.left().angle_to(l.direction().right());
                    (-CUSP..=CUSP - turn).contains(&ahead)
                }
                _ => true,
            };
            curves.extend(grown.iter().filter(faces).map(|edge| edge.translated(wall.end().to_vec())));
        }
        curves
    }

    /// The reflected outline of the profile grown by the distance: parallels of its edges and arcs about its corners.
    fn grown(&self) -> Vec<Segment> {
        let segments = &self.shape.segments;
        let mut out = Vec::new();
        for (k, edge) in segments.iter().enumerate() {
            let next = &segments[(k + 1) % segments.len()];
            out.extend(outline::parallel(edge, self.distance, outline::Side::Right));
            let (m, n) = (edge.end_tangent().right(), next.start_tangent().right());
            let corner = edge.end();
            if m.angle_to(n) > 0.0 {
                let arm = |v: Vec2| corner + v * self.distance;
                out.push(Segment::Arc(Arc {
                    start: arm(m),
                    end: arm(n),
                    center: corner,
                    radius: self.distance,
                    ccw: true,
                }));
            }
        }
        out.iter().map(|s| super::shape::reflected(s, Point::ORIGIN)).collect()
    }
}
