//! Regions and programs written by hand.

use pocketry_geom::{Contour, Region};
use std::fmt::Write;

/// A rectangle from the origin.
pub(crate) fn rectangle(width: f64, height: f64) -> Region {
    let outer = [[0.0, 0.0, 0.0], [width, 0.0, 0.0], [width, height, 0.0], [0.0, height, 0.0]];
    Region::from_parts_unchecked(vec![Contour::from_vertices(&outer)], vec![None])
}

/// A rectangle with a round island.
pub(crate) fn rectangle_with_boss(width: f64, height: f64, x: f64, y: f64, radius: f64) -> Region {
    let mut contours = rectangle(width, height).contours().to_vec();
    contours.push(Contour::from_vertices(&[[x - radius, y, -1.0], [x + radius, y, -1.0]]));
    Region::from_parts_unchecked(contours, vec![None, Some(0)])
}

/// A program: the head that a post writes, these blocks, and the end.
pub(crate) fn program(blocks: &[String]) -> String {
    format!("%\nG21 G17 G90 G91.1 G40 G49 G80 G94\nG61\nS8000 M3\nG0 Z10\n{}\nG0 Z10\nM5\nM2\n%\n", blocks.join("\n"))
}

/// Rectangular loops at these insets of a rectangle, each entered by a plunge at its corner.
pub(crate) fn rectangular_loops(width: f64, height: f64, insets: &[f64]) -> Vec<String> {
    let mut blocks = Vec::new();
    for d in insets {
        let (x, y) = (width - d, height - d);
        blocks.push(format!("G0 X{d:.4} Y{d:.4}\nG0 Z2\nG1 Z-3 F200"));
        blocks.push(format!("X{x:.4} F600\nY{y:.4}\nX{d:.4}\nY{d:.4}\nG0 Z10"));
    }
    blocks
}

/// A full circle, entered by a plunge.
pub(crate) fn circle(x: f64, y: f64, radius: f64) -> String {
    let mut out = String::new();
    write!(out, "G0 X{:.4} Y{y:.4}\nG0 Z2\nG1 Z-3 F200\nG2 I{:.4} J0 F600\nG0 Z10", x + radius, -radius).unwrap();
    out
}
