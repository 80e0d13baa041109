//! What hangs together below the tool's reach: stretches of wall, and the mouths through which the tool looks in.
//!
//! A vertex of the skeleton lies *below* the region to be cut (nearer to the wall than the stock to leave), in the *band*
//! that the tool's axis can't enter, or is *high*: the axis gets there. Around a cell the edges lead from below into the
//! band, to a mouth, and back again; between two such events runs one stretch of wall. Stretches on both sides of an
//! edge belong to one zone.

use super::{Mouth, Reach};
use crate::offset::degenerate_slack;
use crate::offset::voronoi::{Carrier, EdgeCurve, parallel_piece, upward};
use crate::point::{Point, Vec2};
use crate::segment::Segment;
use crate::skeleton::trees::DisjointSets;
use crate::skeleton::{EdgeId, NONE, SiteId, SiteShape, Skeleton, VertexId};
use crate::tolerance::CROSSING;

/// Where a vertex lies, in the order of clearance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Below,
    Band,
    High,
}

/// Connected material below the tool's reach.
#[derive(Clone, Debug, Default)]
pub(super) struct Zone {
    /// Walls, or their parallels at the stock to leave, the material to the left.
    pub(super) walls: Vec<Segment>,
    /// The outermost places of the tool's axis.
    pub(super) mouths: Vec<Mouth>,
    /// The skeleton's edges in it, as their even halves; those that end at mouths included.
    pub(super) edges: Vec<EdgeId>,
}

/// The skeleton below one reach.
pub(super) struct Band<'a> {
    pub(super) skeleton: &'a Skeleton,
    reach: Reach,
    slack: f64,
}

/// A stretch of wall while its cell is walked around.
#[derive(Default)]
struct Stretches {
    walls: Vec<Segment>,
    /// For each half-edge the stretch below it.
    of_edge: Vec<u32>,
}

impl<'a> Band<'a> {
    pub(super) fn new(skeleton: &'a Skeleton, reach: Reach) -> Self {
        Self { skeleton, reach, slack: degenerate_slack(reach.axis()) }
    }

    pub(super) fn level(&self, vertex: VertexId) -> Level {
        let clearance = self.skeleton.vertices()[vertex as usize].clearance;
        if clearance >= self.reach.axis() - self.slack {
            Level::High
        } else if clearance < self.reach.stock_to_leave {
            Level::Below
        } else {
            Level::Band
        }
    }

    /// The levels at the ends of a half-edge.
    fn levels(&self, e: EdgeId) -> (Level, Level) {
        (self.level(self.skeleton.origin(e)), self.level(self.skeleton.target(e)))
    }

    /// The zones, in the order of their first stretches.
    pub(super) fn zones(&self) -> Vec<Zone> {
        let mouths = self.mouths();
        let stretches = self.stretches(&mouths);
        let mut sets = DisjointSets::new(stretches.walls.len());
        let inside: Vec<EdgeId> = (0..self.skeleton.edge_count() as EdgeId)
            .map(|k| 2 * k)
            .filter(|&e| stretches.of_edge[e as usize] != NONE && stretches.of_edge[e as usize ^ 1] != NONE)
            .collect();
        for &e in &inside {
            sets.join(stretches.of_edge[e as usize], stretches.of_edge[e as usize ^ 1]);
        }
        let mut number = vec![NONE; stretches.walls.len()];
        let mut zones: Vec<Zone> = Vec::new();
        for (wall, k) in stretches.walls.iter().zip(0..) {
            let root = sets.find(k) as usize;
            if number[root] == NONE {
                number[root] = zones.len() as u32;
                zones.push(Zone::default());
            }
            if wall.start() != wall.end() {
                zones[number[root] as usize].walls.push(*wall);
            }
        }
        for e in inside {
            let zone = &mut zones[number[sets.find(stretches.of_edge[e as usize]) as usize] as usize];
            zone.edges.push(e);
            zone.mouths.extend(mouths[e as usize / 2]);
        }
        zones
    }

    /// For each edge the mouth on it.
    fn mouths(&self) -> Vec<Option<Mouth>> {
        let mouth = |k: EdgeId| {
            let up = upward(self.skeleton, 2 * k);
            let (low, high) = self.levels(up);
            (low < Level::High && high == Level::High).then(|| self.mouth(up))
        };
        (0..self.skeleton.edge_count() as EdgeId).map(mouth).collect()
    }

    fn mouth(&self, up: EdgeId) -> Mouth {
        let s = self.skeleton;
        let curve = EdgeCurve::new(s, up);
        let at = curve.at_clearance(self.reach.axis());
        let radius = self.reach.axis().min(curve.high().clearance) - self.reach.stock_to_leave;
        let carriers = [up, Skeleton::twin(up)].map(|e| Carrier::of(s.sites()[s.site(e) as usize].shape));
        let way = carriers.map(|c| towards(&c, at, radius));
        // About a site's own centre every direction leads to it: that of the other site is the one along the edge.
        let down = (curve.low().point - at).normalized();
        let feet = [way[0].or(way[1]), way[1].or(way[0])].map(|w| at + w.unwrap_or(down) * radius);
        Mouth { at, radius, feet }
    }

    fn stretches(&self, mouths: &[Option<Mouth>]) -> Stretches {
        let of_edge = vec![NONE; self.skeleton.half_edges().len()];
        let mut found = Stretches { walls: Vec::with_capacity(self.skeleton.sites().len()), of_edge };
        for site in 0..self.skeleton.sites().len() as SiteId {
            self.walk(site, mouths, &mut found);
        }
        found
    }

    /// Around one cell, from event to event.
    fn walk(&self, site: SiteId, mouths: &[Option<Mouth>], found: &mut Stretches) {
        let s = self.skeleton;
        let shape = s.sites()[site as usize].shape;
        let (first, last) = ends(shape);
        let on_wall = self.reach.stock_to_leave == 0.0;
        let mut start = on_wall.then_some(first);
        for e in s.cell(site) {
            let (from, to) = self.levels(e);
            if from == to && from != Level::Band {
                continue;
            }
            let event = |level: Level| match level {
                Level::Below => Some(EdgeCurve::new(s, e).at_clearance(self.reach.stock_to_leave)),
                Level::Band => None,
                Level::High => mouths[e as usize / 2].map(|m| m.feet[usize::from(upward(s, e) != e)]),
            };
            start = event(from).or(start);
            found.of_edge[e as usize] = found.walls.len() as u32;
            if let Some(end) = event(to) {
                found.walls.push(parallel_piece(shape, self.reach.stock_to_leave, start.unwrap_or(end), end));
                start = None;
            }
        }
        if let Some(start) = start.filter(|_| on_wall) {
            found.walls.push(parallel_piece(shape, 0.0, start, last));
        }
    }
}

/// The direction from `at` to a site at this distance; none where `at` is the site's centre.
fn towards(carrier: &Carrier, at: Point, distance: f64) -> Option<Vec2> {
    let defined = carrier.center().is_none_or(|(center, _)| center.distance(at) > CROSSING * distance);
    defined.then(|| -carrier.gradient(at))
}

fn ends(shape: SiteShape) -> (Point, Point) {
    match shape {
        SiteShape::Line(l) => (l.start, l.end),
        SiteShape::Arc(a) => (a.start, a.end),
        SiteShape::Point(p) => (p, p),
    }
}
