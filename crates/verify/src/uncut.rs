//! Is anything left that the tool can reach?
//!
//! Let S be all that the final moves sweep, widened by the cover tolerance, and M the opening of the region by the tool
//! (see [`crate::reach`]). The claim is that M lies in S. Suppose it does not; then the part of M outside S either comes
//! up to the outline of S inside M, or is made of whole connected pieces of M. So it is enough to show that
//!
//! 1. no part of the outline of S lies in M: each keeps farther than the tool's radius from the outline of the admissible
//!    centres, and is no such centre itself;
//! 2. of every piece of the centres' outline, and so of every connected piece of M, one point lies in S.
//!
//! The outline of S is cut out of the parallels of the path and the sectors about its joints, by exact intersection of
//! lines and circles. Each cut is made a rounding too small, so that a part of an outline may be listed twice but is
//! never lost, and nothing is flattened or sampled. Where the proof fails, the same pieces bound what was left.

use crate::cells::Cells;
use crate::outline::{self, Side};
use crate::reach::{Centers, Opening};
use crate::report::Spot;
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::{BBox, Point, Segment};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The final moves and the radius of what counts as swept.
pub(crate) struct Sweep {
    tree: Tree,
    cells: Cells,
    radius: f64,
    rounding: f64,
    /// Curves that hold the outline; what is swept lies to the right of each.
    curves: Vec<Segment>,
}

impl Sweep {
    /// What a disc sweeps along a path (its curves in order; where one does not start at the end of the one before, the path breaks off).
    pub(crate) fn new(path: &[Segment], radius: f64, rounding: f64) -> Self {
        let tree = Tree::new(path);
        let radius = radius - rounding;
        let mut curves = Vec::with_capacity(3 * path.len());
        for run in path.chunk_by(|a, b| a.end() == b.start()) {
            sides(run, radius, &mut curves);
        }
        Self { tree, cells: Cells::new(path, radius - 2.0 * rounding), radius, rounding, curves }
    }

    /// How far beyond the swept zone a point lies; 0 inside.
    fn beyond(&self, p: Point) -> f64 {
        self.tree.nearest(p, f64::INFINITY).map_or(f64::INFINITY, |(d, _)| (d - self.radius).max(0.0))
    }

    /// Whether everything that the centres' discs cover is swept.
    pub(crate) fn covers(&self, centers: &Centers, walls: &Walls, radius: f64) -> bool {
        let met = |piece: &Segment| {
            let p = piece.at(0.5);
            self.cells.hold_point(p) || self.tree.any_within(p, self.radius)
        };
        let away = |piece: &Segment| centers.tree.nearest_to_curve(piece, radius).is_none();
        let clear = |piece: &Segment| away(piece) && !centers.contain(walls, piece.at(0.5));
        // Most curves are known to be swept over, or keep by a wall and so are clear as a whole; the others are clipped first.
        let beside = |curve: &Segment| centers.excluded_by_wall(walls, curve.at(0.5)) && away(curve);
        let holds =
            |curve: &Segment| self.cells.hold_curve(curve) || beside(curve) || self.exposed(curve).iter().all(clear);
        centers.pieces.par_iter().with_min_len(64).all(met) && self.curves.par_iter().with_min_len(64).all(holds)
    }

    /// The parts of a curve that belong to the outline.
    fn exposed(&self, curve: &Segment) -> Vec<Segment> {
        outline::exposed(std::slice::from_ref(curve), &self.tree, self.radius - self.rounding)
    }

    /// The places of the opening that were not swept.
    pub(crate) fn left_over(&self, centers: &Centers, walls: &Walls, radius: f64, opening: &Opening) -> Vec<Spot> {
        let far = outline::exposed(&opening.pieces, &self.tree, self.radius);
        let mut pieces: Vec<Segment> = far;
        for piece in &outline::exposed(&self.curves, &self.tree, self.radius - self.rounding) {
            let away = crate::clip::exposed(piece, &centers.tree, radius);
            let deep = |span: &(f64, f64)| !centers.contain(walls, piece.at(0.5 * (span.0 + span.1)));
            let mut from = 0.0;
            for span in away.into_iter().filter(deep).chain([(1.0, 1.0)]) {
                pieces.extend((from < span.0).then(|| crate::clip::sub(piece, (from, span.0))).flatten());
                from = span.1;
            }
        }
        let reach = centers.link_reach(radius);
        outline::drop_repeated(&mut pieces, reach);
        let next = outline::links(&pieces, reach);
        let loops = outline::loops(&pieces, &next);
        let mut spots: Vec<(BBox, Spot)> = loops.iter().map(|l| self.spot(&pieces, l)).collect();
        spots.sort_by(|a, b| b.1.area.total_cmp(&a.1.area));
        without_holes(spots)
    }

    fn spot(&self, pieces: &[Segment], walk: &outline::Loop) -> (BBox, Spot) {
        let members = || walk.pieces.iter().map(|&k| &pieces[k as usize]);
        let bbox = members().fold(BBox::EMPTY, |b, p| b.union(p.bbox()));
        let points = members().flat_map(|p| [p.start(), p.at(0.5)]);
        let (beyond, at) = points.map(|p| (self.beyond(p), p)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
        let narrow = 0.5 * bbox.width().min(bbox.height());
        (bbox, Spot { at, area: walk.area, radius: narrow.min((walk.area.abs() / PI).sqrt()), beyond })
    }
}

/// Takes the holes (loops of negative area, which come last) out of the least spots about them. Where nothing else is
/// left, the largest loop stays, with no area: a place that can't be proven to be cut.
fn without_holes(mut spots: Vec<(BBox, Spot)>) -> Vec<Spot> {
    let holes = spots.split_off(spots.partition_point(|s| s.1.area > 0.0));
    for (bbox, hole) in &holes {
        if let Some((_, spot)) = spots.iter_mut().rev().find(|(about, _)| about.union(*bbox) == *about) {
            spot.area = (spot.area + hole.area).max(0.0);
        }
    }
    spots.sort_by(|a, b| b.1.area.total_cmp(&a.1.area));
    if spots.is_empty() {
        spots.extend(holes.first().map(|(bbox, hole)| (*bbox, Spot { area: 0.0, ..*hole })));
    }
    spots.into_iter().map(|(_, spot)| spot).collect()
}

/// Both parallels of an unbroken run of curves, the sectors about its joints and the caps of its ends, with the swept
/// zone to the right.
fn sides(run: &[Segment], radius: f64, out: &mut Vec<Segment>) {
    let moving: Vec<&Segment> = run.iter().filter(|c| c.start() != c.end()).collect();
    let (Some(first), Some(last)) = (moving.first(), moving.last()) else {
        return out.extend(outline::circle(run[0].start(), radius));
    };
    let closed = first.start() == last.end();
    for (k, curve) in moving.iter().enumerate() {
        out.extend(outline::parallel(curve, radius, Side::Left));
        out.extend(outline::parallel(curve, radius, Side::Right).map(|c| c.reversed()));
        if let Some(next) = moving.get(k + 1).or(closed.then_some(first)) {
            out.extend(outline::sector(curve, next, radius, Side::Left));
            out.extend(outline::sector(curve, next, radius, Side::Right).map(|c| c.reversed()));
        }
    }
    if !closed {
        out.push(outline::cap(last.end(), last.end_tangent(), radius));
        out.push(outline::cap(first.start(), -first.start_tangent(), radius));
    }
}
