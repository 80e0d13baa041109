//! What disks and mitres surely cover, as a quadtree: edges that lie in it are no part of an offset, and need no crossings.
//!
//! Where edges are much shorter than the distance, nearly all of the raw curve runs deep inside of strips and mitres, crossing
//! itself over and over. A point of the region nearer than d to the boundary lies in a strip or a mitre, so disks of radius d
//! about the boundary's vertices tell most of it; long mitres tell the rest.

use super::corner::Joint;
use super::profile::Edge;
use crate::bbox::BBox;
use crate::point::{Point, Vec2, vec2};

/// Halvings of the region's size down to the smallest cells, at most.
const DEEPEST: u32 = 10;

/// The smallest cells measure about this share of the distance.
const FINEST: f64 = 1.0 / 16.0;

/// Mitres that reach farther than this many distances are worth a look of their own.
const LONG: f64 = 1.25;

/// A square node: nothing known, all covered, or the place of its first of four children.
const OPEN: u32 = u32::MAX;
const FULL: u32 = u32::MAX - 1;

/// How a shape lies to a square.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fit {
    Apart,
    Around,
    Across,
}

/// A square of the tree.
#[derive(Clone, Copy)]
struct Square {
    node: usize,
    center: Point,
    half: f64,
    level: u32,
}

impl Square {
    fn quarters(self, first: usize) -> [Self; 4] {
        let half = 0.5 * self.half;
        let shift = |k: usize| vec2(if k & 1 == 0 { -half } else { half }, if k & 2 == 0 { -half } else { half });
        [0, 1, 2, 3].map(|k| Self { node: first + k, center: self.center + shift(k), half, level: self.level + 1 })
    }
}

/// The places that disks and mitres cover, and all outside of the region's box.
pub(super) struct Covered {
    nodes: Vec<u32>,
    center: Point,
    half: f64,
    depth: u32,
    bbox: BBox,
}

impl Covered {
    /// What surely lies in strips and mitres, `slack` left out.
    pub(super) fn new(loops: &[Vec<Edge>], joint: &Joint, bbox: BBox, slack: f64) -> Self {
        let half = 0.5 * bbox.width().max(bbox.height()) + slack;
        let depth = (2.0 * half / (FINEST * joint.distance)).log2().ceil().clamp(1.0, f64::from(DEEPEST)) as u32;
        let mut covered = Self { nodes: vec![OPEN], center: bbox.center(), half, depth, bbox: bbox.inflated(slack) };
        let spacing = FINEST * joint.distance;
        for edges in loops {
            covered.add_mitres(edges, joint, slack);
        }
        for edges in loops {
            let mut last: Option<Point> = None;
            for e in edges {
                if last.is_none_or(|l| l.distance_squared(e.start) > spacing * spacing) {
                    covered.add_disk(e.start, joint.distance - slack);
                    last = Some(e.start);
                }
            }
        }
        covered
    }

    fn root(&self) -> Square {
        Square { node: 0, center: self.center, half: self.half, level: 0 }
    }

    fn add_disk(&mut self, center: Point, radius: f64) {
        self.add(self.root(), &|square: Square| {
            let (dx, dy) = ((center.x - square.center.x).abs(), (center.y - square.center.y).abs());
            let near = vec2((dx - square.half).max(0.0), (dy - square.half).max(0.0));
            let far = vec2(dx + square.half, dy + square.half);
            match () {
                () if near.dot(near) >= radius * radius => Fit::Apart,
                () if far.dot(far) < radius * radius => Fit::Around,
                () => Fit::Across,
            }
        });
    }

    /// Long mitres: what lies ahead of the edge before, behind the one after, below both offset lines and the cut.
    fn add_mitres(&mut self, edges: &[Edge], joint: &Joint, slack: f64) {
        for k in 0..edges.len() {
            let (before, after) = (&edges[(k + edges.len() - 1) % edges.len()], &edges[k]);
            let reach = after.half_turn.hypot(1.0);
            if after.half_turn >= 0.0 || !reach.is_finite() || reach.min(joint.limit) <= LONG {
                continue;
            }
            let (u, v, d) = (before.direction, after.direction, joint.distance);
            let bisector = (u - v).normalized();
            let cut = if reach > joint.limit { d } else { joint.far };
            let sides =
                [(-u, -slack), (v, -slack), (u.left(), d - slack), (v.left(), d - slack), (bisector, cut - slack)];
            let apex = after.start;
            self.add(self.root(), &|square: Square| {
                let from = square.center - apex;
                let room = |(n, most): &(Vec2, f64)| (most - n.dot(from), square.half * (n.x.abs() + n.y.abs()));
                let mut fit = Fit::Around;
                for side in &sides {
                    let (room, extent) = room(side);
                    if room <= -extent {
                        return Fit::Apart;
                    }
                    if room < extent {
                        fit = Fit::Across;
                    }
                }
                fit
            });
        }
    }

    /// Marks the squares that a shape is around.
    fn add(&mut self, square: Square, fit: &impl Fn(Square) -> Fit) {
        let content = self.nodes[square.node];
        if content == FULL {
            return;
        }
        match fit(square) {
            Fit::Apart => return,
            Fit::Around => {
                self.nodes[square.node] = FULL;
                return;
            }
            Fit::Across if square.level == self.depth => return,
            Fit::Across => {}
        }
        let first = if content == OPEN {
            let first = self.nodes.len();
            self.nodes.extend([OPEN; 4]);
            self.nodes[square.node] = first as u32;
            first
        } else {
            content as usize
        };
        for quarter in square.quarters(first) {
            self.add(quarter, fit);
        }
        if self.nodes[first..first + 4].iter().all(|&n| n == FULL) {
            self.nodes[square.node] = FULL;
        }
    }

    /// Whether all of an edge is covered.
    pub(super) fn holds(&self, [a, b]: [Point; 2]) -> bool {
        if !self.bbox.intersects(BBox::of(a, b)) {
            return true;
        }
        self.holds_in(self.root(), a, b)
    }

    fn holds_in(&self, square: Square, a: Point, b: Point) -> bool {
        let content = self.nodes[square.node];
        if content == FULL || misses(square, a, b) {
            return true;
        }
        content != OPEN && square.quarters(content as usize).into_iter().all(|quarter| self.holds_in(quarter, a, b))
    }
}

/// Whether an edge stays outside of a square, by one of three separating directions.
fn misses(square: Square, a: Point, b: Point) -> bool {
    let (a, b, h) = (a - square.center, b - square.center, square.half);
    let along = b - a;
    a.x.min(b.x) > h
        || a.x.max(b.x) < -h
        || a.y.min(b.y) > h
        || a.y.max(b.y) < -h
        || along.cross(a).abs() > h * (along.x.abs() + along.y.abs())
}
