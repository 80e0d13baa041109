//! Distances between points, lines and arcs, and to a region's boundary.
//!
//! All in closed form: the least distance of two curves is taken at ends, at feet of ends, on the normals that they have
//! in common, or it is zero where they cross. Every candidate is a pair of points on the two, so a result is never too
//! small but by rounding.

use crate::index::SegmentIndex;
use crate::intersect::meet;
use crate::point::{Point, Vec2};
use crate::region::Region;
use crate::segment::{Arc, Segment};

/// Steps of the search for a disk: it converges like Newton's method, in three or four.
const DISK_STEPS: usize = 64;

/// The least distance between two closed segments, mm.
pub fn between(a: &Segment, b: &Segment) -> f64 {
    if meet(a, b) {
        return 0.0;
    }
    let mut least = f64::INFINITY;
    for (s, t) in [(a, b), (b, a)] {
        least = least.min(t.distance(s.start())).min(t.distance(s.end()));
        if let Segment::Arc(arc) = t {
            common_normals(s, arc, |p| least = least.min(t.distance(p)));
        }
    }
    least
}

/// Points of `s` where a normal of it leads to the arc's centre.
fn common_normals(s: &Segment, arc: &Arc, mut found: impl FnMut(Point)) {
    match s {
        Segment::Line(l) => found(l.nearest(arc.center)),
        Segment::Arc(own) => {
            let toward = arc.center - own.center;
            let length = toward.length();
            for direction in [toward, -toward].into_iter().filter(|&d| length > 0.0 && own.spans(d)) {
                found(own.center + direction * (own.radius / length));
            }
        }
    }
}

/// A region's boundary, ready for many questions.
#[derive(Clone, Debug, Default)]
pub struct Boundary {
    index: SegmentIndex,
    /// Contour and place in it of each segment.
    owners: Vec<(u32, u32)>,
    segments: Vec<Segment>,
}

/// The nearest segment of a boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The contour.
    pub contour: u32,
    /// The segment in that contour.
    pub segment: u32,
    /// Its distance, mm.
    pub distance: f64,
}

impl Boundary {
    /// The boundary of a region.
    pub fn new(region: &Region) -> Self {
        let segments: Vec<Segment> = region.segments().copied().collect();
        let owners =
            (0..).zip(region.contours()).flat_map(|(k, c)| (0..c.segments.len() as u32).map(move |s| (k, s))).collect();
        Self { index: SegmentIndex::new(&segments), owners, segments }
    }

    /// The index over all segments, contour by contour.
    pub fn index(&self) -> &SegmentIndex {
        &self.index
    }

    /// All segments, contour by contour.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Contour, and place in it, of a segment of [`Self::segments`].
    pub fn owner(&self, segment: usize) -> (u32, u32) {
        self.owners[segment]
    }

    fn named(&self, (segment, distance): (usize, f64)) -> Nearest {
        let (contour, segment) = self.owners[segment];
        Nearest { contour, segment, distance }
    }

    /// Distance from a point, mm; infinite for an empty region.
    pub fn distance(&self, p: Point) -> f64 {
        self.index.nearest(p).map_or(f64::INFINITY, |(_, d)| d)
    }

    /// The segment nearest to a point.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        self.index.nearest(p).map(|n| self.named(n))
    }

    /// Least distance from any point of a line or arc, mm; 0 where it crosses the boundary; infinite for an empty region.
    pub fn distance_to(&self, s: &Segment) -> f64 {
        self.index.nearest_to(s, f64::INFINITY).map_or(f64::INFINITY, |(_, d)| d)
    }

    /// The segment nearest to a line or arc, if any is nearer than `bound`.
    pub fn nearest_to(&self, s: &Segment, bound: f64) -> Option<Nearest> {
        self.index.nearest_to(s, bound).map(|n| self.named(n))
    }

    /// Whether a point lies in the region: even-odd by exact predicates along lines; a point of the boundary itself may
    /// count either way.
    pub fn contains(&self, p: Point) -> bool {
        self.index.crossings_left(p) % 2 == 1
    }

    /// Distance from a point, positive inside the region and negative outside, mm.
    pub fn signed_distance(&self, p: Point) -> f64 {
        let distance = self.distance(p);
        if self.contains(p) { distance } else { -distance }
    }

    /// The radius of the largest disk, none larger than `most`, that touches the wall at `foot` from the side of the unit vector `normal`
    /// and has nothing in it but what comes in by the slack (mm), from above; and the other segment that it touches. Radii of `least` and
    /// below are not told apart.
    pub fn largest_disk(&self, foot: Point, normal: Vec2, [least, most]: [f64; 2], slack: f64) -> (f64, Option<usize>) {
        let (mut radius, mut other) = (most, None);
        for _ in 0..DISK_STEPS {
            let center = foot + normal * radius;
            let Some((wall, _)) = self.index.nearest_within(center, radius - slack) else { break };
            let touching = touching(&self.segments[wall], foot, normal, center);
            other = Some(wall);
            if touching >= radius {
                break;
            }
            radius = touching.max(least);
            if touching <= least {
                break;
            }
        }
        (radius, other)
    }
}

/// Radius of the disk that touches a wall at `foot` from the side of `normal`, and the other wall where that is nearest to
/// `center`.
fn touching(wall: &Segment, foot: Point, normal: Vec2, center: Point) -> f64 {
    let nearest = wall.nearest(center);
    let inside = matches!(wall, Segment::Line(l) if nearest != l.start && nearest != l.end);
    if inside {
        let across = (center - nearest).normalized();
        return (foot - nearest).dot(across) / (1.0 - normal.dot(across));
    }
    let to = nearest - foot;
    to.length_squared() / (2.0 * normal.dot(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::point;
    use crate::repair::{RepairOptions, build};
    use crate::{Contour, vec2};
    use proptest::prelude::*;

    fn segment() -> impl Strategy<Value = Segment> {
        let c = || -10.0..10.0_f64;
        (c(), c(), c(), c(), prop_oneof![Just(0.0), 0.05..3.0_f64, -3.0..-0.05_f64])
            .prop_map(|(x, y, u, v, bulge)| Segment::from_bulge(point(x, y), point(u, v + 1e-3), bulge))
    }

    /// Least distance over many points of both, refined: never below the true one by more than rounding.
    fn sampled(a: &Segment, b: &Segment) -> f64 {
        let n = 400;
        (0..=n).map(|k| b.distance(a.at(f64::from(k) / f64::from(n)))).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn the_least_distance_is_what_samples_approach(a in segment(), b in segment()) {
            let exact = between(&a, &b);
            let step = a.length() / 400.0;
            prop_assert!(exact <= sampled(&a, &b) + 1e-9);
            prop_assert!(sampled(&a, &b) <= exact + step);
            prop_assert!((exact - between(&b, &a)).abs() < 1e-9);
            prop_assert!((exact - between(&a.reversed(), &b)).abs() < 1e-9);
        }

        #[test]
        fn a_boundary_answers_like_all_its_segments(a in segment(), x in -12.0..12.0_f64, y in -12.0..12.0_f64) {
            let ring = |r: f64| Contour::from_vertices(&[[r, 0.0, 0.7], [0.0, r, 0.0], [-r, 0.0, 0.3], [0.0, -r, -0.2]]);
            let region = build(vec![ring(10.0), ring(4.0)], &RepairOptions::default()).unwrap().region;
            let boundary = Boundary::new(&region);
            let brute = region.segments().map(|s| between(&a, s)).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(boundary.distance_to(&a), brute);
            let p = point(x, y);
            let nearest = region.segments().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(boundary.distance(p), nearest);
            prop_assert_eq!(boundary.contains(p), region.contains(p));
        }
    }

    #[test]
    fn circles_beside_inside_and_around_each_other() {
        let half = |x: f64, r: f64| Segment::from_bulge(point(x - r, 0.0), point(x + r, 0.0), 1.0);
        assert!((between(&half(0.0, 1.0), &half(5.0, 2.0)) - 2.0).abs() < 1e-12);
        assert!((between(&half(0.0, 10.0), &half(1.0, 2.0)) - 7.0).abs() < 1e-12);
        assert!((between(&half(0.0, 10.0), &half(0.0, 2.0)) - 8.0).abs() < 1e-12);
        let high = half(0.0, 2.0).translated(vec2(0.0, -5.0));
        assert!((between(&half(0.0, 10.0), &high) - 3.0).abs() < 1e-12);
        assert_eq!(between(&half(0.0, 1.0), &half(0.5, 1.0)), 0.0);
    }

    #[test]
    fn inside_and_outside_have_signs() {
        let square = Contour::from_vertices(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]]);
        let boundary = Boundary::new(&build(vec![square], &RepairOptions::default()).unwrap().region);
        assert_eq!(boundary.signed_distance(point(1.0, 2.0)), 1.0);
        assert_eq!(boundary.signed_distance(point(-2.0, 2.0)), -2.0);
        assert_eq!(Boundary::default().distance(Point::ORIGIN), f64::INFINITY);
    }
}
