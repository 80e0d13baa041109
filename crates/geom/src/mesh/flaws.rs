//! What keeps a mesh from being the surface of a solid.

use super::{Corner, Mesh};
use std::fmt;

/// Edges at fault, with a place each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flaw {
    /// How many edges.
    pub count: usize,
    /// The middle of the first of them.
    pub at: Corner,
}

/// What is wrong with a mesh as the surface of a solid; every part `None` or false for a sound one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flaws {
    /// Edges with a facet on one side only: holes.
    pub open: Option<Flaw>,
    /// Edges where more than two facets meet.
    pub crowded: Option<Flaw>,
    /// Edges whose two facets run the same way along them: one of them is turned over.
    pub twisted: Option<Flaw>,
    /// Whether the mesh is closed and oriented, but inside out.
    pub inverted: bool,
}

impl Flaws {
    /// Whether the mesh is the surface of a solid.
    pub fn is_sound(&self) -> bool {
        *self == Self::default()
    }

    /// Whether every edge has two facets that run along it in turn.
    pub fn is_closed_and_oriented(&self) -> bool {
        Self { inverted: false, ..*self }.is_sound()
    }

    /// Everything that is wrong, for a machinist.
    pub fn complaints(&self) -> Vec<String> {
        let told = [
            (self.open, "the surface is open: edges with a facet on one side only"),
            (self.crowded, "more than two facets meet at edges"),
            (self.twisted, "facets are turned over: neighbours disagree about the outside at edges"),
        ];
        let mut out: Vec<String> =
            told.into_iter().filter_map(|(flaw, what)| flaw.map(|f| format!("{what}: {f}"))).collect();
        if self.inverted {
            out.push("the model is inside out".to_owned());
        }
        out
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.at;
        write!(f, "{}, the first at ({x:.4}, {y:.4}, {z:.4})", self.count)
    }
}

impl Mesh {
    /// Looks at every edge and at the sign of the volume.
    pub fn flaws(&self) -> Flaws {
        // For each edge how many facets run along it from the lower vertex number to the higher, and back.
        let mut along = vec![[0_u32; 2]; self.edges.len()];
        for (facet, sides) in self.facets.iter().zip(&self.sides) {
            for k in 0..3 {
                let back = facet[k] > facet[(k + 1) % 3];
                along[sides[k] as usize][usize::from(back)] += 1;
            }
        }
        let mut flaws = Flaws::default();
        for (edge, n) in self.edges.iter().zip(along) {
            let slot = match n {
                [1, 1] => continue,
                [1, 0] | [0, 1] => &mut flaws.open,
                [2, 0] | [0, 2] => &mut flaws.twisted,
                _ => &mut flaws.crowded,
            };
            let [p, q] = edge.map(|v| self.vertices[v as usize]);
            let at = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])];
            slot.get_or_insert(Flaw { count: 0, at }).count += 1;
        }
        flaws.inverted = flaws.is_sound() && self.volume() < 0.0;
        flaws
    }
}
