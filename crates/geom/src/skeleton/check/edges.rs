//! Points within edges, derived from the definition: centres of the disks that touch both sites.

use super::feet::End;
use super::report::{Element as Part, FaultKind};
use super::{Judge, Skeleton};
use crate::point::Point;
use crate::skeleton::EdgeId;

/// A candidate for a point of an edge.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) x: Point,
    r: f64,
    /// How far the distances to the two sites lie from r.
    mismatch: f64,
}

impl Judge<'_> {
    pub(super) fn check_edges(&mut self) {
        for e in (0..self.skeleton.half_edges().len() as EdgeId).step_by(2) {
            self.check_edge(e);
        }
    }

    /// The ends of an edge and `between` points within.
    pub(super) fn polyline(&self, e: EdgeId, between: u32) -> Vec<Point> {
        let mut points = vec![self.origin_point(e)];
        points.extend((1..=between).map(|k| self.sample(e, f64::from(k) / f64::from(between + 1)).x));
        points.push(self.target_point(e));
        points
    }

    fn check_edge(&mut self, e: EdgeId) {
        let size = self.size();
        for k in 1..=self.options.samples {
            let t = f64::from(k) / f64::from(self.options.samples + 1);
            let sample = self.sample(e, t);
            let off = (self.nearest.distance(sample.x) - sample.r).abs().max(sample.mismatch) / size;
            let beyond = self.beyond_ends(e, sample.r) / size;
            self.report.samples += 1;
            self.report.worst_edge = self.report.worst_edge.max(off);
            let kind = match self.options.clearance {
                limit if sample.mismatch > limit * size => FaultKind::EdgeNotEquidistant,
                limit if off > limit => FaultKind::EdgeClearance,
                limit if beyond > limit => FaultKind::NotMonotone,
                _ => continue,
            };
            self.fault(kind, Part::Edge(e), sample.x, off.max(beyond));
            return;
        }
    }

    /// How far a clearance lies outside those of an edge's ends: a bisector's clearance has its extrema at apexes, so
    /// it is monotone between two of its points exactly where it stays between their clearances.
    fn beyond_ends(&self, e: EdgeId, r: f64) -> f64 {
        let (u, v) = (self.skeleton.origin_clearance(e), self.skeleton.target_clearance(e));
        (u.min(v) - r).max(r - u.max(v)).max(0.0)
    }

    /// A point of an edge, about at fraction `t` of the way: on the chord where that is on the bisector (straight and
    /// very short edges), else at this fraction of the feet's way on either site. Of these, the one that fits best.
    fn sample(&self, e: EdgeId, t: f64) -> Sample {
        let twin = Skeleton::twin(e);
        let score = |s: &Sample| s.mismatch.max(self.beyond_ends(e, s.r));
        let mut best = self.chord_sample(e, t);
        let here_first = self.foot_travel(e) >= self.foot_travel(twin);
        for here in [here_first, !here_first] {
            if score(&best) <= self.options.tight * self.size() {
                break;
            }
            let candidate = if here { self.pencil_sample(e, t) } else { self.pencil_sample(twin, 1.0 - t) };
            if score(&candidate) < score(&best) {
                best = candidate;
            }
        }
        best
    }

    /// Whether the chord of an edge lies on the bisector of its sites, or at least nearer to it than what feet tell:
    /// along a spoke to the common centre of two arcs they tell nothing.
    pub(super) fn is_straight(&self, e: EdgeId) -> bool {
        let off = |s: Sample| s.mismatch.max(self.beyond_ends(e, s.r));
        let chord = off(self.chord_sample(e, 0.5));
        let by_feet = || off(self.pencil_sample(e, 0.5)).min(off(self.pencil_sample(Skeleton::twin(e), 0.5)));
        chord <= self.options.tight * self.size() || chord <= by_feet()
    }

    /// How far the foot travels on the site right of `e`.
    fn foot_travel(&self, e: EdgeId) -> f64 {
        let r = self.skeleton.origin_clearance(e).max(self.skeleton.target_clearance(e));
        let change = self.foot(e, End::Target) - self.foot(e, End::Origin);
        self.elements[self.skeleton.site(e) as usize].length_of(change, r)
    }

    /// The disk that touches the site right of `e` at fraction `t` of the feet's way, and the site left of it.
    pub(super) fn pencil_sample(&self, e: EdgeId, t: f64) -> Sample {
        let s = self.skeleton;
        let from = self.foot(e, End::Origin);
        let to = self.foot(e, End::Target);
        let foot = self.elements[s.site(e) as usize].at((1.0 - t) * from + t * to);
        let r = self.elements[s.site(Skeleton::twin(e)) as usize].tangent_radius(&foot);
        self.measured(e, foot.anchor + (foot.offset + foot.normal * r), r)
    }

    pub(super) fn chord_sample(&self, e: EdgeId, t: f64) -> Sample {
        let x = self.origin_point(e).lerp(self.target_point(e), t);
        let r = self.elements[self.skeleton.site(e) as usize].distance(x);
        self.measured(e, x, r)
    }

    fn measured(&self, e: EdgeId, x: Point, r: f64) -> Sample {
        let s = self.skeleton;
        let off = |e: EdgeId| (self.elements[s.site(e) as usize].distance(x) - r).abs();
        let mismatch = if r.is_finite() { off(e).max(off(Skeleton::twin(e))) } else { f64::INFINITY };
        Sample { x, r, mismatch }
    }
}
