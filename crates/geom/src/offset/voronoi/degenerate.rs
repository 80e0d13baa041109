//! Channels exactly as wide as the tool: the part of the skeleton whose clearance equals the distance.
//!
//! The clearances that count as equal are `[d - slack, d]` (see [`degenerate_slack`]). Every edge contributes the part of
//! it in that range; connected parts become one closed tour each. A part that hangs on a loop (its edge rises above `d`)
//! is toured from there, and left out if it is no longer than a spur; a part on its own is always kept, as a point if it
//! has no extent.

use super::crossing::{EdgeCurve, upward};
use crate::bbox::BBox;
use crate::offset::{DegeneratePath, degenerate_slack};
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::{EdgeId, Skeleton};
use crate::tolerance::SPUR_SHARE;
use std::collections::BTreeMap;

/// Where a part of an edge ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Node {
    /// On a loop of the offset: the edge goes on above `d`.
    Crossing(EdgeId),
    /// At a vertex.
    Vertex(u32),
    /// In the middle of an edge that goes on below `d - slack`.
    Cut(EdgeId),
}

/// The part of an edge between two clearances.
struct Part {
    edge: EdgeId,
    low: Node,
    high: Node,
    from: f64,
    to: f64,
    length: f64,
}

/// A link of a node: the part and whether it is travelled upwards.
type Link = (usize, bool);

/// All parts at distance `d`, in the order of their edges.
pub(super) fn paths(skeleton: &Skeleton, d: f64) -> Vec<DegeneratePath> {
    let slack = degenerate_slack(d);
    let spur = SPUR_SHARE * d;
    let parts: Vec<Part> = (0..skeleton.edge_count() as EdgeId)
        .filter_map(|k| part(skeleton, upward(skeleton, 2 * k), d, slack))
        .filter(|p| p.length >= spur || !matches!((p.low, p.high), (Node::Cut(_), Node::Crossing(_))))
        .collect();
    let graph = Graph::new(skeleton, &parts, d, slack);
    graph.components().into_iter().filter_map(|nodes| graph.tour(&nodes, spur)).collect()
}

fn part(skeleton: &Skeleton, up: EdgeId, d: f64, slack: f64) -> Option<Part> {
    let (low, high) = (skeleton.origin_clearance(up), skeleton.target_clearance(up));
    if low > d || high < d - slack {
        return None;
    }
    let curve = EdgeCurve::new(skeleton, up);
    let (from, to) = (low.max(d - slack), high.min(d));
    let length = curve.at_clearance(from).distance(curve.at_clearance(to));
    let (bottom, top) = (Node::Vertex(skeleton.origin(up)), Node::Vertex(skeleton.target(up)));
    let bottom = if low < d - slack { Node::Cut(up) } else { bottom };
    let top = if high > d { Node::Crossing(up) } else { top };
    Some(Part { edge: up, low: bottom, high: top, from, to, length })
}

struct Graph<'a> {
    skeleton: &'a Skeleton,
    parts: &'a [Part],
    links: BTreeMap<Node, Vec<Link>>,
    distance: f64,
    slack: f64,
}

impl<'a> Graph<'a> {
    fn new(skeleton: &'a Skeleton, parts: &'a [Part], distance: f64, slack: f64) -> Self {
        let mut links: BTreeMap<Node, Vec<Link>> = BTreeMap::new();
        for (k, p) in parts.iter().enumerate() {
            links.entry(p.low).or_default().push((k, true));
            links.entry(p.high).or_default().push((k, false));
        }
        Self { skeleton, parts, links, distance, slack }
    }

    /// The nodes of each connected part, in increasing order.
    fn components(&self) -> Vec<Vec<Node>> {
        let mut seen = std::collections::BTreeSet::new();
        let mut components = Vec::new();
        for &root in self.links.keys() {
            if !seen.insert(root) {
                continue;
            }
            let (mut nodes, mut next) = (vec![root], 0);
            while next < nodes.len() {
                let fresh: Vec<Node> =
                    self.links[&nodes[next]].iter().map(|&l| self.far(l)).filter(|&n| seen.insert(n)).collect();
                nodes.extend(fresh);
                next += 1;
            }
            nodes.sort_unstable();
            components.push(nodes);
        }
        components
    }

    /// The node at the other end of a link.
    fn far(&self, (part, up): Link) -> Node {
        if up { self.parts[part].high } else { self.parts[part].low }
    }

    fn place(&self, node: Node) -> Point {
        let at = |e, clearance| EdgeCurve::new(self.skeleton, e).at_clearance(clearance);
        match node {
            Node::Crossing(e) => at(e, self.distance),
            Node::Vertex(v) => self.skeleton.vertices()[v as usize].point,
            Node::Cut(e) => at(e, self.distance - self.slack),
        }
    }

    fn clearance(&self, node: Node) -> f64 {
        match node {
            Node::Crossing(_) => self.distance,
            Node::Vertex(v) => self.skeleton.vertices()[v as usize].clearance,
            Node::Cut(_) => self.distance - self.slack,
        }
    }

    /// The tour of a connected part; nothing for a spur on a loop.
    fn tour(&self, nodes: &[Node], spur: f64) -> Option<DegeneratePath> {
        let extent = nodes.iter().fold(BBox::EMPTY, |b, &n| b.with(self.place(n))).size();
        let attached = nodes.iter().find_map(|&n| if let Node::Crossing(e) = n { Some(e) } else { None });
        let top = *nodes.iter().rev().max_by(|a, b| self.clearance(**a).total_cmp(&self.clearance(**b)))?;
        if extent < spur {
            let point = DegeneratePath { start: self.place(top), tour: Vec::new(), attached: None };
            return attached.is_none().then_some(point);
        }
        let kept = |node: Node| -> Vec<Link> {
            let keeps = |&l: &Link| self.parts[l.0].length >= spur || !matches!(self.far(l), Node::Cut(_));
            self.links[&node].iter().copied().filter(keeps).collect()
        };
        let end = nodes.iter().copied().find(|&n| !matches!(n, Node::Cut(_)) && kept(n).len() == 1);
        let start = attached.map(Node::Crossing).or(end).unwrap_or(top);
        let ring = nodes.iter().all(|&n| matches!(n, Node::Cut(_)) || kept(n).len() == 2);
        let links = if ring { self.ring(start, &kept) } else { self.out_and_back(start, &kept) };
        let tour = links.iter().flat_map(|&l| self.segments(l)).collect();
        Some(DegeneratePath { start: self.place(start), tour, attached })
    }

    /// Once round a ring.
    fn ring(&self, start: Node, kept: &dyn Fn(Node) -> Vec<Link>) -> Vec<Link> {
        let mut tour: Vec<Link> = vec![kept(start)[0]];
        loop {
            let last = tour[tour.len() - 1];
            let node = self.far(last);
            match kept(node).into_iter().find(|l| l.0 != last.0) {
                Some(next) if node != start && tour.len() <= self.parts.len() => tour.push(next),
                _ => return tour,
            }
        }
    }

    /// Depth first through every part, each of them there and back.
    fn out_and_back(&self, start: Node, kept: &dyn Fn(Node) -> Vec<Link>) -> Vec<Link> {
        let mut walked = std::collections::BTreeSet::new();
        let mut met = std::collections::BTreeSet::from([start]);
        let mut tour = Vec::new();
        let mut stack = vec![(kept(start), None)];
        while let Some((links, back)) = stack.last_mut() {
            if let Some((part, up)) = links.pop() {
                if !walked.insert(part) {
                    continue;
                }
                tour.push((part, up));
                let node = self.far((part, up));
                if met.insert(node) {
                    stack.push((kept(node), Some((part, !up))));
                } else {
                    tour.push((part, !up));
                }
            } else {
                tour.extend(*back);
                stack.pop();
            }
        }
        tour
    }

    fn segments(&self, (part, up): Link) -> Vec<Segment> {
        let p = &self.parts[part];
        let (low, high) = ((p.from, self.place(p.low)), (p.to, self.place(p.high)));
        let (from, to) = if up { (low, high) } else { (high, low) };
        EdgeCurve::new(self.skeleton, p.edge).path(from, to, up, self.slack.into())
    }
}
