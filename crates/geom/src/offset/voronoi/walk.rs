//! Steps 3 and 4 of algorithm 3.6: from spanning edges to closed loops.
//!
//! Around a cell the edges that span the distance go up and down in turn. Ordered cell by cell, the k-th that goes up
//! therefore starts the piece that the k-th that goes down ends: no edge in between is looked at, however many the cell
//! has. A [`Gate`] ends one piece and starts the next.

use super::crossing::EdgeCurve;
use super::gate::Gate;
use super::piece::parallel_piece;
use crate::contour::Contour;
use crate::offset::OffsetLoop;
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::{EdgeId, NONE, SiteId, Skeleton};

/// Where a piece parallel to a site starts.
#[derive(Clone, Copy, Debug)]
enum Start {
    /// On an edge going up.
    Edge(EdgeId),
    /// At a gate (an index).
    Gate(u32),
}

/// A skeleton seen by walks.
pub(super) struct Walk<'a> {
    pub(super) skeleton: &'a Skeleton,
    /// The place of every half-edge in the order of the cells.
    pub(super) ranks: &'a [u32],
    /// The gates that are open: those with a clearance above the distance.
    pub(super) gates: &'a [Gate],
    /// The distance.
    pub(super) d: f64,
    /// Shorter pieces are dropped, mm.
    pub(super) drop: f64,
}

/// One segment of a loop before it has a shape.
struct Leg {
    start: Point,
    end: Point,
    /// The site it is parallel to, or `NONE` along a critical edge.
    site: SiteId,
    /// The edge on which it starts, or `NONE` at a gate.
    crossing: EdgeId,
}

/// The place of every half-edge in the order of the cells, each from its site's start to its end.
pub(super) fn ranks(skeleton: &Skeleton) -> Vec<u32> {
    let mut ranks = vec![NONE / 4; skeleton.half_edges().len()];
    let cells = (0..skeleton.sites().len() as SiteId).flat_map(|site| skeleton.cell(site));
    for (rank, e) in cells.enumerate() {
        ranks[e as usize] = rank as u32;
    }
    ranks
}

/// Places with what is there, sorted: as single integers, which sort in half the time of pairs.
fn in_order(places: impl Iterator<Item = (u32, u32)>) -> impl Iterator<Item = (u32, u32)> {
    let mut keys: Vec<u64> = places.map(|(place, name)| u64::from(place) << 32 | u64::from(name)).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| ((key >> 32) as u32, key as u32))
}

impl Walk<'_> {
    /// The loops through these half-edges, which are all that go up across the distance, and the open gates; each
    /// with an edge of the part of the region that it lies in.
    pub(super) fn loops(&self, spanning: &[EdgeId]) -> Vec<(OffsetLoop, EdgeId)> {
        let edges = spanning.iter().map(|&e| (self.edge_place(e), e));
        let gates = self.gates.iter().zip(0..).map(|(g, k)| (self.gate_place(g), k));
        // Places of edges are even, those of gates odd.
        let start = |(place, name)| if place % 2 == 0 { Start::Edge(name) } else { Start::Gate(name) };
        let starts: Vec<Start> = in_order(edges.chain(gates)).map(start).collect();
        let points: Vec<Point> = starts.iter().map(|&s| self.point(s)).collect();
        let next = self.successors(&starts);
        // Step 4: every piece that is in no loop yet starts one (4a, 4b); the a-list is the list of pieces.
        let mut visited = vec![false; starts.len()];
        let mut loops = Vec::new();
        let mut legs = Vec::new();
        for first in 0..starts.len() {
            let mut at = first;
            while !visited[at] {
                // Steps 4c to 4f.
                visited[at] = true;
                let then = next[at] as usize;
                self.piece(starts[at], points[at], starts[then], points[then], &mut legs);
                at = then;
            }
            // Step 4g: back at the start.
            loops.extend(self.assemble(&legs).map(|l| (l, self.edge(starts[first]))));
            legs.clear();
        }
        loops
    }

    /// For each piece the one that starts where it ends: a permutation, so that every loop closes.
    fn successors(&self, starts: &[Start]) -> Vec<u32> {
        let arrival = |start: Start| match start {
            Start::Edge(e) => self.edge_place(Skeleton::twin(e)),
            Start::Gate(g) => self.gate_place(&self.gates[self.gates[g as usize].from as usize]),
        };
        in_order(starts.iter().zip(0..).map(|(&s, k)| (arrival(s), k))).map(|(_, k)| k).collect()
    }

    fn edge_place(&self, e: EdgeId) -> u32 {
        2 * self.ranks[e as usize]
    }

    fn gate_place(&self, gate: &Gate) -> u32 {
        2 * self.ranks[gate.after as usize] + 1
    }

    fn edge(&self, start: Start) -> EdgeId {
        match start {
            Start::Edge(e) => e,
            Start::Gate(g) => self.skeleton.next(self.gates[g as usize].after),
        }
    }

    fn point(&self, start: Start) -> Point {
        match start {
            Start::Edge(e) => EdgeCurve::new(self.skeleton, e).at_clearance(self.d),
            Start::Gate(g) => self.gates[g as usize].at(self.d),
        }
    }

    /// Step 4e: the piece from one start to the next, and the way across a pass.
    fn piece(&self, start: Start, from: Point, then: Start, to: Point, legs: &mut Vec<Leg>) {
        let (site, crossing) = match start {
            Start::Edge(e) => (self.skeleton.site(e), e),
            Start::Gate(g) => (self.skeleton.site(self.gates[g as usize].after), NONE),
        };
        match then {
            Start::Edge(_) => legs.push(Leg { start: from, end: to, site, crossing }),
            Start::Gate(g) => {
                let gate = &self.gates[self.gates[g as usize].from as usize];
                let end = gate.at(self.d);
                legs.push(Leg { start: from, end, site, crossing });
                let straight = Segment::line(end, to).distance(gate.pass) <= self.drop;
                let corner = if straight { to } else { gate.pass };
                legs.push(Leg { start: end, end: corner, site: NONE, crossing: NONE });
                legs.push(Leg { start: corner, end: to, site: NONE, crossing: NONE });
            }
        }
    }

    /// Legs become segments. Those that are too short go, and the next one starts where the one before ended; a loop
    /// without extent goes whole.
    fn assemble(&self, legs: &[Leg]) -> Option<OffsetLoop> {
        let mut kept: Vec<(Point, Point, &Leg)> = Vec::with_capacity(legs.len());
        let mut at = legs.first()?.start;
        for leg in legs {
            if at.distance(leg.end) > self.drop {
                kept.push((at, leg.end, leg));
                at = leg.end;
            }
        }
        if kept.len() < 2 {
            return None;
        }
        kept[0].0 = at;
        let segment = |&(start, end, leg): &(Point, Point, &Leg)| match leg.site {
            NONE => Segment::line(start, end),
            site => parallel_piece(self.skeleton.sites()[site as usize].shape, self.d, start, end),
        };
        Some(OffsetLoop {
            contour: Contour::new(kept.iter().map(segment).collect()),
            sites: kept.iter().map(|k| k.2.site).collect(),
            crossings: kept.iter().map(|k| k.2.crossing).collect(),
        })
    }
}
