//! Vertices: clearance, contacts, and the turn of the contacts around each.

use super::feet::End;
use super::report::{Element as Part, FaultKind};
use super::{Judge, Skeleton};
use crate::point::{Point, Vec2};
use crate::skeleton::{EdgeId, VertexId};
use std::f64::consts::TAU;

/// Contacts so near to one another in direction, radians, are those of an edge straight towards or away from them.
const NARROW: f64 = 1.0 / 256.0;

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
        if excess > self.options.foot && self.is_felt(excess, r) {
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
            let (mut turned, mut unsure) = (0.0, 0);
            let mut e = start;
            while !std::mem::replace(&mut done[e as usize], true) {
                let across = self.turn_across(e);
                turned += across.unwrap_or(0.0);
                unsure += i32::from(across.is_none());
                let twin = Skeleton::twin(e);
                let next = s.next(twin);
                turned += self.turn_within(twin, next);
                e = next;
            }
            let once = (0..=unsure).any(|more| (turned + f64::from(more) * TAU - TAU).abs() < 0.5);
            if e != start || !once || orbits[v as usize] > 1 {
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

    /// From the contact with the site right of `e` to that with the site left of it, counter-clockwise across the edge,
    /// at the origin of `e`: nothing or a full turn where both lie in one direction, as the edge falls or rises;
    /// `None` where it does neither, being without length.
    fn turn_across(&self, e: EdgeId) -> Option<f64> {
        let twin = Skeleton::twin(e);
        let turn = self.contact(e, End::Origin).angle_to(self.contact(twin, End::Target));
        if turn.abs() > NARROW {
            return Some(turn.rem_euclid(TAU));
        }
        let rise = self.skeleton.target_clearance(e) - self.skeleton.origin_clearance(e);
        let clear = rise.abs() > self.options.tight * self.size();
        clear.then_some(if rise > 0.0 { turn + TAU } else { turn })
    }

    /// From the foot where `incoming` ends to the foot where `outgoing` begins, both in one cell: nothing, save at
    /// the site's centre of curvature.
    fn turn_within(&self, incoming: EdgeId, outgoing: EdgeId) -> f64 {
        let element = &self.elements[self.skeleton.site(outgoing) as usize];
        let change = self.foot(outgoing, End::Origin) - self.foot(incoming, End::Target);
        // About a reflex vertex feet turn clockwise, but a disk there has no size and is no inner vertex.
        element.curvature().map_or(0.0, |k| k * change)
    }

    /// Direction from a vertex to its foot on the site right of `e`.
    fn contact(&self, e: EdgeId, end: End) -> Vec2 {
        let x: Point = self.end_point(e, end);
        let element = &self.elements[self.skeleton.site(e) as usize];
        let foot = element.at(self.foot(e, end).clamp(0.0, element.extent()));
        if x.distance(foot.point()) > 0.0 { foot.point() - x } else { -foot.normal }
    }
}
