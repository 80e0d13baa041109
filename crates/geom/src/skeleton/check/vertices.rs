//! Vertices: clearance, contacts, and the turn of the contacts around each.

use super::feet::End;
use super::report::{Element as Part, FaultKind};
use super::{Judge, Skeleton};
use crate::point::{Point, Vec2};
use crate::skeleton::{EdgeId, NONE, VertexId};
use std::f64::consts::TAU;

/// An angle so near to a full turn belongs to the two contacts of a spoke seen in the wrong order by rounding.
const ALMOST_FULL: f64 = 0.999 * TAU;

impl Judge<'_> {
    pub(super) fn check_vertices(&mut self) {
        for v in 0..self.skeleton.vertices().len() {
            self.check_clearance(v as VertexId);
        }
        for e in 0..self.skeleton.half_edges().len() {
            for end in [End::Origin, End::Target] {
                self.check_contact(e as EdgeId, end);
            }
        }
        self.check_turns();
    }

    fn check_clearance(&mut self, v: VertexId) {
        let vertex = self.skeleton.vertices()[v as usize];
        let off = (self.nearest.distance(vertex.point) - vertex.clearance).abs() / self.size();
        self.report.worst_vertex = self.report.worst_vertex.max(off);
        self.report.over_tight += usize::from(off > self.options.tight);
        if off > self.options.clearance {
            self.fault(FaultKind::VertexClearance, Part::Vertex(v), vertex.point, off);
        }
    }

    /// The site to the right of `e` must touch the disk of the vertex at this end, from inside and within its extent.
    fn check_contact(&mut self, e: EdgeId, end: End) {
        let s = self.skeleton;
        let v = if end == End::Origin { s.origin(e) } else { s.target(e) };
        let vertex = s.vertices()[v as usize];
        let (x, r, size) = (vertex.point, vertex.clearance, self.size());
        let element = self.elements[s.site(e) as usize];
        let off = (element.distance(x) - r).abs() / size;
        self.report.worst_foot = self.report.worst_foot.max(off);
        if off > self.options.clearance {
            self.fault(FaultKind::FootDistance, Part::Edge(e), x, off);
            return;
        }
        let foot = self.foot(e, end);
        let at = element.at(foot.clamp(0.0, element.extent()));
        let inward = (x - at.point()).dot(at.normal) / size;
        if inward < -self.options.clearance {
            self.fault(FaultKind::FootSide, Part::Edge(e), x, -inward);
        }
        let [before, after] = element.looseness(r);
        let beyond = (-foot - before).max(foot - element.extent() - after);
        let excess = beyond / element.foot_slack(x, size);
        self.report.worst_outside = self.report.worst_outside.max(excess);
        if excess > self.options.foot {
            self.fault(FaultKind::FootOutside, Part::Edge(e), x, excess);
        }
    }

    /// Counter-clockwise around an inner vertex the contacts of its cells turn once.
    fn check_turns(&mut self) {
        let s = self.skeleton;
        let mut done = vec![false; s.half_edges().len()];
        let mut orbits = vec![0_u32; s.vertices().len()];
        for start in 0..s.half_edges().len() as EdgeId {
            let v = s.origin(start);
            let vertex = s.vertices()[v as usize];
            if done[start as usize] || vertex.clearance == 0.0 {
                continue;
            }
            orbits[v as usize] += 1;
            let mut turned = 0.0;
            let mut e = start;
            while !std::mem::replace(&mut done[e as usize], true) {
                turned += self.turn_across(e);
                let twin = Skeleton::twin(e);
                let next = s.next(twin);
                turned += self.turn_within(twin, next);
                e = next;
            }
            let off = (turned - TAU).abs();
            if e != start || off > 0.5 || orbits[v as usize] > 1 {
                self.fault(FaultKind::ContactsTurn, Part::Vertex(v), vertex.point, turned / TAU);
            }
        }
        for (v, _) in orbits.iter().enumerate().filter(|(_, n)| **n == 0) {
            let vertex = s.vertices()[v];
            if vertex.clearance > 0.0 {
                self.fault(FaultKind::ContactsTurn, Part::Vertex(v as VertexId), vertex.point, 0.0);
            }
        }
    }

    /// From the contact with the site right of `e` to that with the site left of it, at the origin of `e`.
    fn turn_across(&self, e: EdgeId) -> f64 {
        let twin = Skeleton::twin(e);
        let right = self.contact(e, End::Origin);
        let left = self.contact(twin, End::Target);
        let turn = right.angle_to(left).rem_euclid(TAU);
        let falls = self.skeleton.target_clearance(e) < self.skeleton.origin_clearance(e);
        if turn > ALMOST_FULL && falls { turn - TAU } else { turn }
    }

    /// From the foot where `incoming` ends to the foot where `outgoing` begins, both in one cell: nothing, save at
    /// the site's centre of curvature.
    fn turn_within(&self, incoming: EdgeId, outgoing: EdgeId) -> f64 {
        debug_assert!(outgoing != NONE);
        let turn = self.contact(incoming, End::Target).angle_to(self.contact(outgoing, End::Origin)).rem_euclid(TAU);
        if turn > ALMOST_FULL { turn - TAU } else { turn }
    }

    /// Direction from a vertex to its foot on the site right of `e`.
    fn contact(&self, e: EdgeId, end: End) -> Vec2 {
        let x: Point = self.end_point(e, end);
        let element = &self.elements[self.skeleton.site(e) as usize];
        let foot = element.at(self.foot(e, end));
        if x.distance(foot.point()) > 0.0 { foot.point() - x } else { -foot.normal }
    }
}
