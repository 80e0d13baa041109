//! Cracks: vertices along open edges that were meant to be one.

use super::{Corner, Mesh};
use std::collections::HashMap;

/// Which vertex stands for which.
pub(super) struct Cracks {
    /// For each vertex the one that stands for it, itself where nothing was joined.
    pub(super) names: Vec<u32>,
    pub(super) joined: usize,
    /// mm.
    pub(super) farthest: f64,
}

/// Joins vertices of open edges within `tolerance` of one another, each to the first one in reach: vertices are looked up in
/// a grid of cells as wide as the tolerance.
pub(super) fn join(mesh: &Mesh, tolerance: f64) -> Cracks {
    let mut cracks = Cracks { names: (0..mesh.vertices.len() as u32).collect(), joined: 0, farthest: 0.0 };
    if tolerance.is_nan() || tolerance <= 0.0 {
        return cracks;
    }
    let mut open: Vec<u32> = open_edges(mesh).flatten().collect();
    open.sort_unstable();
    open.dedup();
    let cell = |v: Corner| v.map(|c| (c / tolerance).floor() as i64);
    let mut grid: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for v in open {
        let at = mesh.vertices[v as usize];
        let [i, j, k] = cell(at);
        let near = (0..27_i64).filter_map(|n| grid.get(&[i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1])).flatten();
        let apart = |u: u32| distance(mesh.vertices[u as usize], at);
        match near.copied().map(|u| (apart(u), u)).filter(|n| n.0 <= tolerance).min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((moved, u)) => {
                cracks.names[v as usize] = u;
                cracks.joined += 1;
                cracks.farthest = cracks.farthest.max(moved);
            }
            None => grid.entry([i, j, k]).or_default().push(v),
        }
    }
    cracks
}

/// The edges with an odd number of facets.
fn open_edges(mesh: &Mesh) -> impl Iterator<Item = [u32; 2]> + '_ {
    let mut count = vec![0_u32; mesh.edges.len()];
    for &side in mesh.sides.iter().flatten() {
        count[side as usize] += 1;
    }
    mesh.edges.iter().zip(count).filter(|(_, n)| n % 2 == 1).map(|(&e, _)| e)
}

fn distance(a: Corner, b: Corner) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}
