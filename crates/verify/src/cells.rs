//! Cells of a square grid that lie wholly within what a disc sweeps: a quick yes for most of the interior.

use pocketry_geom::{BBox, Point, Segment, Vec2, vec2};

/// Cells to the disc's radius.
const CELLS_PER_RADIUS: f64 = 3.0;

/// Never more cells than this: 48 MB.
const MOST_CELLS: f64 = 400_000_000.0;

/// The cells known to be swept.
pub(crate) struct Cells {
    origin: Point,
    size: f64,
    columns: usize,
    rows: usize,
    swept: Vec<u64>,
}

impl Cells {
    /// Marks what a disc sweeps from points along the path, no farther apart than a cell.
    pub(crate) fn new(path: &[Segment], radius: f64) -> Self {
        let bbox = path.iter().fold(BBox::EMPTY, |b, c| b.with(c.start()).with(c.end())).inflated(radius);
        let (width, height) = (bbox.width(), bbox.height());
        let size = (radius / CELLS_PER_RADIUS).max((width * height / MOST_CELLS).sqrt());
        let count = |extent: f64| if extent > 0.0 { (extent / size).ceil() as usize } else { 0 };
        let (columns, rows) = (count(width), count(height));
        let swept = vec![0; (columns * rows).div_ceil(64)];
        let mut cells = Self { origin: bbox.min, size, columns, rows, swept };
        let mut last: Option<Point> = None;
        for curve in path {
            let length = curve.length();
            let start = curve.start();
            if last.is_none_or(|l| l.distance(start) > 0.0) && last.is_none_or(|l| l.distance(start) + length >= size) {
                points(curve, (length / size) as usize + 1, |p| {
                    cells.mark(p, radius);
                    true
                });
                last = Some(curve.end());
            }
        }
        cells
    }

    /// Marks the cells wholly within a disc, row by row.
    fn mark(&mut self, center: Point, radius: f64) {
        let (x, y) = ((center.x - self.origin.x) / self.size, (center.y - self.origin.y) / self.size);
        let reach = radius / self.size;
        // A negative number becomes 0 here, and a positive one is rounded down.
        let lowest = (y - reach + 1.0) as usize;
        let highest = ((y + reach) as usize).min(self.rows);
        for row in lowest..highest {
            let farther = (row as f64 - y).abs().max((row as f64 + 1.0 - y).abs());
            let half = (reach * reach - farther * farther).max(0.0).sqrt();
            let from = (x - half + 1.0) as usize;
            let to = ((x + half) as usize).min(self.columns);
            if from < to {
                self.fill(row * self.columns + from, row * self.columns + to);
            }
        }
    }

    /// Sets the bits of a range that is not empty, word by word.
    fn fill(&mut self, from: usize, to: usize) {
        let (first, last) = (from / 64, (to - 1) / 64);
        for word in first..=last {
            let mut mask = u64::MAX;
            if word == first {
                mask &= u64::MAX << (from % 64);
            }
            if word == last {
                mask &= u64::MAX >> (63 - (to - 1) % 64);
            }
            self.swept[word] |= mask;
        }
    }

    /// Whether every cell that the box meets is swept. Rounding may name the neighbour of a point on a cell's border; that
    /// is within the rounding that the radius was lessened by.
    fn hold(&self, b: BBox) -> bool {
        let low = |v: f64, origin: f64| (v - origin) / self.size;
        let (x0, x1) = (low(b.min.x, self.origin.x), low(b.max.x, self.origin.x));
        let (y0, y1) = (low(b.min.y, self.origin.y), low(b.max.y, self.origin.y));
        if !(x0 >= 0.0 && y0 >= 0.0 && x1 < self.columns as f64 && y1 < self.rows as f64) {
            return false;
        }
        (y0 as usize..=y1 as usize).all(|row| {
            (x0 as usize..=x1 as usize).all(|column| {
                let bit = row * self.columns + column;
                self.swept[bit / 64] & (1 << (bit % 64)) != 0
            })
        })
    }

    /// Whether a point lies in a swept cell.
    pub(crate) fn hold_point(&self, p: Point) -> bool {
        self.hold(BBox::of(p, p))
    }

    /// Whether a curve lies in swept cells as a whole.
    pub(crate) fn hold_curve(&self, curve: &Segment) -> bool {
        let length = curve.length();
        let steps = (2.0 * length / self.size) as usize + 1;
        let step = length / steps as f64;
        // An arc strays from its chord by no more than an eighth of the squared length times the curvature.
        let stray = curve.curvature().abs() * step * step;
        let mut from = curve.start();
        points(curve, steps, |to| {
            let held = self.hold(BBox::of(from, to).inflated(stray));
            from = to;
            held
        })
    }
}

/// Calls `visit` for the ends of a curve and the points that divide it evenly, until it says to stop; whether it never did.
fn points(curve: &Segment, steps: usize, mut visit: impl FnMut(Point) -> bool) -> bool {
    let count = steps as f64;
    match curve {
        Segment::Line(l) => (0..=steps).all(|k| visit(l.start.lerp(l.end, k as f64 / count))),
        Segment::Arc(a) => {
            let turn = Vec2::from_angle(a.sweep() / count);
            let mut spoke = a.start - a.center;
            let inner = (0..steps).all(|_| {
                let p = a.center + spoke;
                spoke = vec2(spoke.x * turn.x - spoke.y * turn.y, spoke.x * turn.y + spoke.y * turn.x);
                visit(p)
            });
            inner && visit(a.end)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_held_is_within_the_radius(
            (a, b, bulge) in (-9.0..9.0, -9.0..9.0, -1.0..1.0f64), (x, y) in (-12.0..12.0, -12.0..12.0),
            (u, v, turn) in (-12.0..12.0, -12.0..12.0, -1.0..1.0f64),
        ) {
            let path = [
                Segment::from_bulge(point(0.0, 0.0), point(a, b), bulge),
                Segment::line(point(a, b), point(-b, a)),
            ];
            let cells = Cells::new(&path, 2.0);
            let near = |p| path[0].distance(p).min(path[1].distance(p)) <= 2.0 + 1e-9;
            prop_assert!(!cells.hold_point(point(x, y)) || near(point(x, y)));
            let curve = Segment::from_bulge(point(x, y), point(x + 0.1 * u, y + 0.1 * v), turn);
            let all = (0..=100).all(|k| near(curve.at(f64::from(k) / 100.0)));
            prop_assert!(!cells.hold_curve(&curve) || all);
        }

        #[test]
        fn the_middle_of_a_band_is_held(x in 0.0..20.0) {
            let path: Vec<Segment> =
                (0..200).map(|k| Segment::line(point(0.1 * f64::from(k), 0.0), point(0.1 * f64::from(k + 1), 0.0))).collect();
            prop_assert!(Cells::new(&path, 2.0).hold_point(point(x, 0.5)));
        }
    }
}
