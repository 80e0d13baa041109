//! Subpockets: section 5 of J. J. Chou and E. Cohen, *Computing Offsets and Tool Paths With Voronoi Diagrams*,
//! UUCS-89-017, University of Utah, 1990; and the loops of their algorithm 6.3.
//!
//! A pass is where two basins of clearance meet. *Critical edges* lead from it to its projections on the walls, and cut the
//! region there. What remains around each peak is a *subpocket*.
//!
//! 1. **Passes** ([`cuts`]). Every pass is cut once: a single vertex there, a constant-clearance path (which the paper leaves
//!    out) at its midpoint, where the skeleton gets a vertex. Of a pass that more than two edges rise from, all but one are
//!    cut off one by one.
//! 2. **Gates** ([`Gate`]). A cut is kept as the corners of the cells where it crosses from the pass to a wall. Each
//!    cell is swept by the shortest ways from its edges to its site, so that a gate parts it cleanly: the paper's tags of
//!    redundant leaves have no counterpart.
//! 3. **Contours.** The paper traverses each tree; here the walk along offsets, at distance 0 and with the gates closed,
//!    goes round every subpocket. At a distance `d` the same walk makes the loops of algorithm 6.3: parallel to the walls, and
//!    along critical edges where the pass is higher than `d`.
//!
//! Subpockets tile the region: every half-edge of the skeleton, with the part of its cell that it sweeps, belongs to exactly
//! one. Each has one peak: cut at its passes, what hangs together is a tree (properties 3.4, 6.1 and 6.2). The exception is an
//! annulus of constant width, whose peak set is a cycle: it is one subpocket with two contours ([`Subpocket::is_annulus`]).
//!
//! O(n log n) time; a walk's cost is that of an offset, and of the open gates.

mod cuts;
#[cfg(test)]
mod tests;

use crate::contour::Contour;
use crate::offset::voronoi::{Gate, VoronoiOffsetter};
use crate::offset::{OffsetError, OffsetLoop, check_distance};
use crate::point::Point;
use crate::skeleton::trees::{DisjointSets, Kind, Trees};
use crate::skeleton::{EdgeId, NONE, SiteId, Skeleton, VertexId};

/// The part of a region around one peak.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subpocket {
    /// Vertices of its peak (set), in the skeleton of [`Subpockets::skeleton`].
    pub peak: Vec<VertexId>,
    /// Clearance of the peak, mm.
    pub clearance: f64,
    /// Whether the peak set is a cycle: an annulus of constant width, bounded by two contours.
    pub is_annulus: bool,
    /// Its boundary, the subpocket to the left of travel: one contour, two of an annulus.
    pub contours: Vec<Contour>,
}

impl Subpocket {
    /// Area, mm².
    pub fn area(&self) -> f64 {
        self.contours.iter().map(Contour::area).sum()
    }
}

/// A pass where subpockets meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// The subpockets to both sides; the same one twice where it meets itself around an island.
    pub between: [u32; 2],
    /// The pass, or the midpoint of a pass set.
    pub pass: Point,
    /// Clearance there, mm: half the width of the bottleneck.
    pub clearance: f64,
    /// The ends of its critical edges.
    pub feet: [Point; 2],
}

/// A loop of one subpocket (algorithm 6.3).
#[derive(Clone, Debug, PartialEq)]
pub struct SubpocketLoop {
    /// Which one.
    pub subpocket: u32,
    /// The loop; along critical edges its segments have no site and no crossing ([`NONE`]).
    pub path: OffsetLoop,
}

/// The subpockets of a region.
#[derive(Clone, Debug)]
pub struct Subpockets {
    skeleton: Skeleton,
    trees: Trees,
    gates: Vec<Gate>,
    /// For each edge its subpocket.
    of_edge: Vec<u32>,
    list: Vec<Subpocket>,
    borders: Vec<Border>,
}

impl Subpockets {
    /// Decomposes the region of a skeleton.
    pub fn new(skeleton: &Skeleton) -> Self {
        let trees = Trees::new(skeleton);
        let (skeleton, gates) = cuts::cut(skeleton.clone(), &trees);
        let mut sets = parts(&skeleton, &gates);
        let mut number = vec![NONE; skeleton.edge_count()];
        let mut list = Vec::new();
        for k in trees.of_kind(Kind::Peak) {
            let peak = &trees.plateaus()[k as usize];
            let Some(edge) = peak.down.first().or(peak.edges.first()) else { continue };
            let part = sets.find(edge / 2) as usize;
            if number[part] == NONE {
                number[part] = list.len() as u32;
                let (clearance, is_annulus) = (peak.clearance, peak.is_ring());
                list.push(Subpocket { peak: peak.vertices.clone(), clearance, is_annulus, contours: Vec::new() });
            }
        }
        let of_edge = (0..skeleton.edge_count() as u32).map(|k| number[sets.find(k) as usize]).collect();
        let mut found = Self { skeleton, trees, gates, of_edge, list, borders: Vec::new() };
        found.borders = found.find_borders();
        for SubpocketLoop { subpocket, path } in found.loops(&found.offsetter(), 0.0) {
            if let Some(s) = found.list.get_mut(subpocket as usize) {
                s.contours.push(path.contour);
            }
        }
        found
    }

    /// The skeleton, with a vertex at the midpoint of each pass set.
    pub const fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The trees of the skeleton that was decomposed.
    pub const fn trees(&self) -> &Trees {
        &self.trees
    }

    /// The subpockets, in the order of their peaks' plateaus.
    pub fn list(&self) -> &[Subpocket] {
        &self.list
    }

    /// Where they meet, the widest first.
    pub fn borders(&self) -> &[Border] {
        &self.borders
    }

    /// The critical edges, each from its pass to its projection.
    pub fn critical_edges(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        self.gates.iter().map(|g| (g.pass, g.foot))
    }

    /// The gates of all passes, highest first.
    pub fn gates(&self) -> &[Gate] {
        &self.gates
    }

    /// The subpockets before and behind a gate, in the order of its cell.
    pub fn sides(&self, gate: &Gate) -> [u32; 2] {
        [self.of_edge(gate.after), self.of_edge(self.skeleton.next(gate.after))]
    }

    /// The subpocket that a skeleton edge lies in.
    pub fn of_edge(&self, edge: EdgeId) -> u32 {
        self.of_edge[edge as usize / 2]
    }

    /// The skeleton prepared for loops.
    pub fn offsetter(&self) -> VoronoiOffsetter<'_> {
        VoronoiOffsetter::with_gates(&self.skeleton, self.gates.clone())
    }

    /// The loops at `distance`, mm: around the points of each subpocket with a larger clearance (algorithm 6.3).
    ///
    /// # Errors
    /// When the distance is not a positive number.
    pub fn loops_at(&self, offsetter: &VoronoiOffsetter<'_>, distance: f64) -> Result<Vec<SubpocketLoop>, OffsetError> {
        Ok(self.loops(offsetter, check_distance(distance)?))
    }

    fn loops(&self, offsetter: &VoronoiOffsetter<'_>, distance: f64) -> Vec<SubpocketLoop> {
        let of = |(path, edge): (OffsetLoop, EdgeId)| SubpocketLoop { subpocket: self.of_edge(edge), path };
        offsetter.loops_and_edges(distance).into_iter().map(of).collect()
    }

    fn find_borders(&self) -> Vec<Border> {
        let border = |(k, g): (usize, &Gate)| {
            let over = &self.gates[g.over as usize];
            // Each pair of gates once.
            let twice = over.over as usize == k && (g.over as usize) < k;
            let between = self.sides(g);
            (!twice).then_some(Border { between, pass: g.pass, clearance: g.clearance, feet: [g.foot, over.foot] })
        };
        self.gates.iter().enumerate().filter_map(border).collect()
    }
}

/// The edges whose swept parts hang together without crossing a gate.
fn parts(skeleton: &Skeleton, gates: &[Gate]) -> DisjointSets {
    let mut closed = vec![false; skeleton.half_edges().len()];
    for g in gates {
        closed[g.after as usize] = true;
    }
    let mut sets = DisjointSets::new(skeleton.edge_count());
    for site in 0..skeleton.sites().len() as SiteId {
        let mut last: Option<EdgeId> = None;
        for e in skeleton.cell(site) {
            if let Some(before) = last.filter(|&b| !closed[b as usize]) {
                sets.join(before / 2, e / 2);
            }
            last = Some(e);
        }
    }
    sets
}
