//! Step 1 on the skeleton: the pieces of it between two distances, and where their paths hang on loops.

use super::forest::Forest;
use super::prune::tours;
use super::{Cleanup, Piece, Place, Way, trusted};
use crate::link::{fitted, towards};
use crate::plan::order::Orderer;
use crate::plan::track::Insertion;
use pocketry_geom::offset::{EdgeCurve, degenerate_slack, upward};
use pocketry_geom::skeleton::trees::DisjointSets;
use pocketry_geom::skeleton::{EdgeId, SiteId, SiteShape, Skeleton, VertexId};
use pocketry_geom::tolerance::{CLEANUP_STEP, SPOKE_RATE};
use pocketry_geom::{Point, Segment};
use std::collections::HashMap;

/// Places of a centre that are tried as the one where its path begins.
const CANDIDATES: usize = 12;

/// How far arcs may leave the chords of a path, as a share of how far the chords may leave the skeleton.
const FIT_SHARE: f64 = 0.25;

/// What clean-up takes.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) insertions: Vec<(u32, Insertion)>,
    pub(super) cleanups: Vec<Cleanup>,
}

/// All clean-up paths between and inside the loops at these distances.
pub(super) fn gather(skeleton: &Skeleton, orderer: &Orderer<'_>, distances: &[f64], radius: f64) -> Gathered {
    let radius = trusted(radius);
    let mut parts = parts(skeleton, distances, radius);
    parts.sort_unstable_by_key(|p| p.0);
    let mut gathered = Gathered::default();
    for same in parts.chunk_by(|a, b| a.0 == b.0) {
        let level = same[0].0;
        let high = distances.get(level + 1).copied().unwrap_or(f64::INFINITY);
        let range =
            Range { skeleton, orderer, level, base: distances[level], low: distances[level] + radius, high, radius };
        range.gather(same, &mut gathered);
    }
    gathered
}

/// A part of the skeleton.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    /// The edge of this half-edge, which leads upwards.
    Edge(EdgeId),
    Vertex(VertexId),
}

/// Every edge (spokes apart: what lies on them belongs to their upper end) and vertex in each range that it meets.
fn parts(skeleton: &Skeleton, distances: &[f64], radius: f64) -> Vec<(usize, Part)> {
    let mut parts = Vec::new();
    let mut meet = |low: f64, high: f64, part: Part| {
        let first = distances.partition_point(|&d| d < low).saturating_sub(1);
        for (level, d) in distances.iter().enumerate().skip(first).take_while(|(_, d)| **d + radius <= high) {
            let top = distances.get(level + 1).copied().unwrap_or(f64::INFINITY);
            if low < top && d + radius <= high {
                parts.push((level, part));
            }
        }
    };
    for k in 0..skeleton.edge_count() as EdgeId {
        let e = upward(skeleton, 2 * k);
        let (low, high) = (skeleton.origin_clearance(e), skeleton.target_clearance(e));
        if !is_spoke(skeleton, e) {
            meet(low, high, Part::Edge(e));
        }
    }
    for (v, vertex) in skeleton.vertices().iter().enumerate() {
        meet(vertex.clearance, vertex.clearance, Part::Vertex(v as VertexId));
    }
    parts
}

/// Whether clearance grows along an edge like length.
fn is_spoke(skeleton: &Skeleton, up: EdgeId) -> bool {
    let vertex = |v: VertexId| skeleton.vertices()[v as usize];
    let (low, high) = (vertex(skeleton.origin(up)), vertex(skeleton.target(up)));
    let rise = high.clearance - low.clearance;
    rise > 0.0 && rise >= (1.0 - SPOKE_RATE) * low.point.distance(high.point)
}

/// Where a part of an edge ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Node {
    Vertex(VertexId),
    /// At the range's lower bound.
    Low(EdgeId),
    /// On the inner loop: its track and the segment of it that starts there.
    Top(u32, u32),
}

/// A part of an edge.
struct Link {
    edge: EdgeId,
    from: (f64, Node),
    to: (f64, Node),
}

/// The range between the loops at `base` and those at `high`.
struct Range<'a> {
    skeleton: &'a Skeleton,
    orderer: &'a Orderer<'a>,
    /// Number of the outer loops' distance.
    level: usize,
    base: f64,
    low: f64,
    high: f64,
    radius: f64,
}

/// A piece with the skeleton's names for its places.
#[derive(Default)]
struct Named {
    piece: Piece<(u32, u32)>,
    places: HashMap<Node, u32>,
}

impl Range<'_> {
    fn gather(&self, parts: &[(usize, Part)], gathered: &mut Gathered) {
        for named in self.pieces(parts) {
            let found = if named.piece.roots.is_empty() {
                self.center(&named).into_iter().collect()
            } else {
                self.rooted(&named.piece)
            };
            for (track, mut insertion) in found {
                insertion.tour = fitted(&insertion.tour, FIT_SHARE * degenerate_slack(self.radius));
                let length = insertion.tour.iter().map(Segment::length).sum();
                let start = insertion.tour[0].start();
                gathered.cleanups.push(Cleanup { kind: named.piece.kind(), start, length });
                gathered.insertions.push((track, insertion));
            }
        }
    }

    /// The connected pieces.
    fn pieces(&self, parts: &[(usize, Part)]) -> Vec<Named> {
        let mut numbers: HashMap<Node, u32> = HashMap::new();
        let mut nodes: Vec<Node> = Vec::new();
        let mut number = |node: Node, nodes: &mut Vec<Node>| {
            *numbers.entry(node).or_insert_with(|| {
                nodes.push(node);
                nodes.len() as u32 - 1
            })
        };
        let mut links = Vec::new();
        for &(_, part) in parts {
            match part {
                Part::Vertex(v) => drop(number(self.node_of(v), &mut nodes)),
                Part::Edge(e) => {
                    let link = self.link(e);
                    let ends = (number(link.from.1, &mut nodes), number(link.to.1, &mut nodes));
                    links.push((ends, link));
                }
            }
        }
        let mut sets = DisjointSets::new(nodes.len());
        for ((a, b), _) in &links {
            sets.join(*a, *b);
        }
        let mut place_of = vec![u32::MAX; nodes.len()];
        let mut pieces: Vec<Named> = Vec::new();
        let mut of = |k: u32, pieces: &mut Vec<Named>| {
            let place = &mut place_of[sets.find(k) as usize];
            if *place == u32::MAX {
                *place = pieces.len() as u32;
                pieces.push(Named::default());
            }
            *place as usize
        };
        for (k, &node) in nodes.iter().enumerate() {
            let piece = of(k as u32, &mut pieces);
            self.add_node(&mut pieces[piece], node);
        }
        for ((a, _), link) in &links {
            let piece = of(*a, &mut pieces);
            self.add_link(&mut pieces[piece], link);
        }
        pieces
    }

    /// A vertex in the range, or on the inner loop if it lies just there.
    fn node_of(&self, v: VertexId) -> Node {
        let at_top = self.skeleton.vertices()[v as usize].clearance >= self.high;
        let up = at_top.then(|| self.orderer.fans.around(v).find_map(|e| self.crossing(upward(self.skeleton, e))));
        up.flatten().map_or(Node::Vertex(v), |(track, segment)| Node::Top(track, segment))
    }

    fn link(&self, e: EdgeId) -> Link {
        let (low, high) = (self.skeleton.origin_clearance(e), self.skeleton.target_clearance(e));
        let from = if low < self.low { (self.low, Node::Low(e)) } else { (low, self.node_of(self.skeleton.origin(e))) };
        let top = (high, self.node_of(self.skeleton.target(e)));
        let crossed = if high > self.high { self.crossing(e) } else { None };
        // An inner loop too small to be there does not end the piece.
        let to = crossed.map_or(top, |(track, segment)| (self.high, Node::Top(track, segment)));
        Link { edge: e, from, to }
    }

    /// The segment of an inner loop that starts where it crosses an edge; or the next one, where that is dropped for
    /// being too short. None if the edge does not span the distance, or the whole loop is dropped.
    fn crossing(&self, up: EdgeId) -> Option<(u32, u32)> {
        let spans = self.skeleton.origin_clearance(up) <= self.high && self.high < self.skeleton.target_clearance(up);
        if !spans {
            return None;
        }
        let mut at = up;
        loop {
            if let Some(&found) = self.orderer.crossings.get(&(self.level + 1, at)) {
                return Some(found);
            }
            let mut e = self.skeleton.next(at);
            while e != at && self.skeleton.target_clearance(e) > self.high {
                e = self.skeleton.next(e);
            }
            at = Skeleton::twin(e);
            if at == up {
                return None;
            }
        }
    }

    fn add_node(&self, named: &mut Named, node: Node) {
        let (at, clearance) = match node {
            Node::Vertex(v) => {
                let vertex = self.skeleton.vertices()[v as usize];
                (vertex.point, vertex.clearance)
            }
            Node::Low(e) => (EdgeCurve::new(self.skeleton, e).at_clearance(self.low), self.low),
            Node::Top(track, segment) => (self.orderer.start_of(track, segment), self.high),
        };
        let k = named.piece.places.len() as u32;
        named.piece.places.push(Place { at, reach: (clearance - self.low).max(0.0) });
        named.places.insert(node, k);
        if let Node::Top(track, segment) = node {
            named.piece.roots.push((k, (track, segment)));
        }
    }

    fn add_link(&self, named: &mut Named, link: &Link) {
        let curve = EdgeCurve::new(self.skeleton, link.edge);
        let slack = degenerate_slack(self.radius);
        let whole = matches!((link.from.1, link.to.1), (Node::Vertex(_), Node::Vertex(_)));
        let curves = if whole { curve.whole(true, slack) } else { curve.between(link.from.0, link.to.0, slack) };
        let [first, last] = [link.from.1, link.to.1].map(|node| named.places[&node]);
        let step = if self.is_hollow(link.edge) { CLEANUP_STEP * self.radius } else { f64::INFINITY };
        let pieces: Vec<Segment> = curves.iter().flat_map(|s| steps(s, step, CLEANUP_STEP * self.radius)).collect();
        let mut at = first;
        for (k, segment) in pieces.iter().enumerate() {
            let next = if k + 1 == pieces.len() {
                last
            } else {
                let reach = (curve.clearance(segment.end()) - self.low).max(0.0);
                named.piece.places.push(Place { at: segment.end(), reach });
                named.piece.places.len() as u32 - 1
            };
            named.piece.ways.push(Way { ends: [at, next], segment: *segment });
            at = next;
        }
        if pieces.is_empty() && first != last {
            let [a, b] = [first, last].map(|k| named.piece.places[k as usize].at);
            named.piece.ways.push(Way { ends: [first, last], segment: Segment::line(a, b) });
        }
    }

    /// Whether clearance need not be convex along an edge: a site is an arc seen from inside.
    fn is_hollow(&self, e: EdgeId) -> bool {
        let hollow =
            |e| matches!(self.skeleton.sites()[self.skeleton.site(e) as usize].shape, SiteShape::Arc(a) if a.ccw);
        hollow(e) || hollow(Skeleton::twin(e))
    }

    /// The paths of a piece that hangs on inner loops.
    fn rooted(&self, piece: &Piece<(u32, u32)>) -> Vec<(u32, Insertion)> {
        let roots: Vec<u32> = piece.roots.iter().map(|r| r.0).collect();
        let tours = tours(&Forest::new(piece, &roots), self.radius);
        let hung = |(&(_, (track, segment)), tour): (&(u32, (u32, u32)), Vec<Segment>)| {
            (track, Insertion { segment: segment as usize, at: None, tour })
        };
        piece.roots.iter().zip(tours).map(hung).filter(|(_, i)| !i.tour.is_empty()).collect()
    }

    /// The path of a piece without inner loops: from the outer one, straight away from the wall, and from there.
    fn center(&self, named: &Named) -> Option<(u32, Insertion)> {
        let mut nodes: Vec<(u32, Node)> = named.places.iter().map(|(&node, &k)| (k, node)).collect();
        nodes.sort_unstable_by_key(|n| n.0);
        let stride = nodes.len().div_ceil(CANDIDATES).max(1);
        let tried = nodes.iter().step_by(stride).filter_map(|&(k, node)| self.center_from(named, k, node));
        let length = |i: &Insertion| i.tour.iter().map(Segment::length).sum::<f64>();
        tried.min_by(|a, b| length(&a.1).total_cmp(&length(&b.1))).filter(|(_, i)| !i.tour.is_empty())
    }

    /// The same, entered at one of its places.
    fn center_from(&self, named: &Named, place: u32, node: Node) -> Option<(u32, Insertion)> {
        let at = named.piece.places[place as usize].at;
        let (sites, clearance): (Vec<SiteId>, f64) = match node {
            Node::Vertex(v) => {
                let around = self.orderer.fans.around(v).map(|e| self.skeleton.site(e));
                (around.collect(), self.skeleton.vertices()[v as usize].clearance)
            }
            Node::Low(e) => (vec![self.skeleton.site(e), self.skeleton.site(Skeleton::twin(e))], self.low),
            Node::Top(..) => return None,
        };
        let (track, segment, foot) = sites.into_iter().find_map(|site| self.landing(at, clearance, site))?;
        let mut piece = Piece { places: named.piece.places.clone(), ways: named.piece.ways.clone(), roots: Vec::new() };
        let root = piece.places.len() as u32;
        piece.places.push(Place { at: foot, reach: -1.0 });
        piece.ways.push(Way { ends: [root, place], segment: Segment::line(foot, at) });
        piece.roots.push((root, ()));
        let tour = tours(&Forest::new(&piece, &[root]), self.radius).pop()?;
        Some((track, Insertion { segment, at: Some(foot), tour }))
    }

    /// Where a step from a place of the skeleton straight towards one of its nearest walls meets the outer loop.
    fn landing(&self, at: Point, clearance: f64, site: SiteId) -> Option<(u32, usize, Point)> {
        let step = towards(self.skeleton.sites()[site as usize].shape, at);
        let landing = self.orderer.landing(at + step * (clearance - self.base), site, self.level, &|_| true)?;
        Some((landing.track, landing.segment, landing.point))
    }
}

/// A segment in equal steps: lines no longer than `straight`, arcs no longer than `curved`.
fn steps(segment: &Segment, straight: f64, curved: f64) -> Vec<Segment> {
    let longest = if matches!(segment, Segment::Line(_)) { straight } else { curved };
    let count = (segment.length() / longest).ceil().max(1.0) as usize;
    let mut rest = *segment;
    let mut steps = Vec::with_capacity(count);
    for k in 1..count {
        let (step, after) = rest.split_at(segment.at(k as f64 / count as f64));
        steps.push(step);
        rest = after;
    }
    steps.push(rest);
    steps
}
