//! What tests of pockets with tool profiles are made of.

use pocketry_geom::repair::{RepairOptions, build};
use pocketry_geom::{Contour, Region, ToolProfile, ToolShape};

pub(super) fn tool(word: &str) -> ToolProfile {
    word.parse::<ToolShape>().unwrap().section(1.0)
}

pub(super) fn region(contours: &[&[[f64; 3]]]) -> Region {
    let contours = contours.iter().map(|c| Contour::from_vertices(c)).collect();
    build(contours, &RepairOptions::default()).unwrap().region
}

/// A rectangle about the origin, half as wide and high.
pub(super) fn block(x: f64, y: f64) -> [[f64; 3]; 4] {
    [[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]]
}
