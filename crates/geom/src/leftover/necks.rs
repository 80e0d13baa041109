//! Bottlenecks between the mouths of a zone.
//!
//! Edges are taken from the widest down; where one joins two parts that each have a mouth, the tool could go from one
//! to the other but for the narrowest place of the widest way, which is here.

use super::Neck;
use super::zones::{Band, Level, Zone};
use crate::offset::upward;
use crate::offset::voronoi::EdgeCurve;
use crate::point::Point;
use crate::skeleton::trees::DisjointSets;
use crate::skeleton::{EdgeId, Skeleton, VertexId};
use crate::tolerance::{CROSSING, PLATEAU};
use std::collections::BTreeMap;

/// The necks of a zone, the widest first: one less than the parts of the tool's room that it has mouths to.
pub(super) fn necks(zone: &Zone, band: &Band<'_>) -> Vec<Neck> {
    if zone.mouths.len() < 2 {
        return Vec::new();
    }
    let s = band.skeleton;
    let mut edges: Vec<EdgeId> = zone.edges.iter().map(|&e| upward(s, e)).collect();
    // Where walls begin nothing passes.
    edges.retain(|&up| band.level(s.origin(up)) == Level::Band && s.origin_clearance(up) > 0.0);
    edges.sort_by(|&a, &b| rank(s, b).total_cmp(&rank(s, a)));
    let mut numbers: BTreeMap<VertexId, u32> = BTreeMap::new();
    let mut number = |v: VertexId| {
        let next = numbers.len() as u32;
        *numbers.entry(v).or_insert(next)
    };
    // A vertex that the axis reaches is a place of its own for each edge that leads there.
    let ends: Vec<(u32, Option<u32>)> = edges
        .iter()
        .map(|&up| (number(s.origin(up)), (band.level(s.target(up)) < Level::High).then(|| number(s.target(up)))))
        .collect();
    let mut sets = DisjointSets::new(numbers.len());
    let mut open = vec![false; numbers.len()];
    let mut necks = Vec::new();
    for (&up, (low, high)) in edges.iter().zip(ends) {
        let low = sets.find(low);
        let high = high.map(|h| sets.find(h));
        if high == Some(low) {
            continue;
        }
        let (here, there) = (open[low as usize], high.is_none_or(|h| open[h as usize]));
        if here && there {
            necks.push(Neck { at: narrowest(s, up), width: 2.0 * s.origin_clearance(up) });
        }
        if let Some(high) = high {
            sets.join(low, high);
        }
        open[sets.find(low) as usize] = here || there;
    }
    necks
}

/// Clearance at the lower end of an edge; of equal ones those count as narrower that are flat, and long.
fn rank(s: &Skeleton, up: EdgeId) -> f64 {
    let clearance = s.origin_clearance(up);
    let length = length(s, up);
    if is_flat(s, up) { clearance * (1.0 - PLATEAU * (1.0 + length / (length + clearance))) } else { clearance }
}

/// Whether the clearance is the same all along an edge.
fn is_flat(s: &Skeleton, up: EdgeId) -> bool {
    let (low, high) = (s.origin_clearance(up), s.target_clearance(up));
    high - low <= PLATEAU * (high + length(s, up))
}

/// From end to end.
fn length(s: &Skeleton, e: EdgeId) -> f64 {
    let [from, to] = [s.origin(e), s.target(e)].map(|v| s.vertices()[v as usize].point);
    from.distance(to)
}

/// The lower end of an edge, or the middle of a flat one.
fn narrowest(s: &Skeleton, up: EdgeId) -> Point {
    let curve = EdgeCurve::new(s, up);
    if !is_flat(s, up) {
        return curve.low().point;
    }
    let way = curve.whole(true, CROSSING);
    let middle = way.get(way.len() / 2);
    middle.map_or(curve.low().point, |s| if way.len() % 2 == 1 { s.at(0.5) } else { s.start() })
}
