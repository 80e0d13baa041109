//! Closed sequences of points without those that they can do without (Douglas and Peucker).

use pocketry_geom::{Point, Segment};

/// The points without those that lie within `tolerance` (mm) of the chords that replace them.
pub(super) fn simplify(line: &[Point], tolerance: f64) -> Vec<Point> {
    let Some(&first) = line.first() else { return Vec::new() };
    // Two far ends, which stay: the first point, and the one farthest from it.
    let far = farthest(line, |p| p.distance(first)).map_or(0, |f| f.0);
    let mut keep = vec![false; line.len() + 1];
    (keep[0], keep[far]) = (true, true);
    let mut stack = vec![(0, far), (far, line.len())];
    while let Some((a, b)) = stack.pop() {
        if b <= a + 1 {
            continue;
        }
        let chord = Segment::line(line[a], line[b % line.len()]);
        if let Some((k, off)) = farthest(&line[a + 1..b], |p| chord.distance(p))
            && off > tolerance
        {
            let k = a + 1 + k;
            keep[k] = true;
            stack.extend([(a, k), (k, b)]);
        }
    }
    line.iter().zip(keep).filter(|(_, k)| *k).map(|(&p, _)| p).collect()
}

fn farthest(points: &[Point], distance: impl Fn(Point) -> f64) -> Option<(usize, f64)> {
    points.iter().map(|&p| distance(p)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    #[test]
    fn straight_runs_become_their_ends_and_corners_stay() {
        let side = |k: u32| f64::from(k) * 0.5;
        let mut square: Vec<Point> = (0..20).map(|k| point(side(k), 0.0)).collect();
        square.extend((0..20).map(|k| point(10.0, side(k))));
        square.extend((0..20).map(|k| point(10.0 - side(k), 10.0)));
        square.extend((0..20).map(|k| point(0.0, 10.0 - side(k))));
        assert_eq!(simplify(&square, 0.01), [point(0.0, 0.0), point(10.0, 0.0), point(10.0, 10.0), point(0.0, 10.0)]);
    }
}
