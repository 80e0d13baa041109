//! Chains of pieces that can't cross themselves, in a tree of boxes: where raw curves come close to one another.
//!
//! All pieces of a chain lead forwards along one axis, and so do those of two chains in a row most often: then nothing
//! of them needs a test. A chain has a single box, turned along its axis.

use super::raw::RawCurves;
use crate::bbox::BBox;
use crate::index::{BoxTree, Oriented, hilbert_order};
use crate::point::{Point, Vec2};
use crate::segment::Segment;
use crate::tolerance::COORDINATE_ROUNDOFF;
use std::ops::{ControlFlow, Range};

/// Most pieces of a chain.
const LONGEST: usize = 8;

/// Cosine of the largest angle between a piece of a chain and its axis.
const FORWARDS: f64 = 0.25;

/// Some pieces of a curve in a row.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) pieces: Range<u32>,
    /// The pieces of its whole curve.
    pub(super) curve: Range<u32>,
    axis: Vec2,
}

/// All chains of raw curves.
pub(super) struct Chains<'a> {
    curves: &'a RawCurves,
    all: Vec<Chain>,
    tree: BoxTree,
}

impl<'a> Chains<'a> {
    pub(super) fn new(curves: &'a RawCurves) -> Self {
        let mut chains = Vec::with_capacity(curves.segments.len() / 4);
        for curve in curves.curves() {
            let mut from = curve.start;
            while from < curve.end {
                let chain = longest(curves, from, &curve);
                from = chain.pieces.end;
                chains.push(chain);
            }
        }
        let middle =
            |c: &Chain| curves.segment(c.pieces.start).start().midpoint(curves.segment(c.pieces.end - 1).end());
        let bbox = chains.iter().fold(BBox::EMPTY, |b, c| b.with(middle(c)));
        let origin = if chains.is_empty() { Point::ORIGIN } else { bbox.center() };
        let order = hilbert_order(chains.iter().map(middle), bbox);
        let chains: Vec<Chain> = order.iter().map(|&k| chains[k as usize].clone()).collect();
        let boxes = chains.iter().map(|c| {
            let pieces = &curves.segments[c.pieces.start as usize..c.pieces.end as usize];
            Oriented::along(c.axis, pieces, origin)
        });
        let tree = BoxTree::new(boxes.collect());
        Self { curves, all: chains, tree }
    }

    /// Calls `found` once for every pair of pieces that may cross and are no neighbours.
    pub(super) fn visit_pairs(&self, mut found: impl FnMut(u32, u32)) {
        let largest = self.curves.segments.iter().fold(0.0, |most: f64, s| {
            let p = s.start();
            most.max(p.x.abs()).max(p.y.abs())
        });
        let margin = COORDINATE_ROUNDOFF * largest;
        let _: ControlFlow<()> = self.tree.visit_pairs(margin, |a, b| {
            if a != b && !self.leads_into(a, b) && !self.leads_into(b, a) {
                self.pieces_of(&self.all[a], &self.all[b], margin, &mut found);
            }
            ControlFlow::Continue(())
        });
    }

    /// Whether the second chain follows the first and leads forwards along its axis, too.
    fn leads_into(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.all[a], &self.all[b]);
        // Where both are all of a curve, each follows the other: then one axis can't be that of both.
        let follows = a.pieces.end == b.pieces.start && a.curve == b.curve;
        follows && a.pieces.clone().chain(b.pieces.clone()).all(|k| leads(self.curves.segment(k), a.axis))
    }

    fn pieces_of(&self, a: &Chain, b: &Chain, margin: f64, found: &mut impl FnMut(u32, u32)) {
        let bbox = |k: u32| self.curves.segment(k).bbox().inflated(margin);
        let all_of_b = b.pieces.clone().fold(BBox::EMPTY, |all, k| all.union(bbox(k)));
        for i in a.pieces.clone() {
            let own = bbox(i);
            if !own.intersects(all_of_b) {
                continue;
            }
            for j in b.pieces.clone() {
                if own.intersects(bbox(j)) && !are_neighbours(i, j, a, b) {
                    found(i, j);
                }
            }
        }
    }
}

/// Whether two pieces follow one another.
fn are_neighbours(i: u32, j: u32, a: &Chain, b: &Chain) -> bool {
    let (low, high) = (i.min(j), i.max(j));
    a.curve == b.curve && (high == low + 1 || (low == a.curve.start && high + 1 == a.curve.end))
}

/// The longest chain from a piece of a curve.
fn longest(curves: &RawCurves, from: u32, curve: &Range<u32>) -> Chain {
    let first = curves.segment(from);
    let axis = (first.end() - first.start()).normalized();
    let most = curve.end.min(from + LONGEST as u32);
    let end =
        if leads(first, axis) { (from + 1..most).find(|&k| !leads(curves.segment(k), axis)) } else { Some(from + 1) };
    Chain { pieces: from..end.unwrap_or(most), curve: curve.clone(), axis }
}

/// Whether a piece leads forwards along an axis all the way.
fn leads(s: &Segment, axis: Vec2) -> bool {
    match s {
        Segment::Line(l) => {
            let along = l.end - l.start;
            let forwards = along.dot(axis);
            forwards > 0.0 && forwards * forwards > FORWARDS * FORWARDS * along.length_squared()
        }
        Segment::Arc(a) => [a.tangent_at(a.start), a.tangent_at(a.end)].iter().all(|t| t.dot(axis) > FORWARDS),
    }
}
