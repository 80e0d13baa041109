//! Moved, turned, mirrored, scaled and re-ordered copies of loops.

use crate::Loops;
use pocketry_geom::{Point, point};

/// A similarity of the plane (mirrored first, then turned, scaled and moved) and a re-ordering of the loops' vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Whether x changes its sign first.
    pub mirror: bool,
    /// Turn, radians counter-clockwise.
    pub rotate: f64,
    /// Factor.
    pub scale: f64,
    /// Displacement.
    pub translate: [f64; 2],
    /// Whether loops are travelled the other way.
    pub reverse: bool,
    /// How many vertices later each loop starts.
    pub start: usize,
}

impl Default for Transform {
    fn default() -> Self {
        Self { mirror: false, rotate: 0.0, scale: 1.0, translate: [0.0; 2], reverse: false, start: 0 }
    }
}

impl Transform {
    /// The image of a point.
    pub fn apply_point(&self, p: Point) -> Point {
        let x = if self.mirror { -p.x } else { p.x };
        let v = if self.rotate == 0.0 { point(x, p.y) } else { point(x, p.y).to_vec().rotated(self.rotate).to_point() };
        point(v.x * self.scale + self.translate[0], v.y * self.scale + self.translate[1])
    }

    /// The image of loops.
    pub fn apply(&self, loops: &Loops) -> Loops {
        loops.iter().map(|l| self.apply_loop(l)).collect()
    }

    fn apply_loop(&self, vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut out: Vec<[f64; 3]> = vertices
            .iter()
            .map(|v| {
                let p = self.apply_point(point(v[0], v[1]));
                [p.x, p.y, if self.mirror { -v[2] } else { v[2] }]
            })
            .collect();
        if self.reverse {
            out = reversed(&out);
        }
        let n = out.len().max(1);
        out.rotate_left(self.start % n);
        out
    }
}

/// The loop travelled the other way: a bulge belongs to the edge after its vertex.
fn reversed(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let n = vertices.len();
    (0..n)
        .map(|k| {
            let (here, before) = (vertices[n - 1 - k], vertices[(2 * n - 2 - k) % n]);
            [here[0], here[1], -before[2]]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reversing_twice_gives_the_loop_back() {
        let l = [[0.0, 0.0, 0.5], [1.0, 0.0, 0.0], [1.0, 1.0, -0.2]];
        let back = reversed(&l);
        assert_eq!(back[0], [1.0, 1.0, 0.0]);
        assert_eq!(back[1], [1.0, 0.0, -0.5]);
        assert_eq!(back[2], [0.0, 0.0, 0.2]);
        assert_eq!(reversed(&back), l);
    }

    #[test]
    fn a_mirrored_arc_bulges_to_the_other_side() {
        let t = Transform { mirror: true, ..Transform::default() };
        assert_eq!(t.apply(&vec![vec![[1.0, 0.0, 0.5], [2.0, 1.0, 0.0]]]), [[[-1.0, 0.0, -0.5], [-2.0, 1.0, 0.0]]]);
    }
}
