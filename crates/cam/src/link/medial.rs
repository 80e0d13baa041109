//! The shortest way from one loop to others of the same distance, along the skeleton.

use crate::plan::Cut;
use pocketry_geom::Segment;
use pocketry_geom::offset::{EdgeCurve, degenerate_slack, upward};
use pocketry_geom::skeleton::{EdgeId, NONE, Skeleton, VertexId};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// For each vertex one half-edge that leaves it.
pub(crate) struct Fans<'a> {
    skeleton: &'a Skeleton,
    leaving: Vec<EdgeId>,
}

impl<'a> Fans<'a> {
    pub(crate) fn new(skeleton: &'a Skeleton) -> Self {
        let mut leaving = vec![NONE; skeleton.vertices().len()];
        for (e, half) in skeleton.half_edges().iter().enumerate() {
            leaving[half.origin as usize] = e as EdgeId;
        }
        Self { skeleton, leaving }
    }

    /// The half-edges that leave a vertex inside the region.
    pub(crate) fn around(&self, vertex: VertexId) -> impl Iterator<Item = EdgeId> + '_ {
        let first = self.leaving[vertex as usize];
        let mut at = Some(first).filter(|&e| e != NONE);
        std::iter::from_fn(move || {
            let e = at?;
            at = Some(self.skeleton.next(Skeleton::twin(e))).filter(|&n| n != first);
            Some(e)
        })
    }
}

/// How a vertex was reached: across a loop's crossing (segment number), or along a half-edge that leads to it.
#[derive(Clone, Copy)]
enum From {
    Loop(usize),
    Edge(EdgeId),
}

/// Costs of vertices reached so far, nearest first.
#[derive(Default)]
struct Front {
    heap: BinaryHeap<Reverse<(u64, VertexId)>>,
    best: HashMap<VertexId, (f64, From)>,
}

impl Front {
    fn reach(&mut self, vertex: VertexId, cost: f64, from: From) {
        if self.best.get(&vertex).is_none_or(|b| cost < b.0) {
            self.best.insert(vertex, (cost, from));
            // The bits of a number that is not negative are ordered like the number.
            self.heap.push(Reverse((cost.to_bits(), vertex)));
        }
    }
}

/// The shortest way from a loop just cut, at distance `d`, to one of the `targets` (half-edges at whose crossings other
/// loops have a segment's start), and the target reached.
pub(crate) fn medial_way(
    fans: &Fans<'_>,
    cut: &Cut,
    d: f64,
    targets: &dyn Fn(EdgeId) -> bool,
) -> Option<(Vec<Segment>, EdgeId)> {
    let skeleton = fans.skeleton;
    let mut front = sources(skeleton, cut, d);
    let mut arrival: Option<(f64, EdgeId, VertexId)> = None;
    while let Some(Reverse((bits, v))) = front.heap.pop() {
        let cost = f64::from_bits(bits);
        if arrival.is_some_and(|a| a.0 <= cost) {
            break;
        }
        if cost > front.best[&v].0 {
            continue;
        }
        for e in fans.around(v) {
            if skeleton.target_clearance(e) > d {
                front.reach(skeleton.target(e), cost + length(skeleton, e), From::Edge(e));
            } else if targets(Skeleton::twin(e)) {
                let curve = EdgeCurve::new(skeleton, e);
                let cost = cost + curve.at_clearance(d).distance(curve.high().point);
                if arrival.is_none_or(|a| cost < a.0) {
                    arrival = Some((cost, Skeleton::twin(e), v));
                }
            }
        }
    }
    let (_, target, v) = arrival?;
    Some((trace(skeleton, cut, d, &front, target, v), target))
}

/// The upper ends of the edges that the loop crosses, at the cost of the way along the loop and up the edge.
fn sources(skeleton: &Skeleton, cut: &Cut, d: f64) -> Front {
    let mut front = Front::default();
    let (total, mut ahead) = (cut.length(), 0.0);
    for (k, (segment, &crossing)) in cut.segments.iter().zip(&cut.crossings).enumerate() {
        if crossing != NONE {
            let curve = EdgeCurve::new(skeleton, crossing);
            let rise = curve.at_clearance(d).distance(curve.high().point);
            front.reach(
                skeleton.target(upward(skeleton, crossing)),
                f64::min(ahead, total - ahead) + rise,
                From::Loop(k),
            );
        }
        ahead += segment.length();
    }
    front
}

/// The way back from the vertex at which a target was reached, put in order.
fn trace(skeleton: &Skeleton, cut: &Cut, d: f64, front: &Front, target: EdgeId, vertex: VertexId) -> Vec<Segment> {
    let tolerance = degenerate_slack(d);
    let mut parts = vec![EdgeCurve::new(skeleton, target).clear(false, d, tolerance)];
    let mut at = vertex;
    loop {
        match front.best[&at].1 {
            From::Edge(e) => {
                parts.push(EdgeCurve::new(skeleton, e).clear(upward(skeleton, e) == e, d, tolerance));
                at = skeleton.origin(e);
            }
            From::Loop(k) => {
                parts.push(EdgeCurve::new(skeleton, cut.crossings[k]).clear(true, d, tolerance));
                parts.push(cut.way(k));
                break;
            }
        }
    }
    parts.into_iter().rev().flatten().collect()
}

fn length(skeleton: &Skeleton, e: EdgeId) -> f64 {
    let place = |v: VertexId| skeleton.vertices()[v as usize].point;
    place(skeleton.origin(e)).distance(place(skeleton.target(e)))
}
