//! Step 1 on the skeleton: the pieces of it between two distances.

use super::{CANDIDATES, Exit, Piece, Place, Way, trusted};
use crate::link::{Fans, towards};
use crate::plan::order::Orderer;
use crate::plan::ways::SkeletonWays;
use pocketry_geom::Segment;
use pocketry_geom::offset::{EdgeCurve, degenerate_slack, upward};
use pocketry_geom::skeleton::trees::DisjointSets;
use pocketry_geom::skeleton::{EdgeId, SiteId, SiteShape, Skeleton, VertexId};
use pocketry_geom::tolerance::{CLEANUP_STEP, SPOKE_RATE};
use std::collections::HashMap;

/// All pieces between and inside the loops at these distances, with the number of the outer loops' distance.
pub(crate) fn of_skeleton(
    ways: &SkeletonWays<'_>,
    orderer: &Orderer<'_>,
    distances: &[f64],
    radius: f64,
) -> Vec<(usize, Piece)> {
    let (skeleton, radius) = (ways.skeleton, trusted(radius));
    let mut parts = parts(skeleton, distances, radius);
    parts.sort_unstable_by_key(|p| p.0);
    let mut pieces = Vec::new();
    for same in parts.chunk_by(|a, b| a.0 == b.0) {
        let level = same[0].0;
        let high = distances.get(level + 1).copied().unwrap_or(f64::INFINITY);
        let (base, low) = (distances[level], distances[level] + radius);
        let range = Range { skeleton, fans: &ways.fans, orderer, level, base, low, high, radius };
        pieces.extend(range.pieces(same).into_iter().map(|named| (level, range.with_exits(named))));
    }
    pieces
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
    fans: &'a Fans<'a>,
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
    piece: Piece,
    places: HashMap<Node, u32>,
}

impl Range<'_> {
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
                pieces.push(Named { piece: Piece { least: self.low, ..Piece::default() }, ..Named::default() });
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
        let up = at_top.then(|| self.fans.around(v).find_map(|e| self.crossing(upward(self.skeleton, e))));
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
            if let Some(found) = self.orderer.crossing(self.level + 1, at) {
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

    /// The piece, with ways out where it hangs on no inner loop.
    fn with_exits(&self, named: Named) -> Piece {
        let Named { mut piece, places } = named;
        if piece.roots.is_empty() {
            let mut nodes: Vec<(u32, Node)> = places.into_iter().map(|(node, k)| (k, node)).collect();
            nodes.sort_unstable_by_key(|n| n.0);
            let stride = nodes.len().div_ceil(CANDIDATES).max(1);
            for &(place, node) in nodes.iter().step_by(stride) {
                self.add_exits(&mut piece, place, node);
            }
        }
        piece
    }

    fn add_exits(&self, piece: &mut Piece, place: u32, node: Node) {
        let from = piece.places[place as usize].at;
        let (sites, clearance): (Vec<SiteId>, f64) = match node {
            Node::Vertex(v) => {
                let around = self.fans.around(v).map(|e| self.skeleton.site(e));
                (around.collect(), self.skeleton.vertices()[v as usize].clearance)
            }
            Node::Low(e) => (vec![self.skeleton.site(e), self.skeleton.site(Skeleton::twin(e))], self.low),
            Node::Top(..) => return,
        };
        piece.exits.extend(sites.into_iter().map(|site| {
            let step = towards(self.skeleton.sites()[site as usize].shape, from);
            Exit { place, site, at: from + step * (clearance - self.base) }
        }));
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
