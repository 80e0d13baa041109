//! Contour lines of the CL-surface: where the tip at height `z` is about to touch.
//!
//! 1. A node is *free* where the tip may be at `z`; around the grid lies a ring of nodes that are not. A line crosses
//!    every grid edge between a free node and one that is not, once.
//! 2. In each cell, crossings are joined so that free ground lies to the left; where all four edges are crossed, the surface at the
//!    cell's middle says how. Every crossing leaves one cell and enters another: the lines close by construction.
//! 3. Crossings are settled on the surface itself, by bisection of the grid edge: the grid's heights are not interpolated,
//!    since a CL-surface has cliffs. They end on the free side.
//! 4. A chord whose middle lies off the line by more than the tolerance is split there, and so on: sharp corners
//!    are found and arcs followed. Points stay within their cell, so that lines of different cells can't cross.
//! 5. Points that a line can do without are dropped ([`super::simplify`]).
//!
//! What is smaller than a cell may be missed: free ground is then lost, and obstacles narrower than a cell are seen only where a
//! node or a crossing meets them. Cutters whose flat is wider than the cell's diagonal have no such obstacles.

use super::simplify::simplify;
use super::{ClSurface, HeightGrid};
use pocketry_geom::repair::{self, RegionError, RepairOptions};
use pocketry_geom::tolerance::surface::{CONTOUR, SETTLED, SIMPLIFY};
use pocketry_geom::{Contour, Point, Region, Segment, Vec2};
use std::collections::BTreeMap;

/// Chords are split no more often than this.
const DEEPEST: usize = 7;

/// A grid edge: column and row of its first node (the ring around the grid counts from -1), and whether it goes up.
type GridEdge = (isize, isize, bool);

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
        let simple: Vec<Vec<Point>> = lines.iter().map(|l| simplify(l, SIMPLIFY)).collect();
        region_of(&simple).or_else(|_| region_of(&lines))
    }

    /// The contour lines at height `z` as closed sequences of points, free ground to the left; ground that is not admitted
    /// counts as not free.
    pub fn contours(&self, surface: &ClSurface, z: f64, admits: &(dyn Fn(Point) -> bool + Sync)) -> Vec<Vec<Point>> {
        let tracer = Tracer { grid: self, surface, z, admits };
        let mut next = tracer.links();
        let mut lines = Vec::new();
        while let Some((&first, _)) = next.first_key_value() {
            let mut line = Vec::new();
            let mut at = first;
            while let Some((to, cell)) = next.remove(&at) {
                let (from, end) = (tracer.crossing(at), tracer.crossing(to));
                line.push(from);
                tracer.refine(cell, from, end, 0, &mut line);
                at = to;
            }
            line.dedup();
            lines.push(line);
        }
        lines.retain(|l| l.len() > 2);
        lines
    }
}

fn region_of(lines: &[Vec<Point>]) -> Result<Region, RegionError> {
    let contour = |l: &Vec<Point>| {
        let ends = l.iter().zip(l.iter().cycle().skip(1));
        Contour::new(ends.filter(|(a, b)| a != b).map(|(&a, &b)| Segment::line(a, b)).collect())
    };
    let contours: Vec<Contour> = lines.iter().map(contour).filter(|c| c.segments.len() > 2).collect();
    if contours.is_empty() {
        return Ok(Region::default());
    }
    match repair::build(contours, &RepairOptions { join_tolerance: CONTOUR }) {
        Ok(healed) => Ok(healed.region),
        Err(RegionError::Nothing { .. }) => Ok(Region::default()),
        Err(other) => Err(other),
    }
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

    /// Step 2: for each crossing the next one and the cell between them.
    fn links(&self) -> BTreeMap<GridEdge, (GridEdge, (isize, isize))> {
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

    fn link_cell(
        &self,
        (i, j): (isize, isize),
        free: [bool; 4],
        next: &mut BTreeMap<GridEdge, (GridEdge, (isize, isize))>,
    ) {
        // Counter-clockwise: edge k leads from corner k to the next one.
        let edges = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
        let leaves: Vec<usize> = (0..4).filter(|&k| free[k] && !free[(k + 1) % 4]).collect();
        let enters: Vec<usize> = (0..4).filter(|&k| !free[k] && free[(k + 1) % 4]).collect();
        let joined = leaves.len() == 2 && self.is_free(self.grid.place(i, j).midpoint(self.grid.place(i + 1, j + 1)));
        for &k in &leaves {
            // Around its own corner to the edge before, or around the corner that is not free to the edge behind.
            let step = if joined { 1 } else { 3 };
            let to = if leaves.len() == 2 { (k + step) % 4 } else { enters[0] };
            next.insert(edges[k], (edges[to], (i, j)));
        }
    }

    /// Step 3.
    fn crossing(&self, (i, j, up): GridEdge) -> Point {
        let (a, b) = (self.grid.place(i, j), if up { self.grid.place(i, j + 1) } else { self.grid.place(i + 1, j) });
        if self.is_free_node(i, j) { self.settle(a, b) } else { self.settle(b, a) }
    }

    /// The last free point on the way from a free point to one that is not, to a share of the tolerance.
    ///
    /// Guesses by the heights of both, a little to either side of what they say, so that a smooth surface is bracketed in a
    /// few steps; halves where that does not help, as at cliffs.
    fn settle(&self, free: Point, taken: Point) -> Point {
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
        free.lerp(taken, low)
    }

    /// Step 4: the points between two points of a cell's line, pushed in order.
    fn refine(&self, cell: (isize, isize), from: Point, to: Point, depth: usize, line: &mut Vec<Point>) {
        let length = from.distance(to);
        if depth == DEEPEST || length <= 2.0 * CONTOUR {
            return;
        }
        let middle = from.midpoint(to);
        let inwards = ((to - from) / length).left();
        let Some(found) = self.line_near(cell, middle, inwards) else { return };
        if found.distance(middle) <= CONTOUR {
            return;
        }
        self.refine(cell, from, found, depth + 1, line);
        line.push(found);
        self.refine(cell, found, to, depth + 1, line);
    }

    /// The line's point straight across a chord's middle, within the cell; the middle itself where it is near enough.
    fn line_near(&self, cell: (isize, isize), middle: Point, inwards: Vec2) -> Option<Point> {
        let (way, start_free) = if self.is_free(middle) { (-inwards, true) } else { (inwards, false) };
        let room = self.room(cell, middle, way);
        let mut reach = CONTOUR;
        let mut last = middle;
        // Ever longer steps, so that near lines, the usual ones, are found soon.
        loop {
            let end = middle + way * reach.min(room);
            if self.is_free(end) != start_free {
                return Some(if start_free { self.settle(last, end) } else { self.settle(end, last) });
            }
            if reach >= room {
                return None;
            }
            last = end;
            reach *= 4.0;
        }
    }

    /// How far one may go from a point of a cell within it.
    fn room(&self, (i, j): (isize, isize), p: Point, way: Vec2) -> f64 {
        let (low, high) = (self.grid.place(i, j), self.grid.place(i + 1, j + 1));
        let along = |p: f64, way: f64, low: f64, high: f64| {
            if way > 0.0 {
                (high - p) / way
            } else if way < 0.0 {
                (low - p) / way
            } else {
                f64::INFINITY
            }
        };
        along(p.x, way.x, low.x, high.x).min(along(p.y, way.y, low.y, high.y)).max(0.0)
    }
}
