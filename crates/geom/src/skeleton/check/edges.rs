//! Points within edges, derived from the definition: centres of the disks that touch both sites.

use super::feet::End;
use super::report::{Element as Part, FaultKind};
use super::{Judge, Skeleton};
use crate::point::Point;
use crate::skeleton::EdgeId;

/// A candidate for a point of an edge.
#[derive(Clone, Copy)]
struct Sample {
    x: Point,
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
        let (s, size) = (self.skeleton, self.size());
        let ends = [s.origin_clearance(e), s.target_clearance(e)];
        let mut last = ends[0];
        let rises = ends[1] >= ends[0];
        let mut slip = 0.0_f64;
        for k in 1..=self.options.samples {
            let t = f64::from(k) / f64::from(self.options.samples + 1);
            let sample = self.sample(e, t);
            self.report.samples += 1;
            if sample.mismatch.is_nan() || sample.mismatch > self.options.clearance * size {
                self.report.worst_edge = self.report.worst_edge.max(sample.mismatch / size);
                self.fault(FaultKind::EdgeNotEquidistant, Part::Edge(e), sample.x, sample.mismatch / size);
                return;
            }
            let off = (self.nearest.distance(sample.x) - sample.r).abs().max(sample.mismatch) / size;
            self.report.worst_edge = self.report.worst_edge.max(off);
            if off > self.options.clearance {
                self.fault(FaultKind::EdgeClearance, Part::Edge(e), sample.x, off);
                return;
            }
            slip = slip.max(if rises { last - sample.r } else { sample.r - last });
            last = sample.r;
        }
        slip = slip.max(if rises { last - ends[1] } else { ends[1] - last }) / size;
        if slip > self.options.clearance {
            self.fault(FaultKind::NotMonotone, Part::Edge(e), self.origin_point(e), slip);
        }
    }

    /// The point of an edge at fraction `t` of its feet's way. It is found from the foot on either site and, where
    /// both feet hardly move (a spoke), on the chord; of these, the one that fits both sites best.
    fn sample(&self, e: EdgeId, t: f64) -> Sample {
        let twin = Skeleton::twin(e);
        let good = |s: &Sample| s.mismatch <= self.options.tight * self.size();
        let (here, there) = (self.foot_travel(e), self.foot_travel(twin));
        let mut best = if here >= there { self.pencil_sample(e, t) } else { self.pencil_sample(twin, 1.0 - t) };
        if !good(&best) {
            let other = if here >= there { self.pencil_sample(twin, 1.0 - t) } else { self.pencil_sample(e, t) };
            let chord = self.chord_sample(e, t);
            for candidate in [other, chord] {
                if candidate.mismatch < best.mismatch || best.mismatch.is_nan() {
                    best = candidate;
                }
            }
        }
        best
    }

    /// How far the foot travels on the site right of `e`.
    fn foot_travel(&self, e: EdgeId) -> f64 {
        let r = self.skeleton.origin_clearance(e).max(self.skeleton.target_clearance(e));
        let change = self.foot(e, End::Target) - self.foot(e, End::Origin);
        self.elements[self.skeleton.site(e) as usize].length_of(change, r)
    }

    /// The disk that touches the site right of `e` at fraction `t` of the feet's way, and the site left of it.
    fn pencil_sample(&self, e: EdgeId, t: f64) -> Sample {
        let s = self.skeleton;
        let from = self.foot(e, End::Origin);
        let to = self.foot(e, End::Target);
        let foot = self.elements[s.site(e) as usize].at((1.0 - t) * from + t * to);
        let r = self.elements[s.site(Skeleton::twin(e)) as usize].tangent_radius(&foot);
        self.measured(e, foot.anchor + (foot.offset + foot.normal * r), r)
    }

    fn chord_sample(&self, e: EdgeId, t: f64) -> Sample {
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
