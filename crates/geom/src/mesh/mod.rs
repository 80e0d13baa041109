//! Polyhedral models: triangles with shared vertices.
//!
//! Files hold loose triangles; [`Mesh::weld`] makes one vertex of equal corners, then joins vertices along open edges that lie
//! within the weld tolerance (cracks), and orders every edge with the facets at it. Everything behind works with these
//! combinatorial facts: [`mod@slice`] chains its segments by shared edges, never by coordinates.

mod cracks;
mod flaws;
pub mod slice;

pub use flaws::{Flaw, Flaws};

use crate::bbox::BBox;
use crate::point::{Point, point};
use std::collections::HashMap;

/// A place in space, mm.
pub type Corner = [f64; 3];

/// Triangles with shared vertices; each runs counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    vertices: Vec<Corner>,
    facets: Vec<[u32; 3]>,
    /// The two vertices of every edge, the lower number first.
    edges: Vec<[u32; 2]>,
    /// For each facet the edges from its first, second and third vertex to the next.
    sides: Vec<[u32; 3]>,
}

/// A mesh and what was done to get it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Welded {
    /// The mesh.
    pub mesh: Mesh,
    /// Facets dropped because two of their corners are one.
    pub collapsed: usize,
    /// Vertices along open edges that were joined to another one.
    pub joined: usize,
    /// The farthest that such a vertex was moved, mm.
    pub farthest: f64,
}

impl Mesh {
    /// Makes a mesh of loose triangles: equal corners become one vertex, and vertices along open edges within
    /// `tolerance` (mm) of one another are joined. O(n) hashing and O(n log n) sorting of edges.
    pub fn weld(triangles: &[[Corner; 3]], tolerance: f64) -> Welded {
        let (mut vertices, mut facets) = (Vec::new(), Vec::with_capacity(triangles.len()));
        let mut known: HashMap<[u64; 3], u32> = HashMap::with_capacity(triangles.len());
        for triangle in triangles {
            facets.push(triangle.map(|corner| {
                // Adding 0 makes one number of 0 and -0.
                let key = corner.map(|c| (c + 0.0).to_bits());
                *known.entry(key).or_insert_with(|| {
                    vertices.push(corner);
                    vertices.len() as u32 - 1
                })
            }));
        }
        drop(known);
        let mut welded = Self::indexed(vertices, facets);
        let cracks = cracks::join(&welded.mesh, tolerance);
        if cracks.joined > 0 {
            let facets = welded.mesh.facets.iter().map(|f| f.map(|v| cracks.names[v as usize])).collect();
            let again = Self::indexed(std::mem::take(&mut welded.mesh.vertices), facets);
            welded = Welded {
                collapsed: welded.collapsed + again.collapsed,
                joined: cracks.joined,
                farthest: cracks.farthest,
                mesh: again.mesh,
            };
        }
        welded
    }

    /// A mesh of vertices and facets that name them; facets that name one vertex twice are dropped.
    fn indexed(vertices: Vec<Corner>, mut facets: Vec<[u32; 3]>) -> Welded {
        let before = facets.len();
        facets.retain(|[a, b, c]| a != b && b != c && c != a);
        let mut ends: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * facets.len());
        for (f, &[a, b, c]) in facets.iter().enumerate() {
            for (k, (p, q)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                ends.push(([p.min(q), p.max(q)], 3 * f as u32 + k as u32));
            }
        }
        ends.sort_unstable();
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(ends.len() / 2);
        let mut sides = vec![[0; 3]; facets.len()];
        for (edge, side) in ends {
            if edges.last() != Some(&edge) {
                edges.push(edge);
            }
            sides[side as usize / 3][side as usize % 3] = edges.len() as u32 - 1;
        }
        let collapsed = before - facets.len();
        Welded { mesh: Self { vertices, facets, edges, sides }, collapsed, ..Welded::default() }
    }

    /// The vertices; after joining, some may be named by no facet.
    pub fn vertices(&self) -> &[Corner] {
        &self.vertices
    }

    /// The vertices of each facet, counter-clockwise seen from outside.
    pub fn facets(&self) -> &[[u32; 3]] {
        &self.facets
    }

    /// The two vertices of each edge.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// For each facet the edges from its first, second and third vertex to the next.
    pub fn sides(&self) -> &[[u32; 3]] {
        &self.sides
    }

    /// The corners of a facet.
    pub fn corners(&self, facet: usize) -> [Corner; 3] {
        self.facets[facet].map(|v| self.vertices[v as usize])
    }

    /// The box of all facets seen from above.
    pub fn bbox(&self) -> BBox {
        self.used().fold(BBox::EMPTY, |b, v| b.with(above(v)))
    }

    /// The lowest and the highest z, mm; infinite where there are no facets.
    pub fn heights(&self) -> (f64, f64) {
        self.used().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v[2]), high.max(v[2])))
    }

    /// Signed volume, mm³: negative where the facets run clockwise seen from outside; meaningless where the mesh is open.
    pub fn volume(&self) -> f64 {
        let origin = self.used().next().unwrap_or([0.0; 3]);
        let six = |f: usize| {
            let [a, b, c] = self.corners(f).map(|p| [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]);
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        (0..self.facets.len()).map(six).sum::<f64>() / 6.0
    }

    /// The same surface seen from the other side.
    #[must_use]
    pub fn inverted(self) -> Self {
        let facets = self.facets.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let sides = self.sides.iter().map(|&[ab, bc, ca]| [ca, bc, ab]).collect();
        Self { facets, sides, ..self }
    }

    /// Moved by this much.
    #[must_use]
    pub fn translated(mut self, by: Corner) -> Self {
        for v in &mut self.vertices {
            *v = [v[0] + by[0], v[1] + by[1], v[2] + by[2]];
        }
        self
    }

    fn used(&self) -> impl Iterator<Item = Corner> + '_ {
        self.facets.iter().flatten().map(|&v| self.vertices[v as usize])
    }
}

/// A place seen from above.
pub const fn above(corner: Corner) -> Point {
    point(corner[0], corner[1])
}

#[cfg(test)]
mod tests;
