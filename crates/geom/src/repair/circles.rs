//! Arcs of one circle get identical centres and radii.

use crate::bbox::BBox;
use crate::contour::Contour;
use crate::point::Point;
use crate::segment::{Arc, Segment};
use crate::tolerance::SAME_CIRCLE;
use std::collections::HashMap;

/// A circle that arcs have been given.
#[derive(Clone, Copy)]
struct Circle {
    center: Point,
    radius: f64,
}

/// Gives arcs whose centres and radii agree to [`SAME_CIRCLE`] of the size those of the longest one among them.
/// End points stay: they are shared with neighbours, and lie off the circle by no more than that.
pub(super) fn snap(loops: &mut [(u32, Contour)], bbox: BBox) {
    let tolerance = SAME_CIRCLE * bbox.size();
    let mut arcs: Vec<(f64, usize, usize)> = Vec::new();
    for (l, (_, contour)) in loops.iter().enumerate() {
        for (k, s) in contour.segments.iter().enumerate() {
            if matches!(s, Segment::Arc(_)) {
                arcs.push((s.length(), l, k));
            }
        }
    }
    arcs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut cells: HashMap<[i64; 3], Circle> = HashMap::with_capacity(arcs.len());
    for (_, l, k) in arcs {
        if let Segment::Arc(arc) = &mut loops[l].1.segments[k] {
            snap_one(arc, &mut cells, tolerance);
        }
    }
}

/// Takes the circle of an earlier arc, or leaves this one's in the cells for later ones.
fn snap_one(arc: &mut Arc, cells: &mut HashMap<[i64; 3], Circle>, tolerance: f64) {
    let numbers = [arc.center.x, arc.center.y, arc.radius];
    // Cells of twice the tolerance: an agreeing circle lies in this one or in the neighbour beyond the nearer wall.
    let cell = numbers.map(|c| (c / (2.0 * tolerance)).floor());
    let step = [0, 1, 2].map(|k| if numbers[k] / (2.0 * tolerance) - cell[k] < 0.5 { -1 } else { 1 });
    for corner in 0..8_i64 {
        // Saturating: the centre of an arc that is all but straight may lie beyond what the cells count.
        let key = [0, 1, 2].map(|k| (cell[k] as i64).saturating_add(step[k] * ((corner >> k) & 1)));
        if let Some(c) = cells.get(&key)
            && c.center.distance(arc.center) <= tolerance
            && (c.radius - arc.radius).abs() <= tolerance
        {
            arc.center = c.center;
            arc.radius = c.radius;
            return;
        }
    }
    cells.entry(cell.map(|c| c as i64)).or_insert(Circle { center: arc.center, radius: arc.radius });
}
