//! Connected components: one for each piece of the region, with the right number of cycles.
//!
//! Together with the boundary, the skeleton of a piece with k islands cuts the plane into one cell for each site, the
//! outside and k islands. Euler's formula, with one boundary edge for each segment and none for a reflex vertex, leaves
//!
//! > vertices − edges = 1 − k − (number of reflex vertices),
//!
//! vertices on the boundary counted once, the two spokes of a reflex vertex being a cycle through it.

use super::Judge;
use super::report::{Element as Part, FaultKind};
use crate::point::Point;
use crate::skeleton::{EdgeId, SiteId, VertexId};
use std::collections::{BTreeMap, BTreeSet};

#[derive(Default)]
struct Component {
    vertices: usize,
    edges: usize,
    corners: usize,
    contours: BTreeSet<u32>,
}

impl Judge<'_> {
    pub(super) fn check_components(&mut self) {
        let components = self.components();
        self.report.components = components.len();
        let pockets = self.region.pockets();
        let mut left: BTreeMap<BTreeSet<u32>, usize> = BTreeMap::new();
        for p in &pockets {
            *left.entry(p.islands.iter().copied().chain([p.outer]).collect()).or_default() += 1;
        }
        for (root, c) in &components {
            let place = self.skeleton.vertices()[*root as usize].point;
            if left.remove(&c.contours).is_none() {
                self.fault(FaultKind::Component, Part::Component(*root), place, c.contours.len() as f64);
            }
            // vertices − edges = 1 − islands − corners, where contours = islands + 1
            let (have, want) = (c.vertices + c.contours.len() + c.corners, c.edges + 2);
            if have != want {
                self.fault(FaultKind::Euler, Part::Component(*root), place, have as f64 - want as f64);
            }
        }
        for contours in left.keys() {
            self.fault(FaultKind::Component, Part::Whole, Point::ORIGIN, contours.len() as f64);
        }
    }

    fn components(&self) -> BTreeMap<VertexId, Component> {
        let s = self.skeleton;
        let mut sets = DisjointSets::new(s.vertices().len());
        for e in (0..s.half_edges().len() as EdgeId).step_by(2) {
            sets.join(s.origin(e), s.target(e));
        }
        let mut components: BTreeMap<VertexId, Component> = BTreeMap::new();
        for v in 0..s.vertices().len() as VertexId {
            components.entry(sets.root(v)).or_default().vertices += 1;
        }
        for e in (0..s.half_edges().len() as EdgeId).step_by(2) {
            components.entry(sets.root(s.origin(e))).or_default().edges += 1;
        }
        for (k, site) in s.sites().iter().enumerate() {
            let c = components.entry(sets.root(s.origin(site.first))).or_default();
            c.contours.insert(site.contour);
            c.corners += usize::from(self.is_corner(k as SiteId));
        }
        components
    }
}

/// Union–find with path halving.
struct DisjointSets(Vec<u32>);

impl DisjointSets {
    fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            let up = self.0[self.0[v as usize] as usize];
            self.0[v as usize] = up;
            v = up;
        }
        v
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        let (low, high) = (a.min(b), a.max(b));
        self.0[high as usize] = low;
    }
}
