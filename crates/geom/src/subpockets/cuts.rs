//! Where passes are cut: from plateaus to gates.

use crate::offset::voronoi::{EdgeCurve, Gate, upward};
use crate::segment::Segment;
use crate::skeleton::trees::{Kind, Plateau, Trees};
use crate::skeleton::{EdgeId, HalfEdge, NONE, SiteShape, Skeleton, Vertex, VertexId};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The skeleton with a vertex at the middle of every pass set, and the gates of all passes, highest first.
pub(super) fn cut(skeleton: Skeleton, trees: &Trees) -> (Skeleton, Vec<Gate>) {
    let mut cutter = Cutter::new(skeleton);
    for k in trees.of_kind(Kind::Pass) {
        let pass = &trees.plateaus()[k as usize];
        if let [first, second] = pass.up[..] {
            let way = way_across(&cutter.skeleton, pass, first, second);
            let arriving = cutter.middle(&way);
            cutter.corners.extend([arriving, cutter.before(Skeleton::twin(arriving))]);
        } else {
            let sides = |&up: &EdgeId| [cutter.before(up), Skeleton::twin(up)];
            let corners: Vec<EdgeId> = pass.up[1..].iter().flat_map(sides).collect();
            cutter.corners.extend(corners);
        }
    }
    let gates = cutter.gates();
    (cutter.skeleton, gates)
}

/// Half-edges from one edge that rises from a plateau to another: down the first, along the plateau, up the second.
fn way_across(skeleton: &Skeleton, pass: &Plateau, first: EdgeId, second: EdgeId) -> Vec<EdgeId> {
    let (start, goal) = (skeleton.origin(first), skeleton.origin(second));
    let mut leaving: BTreeMap<VertexId, Vec<EdgeId>> = BTreeMap::new();
    for e in pass.edges.iter().flat_map(|&e| [e, Skeleton::twin(e)]) {
        leaving.entry(skeleton.origin(e)).or_default().push(e);
    }
    let mut reached: BTreeMap<VertexId, EdgeId> = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(v) = queue.pop_front().filter(|&v| v != goal) {
        for &e in leaving.get(&v).into_iter().flatten() {
            let to = skeleton.target(e);
            if to != start && !reached.contains_key(&to) {
                reached.insert(to, e);
                queue.push_back(to);
            }
        }
    }
    let mut way = vec![second];
    let mut at = goal;
    while let Some(&e) = reached.get(&at).filter(|_| at != start) {
        way.push(e);
        at = skeleton.origin(e);
    }
    way.push(Skeleton::twin(first));
    way.reverse();
    way
}

/// A half-edge as lines and arcs in its direction; constant-clearance edges are one.
fn path(skeleton: &Skeleton, e: EdgeId) -> Vec<Segment> {
    let clearance = skeleton.origin_clearance(e);
    EdgeCurve::new(skeleton, e).whole(upward(skeleton, e) == e, clearance)
}

struct Cutter {
    skeleton: Skeleton,
    /// For each half-edge the one before it in its cell.
    before: Vec<EdgeId>,
    /// Half-edges that arrive at a pass, the corner after which is cut.
    corners: BTreeSet<EdgeId>,
}

impl Cutter {
    fn new(skeleton: Skeleton) -> Self {
        let mut before = vec![NONE; skeleton.half_edges.len()];
        for (e, half) in skeleton.half_edges.iter().enumerate() {
            before[half.next as usize] = e as EdgeId;
        }
        Self { skeleton, before, corners: BTreeSet::new() }
    }

    fn before(&self, e: EdgeId) -> EdgeId {
        self.before[e as usize]
    }

    /// The half-edge of a way that arrives at the midpoint of the part on its plateau; an edge is split where need be.
    fn middle(&mut self, way: &[EdgeId]) -> EdgeId {
        let length = |e: &EdgeId| path(&self.skeleton, *e).iter().map(Segment::length).sum::<f64>();
        let lengths: Vec<f64> = way[1..way.len() - 1].iter().map(length).collect();
        let mut left = 0.5 * lengths.iter().sum::<f64>();
        for (&e, &run) in way[1..].iter().zip(&lengths) {
            if left < run {
                return self.split(e, left / run);
            }
            left -= run;
        }
        way[way.len() - 2]
    }

    /// Puts a vertex on an edge of constant clearance, unless its end will do; what is returned arrives there.
    fn split(&mut self, e: EdgeId, share: f64) -> EdgeId {
        let s = &mut self.skeleton;
        let ends = [s.origin(e), s.target(e)].map(|v| s.vertices[v as usize].point);
        let place = match path(s, e)[..] {
            [only] => only.at(share),
            _ => ends[1],
        };
        if ends.contains(&place) {
            return e;
        }
        let (t, v, ahead) = (Skeleton::twin(e), s.vertices.len() as VertexId, s.half_edges.len() as EdgeId);
        let clearance = s.origin_clearance(e).midpoint(s.target_clearance(e));
        s.vertices.push(Vertex { point: place, clearance });
        let (onward, back) = (s.half_edges[e as usize], s.half_edges[t as usize]);
        // The second part of the half-edge, and its twin, which now comes before the old twin.
        s.half_edges.extend([HalfEdge { origin: v, ..onward }, HalfEdge { next: t, ..back }]);
        s.half_edges[e as usize].next = ahead;
        s.half_edges[t as usize].origin = v;
        s.half_edges[self.before[t as usize] as usize].next = Skeleton::twin(ahead);
        self.before.extend([e, self.before[t as usize]]);
        self.before[onward.next as usize] = ahead;
        self.before[t as usize] = Skeleton::twin(ahead);
        e
    }

    /// Gates at all corners, each linked with the one that a walk around its pass comes to next.
    fn gates(&self) -> Vec<Gate> {
        let mut order: Vec<EdgeId> = self.corners.iter().copied().collect();
        let clearance = |e: EdgeId| self.skeleton.target_clearance(e);
        order.sort_by(|&a, &b| clearance(b).total_cmp(&clearance(a)).then(a.cmp(&b)));
        let number: BTreeMap<EdgeId, u32> = order.iter().copied().zip(0..).collect();
        let mut gates: Vec<Gate> = order.iter().map(|&after| self.gate(after)).collect();
        for k in 0..gates.len() {
            let over = number[&self.turn(gates[k].after)];
            gates[k].over = over;
            gates[over as usize].from = k as u32;
        }
        gates
    }

    fn gate(&self, after: EdgeId) -> Gate {
        let s = &self.skeleton;
        let Vertex { point: pass, clearance } = s.vertices()[s.target(after) as usize];
        let foot = match s.sites()[s.site(after) as usize].shape {
            SiteShape::Line(l) => l.nearest(pass),
            SiteShape::Arc(a) => a.nearest(pass),
            SiteShape::Point(p) => p,
        };
        Gate { after, over: NONE, from: NONE, pass, foot, clearance }
    }

    /// The first cut corner met when turning around a vertex from a half-edge that arrives there, across its twin.
    fn turn(&self, arriving: EdgeId) -> EdgeId {
        let mut at = self.before(Skeleton::twin(arriving));
        while at != arriving && !self.corners.contains(&at) {
            at = self.before(Skeleton::twin(at));
        }
        at
    }
}
