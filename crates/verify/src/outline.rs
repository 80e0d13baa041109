//! The outline of what lies within a radius of a family of curves: parallels of the curves, sectors about their joints.
//!
//! Every point at exactly that distance from the family has its nearest point inside a curve, and then lies on one of the
//! curve's two parallels, or at an end, and then lies in the normal cone of the joint there: a sector between the normals
//! of the two curves that meet, on the outer side of the turn; a half circle at a loose end. [`crate::clip`] cuts away
//! what other curves are nearer to.

use crate::clip;
use crate::tree::Tree;
use pocketry_geom::tolerance::proof::SMOOTH_JOINT;
use pocketry_geom::{Arc, Point, Segment, Vec2};
use rayon::prelude::*;
use std::collections::HashMap;

/// Factor by which the reach grows in the search for gaps.
const WIDENED: f64 = 8.0;

/// Which side of a directed curve.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Side {
    /// To the left of travel.
    Left,
    /// To the right of travel.
    Right,
}

/// The parallel of a curve at `radius` on one side, travelled like the curve; `None` where an arc's would turn inside out.
pub(crate) fn parallel(curve: &Segment, radius: f64, side: Side) -> Option<Segment> {
    let turned = |v: Vec2| if side == Side::Left { v.left() } else { v.right() };
    match curve {
        Segment::Line(l) => {
            let by = turned(l.direction()) * radius;
            by.x.is_finite().then(|| curve.translated(by))
        }
        Segment::Arc(a) => {
            let inner = a.ccw == (side == Side::Left);
            let wanted = if inner { a.radius - radius } else { a.radius + radius };
            let moved = |p: Point| a.center + (p - a.center) * (wanted / a.radius);
            (wanted > 0.0).then(|| Segment::Arc(Arc { start: moved(a.start), end: moved(a.end), radius: wanted, ..*a }))
        }
    }
}

/// The sector about a joint on one side, from the end normal of one curve to the start normal of the next, where the
/// turn opens one; counter-clockwise on the right, clockwise on the left, so that it runs on between the parallels.
pub(crate) fn sector(before: &Segment, after: &Segment, radius: f64, side: Side) -> Option<Segment> {
    let (incoming, outgoing) = (before.end_tangent(), after.start_tangent());
    let turn = incoming.angle_to(outgoing);
    let opens = if side == Side::Right { turn > SMOOTH_JOINT } else { turn < -SMOOTH_JOINT };
    opens.then(|| about(after.start(), incoming, outgoing, radius, side))
}

/// The half circle round a loose end, travelled on from the left parallel (at the end of a curve that runs along
/// `direction`) to the right one, clockwise.
pub(crate) fn cap(at: Point, direction: Vec2, radius: f64) -> Segment {
    about(at, direction, -direction, radius, Side::Left)
}

fn about(center: Point, from: Vec2, to: Vec2, radius: f64, side: Side) -> Segment {
    let normal = |v: Vec2| if side == Side::Left { v.left() } else { v.right() };
    let (start, end) = (center + normal(from) * radius, center + normal(to) * radius);
    Segment::Arc(Arc { start, end, center, radius, ccw: side == Side::Right })
}

/// The full circle about a lone point, in two halves.
pub(crate) fn circle(center: Point, radius: f64) -> [Segment; 2] {
    let east = Vec2::new(1.0, 0.0);
    [cap(center, east, radius), cap(center, -east, radius)]
}

/// The parts of curves no nearer than `radius` to any segment of the tree, in the order of the curves.
pub(crate) fn exposed(curves: &[Segment], tree: &Tree, radius: f64) -> Vec<Segment> {
    curves
        .par_iter()
        .with_min_len(16)
        .flat_map_iter(|curve| clip::exposed(curve, tree, radius).into_iter().filter_map(|span| clip::sub(curve, span)))
        .collect()
}

/// For each piece the piece that starts where it ends, within `reach`; nearest pairs first, each start taken once.
pub(crate) fn links(pieces: &[Segment], reach: f64) -> Vec<Option<u32>> {
    let cell = |p: Point| ((p.x / reach).floor() as i64, (p.y / reach).floor() as i64);
    let mut starts: HashMap<(i64, i64), Vec<u32>> = HashMap::with_capacity(pieces.len());
    for (k, piece) in (0..).zip(pieces) {
        starts.entry(cell(piece.start())).or_default().push(k);
    }
    let mut pairs: Vec<(f64, u32, u32)> = Vec::with_capacity(pieces.len());
    for (k, piece) in (0..).zip(pieces) {
        let (i, j) = cell(piece.end());
        let cells = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| (i + di, j + dj)));
        for &next in cells.filter_map(|c| starts.get(&c)).flatten() {
            let gap = piece.end().distance(pieces[next as usize].start());
            if gap <= reach {
                pairs.push((gap, k, next));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut next = vec![None; pieces.len()];
    let mut taken = vec![false; pieces.len()];
    for (_, k, n) in pairs {
        if next[k as usize].is_none() && !taken[n as usize] {
            next[k as usize] = Some(n);
            taken[n as usize] = true;
        }
    }
    next
}

/// Keeps one of several pieces that are the same within `reach` (of a path that is gone over twice both outlines stay).
pub(crate) fn drop_repeated(pieces: &mut Vec<Segment>, reach: f64) {
    pieces.sort_by(|a, b| a.at(0.5).x.total_cmp(&b.at(0.5).x));
    let mut kept: Vec<Segment> = Vec::with_capacity(pieces.len());
    for piece in pieces.iter() {
        let same = |other: &&Segment| {
            let near = |t| piece.at(t).distance(other.at(t)) <= reach;
            near(0.5) && near(0.0) && near(1.0)
        };
        let beside = kept.iter().rev().take_while(|k| piece.at(0.5).x - k.at(0.5).x <= reach);
        if beside.into_iter().find(same).is_none() {
            kept.push(*piece);
        }
    }
    *pieces = kept;
}

/// A closed walk over pieces and its signed area.
#[derive(Clone, Debug)]
pub(crate) struct Loop {
    /// Indices of the pieces, in order.
    pub(crate) pieces: Vec<u32>,
    /// Signed area, mm², the gaps closed by straight lines.
    pub(crate) area: f64,
}

/// The closed walks that linked pieces make; a walk that can't go on is closed by a straight line.
pub(crate) fn loops(pieces: &[Segment], next: &[Option<u32>]) -> Vec<Loop> {
    let mut has_before = vec![false; pieces.len()];
    for n in next.iter().flatten() {
        has_before[*n as usize] = true;
    }
    let mut seen = vec![false; pieces.len()];
    let open_first = (0..pieces.len()).filter(|&k| !has_before[k]).chain(0..pieces.len());
    let mut out = Vec::new();
    for first in open_first {
        if seen[first] {
            continue;
        }
        let mut walk = Vec::new();
        let mut at = Some(first as u32);
        while let Some(k) = at.filter(|&k| !seen[k as usize]) {
            seen[k as usize] = true;
            walk.push(k);
            at = next[k as usize];
        }
        let area = walk_area(pieces, &walk);
        out.push(Loop { pieces: walk, area });
    }
    out
}

/// The area that pieces enclose, which lie around it counter-clockwise but for small gaps, and a bound of its error; infinite
/// where an end has no follower within `widest`.
///
/// Gaps are looked for from `reach` on. A line closes them: what is missing there leaves it by no more than its length.
pub(crate) fn enclosed_area(pieces: &[Segment], reach: f64, widest: f64) -> (f64, f64) {
    let Some(first) = pieces.first() else { return (0.0, 0.0) };
    let origin = first.start();
    let area = 0.5 * pieces.iter().map(|s| s.area_twice(origin)).sum::<f64>();
    let mut reach = reach;
    while reach < widest {
        let next: Option<Vec<u32>> = links(pieces, reach).into_iter().collect();
        if let Some(next) = next {
            let ends = || pieces.iter().zip(&next).map(|(s, &n)| (s.end(), pieces[n as usize].start()));
            let joined = 0.5 * ends().map(|(a, b)| (a - origin).cross(b - origin)).sum::<f64>();
            return (area + joined, ends().map(|(a, b)| a.distance_squared(b)).sum());
        }
        reach *= WIDENED;
    }
    (area, f64::INFINITY)
}

fn walk_area(pieces: &[Segment], walk: &[u32]) -> f64 {
    let piece = |k: usize| &pieces[walk[k % walk.len()] as usize];
    let origin = piece(0).start();
    let twice = (0..walk.len()).map(|k| {
        let join = (piece(k).end() - origin).cross(piece(k + 1).start() - origin);
        piece(k).area_twice(origin) + join
    });
    0.5 * twice.sum::<f64>()
}
