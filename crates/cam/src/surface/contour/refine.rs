//! Step 4: points between the crossings of a cell, each chord in a convex room of its own.
//!
//! A room is a convex area with the chord's ends on its border and the open chord inside. A chord is split at a point strictly
//! inside its room; the straight line through that point across the chord splits the room, too. The sides are judged by
//! exact predicates, so rooms never meet, and neither do the chords in them, wherever the points are found.

use super::{Link, Tracer};
use pocketry_geom::predicates::orientation;
use pocketry_geom::tolerance::surface::{CONTOUR, SETTLED};
use pocketry_geom::{Point, Vec2};

/// Chords are split no more often than this.
const DEEPEST: usize = 7;

/// A convex area.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// Points on the lines that bound it, which lies to the left of each.
    sides: Vec<[Point; 2]>,
}

impl Room {
    /// The room of a cell's chord: the cell, with a quarter of each cell next to it that no line enters; or one half of
    /// the cell where two chords go around opposite corners.
    ///
    /// The quarters, between a side and the middle of the other cell, are for what bulges out between two nodes.
    pub(super) fn of(tracer: &Tracer<'_>, link: Link) -> Self {
        let (i, j) = link.cell;
        let place = |(i, j)| tracer.grid.place(i, j);
        let nodes = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        if let Some(c) = link.corner {
            let half = [0, 1, 2, 3].map(|k| [place(nodes[k]), place(nodes[(k + 1) % 4])]);
            let across = [place(nodes[(c + 1) % 4]), place(nodes[(c + 3) % 4])];
            return Self { sides: half.into_iter().chain([across]).collect() };
        }
        let beyond = [(i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j)];
        let mut sides = Vec::with_capacity(8);
        for k in 0..4 {
            let (from, to) = (place(nodes[k]), place(nodes[(k + 1) % 4]));
            if tracer.is_uncut(beyond[k]) {
                let apex = tracer.middle(beyond[k]);
                sides.extend([[from, apex], [apex, to]]);
            } else {
                sides.push([from, to]);
            }
        }
        Self { sides }
    }

    fn within(&self, side: [Point; 2]) -> Self {
        Self { sides: self.sides.iter().copied().chain([side]).collect() }
    }

    /// Whether a point lies strictly inside. Exact.
    fn holds(&self, p: Point) -> bool {
        self.sides.iter().all(|&[a, b]| orientation(a, b, p) > 0.0)
    }

    /// How far one may go from a point this way without coming nearer than `margin` to a side, mm.
    fn reach(&self, p: Point, way: Vec2, margin: f64) -> f64 {
        let along = |&[a, b]: &[Point; 2]| {
            let side = (b - a).normalized();
            let (off, rate) = (side.cross(p - a), side.cross(way));
            if rate < 0.0 { (margin - off) / rate } else { f64::INFINITY }
        };
        self.sides.iter().map(along).fold(f64::INFINITY, f64::min).max(0.0)
    }
}

impl Tracer<'_> {
    /// The points between two points of a cell's line, pushed in order.
    pub(super) fn refine(&self, room: &Room, from: Point, to: Point, depth: usize, line: &mut Vec<Point>) {
        let length = from.distance(to);
        if depth == DEEPEST || length <= 2.0 * CONTOUR {
            return;
        }
        let middle = from.midpoint(to);
        let inwards = ((to - from) / length).left();
        let Some(found) = self.line_near(room, middle, inwards) else { return };
        if found.distance(middle) <= CONTOUR {
            return;
        }
        let across = [found, found + inwards * length];
        let side = |p: Point| orientation(across[0], across[1], p);
        if !(room.holds(found) && side(from) > 0.0 && side(to) < 0.0) {
            return;
        }
        self.refine(&room.within(across), from, found, depth + 1, line);
        line.push(found);
        self.refine(&room.within([across[1], across[0]]), found, to, depth + 1, line);
    }

    /// The line's point straight across a chord's middle, within the room.
    fn line_near(&self, room: &Room, middle: Point, inwards: Vec2) -> Option<Point> {
        let (way, start_free) = if self.is_free(middle) { (-inwards, true) } else { (inwards, false) };
        let most = room.reach(middle, way, 0.5 * SETTLED * CONTOUR);
        let mut reach = CONTOUR;
        let mut last = middle;
        // Ever longer steps, so that near lines, the usual ones, are found soon.
        loop {
            let end = middle + way * reach.min(most);
            if self.is_free(end) != start_free {
                let (free, taken) = if start_free { (last, end) } else { (end, last) };
                return Some(free.lerp(taken, self.settle(free, taken)));
            }
            if reach >= most {
                return None;
            }
            last = end;
            reach *= 4.0;
        }
    }
}
