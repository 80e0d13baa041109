//! The deepest place of a zone: the point with the largest distance from its nearest mouth.
//!
//! The distance from one mouth is convex, so its largest value is reached on the walls. The distance from the nearest of
//! several has further maxima at vertices of the mouths' Voronoi diagram, three of them (or more) equally far to all sides.
//!
//! - **Walls.** On a stretch the distance from any one mouth bounds that from the nearest, and its maximum is in an end or,
//!   on an arc, opposite to the mouth. Where another mouth is nearer there, the stretch is parted where the two are
//!   equally far. Stretches are taken in the order of their bounds: the first whose bound is reached is the answer.
//! - **Between mouths.** Squares are halved until few mouths can be nearest in them, whose circumcentres are tried; squares
//!   and stretches that can't beat what is known are left out.

use super::Depth;
use super::mouths::Mouths;
use super::zones::Zone;
use crate::bbox::BBox;
use crate::index::SegmentIndex;
use crate::point::{Point, point};
use crate::segment::{Arc, Segment};
use crate::tolerance::DEPTH;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

/// Squares in which no more mouths can be nearest are settled by the circumcentres of all triples.
const FEW: usize = 8;

/// How often a square is halved: mouths that are still too many then are equally far.
const HALVINGS: u32 = 40;

/// Where the nearest mouth is farthest: the distance from it, mm, and the place.
type Farthest = (f64, Point);

/// The deepest place of a zone with at least one mouth; `radius` is that of the tool.
pub(super) fn deepest(zone: &Zone, mouths: &Mouths<'_>, radius: f64) -> Depth {
    let exact = DEPTH * radius;
    let on_walls = farthest_on_walls(&zone.walls, mouths, exact, (radius, mouths.list()[0].at));
    let (distance, at) = farthest_between(zone, mouths, exact, on_walls);
    Depth { size: distance - radius, at }
}

/// A piece of a wall with a bound of the distance from the nearest mouth.
struct Stretch {
    bound: f64,
    /// Where the distance from one mouth reaches the bound.
    at: Point,
    wall: Segment,
    /// The mouths nearest to its ends.
    nearest: [usize; 2],
}

impl Stretch {
    fn new(wall: Segment, mouths: &Mouths<'_>) -> Self {
        let nearest = [wall.start(), wall.end()].map(|p| mouths.nearest(p).0);
        let [a, b] = nearest.map(|k| farthest_from(&wall, mouths.list()[k].at));
        let (bound, at) = if b.0 < a.0 { b } else { a };
        Self { bound, at, wall, nearest }
    }

    /// Where to part it: where its bound proved too high, or where two mouths are equally far.
    fn parting(&self, mouths: &Mouths<'_>) -> Point {
        if self.at != self.wall.start() && self.at != self.wall.end() {
            return self.at;
        }
        let [a, b] = self.nearest.map(|k| mouths.list()[k].at);
        equally_far(&self.wall, a, b).unwrap_or_else(|| self.wall.at(0.5))
    }
}

impl PartialEq for Stretch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Stretch {}

impl PartialOrd for Stretch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Stretch {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

fn farthest_on_walls(walls: &[Segment], mouths: &Mouths<'_>, exact: f64, least: Farthest) -> Farthest {
    let mut stretches: BinaryHeap<Stretch> = walls.iter().map(|w| Stretch::new(*w, mouths)).collect();
    let mut best = least;
    while let Some(s) = stretches.pop().filter(|s| s.bound > best.0 + exact) {
        let distance = mouths.nearest(s.at).1;
        if distance > best.0 {
            best = (distance, s.at);
        }
        if distance < s.bound - exact {
            let (before, after) = s.wall.split_at(s.parting(mouths));
            // Rounding could turn a piece without extent into a whole turn.
            let parts = [before, after].into_iter().filter(|p| p.length() < s.wall.length());
            stretches.extend(parts.map(|p| Stretch::new(p, mouths)));
        }
    }
    best
}

/// The point of a wall farthest from `p`: an end, or of an arc the point opposite.
fn farthest_from(wall: &Segment, p: Point) -> Farthest {
    let further = |a: Farthest, q: Point| if q.distance(p) > a.0 { (q.distance(p), q) } else { a };
    let ends = further((wall.start().distance(p), wall.start()), wall.end());
    match wall {
        Segment::Arc(a) if a.center != p => {
            let opposite = a.center + (a.center - p).normalized() * a.radius;
            if within(a, opposite) { further(ends, opposite) } else { ends }
        }
        _ => ends,
    }
}

/// A point of a wall's interior that is equally far from two points.
fn equally_far(wall: &Segment, a: Point, b: Point) -> Option<Point> {
    let (middle, way) = (a.midpoint(b), b - a);
    match wall {
        Segment::Line(l) => {
            let along = l.end - l.start;
            let share = (middle - l.start).dot(way) / along.dot(way);
            (share > DEPTH && share < 1.0 - DEPTH).then(|| l.start.lerp(l.end, share))
        }
        Segment::Arc(arc) => {
            let normal = (way.length_squared() > 0.0).then(|| way.normalized())?;
            let off = (middle - arc.center).dot(normal);
            let aside = ((arc.radius - off) * (arc.radius + off)).max(0.0).sqrt();
            let on = |side: f64| arc.center + normal * off + normal.left() * side;
            [on(aside), on(-aside)].into_iter().find(|&p| within(arc, p))
        }
    }
}

/// Whether a point of the circle lies on the arc, away from its ends. (By angles, as arcs without extent have no sides.)
fn within(arc: &Arc, p: Point) -> bool {
    let (from, to) = (arc.start - arc.center, p - arc.center);
    let turn = if arc.ccw { from.angle_to(to) } else { to.angle_to(from) };
    let turn = if turn < 0.0 { turn + TAU } else { turn };
    let gap = DEPTH * arc.radius;
    turn < arc.sweep().abs() && p.distance(arc.start) > gap && p.distance(arc.end) > gap
}

/// A square and the mouths that may be nearest to some point of it.
struct Square {
    bbox: BBox,
    mouths: Vec<u32>,
    depth: u32,
}

fn farthest_between(zone: &Zone, mouths: &Mouths<'_>, exact: f64, least: Farthest) -> Farthest {
    let list = mouths.list();
    if list.len() < 3 {
        return least;
    }
    let inside = Inside::of(zone);
    let bbox = list.iter().fold(BBox::EMPTY, |b, m| b.with(m.at));
    let mut squares = vec![Square { bbox, mouths: (0..list.len() as u32).collect(), depth: 0 }];
    let mut best = least;
    while let Some(mut square) = squares.pop() {
        let to_corner = |k: u32| farthest_corner(square.bbox, list[k as usize].at);
        let bound = square.mouths.iter().map(|&k| to_corner(k)).fold(f64::INFINITY, f64::min);
        if bound <= best.0 + exact {
            continue;
        }
        square.mouths.retain(|&k| nearest_corner(square.bbox, list[k as usize].at) <= bound);
        if square.mouths.len() > FEW && square.depth < HALVINGS {
            squares.extend(square.halves());
            continue;
        }
        square.mouths.truncate(FEW);
        for center in circumcentres(&square.mouths, mouths) {
            let distance = mouths.nearest(center).1;
            if distance > best.0 + exact && inside.contains(center) {
                best = (distance, center);
            }
        }
    }
    best
}

impl Square {
    fn halves(self) -> [Self; 2] {
        let BBox { min, max } = self.bbox;
        let middle = min.midpoint(max);
        let (low, high) = if max.x - min.x > max.y - min.y {
            (point(middle.x, max.y), point(middle.x, min.y))
        } else {
            (point(max.x, middle.y), point(min.x, middle.y))
        };
        let depth = self.depth + 1;
        [
            Self { bbox: BBox { min, max: low }, mouths: self.mouths.clone(), depth },
            Self { bbox: BBox { min: high, max }, mouths: self.mouths, depth },
        ]
    }
}

fn farthest_corner(b: BBox, p: Point) -> f64 {
    let away = |low: f64, high: f64, x: f64| (x - low).abs().max((high - x).abs());
    away(b.min.x, b.max.x, p.x).hypot(away(b.min.y, b.max.y, p.y))
}

fn nearest_corner(b: BBox, p: Point) -> f64 {
    p.distance(point(p.x.clamp(b.min.x, b.max.x), p.y.clamp(b.min.y, b.max.y)))
}

/// The circumcentres of all triples.
fn circumcentres(chosen: &[u32], mouths: &Mouths<'_>) -> Vec<Point> {
    let at = |k: usize| mouths.list()[chosen[k] as usize].at;
    let n = chosen.len();
    let mut out = Vec::new();
    for a in 0..n {
        for b in a + 1..n {
            out.extend((b + 1..n).filter_map(|c| circumcentre(at(a), at(b), at(c))));
        }
    }
    out
}

fn circumcentre(a: Point, b: Point, c: Point) -> Option<Point> {
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.cross(v);
    let way = (u.left() * -v.length_squared() + v.left() * u.length_squared()) / twice;
    Some(a - way).filter(|p| p.is_finite())
}

/// The boundary of a zone, in an index once it is asked for: the walls and, at mouths, the ways to the two feet.
struct Inside<'a> {
    zone: &'a Zone,
    index: OnceCell<SegmentIndex>,
}

impl<'a> Inside<'a> {
    fn of(zone: &'a Zone) -> Self {
        Self { zone, index: OnceCell::new() }
    }

    /// Whether a point lies in the zone (even-odd).
    fn contains(&self, p: Point) -> bool {
        let index = self.index.get_or_init(|| {
            let gates = self.zone.mouths.iter().flat_map(|m| m.feet.map(|f| Segment::line(m.at, f)));
            SegmentIndex::new(&self.zone.walls.iter().copied().chain(gates).collect::<Vec<_>>())
        });
        index.crossings_left(p) % 2 == 1
    }
}
