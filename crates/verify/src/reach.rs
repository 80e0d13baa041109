//! What the tool can reach: the admissible centres and the opening of the region by the tool.
//!
//! Admissible centres are the points of the region whose clearance is at least the tool's radius, the stock to leave and
//! a little more. Their outline is cut out of the walls' inner parallels and the sectors about reflex corners. The
//! opening is all that a tool in an admissible centre covers; its outline is cut out of the outer parallels of the
//! centres' outline and the sectors about its corners.
//!
//! Where walls touch, or run back on themselves as the sides of a spike do, the parallel of one wall comes out behind the
//! other and there keeps its distance from both, for as long as they lie within the rounding of one another. No piece
//! meets a wall, so its middle tells whether it lies inside the region.

use crate::outline::{self, Side};
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::tolerance::proof::CUSP;
use pocketry_geom::{Point, Segment};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The outline of the admissible centres, which lie to the left of every piece.
pub(crate) struct Centers {
    pub(crate) pieces: Vec<Segment>,
    pub(crate) tree: Tree,
    /// Least clearance.
    clearance: f64,
    rounding: f64,
}

impl Centers {
    /// The centres with at least this clearance (less the rounding: rather too many than too few).
    pub(crate) fn new(walls: &Walls, clearance: f64, rounding: f64) -> Self {
        let clearance = clearance - rounding;
        let mut curves = Vec::with_capacity(2 * walls.segments.len());
        for (wall, &next) in walls.segments.iter().zip(&walls.next) {
            let next = &walls.segments[next as usize];
            curves.extend(outline::parallel(wall, clearance, Side::Left));
            curves.extend(corner(wall, next, clearance));
        }
        let exposed = outline::exposed(&curves, &walls.tree, clearance - rounding);
        let inside = |piece: &Segment| walls.contain(piece.at(0.5));
        let pieces: Vec<Segment> = exposed.into_par_iter().with_min_len(64).filter(inside).collect();
        Self { tree: Tree::new(&pieces), pieces, clearance: clearance - rounding, rounding }
    }

    /// Whether a point is an admissible centre itself.
    pub(crate) fn contain(&self, walls: &Walls, p: Point) -> bool {
        !self.excluded_by_wall(walls, p) && walls.contain(p)
    }

    /// Whether a wall is too near to a point for it to be an admissible centre.
    pub(crate) fn excluded_by_wall(&self, walls: &Walls, p: Point) -> bool {
        walls.tree.any_within(p, self.clearance)
    }

    /// The outline of all that a disc of this radius about admissible centres covers, to the left of every piece.
    pub(crate) fn opening(&self, radius: f64) -> Opening {
        let radius = radius - self.rounding;
        let reach = self.link_reach(radius);
        let next = outline::links(&self.pieces, reach);
        let mut curves = Vec::with_capacity(2 * self.pieces.len());
        for (piece, next) in self.pieces.iter().zip(&next) {
            curves.extend(outline::parallel(piece, radius, Side::Right));
            match next {
                Some(next) => curves.extend(outline::sector(piece, &self.pieces[*next as usize], radius, Side::Right)),
                None => curves.extend(outline::circle(piece.end(), radius)),
            }
        }
        let pieces = outline::exposed(&curves, &self.tree, radius - self.rounding);
        let (area, area_error) = outline::enclosed_area(&pieces, reach, radius);
        Opening { pieces, area: area.max(0.0), area_error }
    }

    /// How far the ends of pieces that belong together may lie apart: a cut at a grazing angle moves by the root of the
    /// rounding.
    pub(crate) fn link_reach(&self, radius: f64) -> f64 {
        8.0 * (2.0 * self.rounding * radius).sqrt() + 8.0 * self.rounding
    }
}

/// The opening of a region by a tool.
pub(crate) struct Opening {
    pub(crate) pieces: Vec<Segment>,
    /// mm².
    pub(crate) area: f64,
    /// What gaps in the outline may make of it at most, mm².
    pub(crate) area_error: f64,
}

/// The sector about a reflex corner. At a cusp (a turn of half a circle) the sign of the turn tells nothing; the sector
/// of a cusp that is no reflex corner lies outside the region.
fn corner(wall: &Segment, next: &Segment, radius: f64) -> Option<Segment> {
    let turn = wall.end_tangent().angle_to(next.start_tangent());
    if turn.abs() < PI - CUSP {
        outline::sector(wall, next, radius, Side::Left)
    } else {
        Some(outline::cap(wall.end(), wall.end_tangent(), radius))
    }
}
