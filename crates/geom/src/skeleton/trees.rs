//! Peaks, passes, trees, control vertices and key branches: section 3.1 of J. J. Chou and E. Cohen, *Computing Offsets
//! and Tool Paths With Voronoi Diagrams*, UUCS-89-017, University of Utah, 1990.
//!
//! The paper excludes constant-clearance edges; here vertices joined by such edges (and by edges of no length) are merged
//! into one [`Plateau`] first, and everything is said of plateaus: most of them are single vertices, a channel's middle is
//! one plateau of several, the middle of an annulus a ring. What remains is ordered strictly by clearance:
//!
//! - a plateau that nothing rises from is a [`Kind::Peak`] (the paper's *mountain point*, the root of a tree);
//! - one from which two edges or more rise is a [`Kind::Pass`] (*valley point*: spokes apart, everything rises from it),
//!   a leaf of each tree that it joins;
//! - every other one has exactly one edge up, to its parent (properties 3.4 and 3.5).
//!
//! The spokes at a pass, which the paper does not have, hang below it in the first of its trees.

use super::{EdgeId, NONE, SiteId, Skeleton, VertexId};
use crate::bbox::BBox;
use crate::tolerance::PLATEAU;

/// What a plateau is to the clearance around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// On the region's boundary: clearance 0.
    Boundary,
    /// A local maximum of clearance, the paper's mountain point (m-vertex).
    Peak,
    /// A local minimum along the skeleton, the paper's valley point (v-vertex).
    Pass,
    /// A constant-clearance path from which one edge rises.
    Shelf,
    /// An ordinary vertex on the way up.
    Slope,
}

/// A maximal set of vertices joined by constant-clearance edges; mostly one vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Plateau {
    /// What it is.
    pub kind: Kind,
    /// Its clearance, mm (the highest of its vertices').
    pub clearance: f64,
    /// Its vertices, in increasing order.
    pub vertices: Vec<VertexId>,
    /// The edges between them, each as its even half-edge.
    pub edges: Vec<EdgeId>,
    /// Half-edges that lead to higher plateaus.
    pub up: Vec<EdgeId>,
    /// Half-edges that lead to lower plateaus.
    pub down: Vec<EdgeId>,
}

impl Plateau {
    /// Whether its edges close to a ring (the middle of an annulus).
    pub fn is_ring(&self) -> bool {
        !self.edges.is_empty() && self.edges.len() >= self.vertices.len()
    }
}

/// Where the walk along an offset may start: a vertex and a way down from it (definitions in section 3.1).
#[derive(Clone, Debug, PartialEq)]
pub struct ControlVertex {
    /// The plateau, an index into [`Trees::plateaus`].
    pub plateau: u32,
    /// Its clearance: the branch spans distances from [`ControlVertex::lowest`] to this one.
    pub clearance: f64,
    /// Clearance at the lower end of the key branch.
    pub lowest: f64,
    /// The key branch: half-edges from the control vertex downwards (constant-clearance edges left out).
    pub key_branch: Vec<EdgeId>,
    /// The boundary contour that it was made for; `None` for a peak.
    pub contour: Option<u32>,
}

impl ControlVertex {
    /// Whether an edge of its key branch spans distance `d`.
    pub fn spans(&self, d: f64) -> bool {
        self.lowest <= d && d < self.clearance
    }
}

/// The forest of a skeleton.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trees {
    plateaus: Vec<Plateau>,
    of_vertex: Vec<u32>,
    controls: Vec<ControlVertex>,
}

impl Trees {
    /// The forest of a skeleton, in O(n log n).
    pub fn new(skeleton: &Skeleton) -> Self {
        let (plateaus, of_vertex) = plateaus(skeleton);
        let mut trees = Self { plateaus, of_vertex, controls: Vec::new() };
        trees.controls = trees.find_controls(skeleton);
        trees
    }

    /// All plateaus.
    pub fn plateaus(&self) -> &[Plateau] {
        &self.plateaus
    }

    /// The plateau of a vertex.
    pub fn plateau_of(&self, vertex: VertexId) -> u32 {
        self.of_vertex[vertex as usize]
    }

    /// The plateaus of one kind, in increasing order.
    pub fn of_kind(&self, kind: Kind) -> impl Iterator<Item = u32> + '_ {
        (0..self.plateaus.len() as u32).filter(move |&k| self.plateaus[k as usize].kind == kind)
    }

    /// Control vertices, highest clearance first (step 2 of algorithm 3.6). As in the paper, a vertex can appear more
    /// than once: there are as many as peaks and contours.
    pub fn controls(&self) -> &[ControlVertex] {
        &self.controls
    }

    /// The peak at the root of a plateau's tree (of the first one, for a pass).
    pub fn root(&self, skeleton: &Skeleton, plateau: u32) -> u32 {
        let mut at = plateau;
        while let Some(&up) = self.plateaus[at as usize].up.first() {
            at = self.target(skeleton, up);
        }
        at
    }

    fn target(&self, skeleton: &Skeleton, edge: EdgeId) -> u32 {
        self.of_vertex[skeleton.target(edge) as usize]
    }

    fn find_controls(&self, skeleton: &Skeleton) -> Vec<ControlVertex> {
        let way_down = self.ways_down(skeleton);
        let mut on_branch = vec![false; self.plateaus.len()];
        // Rule 1: every peak, with the branch to its tree's lowest leaf.
        let mut controls: Vec<ControlVertex> = Vec::new();
        for peak in self.of_kind(Kind::Peak) {
            let mut branch = Vec::new();
            let mut at = peak;
            on_branch[at as usize] = true;
            while let Some(edge) = way_down[at as usize] {
                branch.push(edge);
                at = self.target(skeleton, edge);
                on_branch[at as usize] = true;
                if self.is_leaf(at, edge) {
                    break;
                }
            }
            controls.push(self.control(peak, at, branch, None));
        }
        // Rule 2: every contour, with the branch from a vertex of it up to the first vertex on a branch, or the root.
        for (contour, foot) in contour_vertices(skeleton) {
            let mut branch = Vec::new();
            let start = self.plateau_of(foot);
            let mut at = start;
            while let Some(&up) = self.plateaus[at as usize].up.first().filter(|_| !on_branch[at as usize]) {
                on_branch[at as usize] = true;
                branch.push(Skeleton::twin(up));
                at = self.target(skeleton, up);
            }
            branch.reverse();
            controls.push(self.control(at, start, branch, Some(contour)));
        }
        controls.sort_by(|a, b| b.clearance.total_cmp(&a.clearance));
        controls
    }

    fn control(&self, top: u32, bottom: u32, key_branch: Vec<EdgeId>, contour: Option<u32>) -> ControlVertex {
        let clearance = |k: u32| self.plateaus[k as usize].clearance;
        ControlVertex { plateau: top, clearance: clearance(top), lowest: clearance(bottom), key_branch, contour }
    }

    /// Whether a plateau reached downwards along `edge` ends that tree: the boundary, or a pass that hangs in another.
    fn is_leaf(&self, plateau: u32, edge: EdgeId) -> bool {
        let p = &self.plateaus[plateau as usize];
        p.down.is_empty() || (p.kind == Kind::Pass && p.up[0] != Skeleton::twin(edge))
    }

    /// For each plateau the half-edge towards the lowest leaf below it, if it is not a leaf itself.
    fn ways_down(&self, skeleton: &Skeleton) -> Vec<Option<EdgeId>> {
        let mut order: Vec<u32> = (0..self.plateaus.len() as u32).collect();
        order.sort_by(|&a, &b| self.rank(a).0.total_cmp(&self.rank(b).0).then(a.cmp(&b)));
        let mut lowest = vec![0.0; self.plateaus.len()];
        let mut way = vec![None; self.plateaus.len()];
        for k in order {
            let p = &self.plateaus[k as usize];
            let leaf = |&e: &EdgeId| {
                let child = self.target(skeleton, e);
                let stops = self.is_leaf(child, e);
                if stops { self.plateaus[child as usize].clearance } else { lowest[child as usize] }
            };
            way[k as usize] = p.down.iter().copied().min_by(|a, b| leaf(a).total_cmp(&leaf(b)));
            lowest[k as usize] = way[k as usize].as_ref().map_or(p.clearance, leaf);
        }
        way
    }

    fn rank(&self, plateau: u32) -> (f64, u32) {
        (self.plateaus[plateau as usize].clearance, plateau)
    }
}

/// For each contour the vertex where the cell of its first site begins.
fn contour_vertices(skeleton: &Skeleton) -> Vec<(u32, VertexId)> {
    let mut found: Vec<(u32, VertexId)> = Vec::new();
    for (site, s) in skeleton.sites().iter().enumerate() {
        let fresh = found.last().is_none_or(|f| f.0 != s.contour);
        if fresh && skeleton.sites()[site].first != NONE && found.iter().all(|f| f.0 != s.contour) {
            found.push((s.contour, skeleton.origin(skeleton.sites()[site as SiteId as usize].first)));
        }
    }
    found
}

fn plateaus(skeleton: &Skeleton) -> (Vec<Plateau>, Vec<u32>) {
    let size = skeleton.vertices().iter().fold(BBox::EMPTY, |b, v| b.with(v.point)).size();
    let flat = |e: EdgeId| {
        let (a, b) = (skeleton.origin_clearance(e), skeleton.target_clearance(e));
        (a - b).abs() <= PLATEAU * size && (a > 0.0) == (b > 0.0)
    };
    let evens = || (0..skeleton.edge_count() as EdgeId).map(|k| 2 * k);
    let mut sets = DisjointSets::new(skeleton.vertices().len());
    for e in evens().filter(|&e| flat(e)) {
        sets.join(skeleton.origin(e), skeleton.target(e));
    }
    let (mut plateaus, of_vertex) = numbered(skeleton, &mut sets);
    let place = |e: EdgeId| of_vertex[skeleton.origin(e) as usize];
    let above = |a: u32, b: u32| {
        plateaus[a as usize].clearance.total_cmp(&plateaus[b as usize].clearance).then(a.cmp(&b)).is_gt()
    };
    let rises: Vec<bool> = evens().map(|e| above(place(e ^ 1), place(e))).collect();
    for e in evens() {
        let (a, b) = (place(e), place(e ^ 1));
        if a == b {
            plateaus[a as usize].edges.push(e);
            continue;
        }
        let (low, high, up) = if rises[e as usize / 2] { (a, b, e) } else { (b, a, e ^ 1) };
        plateaus[low as usize].up.push(up);
        plateaus[high as usize].down.push(Skeleton::twin(up));
    }
    for p in &mut plateaus {
        p.kind = kind(p);
    }
    (plateaus, of_vertex)
}

fn kind(p: &Plateau) -> Kind {
    match p.up.len() {
        _ if p.clearance <= 0.0 => Kind::Boundary,
        0 => Kind::Peak,
        1 if p.edges.is_empty() => Kind::Slope,
        1 => Kind::Shelf,
        _ => Kind::Pass,
    }
}

/// The plateaus of the vertices' sets, still without edges, and each vertex's plateau.
fn numbered(skeleton: &Skeleton, sets: &mut DisjointSets) -> (Vec<Plateau>, Vec<u32>) {
    let mut number = vec![NONE; skeleton.vertices().len()];
    let mut of_vertex = Vec::with_capacity(number.len());
    let mut plateaus: Vec<Plateau> = Vec::new();
    for (k, vertex) in skeleton.vertices().iter().enumerate() {
        let root = sets.find(k as u32) as usize;
        if number[root] == NONE {
            number[root] = plateaus.len() as u32;
            plateaus.push(Plateau {
                kind: Kind::Slope,
                clearance: vertex.clearance,
                vertices: Vec::new(),
                edges: Vec::new(),
                up: Vec::new(),
                down: Vec::new(),
            });
        }
        let plateau = &mut plateaus[number[root] as usize];
        plateau.clearance = plateau.clearance.max(vertex.clearance);
        plateau.vertices.push(k as u32);
        of_vertex.push(number[root]);
    }
    (plateaus, of_vertex)
}

/// Disjoint sets of small integers, by path halving.
#[derive(Clone, Debug)]
pub struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    /// As many sets of one element each.
    pub fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// The representative of an element's set.
    pub fn find(&mut self, mut k: u32) -> u32 {
        while self.parents[k as usize] != k {
            self.parents[k as usize] = self.parents[self.parents[k as usize] as usize];
            k = self.parents[k as usize];
        }
        k
    }

    /// Makes one set of two; its representative is the smaller one.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::super::handmade;
    use super::*;

    fn check(skeleton: &Skeleton) -> Trees {
        let trees = Trees::new(skeleton);
        for p in trees.plateaus() {
            for &e in &p.up {
                // Properties 3.3 and 3.5.
                assert!(skeleton.target_clearance(e) > skeleton.origin_clearance(e));
            }
            match p.kind {
                Kind::Peak => assert!(p.up.is_empty()),
                Kind::Pass => assert!(p.up.len() >= 2),
                Kind::Slope | Kind::Shelf => assert_eq!(p.up.len(), 1),
                Kind::Boundary => assert!(p.down.is_empty() && !p.up.is_empty()),
            }
        }
        // Property 3.4: every plateau hangs in a tree rooted at a peak.
        for k in 0..trees.plateaus().len() as u32 {
            assert_eq!(trees.plateaus()[trees.root(skeleton, k) as usize].kind, Kind::Peak);
        }
        for c in trees.controls() {
            let mut clearance = c.clearance;
            for &e in &c.key_branch {
                assert!(skeleton.target_clearance(e) < clearance);
                clearance = skeleton.target_clearance(e);
            }
            assert!((clearance - c.lowest).abs() < 1e-12);
        }
        trees
    }

    #[test]
    fn a_rectangle_has_one_peak_set_the_middle_edge() {
        let skeleton = handmade::rectangle(10.0, 4.0);
        let trees = check(&skeleton);
        let peaks: Vec<_> = trees.of_kind(Kind::Peak).collect();
        assert_eq!(peaks.len(), 1);
        let peak = &trees.plateaus()[peaks[0] as usize];
        assert_eq!((peak.vertices.len(), peak.edges.len(), peak.is_ring()), (2, 1, false));
        assert_eq!(trees.controls().len(), 2);
        assert_eq!(trees.controls()[0].key_branch.len(), 1);
        assert!(trees.controls()[0].spans(0.0) && trees.controls()[0].spans(1.9) && !trees.controls()[0].spans(2.0));
    }

    #[test]
    fn an_annulus_has_a_ring_for_a_peak() {
        let skeleton = handmade::annulus(10.0, 4.0);
        let trees = check(&skeleton);
        let peaks: Vec<_> = trees.of_kind(Kind::Peak).collect();
        assert_eq!(peaks.len(), 1);
        assert!(trees.plateaus()[peaks[0] as usize].is_ring());
        assert_eq!(trees.controls().len(), 3);
    }

    #[test]
    fn an_ell_has_two_shelves_and_one_peak() {
        let trees = check(&handmade::ell(10.0));
        assert_eq!(trees.of_kind(Kind::Peak).count(), 1);
        assert_eq!(trees.of_kind(Kind::Shelf).count(), 2);
        assert_eq!(trees.of_kind(Kind::Pass).count(), 0);
    }

    #[test]
    fn a_disc_has_its_centre_for_a_peak() {
        let trees = check(&handmade::disc(5.0));
        assert_eq!(trees.of_kind(Kind::Peak).count(), 1);
        assert_eq!(trees.controls().len(), 2);
    }

    #[test]
    fn a_neck_is_a_pass_between_two_trees() {
        let skeleton = handmade::neck();
        let trees = check(&skeleton);
        assert_eq!(trees.of_kind(Kind::Peak).count(), 2);
        assert_eq!(trees.of_kind(Kind::Pass).count(), 1);
        let pass = trees.of_kind(Kind::Pass).next().unwrap();
        assert_eq!(trees.plateaus()[pass as usize].up.len(), 2);
    }
}
