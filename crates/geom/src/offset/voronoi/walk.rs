//! Steps 3 and 4 of algorithm 3.6: from spanning edges to closed loops.

use super::crossing::EdgeCurve;
use super::piece::parallel_piece;
use crate::contour::Contour;
use crate::offset::OffsetLoop;
use crate::point::Point;
use crate::skeleton::{EdgeId, SiteId, Skeleton};
use crate::tolerance::OFFSET_DROP;

/// The place where a loop crosses an edge, and the cell it goes on in.
struct Crossing {
    edge: EdgeId,
    point: Point,
    site: SiteId,
}

/// The loops through these half-edges, which are all that go up across `d`, in increasing order.
pub(super) fn loops(skeleton: &Skeleton, spanning: &[EdgeId], d: f64, size: f64) -> Vec<OffsetLoop> {
    let mut visited = vec![false; spanning.len()];
    let mut loops = Vec::new();
    // Step 4: every spanning edge that no loop has crossed yet starts one (4a, 4b).
    for start in 0..spanning.len() {
        if visited[start] {
            continue;
        }
        let mut crossings = Vec::new();
        let mut at = start;
        while !visited[at] {
            // Step 4c: the a-list here is the list of spanning edges.
            visited[at] = true;
            let edge = spanning[at];
            crossings.push(Crossing {
                edge,
                point: EdgeCurve::new(skeleton, edge).at_clearance(d),
                site: skeleton.site(edge),
            });
            // Steps 4d and 4f: on to where the cell's boundary comes down through `d`, and over to the next cell.
            let over = Skeleton::twin(descent(skeleton, edge, d));
            at = spanning.binary_search(&over).unwrap_or(start);
        }
        // Step 4g: back at the starting edge.
        loops.extend(assemble(skeleton, &crossings, d, OFFSET_DROP * size));
    }
    loops
}

/// Step 4d: the next edge of the cell of `up` that spans `d`; clearance falls along it.
fn descent(skeleton: &Skeleton, up: EdgeId, d: f64) -> EdgeId {
    let mut e = skeleton.next(up);
    while e != up && skeleton.target_clearance(e) > d {
        e = skeleton.next(e);
    }
    e
}

/// Step 4e: the segments between successive crossings. Those shorter than `drop` go, and the next one starts where the
/// one before ended; a loop without extent goes whole.
fn assemble(skeleton: &Skeleton, crossings: &[Crossing], d: f64, drop: f64) -> Option<OffsetLoop> {
    let mut kept: Vec<(Point, Point, &Crossing)> = Vec::with_capacity(crossings.len());
    let mut at = crossings[0].point;
    for (k, crossing) in crossings.iter().enumerate() {
        let end = crossings[(k + 1) % crossings.len()].point;
        if at.distance(end) > drop {
            kept.push((at, end, crossing));
            at = end;
        }
    }
    if kept.len() < 2 {
        return None;
    }
    kept[0].0 = at;
    let shape = |site: SiteId| skeleton.sites()[site as usize].shape;
    let segments = kept.iter().map(|&(start, end, c)| parallel_piece(shape(c.site), d, start, end)).collect();
    Some(OffsetLoop {
        contour: Contour::new(segments),
        sites: kept.iter().map(|k| k.2.site).collect(),
        crossings: kept.iter().map(|k| k.2.edge).collect(),
    })
}
