//! Indices, links, cells and the list of sites.

use super::Judge;
use super::element::{Corner, Element, Wall, turn_at};
use super::report::{Element as Part, FaultKind};
use crate::point::Point;
use crate::segment::Segment;
use crate::skeleton::{EdgeId, NONE, Site, SiteId, SiteShape};
use crate::tolerance;
use std::f64::consts::PI;

/// The sites of a contour's segments and of the vertices where they start.
struct Owners {
    walls: Vec<Vec<SiteId>>,
    corners: Vec<Vec<SiteId>>,
}

impl Judge<'_> {
    /// Whether the structure is sound enough for the other parts to walk it; says what is wrong with it.
    pub(super) fn check_structure(&mut self) -> bool {
        if !self.links_hold() {
            return false;
        }
        let owners = self.check_sites();
        if self.elements.len() < self.skeleton.sites().len() {
            return false;
        }
        let walkable = self.check_cell_walks();
        if walkable {
            self.check_joints(&owners);
        }
        walkable
    }

    fn links_hold(&mut self) -> bool {
        let s = self.skeleton;
        let edges = s.half_edges();
        let mut sound = edges.len() & 1 == 0;
        for (k, h) in edges.iter().enumerate() {
            let inside = (h.origin as usize) < s.vertices().len()
                && (h.next as usize) < edges.len()
                && (h.site as usize) < s.sites().len();
            if !inside {
                self.fault(FaultKind::BrokenLink, Part::Edge(k as EdgeId), Point::ORIGIN, 1.0);
                sound = false;
            }
        }
        for (k, v) in s.vertices().iter().enumerate() {
            if !(v.point.is_finite() && v.clearance.is_finite() && v.clearance >= 0.0) {
                self.fault(FaultKind::NotFinite, Part::Vertex(k as u32), v.point, v.clearance);
                sound = false;
            }
        }
        for (k, site) in s.sites().iter().enumerate() {
            if site.first != NONE && site.first as usize >= edges.len() {
                self.fault(FaultKind::BrokenLink, Part::Site(k as SiteId), Point::ORIGIN, 1.0);
                sound = false;
            }
        }
        sound
    }

    /// Every element must have its site; fills the list of elements as long as sites name elements of the region.
    fn check_sites(&mut self) -> Owners {
        let (skeleton, region) = (self.skeleton, self.region);
        let empty = || region.contours().iter().map(|c| vec![NONE; c.segments.len()]).collect::<Vec<_>>();
        let mut owners = Owners { walls: empty(), corners: empty() };
        for (k, site) in skeleton.sites().iter().enumerate() {
            let (id, c, s) = (k as SiteId, site.contour as usize, site.segment as usize);
            if region.contours().get(c).is_none_or(|contour| s >= contour.segments.len()) {
                self.fault(FaultKind::SiteUnexpected, Part::Site(id), Point::ORIGIN, 1.0);
                return owners;
            }
            let corner = matches!(site.shape, SiteShape::Point(_));
            let owner = if corner { &mut owners.corners[c][s] } else { &mut owners.walls[c][s] };
            let taken = std::mem::replace(owner, id) != NONE;
            self.elements.push(self.element_of(site));
            let place = self.elements[k].ends()[0];
            if taken {
                self.fault(FaultKind::SiteTwice, Part::Site(id), place, 1.0);
            }
            let turn = turn_at(region, c, s);
            if corner && turn >= 0.0 && PI - turn > tolerance::CHECK_SMOOTH_TURN {
                self.fault(FaultKind::SiteUnexpected, Part::Site(id), place, turn);
            }
            let off = shape_error(site, &region.contours()[c].segments[s]) / self.size();
            if off.is_nan() || off > self.options.clearance {
                self.fault(FaultKind::SiteShape, Part::Site(id), place, off);
            }
        }
        self.check_missing(&owners);
        owners
    }

    fn element_of(&self, site: &Site) -> Element {
        let (c, s) = (site.contour as usize, site.segment as usize);
        match site.shape {
            SiteShape::Point(_) => Element::Corner(Corner::new(self.region, c, s)),
            _ => Element::Wall(Wall::new(self.region, c, s, tolerance::CHECK_SMOOTH_TURN)),
        }
    }

    fn check_missing(&mut self, owners: &Owners) {
        for (c, contour) in self.region.contours().iter().enumerate() {
            for (s, segment) in contour.segments.iter().enumerate() {
                let turn = turn_at(self.region, c, s);
                let needed = turn < -tolerance::CHECK_SMOOTH_TURN && PI + turn > tolerance::CHECK_SMOOTH_TURN;
                if owners.walls[c][s] == NONE || (needed && owners.corners[c][s] == NONE) {
                    self.fault(FaultKind::SiteMissing, Part::Segment(c as u32, s as u32), segment.start(), turn);
                }
            }
        }
    }

    /// Walks every cell once; whether each walk comes back to its first half-edge.
    fn check_cell_walks(&mut self) -> bool {
        let s = self.skeleton;
        let mut seen = vec![false; s.half_edges().len()];
        let mut walkable = true;
        for (k, site) in s.sites().iter().enumerate() {
            let (id, mut e) = (k as SiteId, site.first);
            if e == NONE {
                self.fault(FaultKind::CellEnds, Part::Site(id), self.elements[k].ends()[0], 0.0);
                walkable = false;
                continue;
            }
            loop {
                if std::mem::replace(&mut seen[e as usize], true) || s.site(e) != id {
                    self.fault(FaultKind::NotInOneCell, Part::Edge(e), self.origin_point(e), f64::from(id));
                    walkable = false;
                    break;
                }
                let next = s.next(e);
                if next == site.first {
                    break;
                }
                if s.target(e) != s.origin(next) {
                    self.fault(FaultKind::BrokenLink, Part::Edge(e), self.target_point(e), f64::from(next));
                }
                e = next;
            }
            if walkable {
                self.check_cell_ends(id, site.first, e);
            }
        }
        for (e, _) in seen.iter().enumerate().filter(|(_, seen)| !**seen) {
            self.fault(FaultKind::NotInOneCell, Part::Edge(e as EdgeId), self.origin_point(e as EdgeId), 0.0);
            walkable = false;
        }
        walkable
    }

    fn check_cell_ends(&mut self, site: SiteId, first: EdgeId, last: EdgeId) {
        let ends = self.elements[site as usize].ends();
        let vertices = [self.skeleton.origin(first), self.skeleton.target(last)];
        for (end, vertex) in ends.into_iter().zip(vertices) {
            let v = self.skeleton.vertices()[vertex as usize];
            let off = v.point.distance(end) / self.size();
            if v.clearance != 0.0 || off > self.options.clearance {
                self.fault(FaultKind::CellEnds, Part::Site(site), end, off.max(v.clearance));
            }
        }
    }

    /// Along each contour a cell must begin at the very vertex where the one before it ends.
    fn check_joints(&mut self, owners: &Owners) {
        let s = self.skeleton;
        for (walls, corners) in owners.walls.iter().zip(&owners.corners) {
            let chain: Vec<SiteId> =
                corners.iter().zip(walls).flat_map(|(&c, &w)| [c, w]).filter(|&id| id != NONE).collect();
            for (k, &site) in chain.iter().enumerate() {
                let next = chain[(k + 1) % chain.len()];
                let last = s.cell(site).last().unwrap_or(NONE);
                if s.target(last) != s.origin(s.sites()[next as usize].first) {
                    let place = self.elements[next as usize].ends()[0];
                    self.fault(FaultKind::JointNotShared, Part::Site(next), place, f64::from(site));
                }
            }
        }
    }
}

/// How far a site's own geometry lies from the region's segment (for a corner, from its start).
fn shape_error(site: &Site, segment: &Segment) -> f64 {
    let ends = |start: Point, end: Point| start.distance(segment.start()).max(end.distance(segment.end()));
    match (site.shape, segment) {
        (SiteShape::Point(p), _) => p.distance(segment.start()),
        (SiteShape::Line(l), Segment::Line(_)) => ends(l.start, l.end),
        (SiteShape::Arc(a), Segment::Arc(b)) => {
            let turned = if a.ccw == b.ccw { 0.0 } else { f64::INFINITY };
            let middle = Segment::Arc(a).at(0.5).distance(segment.at(0.5));
            ends(a.start, a.end).max(middle).max(turned)
        }
        _ => f64::INFINITY,
    }
}
