//! The order in which segments follow a Hilbert curve.

use crate::bbox::BBox;
use crate::point::Point;
use crate::segment::Segment;

/// Bits a coordinate is cut down to.
const BITS: u32 = 16;

/// The places of `segments`, sorted along a Hilbert curve by the middles of their chords; ties keep their order.
pub(super) fn order(segments: &[Segment], bbox: BBox) -> Vec<u32> {
    let side = f64::from(1_u32 << BITS) - 1.0;
    let scale = side / bbox.size().max(f64::MIN_POSITIVE);
    let key = |s: &Segment| {
        let middle: Point = s.start().midpoint(s.end());
        curve_position(((middle.x - bbox.min.x) * scale) as u32, ((middle.y - bbox.min.y) * scale) as u32)
    };
    let mut keyed: Vec<u64> = segments.iter().enumerate().map(|(k, s)| u64::from(key(s)) << 32 | k as u64).collect();
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
