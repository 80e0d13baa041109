//! Whether anything of interest is near, in a few instructions: a coarse grid of marks.

use pocketry_geom::BBox;

/// Cells along each side.
const CELLS: usize = 64;

/// The places near some boxes.
pub(super) struct Nearby {
    bbox: BBox,
    /// Cells, row after row.
    marks: Vec<bool>,
}

impl Nearby {
    /// Marks what lies in these boxes.
    pub(super) fn new(boxes: &[BBox]) -> Self {
        let bbox = boxes.iter().fold(BBox::EMPTY, |all, &b| all.union(b));
        let mut nearby = Self { bbox, marks: vec![false; CELLS * CELLS] };
        for &b in boxes {
            let [columns, rows] = nearby.cells(b);
            for row in rows[0]..=rows[1] {
                nearby.marks[row * CELLS + columns[0]..=row * CELLS + columns[1]].fill(true);
            }
        }
        nearby
    }

    /// Whether a box may meet one of those that were marked; `false` is certain.
    pub(super) fn may_meet(&self, b: BBox) -> bool {
        if !b.intersects(self.bbox) {
            return false;
        }
        let [columns, rows] = self.cells(b);
        (rows[0]..=rows[1])
            .any(|row| self.marks[row * CELLS + columns[0]..=row * CELLS + columns[1]].iter().any(|&m| m))
    }

    /// The first and last column and row that a box meets, cut off at the grid's edges.
    fn cells(&self, b: BBox) -> [[usize; 2]; 2] {
        let cell = |x: f64, low: f64, extent: f64| {
            let share = (x - low) / extent * CELLS as f64;
            if share > 0.0 { (share as usize).min(CELLS - 1) } else { 0 }
        };
        let (low, width, height) = (self.bbox.min, self.bbox.width(), self.bbox.height());
        [[b.min.x, b.max.x].map(|x| cell(x, low.x, width)), [b.min.y, b.max.y].map(|y| cell(y, low.y, height))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;
    use proptest::prelude::*;

    fn bbox() -> impl Strategy<Value = BBox> {
        (-50.0..50.0, -50.0..50.0, 0.0..20.0, 0.0..20.0)
            .prop_map(|(x, y, w, h)| BBox::EMPTY.with(point(x, y)).with(point(x + w, y + h)))
    }

    proptest! {
        #[test]
        fn what_meets_a_box_may_meet_it(boxes in prop::collection::vec(bbox(), 1..6), b in bbox()) {
            let nearby = Nearby::new(&boxes);
            prop_assert!(nearby.may_meet(b) || boxes.iter().all(|other| !b.intersects(*other)));
        }
    }

    #[test]
    fn what_is_far_from_all_boxes_is_not_near() {
        let boxes = [0.0, 90.0].map(|x| BBox::EMPTY.with(point(x, x)).with(point(x + 10.0, x + 10.0)));
        let nearby = Nearby::new(&boxes);
        assert!(!nearby.may_meet(BBox::EMPTY.with(point(40.0, 60.0)).with(point(50.0, 70.0))));
        assert!(nearby.may_meet(boxes[1]));
    }
}
