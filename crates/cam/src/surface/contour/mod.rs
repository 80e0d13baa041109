//! Contour lines of the CL-surface: where the tip at height `z` is about to touch.
//!
//! 1. A node is *free* where the tip may be at `z`; around the grid lies a ring of nodes that are not. A line crosses
//!    every grid edge between a free node and one that is not, once.
//! 2. In each cell, crossings are joined so that free ground lies to the left; where all four edges are crossed, the surface at the
//!    cell's middle says how. Every crossing leaves one cell and enters another: the lines close by construction.
//! 3. Crossings are settled on the surface itself, by bisection of the grid edge: the grid's heights are not interpolated,
//!    since a CL-surface has cliffs. They end on the free side, strictly between the edge's nodes.
//! 4. A chord whose middle lies off the line by more than the tolerance, or a quarter within taken ground, is split there, and so on:
//!    sharp corners are found and arcs followed ([`refine`]). Every chord has a convex room of its own, which goes beyond its cell
//!    where no other line needs the place.
//! 5. Points that a line can do without are dropped ([`super::simplify`]); lines that would then cross keep all of theirs.
//!
//! Lines cross neither themselves nor each other, whatever the surface answers: up to step 4 the open chords lie in rooms that
//! don't meet, and their ends are distinct. No answer of the surface is trusted to agree with another one, which matters
//! where a wall stands right on a node or a cell's middle and rounding says on which side.
//!
//! What is narrower than a cell, such as the tip of a cusp, may be missed: free ground is then lost, and obstacles narrower
//! than a cell are seen only where a node or a crossing meets them. Cutters whose flat is wider than the cell's diagonal have no such obstacles.

mod refine;
#[cfg(test)]
mod tests;

use super::simplify::simplify;
use super::{ClSurface, HeightGrid};
use pocketry_geom::repair::{self, RegionError, RepairOptions};
use pocketry_geom::tolerance::surface::{CONTOUR, SETTLED, SIMPLIFY};
use pocketry_geom::{Contour, Point, Region, Segment};
use refine::Room;
use std::collections::BTreeMap;

/// A grid edge: column and row of its first node (the ring around the grid counts from -1), and whether it goes up.
type GridEdge = (isize, isize, bool);

/// The way from one crossing to the next.
#[derive(Clone, Copy, Debug)]
struct Link {
    to: GridEdge,
    /// The cell between them, by its lowest node.
    cell: (isize, isize),
    /// The corner that it goes around, where another way of the cell goes around the opposite one.
    corner: Option<usize>,
}

impl HeightGrid {
    /// Where the tip may be at height `z`: a region whose boundary already is one of the tool's centre.
    ///
    /// # Errors
    /// Where no region can be made of the lines, which rounding alone could cause.
    pub fn free_region(
        &self,
        surface: &ClSurface,
        z: f64,
        admits: &(dyn Fn(Point) -> bool + Sync),
    ) -> Result<Region, RegionError> {
        let lines = self.contours(surface, z, admits);
        let both = lines.into_iter().map(|l| (simplify(&l, SIMPLIFY), l));
        // What has no more than two points is narrower than the tolerance.
        let (mut lines, mut full): (Vec<_>, Vec<_>) = both.filter(|(simple, _)| simple.len() > 2).unzip();
        loop {
            match region_of(&lines) {
                Err(RegionError::Crossing { first, second, .. })
                    if [first, second].iter().any(|&k| !full[k as usize].is_empty()) =>
                {
                    for k in [first as usize, second as usize] {
                        let points = std::mem::take(&mut full[k]);
                        if !points.is_empty() {
                            lines[k] = points;
                        }
                    }
                }
                done => return done,
            }
        }
    }

    /// The contour lines at height `z` as closed sequences of points, free ground to the left; ground that is not admitted
    /// counts as not free.
    pub fn contours(&self, surface: &ClSurface, z: f64, admits: &(dyn Fn(Point) -> bool + Sync)) -> Vec<Vec<Point>> {
        let tracer = Tracer { grid: self, surface, z, admits };
        let mut next = tracer.links();
        let mut lines = Vec::new();
        while let Some((&first, _)) = next.first_key_value() {
            let mut line = Vec::new();
            let start = tracer.crossing(first);
            let (mut at, mut from) = (first, start);
            while let Some(link) = next.remove(&at) {
                let end = if link.to == first { start } else { tracer.crossing(link.to) };
                line.push(from);
                tracer.refine(&Room::of(&tracer, link), from, end, 0, &mut line);
                (at, from) = (link.to, end);
            }
            lines.push(line);
        }
        lines
    }
}

fn region_of(lines: &[Vec<Point>]) -> Result<Region, RegionError> {
    if lines.is_empty() {
        return Ok(Region::default());
    }
    let contour = |l: &Vec<Point>| {
        let ends = l.iter().zip(l.iter().cycle().skip(1));
        Contour::new(ends.map(|(&a, &b)| Segment::line(a, b)).collect())
    };
    match repair::build(lines.iter().map(contour).collect(), &RepairOptions { join_tolerance: CONTOUR }) {
        Ok(healed) => Ok(healed.region),
        Err(RegionError::Nothing { .. }) => Ok(Region::default()),
        Err(other) => Err(other),
    }
}

/// The edges of a cell, counter-clockwise: edge k leads from corner k to the next one.
const fn sides((i, j): (isize, isize)) -> [GridEdge; 4] {
    [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)]
}

struct Tracer<'a> {
    grid: &'a HeightGrid,
    surface: &'a ClSurface,
    z: f64,
    admits: &'a (dyn Fn(Point) -> bool + Sync),
}

impl Tracer<'_> {
    fn is_free(&self, p: Point) -> bool {
        (self.admits)(p) && self.surface.is_free(p, self.z)
    }

    /// Step 1, from the grid's own heights.
    fn is_free_node(&self, i: isize, j: isize) -> bool {
        let inside =
            (0..self.grid.columns().cast_signed()).contains(&i) && (0..self.grid.rows().cast_signed()).contains(&j);
        inside && self.grid.height(i as usize, j as usize) <= self.z && (self.admits)(self.grid.place(i, j))
    }

    /// Whether all nodes of a cell are alike, so that no line starts in it.
    fn is_uncut(&self, (i, j): (isize, isize)) -> bool {
        let first = self.is_free_node(i, j);
        [(i + 1, j), (i + 1, j + 1), (i, j + 1)].iter().all(|&(i, j)| self.is_free_node(i, j) == first)
    }

    fn middle(&self, (i, j): (isize, isize)) -> Point {
        self.grid.place(i, j).midpoint(self.grid.place(i + 1, j + 1))
    }

    /// Step 2: for each crossing the way to the next one.
    fn links(&self) -> BTreeMap<GridEdge, Link> {
        let mut next = BTreeMap::new();
        let (columns, rows) = (self.grid.columns().cast_signed(), self.grid.rows().cast_signed());
        let row = |j: isize| -> Vec<bool> { (-1..=columns).map(|i| self.is_free_node(i, j)).collect() };
        let mut low = row(-1);
        for j in -1..rows {
            let high = row(j + 1);
            for i in -1..columns {
                let k = (i + 1) as usize;
                let corners = [low[k], low[k + 1], high[k + 1], high[k]];
                if corners.iter().any(|&c| c != corners[0]) {
                    self.link_cell((i, j), corners, &mut next);
                }
            }
            low = high;
        }
        next
    }

    fn link_cell(&self, (i, j): (isize, isize), free: [bool; 4], next: &mut BTreeMap<GridEdge, Link>) {
        let edges = sides((i, j));
        let leaves: Vec<usize> = (0..4).filter(|&k| free[k] && !free[(k + 1) % 4]).collect();
        let enters: Vec<usize> = (0..4).filter(|&k| !free[k] && free[(k + 1) % 4]).collect();
        let joined = leaves.len() == 2 && self.is_free(self.middle((i, j)));
        for &k in &leaves {
            let (to, corner) = match (leaves.len(), joined) {
                (2, true) => ((k + 1) % 4, Some((k + 1) % 4)),
                (2, false) => ((k + 3) % 4, Some(k)),
                _ => (enters[0], None),
            };
            next.insert(edges[k], Link { to: edges[to], cell: (i, j), corner });
        }
    }

    /// The crossings of all lines with a cell's edges.
    fn crossings(&self, cell: (isize, isize)) -> impl Iterator<Item = Point> + '_ {
        sides(cell).into_iter().filter(|&e| self.is_crossed(e)).map(|e| self.crossing(e))
    }

    fn is_crossed(&self, (i, j, up): GridEdge) -> bool {
        let (i_end, j_end) = if up { (i, j + 1) } else { (i + 1, j) };
        self.is_free_node(i, j) != self.is_free_node(i_end, j_end)
    }

    /// Step 3.
    fn crossing(&self, (i, j, up): GridEdge) -> Point {
        let (a, b) = (self.grid.place(i, j), if up { self.grid.place(i, j + 1) } else { self.grid.place(i + 1, j) });
        let (free, taken) = if self.is_free_node(i, j) { (a, b) } else { (b, a) };
        // Half a step of the search off the nodes, so that no two crossings are one.
        let off = (0.5 * SETTLED * CONTOUR / free.distance(taken)).min(0.25);
        free.lerp(taken, self.settle(free, taken).clamp(off, 1.0 - off))
    }

    /// The last free point on the way from a free point to one that is not, to a share of the tolerance, as a share of the way.
    ///
    /// Guesses by the heights of both, a little to either side of what they say, so that a smooth surface is bracketed in a
    /// few steps; halves where that does not help, as at cliffs.
    fn settle(&self, free: Point, taken: Point) -> f64 {
        let whole = free.distance(taken);
        let near = SETTLED * CONTOUR / whole;
        let height = |t: f64| {
            let p = free.lerp(taken, t);
            if (self.admits)(p) { self.surface.height(p) - self.z } else { f64::INFINITY }
        };
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (height(low), height(high));
        let (mut halve, mut side) = (false, -1.0);
        while high - low > near {
            let guess = low + (high - low) * at_low / (at_low - at_high) + 0.4 * side * near;
            let inside = (low + 0.2 * near..=high - 0.2 * near).contains(&guess);
            let t = if halve || !inside { 0.5 * (low + high) } else { guess };
            if t <= low || t >= high {
                break;
            }
            let (before, at) = (high - low, height(t));
            if at <= 0.0 {
                (low, at_low, side) = (t, at, 1.0);
            } else {
                (high, at_high, side) = (t, at, -1.0);
            }
            halve = !halve && high - low > 0.5 * before;
        }
        low
    }
}
