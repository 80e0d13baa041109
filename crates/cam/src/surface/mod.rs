//! The CL-surface: the Minkowski sum of the part's surface and the inverse cutter (S. C. Park and B. K. Choi, *Uncut free
//! pocketing tool-paths generation using pair-wise offset algorithm*, Computer-Aided Design 33, 2001, figure 3).
//!
//! [`ClSurface::height`] is how low the tip may go at a place without the cutter entering the model: exact, in closed form or to
//! rounding, against facets, edges and vertices ([`contact`]). [`HeightGrid`] holds it at the nodes of a grid;
//! [`HeightGrid::contours`] follows a height through the grid and settles every point of the line on the surface
//! itself, so that the grid decides only how small a detail may be and be found.
//!
//! The model is seen from above: what lies under an overhang does not exist, and an open surface serves as well as a solid.

mod bins;
mod contact;
mod contour;
mod grid;
mod profile;
mod simplify;
#[cfg(test)]
mod tests;

pub use grid::HeightGrid;

use bins::Bins;
use contact::{Facet, edge_tip};
use pocketry_geom::Point;
use pocketry_geom::mesh::{Corner, Mesh, above};
use pocketry_motion::Cutter;
use profile::Profile;

/// How low a cutter's tip may go over a model.
#[derive(Clone, Debug)]
pub struct ClSurface {
    profile: Profile,
    facets: Vec<Facet>,
    edges: Vec<[Corner; 2]>,
    bins: Bins,
}

impl ClSurface {
    /// The surface of a model for a cutter of this radius that leaves `leave` (mm) of material everywhere.
    pub fn new(mesh: &Mesh, cutter: Cutter, radius: f64, leave: f64) -> Self {
        let profile = Profile::new(cutter, radius, leave);
        let planes: Vec<Option<Facet>> =
            (0..mesh.facets().len()).map(|f| Facet::new(mesh.corners(f), &profile)).collect();
        let edges: Vec<[Corner; 2]> =
            ridges(mesh, &planes).map(|e| mesh.edges()[e].map(|v| mesh.vertices()[v as usize])).collect();
        let solid = |f: &usize| planes[*f].is_some();
        let corners: Vec<[Corner; 3]> = (0..planes.len()).filter(solid).map(|f| mesh.corners(f)).collect();
        let bins = Bins::new(&corners, &edges, mesh.bbox(), profile.radius());
        Self { profile, facets: planes.into_iter().flatten().collect(), edges, bins }
    }

    /// The lowest place of the tip at `c`, mm; minus infinity where the cutter meets nothing.
    pub fn height(&self, c: Point) -> f64 {
        self.highest(c, f64::NEG_INFINITY, f64::INFINITY) + self.profile.below()
    }

    /// Whether the tip may be at `c` and height `z`.
    pub fn is_free(&self, c: Point, z: f64) -> bool {
        let limit = z - self.profile.below();
        self.highest(c, limit, limit) <= limit
    }

    /// The highest tip that any item asks for, if above `known`; any such one above `enough` will do.
    fn highest(&self, c: Point, known: f64, enough: f64) -> f64 {
        let mut best = known;
        self.bins.visit(c, self.profile.radius(), |item| {
            if item.top <= best {
                return false;
            }
            let rho = item.bbox.distance_squared(c).sqrt();
            if rho <= self.profile.radius() && item.top - self.profile.height(rho) > best {
                let k = item.index as usize;
                let tip = if item.is_edge {
                    edge_tip(&self.profile, c, self.edges[k], best)
                } else {
                    self.facets[k].tip(c, best)
                };
                best = tip.map_or(best, |t| best.max(t));
            }
            best <= enough
        });
        best
    }
}

/// How high the cutter's shape lets material stand between loops this far apart, and within the innermost ones, mm.
pub(crate) fn scallop(cutter: Cutter, radius: f64, stepover: f64) -> f64 {
    Profile::new(cutter, radius, 0.0).height(stepover.min(radius))
}

/// The distance of loops at which the cutter's shape lets material stand so high, mm; at most the radius.
pub(crate) fn stepover_for(cutter: Cutter, radius: f64, scallop: f64) -> f64 {
    Profile::new(cutter, radius, 0.0).reach(scallop)
}

/// The edges that a cutter can touch where it touches none of the facets inside: not those in a valley or a plane.
fn ridges<'a>(mesh: &'a Mesh, planes: &'a [Option<Facet>]) -> impl Iterator<Item = usize> + 'a {
    let mut sides: Vec<[u32; 2]> = vec![[u32::MAX; 2]; mesh.edges().len()];
    let mut crowded = vec![false; mesh.edges().len()];
    for (f, three) in mesh.sides().iter().enumerate() {
        for &e in three {
            let slots = &mut sides[e as usize];
            match slots.iter_mut().find(|s| **s == u32::MAX) {
                Some(slot) => *slot = f as u32,
                None => crowded[e as usize] = true,
            }
        }
    }
    (0..sides.len()).filter(move |&e| {
        let [f, g] = sides[e];
        if g == u32::MAX || crowded[e] {
            return true;
        }
        let apex = |facet: u32| {
            let own = mesh.facets()[facet as usize].into_iter().find(|v| !mesh.edges()[e].contains(v));
            mesh.vertices()[own.unwrap_or_default() as usize]
        };
        match (&planes[f as usize], &planes[g as usize]) {
            (Some(p), Some(q)) if opposite(mesh, e, apex(f), apex(g)) => {
                p.below(apex(g)) < 0.0 || q.below(apex(f)) < 0.0
            }
            (Some(p), None) => p.below(apex(g)) < 0.0,
            (None, Some(q)) => q.below(apex(f)) < 0.0,
            (None, None) => false,
            // Both facets on one side of the edge, seen from above: a silhouette.
            _ => true,
        }
    })
}

/// Whether two apexes lie on different sides of an edge seen from above.
fn opposite(mesh: &Mesh, edge: usize, p: Corner, q: Corner) -> bool {
    let [a, b] = mesh.edges()[edge].map(|v| above(mesh.vertices()[v as usize]));
    let side = |r: Corner| (b - a).cross(above(r) - a);
    side(p) * side(q) < 0.0
}
