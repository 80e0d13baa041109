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

/// How far quarters of a chord may lie within taken ground, as a share of the tolerance. A line with one corner that is off by
/// the tolerance, and less so at the middle, is off by more than this at a quarter: the nearer the corner is to the middle,
/// the less, but for 3/8 of the way two thirds.
const QUARTER: f64 = 0.65;

/// How much of the strip that a cell keeps off belongs to the triangle of the other one: not all, so that rounding does not
/// let them meet.
const BULGE: f64 = 0.8;

/// A convex area.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// Points on the lines that bound it, which lies to the left of each.
    sides: Vec<[Point; 2]>,
}

impl Room {
    /// The room of a cell's chord: the cell, with a quarter of each cell next to it that no line enters, and a share of each
    /// that only other lines enter; or one half of the cell where two chords go around opposite corners.
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
        let (edges, beyond) = (super::sides(link.cell), [(i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j)]);
        let mut sides = Vec::with_capacity(8);
        for k in 0..4 {
            let side @ [from, to] = [place(nodes[k]), place(nodes[(k + 1) % 4])];
            if tracer.is_crossed(edges[k]) {
                sides.push(side);
            } else if tracer.is_uncut(beyond[k]) {
                let apex = tracer.middle(beyond[k]);
                sides.extend([[from, apex], [apex, to]]);
            } else {
                tracer.share(side, link.cell, beyond[k], &mut sides);
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
    /// The border of a cell's room towards a cell beyond an edge that no line crosses, where other lines run in both: the one
    /// whose crossings lie nearer to the edge, whose line may bulge over it, has a triangle beyond; the other
    /// keeps off by as much, and still holds its own crossings.
    fn share(&self, [from, to]: [Point; 2], own: (isize, isize), other: (isize, isize), sides: &mut Vec<[Point; 2]>) {
        let inwards = (to - from).normalized().left();
        let nearest = |cell| self.crossings(cell).map(|p| inwards.dot(p - from).abs()).fold(f64::INFINITY, f64::min);
        let shift = 0.5 * (nearest(own) - nearest(other));
        if shift > CONTOUR {
            sides.push([from + inwards * shift, to + inwards * shift]);
        } else if shift < -CONTOUR {
            let apex = from.midpoint(to) + inwards * (BULGE * shift);
            sides.extend([[from, apex], [apex, to]]);
        } else {
            sides.push([from, to]);
        }
    }

    /// The points between two points of a cell's line, pushed in order.
    pub(super) fn refine(&self, room: &Room, from: Point, to: Point, depth: usize, line: &mut Vec<Point>) {
        let length = from.distance(to);
        if depth == DEEPEST || length <= 2.0 * CONTOUR {
            return;
        }
        let inwards = ((to - from) / length).left();
        let Some(found) = self.off_chord(room, from, to, inwards) else { return };
        let across = [found, found + inwards * length];
        let side = |p: Point| orientation(across[0], across[1], p);
        if !(room.holds(found) && side(from) > 0.0 && side(to) < 0.0) {
            return;
        }
        self.refine(&room.within(across), from, found, depth + 1, line);
        line.push(found);
        self.refine(&room.within([across[1], across[0]]), found, to, depth + 1, line);
    }

    /// A point of the line that lies too far off a chord: across from its middle, or from a quarter that is within taken ground.
    fn off_chord(&self, room: &Room, from: Point, to: Point, inwards: Vec2) -> Option<Point> {
        let middle = from.midpoint(to);
        if let Some(found) = self.line_near(room, middle, inwards).filter(|p| p.distance(middle) > CONTOUR) {
            return Some(found);
        }
        let near = inwards * (QUARTER * CONTOUR);
        let quarters = [from.midpoint(middle), middle.midpoint(to)];
        let taken = quarters.into_iter().find(|&q| !self.is_free(q) && !self.is_free(q + near))?;
        self.line_near(room, taken, inwards)
    }

    /// The line's point straight across from a point of a chord, within the room; where the room ends before it and the point is taken,
    /// the room's last place, which is nearer to it.
    fn line_near(&self, room: &Room, p: Point, inwards: Vec2) -> Option<Point> {
        let (way, start_free) = if self.is_free(p) { (-inwards, true) } else { (inwards, false) };
        let most = room.reach(p, way, 0.5 * SETTLED * CONTOUR);
        let mut reach = CONTOUR;
        let mut last = p;
        // Ever longer steps, so that near lines, the usual ones, are found soon.
        loop {
            let end = p + way * reach.min(most);
            if self.is_free(end) != start_free {
                let (free, taken) = if start_free { (last, end) } else { (end, last) };
                return Some(free.lerp(taken, self.settle(free, taken)));
            }
            if reach >= most {
                return (!start_free).then_some(end);
            }
            last = end;
            reach *= 4.0;
        }
    }
}
