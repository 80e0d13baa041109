//! The order in which points follow a Hilbert curve.

use crate::bbox::BBox;
use crate::point::Point;

/// Bits a coordinate is cut down to.
const BITS: u32 = 16;

/// The places of some points, sorted along a Hilbert curve; ties keep their order.
pub(crate) fn order(points: impl Iterator<Item = Point>, bbox: BBox) -> Vec<u32> {
    let side = f64::from(1_u32 << BITS) - 1.0;
    let scale = side / bbox.size().max(f64::MIN_POSITIVE);
    let key = |p: Point| curve_position(((p.x - bbox.min.x) * scale) as u32, ((p.y - bbox.min.y) * scale) as u32);
    let mut keyed: Vec<u64> = points.enumerate().map(|(k, p)| u64::from(key(p)) << 32 | k as u64).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|k| k as u32).collect()
}

/// Distance along the Hilbert curve of a cell.
fn curve_position(mut x: u32, mut y: u32) -> u32 {
    let mut position = 0;
    for level in (0..BITS).rev() {
        let (right, up) = ((x >> level) & 1, (y >> level) & 1);
        position = position << 2 | ((3 * right) ^ up);
        if up == 0 {
            if right == 1 {
                x = !x;
                y = !y;
            }
            std::mem::swap(&mut x, &mut y);
        }
    }
    position
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_the_plane() {
        let mut cells: Vec<(u32, u32, u32)> =
            (0..16).flat_map(|x| (0..16).map(move |y| (curve_position(x, y), x, y))).collect();
        cells.sort_unstable();
        for pair in cells.windows(2) {
            assert_eq!(pair[0].1.abs_diff(pair[1].1) + pair[0].2.abs_diff(pair[1].2), 1);
        }
    }
}
