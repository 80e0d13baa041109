use super::*;
use crate::distance::Boundary;
use crate::offset::morphology::eroded;
use crate::point::{Point, Vec2, point};
use crate::profile::ToolProfile;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A closed spline through no corner: control points around the origin at these distances.
fn ring(radii: &[f64]) -> Vec<Cubic> {
    let n = radii.len() as f64;
    let at = |(k, r): (usize, &f64)| Point::ORIGIN + Vec2::from_angle(TAU * k as f64 / n) * *r;
    closed_bspline(&radii.iter().enumerate().map(at).collect::<Vec<_>>()).unwrap()
}

/// The curves in very short chords.
fn fine(region: &FreeRegion) -> Boundary {
    Boundary::new(&region.sampled(0.02).unwrap().region)
}

#[test]
fn polar_values_are_those_of_a_uniform_spline() {
    let p = [point(0.0, 0.0), point(3.0, 1.0), point(5.0, -2.0), point(9.0, 4.0)];
    let knots: Vec<f64> = (0..8).map(f64::from).collect();
    let [cubic] = bspline(&knots, &p).unwrap()[..] else { panic!() };
    let mean = |w: [f64; 4]| {
        let sum = p.iter().zip(w).fold([0.0; 2], |s, (p, w)| [s[0] + w * p.x, s[1] + w * p.y]);
        point(sum[0] / 6.0, sum[1] / 6.0)
    };
    let expected = [
        mean([1.0, 4.0, 1.0, 0.0]),
        mean([0.0, 4.0, 2.0, 0.0]),
        mean([0.0, 2.0, 4.0, 0.0]),
        mean([0.0, 1.0, 4.0, 1.0]),
    ];
    assert!(cubic.control.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-12), "{cubic:?}");
}

#[test]
fn a_clamped_spline_starts_and_ends_at_its_control_points() {
    let p = [point(0.0, 0.0), point(1.0, 2.0), point(3.0, 2.0), point(4.0, 0.0), point(6.0, 1.0)];
    let cubics = bspline(&[0.0, 0.0, 0.0, 0.0, 1.5, 2.0, 2.0, 2.0, 2.0], &p).unwrap();
    assert_eq!(cubics.len(), 2);
    assert!(cubics[0].control[0].distance(p[0]) < 1e-12 && cubics[1].control[3].distance(p[4]) < 1e-12);
    assert!(cubics[0].control[3].distance(cubics[1].control[0]) < 1e-12);
    // Twice continuously differentiable: the first derivatives by the knots' parameter agree.
    let (a, b) = (cubics[0].derivative(1.0) / 1.5, cubics[1].derivative(0.0) / 0.5);
    assert!((a - b).length() < 1e-9);
    assert!(matches!(bspline(&[0.0; 3], &p), Err(SplineError::Count { .. })));
    assert!(matches!(
        bspline(&[0.0, 0.0, 0.0, 0.0, 3.0, 2.0, 2.0, 2.0, 2.0], &p),
        Err(SplineError::Knots { index: 5 })
    ));
}

#[test]
fn islands_are_cut_out_and_steps_checked() {
    let (outer, island) = (ring(&[20.0; 6]), ring(&[6.0; 5]));
    let region = FreeRegion { contours: vec![outer, island] };
    let sampled = region.fitted().unwrap();
    assert_eq!(sampled.region.parents(), [None, Some(0)]);
    assert!(sampled.error <= tolerance::FIT * (1.0 + 1e-12));
    assert!(matches!(region.sampled(0.0), Err(FreeformError::Step { .. })));
    assert!(matches!(region.sampled(f64::NAN), Err(FreeformError::Step { .. })));
    assert!(matches!(FreeRegion::default().sampled(1.0), Err(FreeformError::Region(_))));
}

/// The paper's algorithm 1 by brute force, on very many points of the true curve: where an ellipse of half axes `a` and `b` touches a point
/// from inside and no other point lies in it. In the order of the trajectory.
fn brute_force(region: &FreeRegion, a: f64, b: f64) -> Vec<Point> {
    let each = 800_u32;
    let samples: Vec<(Point, Vec2)> = region
        .contours
        .iter()
        .flatten()
        .flat_map(|c| (0..each).map(move |k| f64::from(k) / f64::from(each)).map(|t| (c.at(t), c.derivative(t))))
        .collect();
    let place = |(p, tangent): &(Point, Vec2)| {
        let normal = tangent.left().normalized();
        let support = (a * a * normal.x * normal.x + b * b * normal.y * normal.y).sqrt();
        *p + Vec2::new(a * a * normal.x, b * b * normal.y) / support
    };
    let enters = |c: Point, p: Point| ((p.x - c.x) / a).powi(2) + ((p.y - c.y) / b).powi(2) < 1.0 - 1e-9;
    samples.iter().map(place).filter(|&c| !samples.iter().any(|(p, _)| enters(c, *p))).collect()
}

/// The largest distance of points of one closed polygon from another one.
fn farthest(from: &[Point], to: &[Point]) -> f64 {
    let edges: Vec<Segment> = (0..to.len()).map(|k| Segment::line(to[k], to[(k + 1) % to.len()])).collect();
    let index = crate::index::SegmentIndex::new(&edges);
    from.iter().map(|p| index.nearest(*p).map_or(f64::INFINITY, |n| n.1)).fold(0.0, f64::max)
}

/// The distance between the outline of the places of an ellipse in the sampled region and that by brute force.
fn hausdorff(region: &FreeRegion, step: f64, truth: &[Point], (a, b): (f64, f64)) -> (f64, f64) {
    let sampled = region.sampled(step).unwrap();
    let profile = ToolProfile::ellipse(2.0 * a, 2.0 * b);
    let places = eroded(&sampled.region, profile.contour(), Point::ORIGIN).unwrap();
    let [outline] = places.contours() else { panic!("one outline") };
    let ours: Vec<Point> = outline.segments.iter().flat_map(|s| (0..8).map(|k| s.at(f64::from(k) / 8.0))).collect();
    (farthest(&ours, truth).max(farthest(truth, &ours)), sampled.error)
}

/// What the ellipse's arcs, the step of the brute force and of the samples of an outline add, mm.
const ALLOWED: f64 = 2.5e-3;

#[test]
fn the_error_falls_with_the_square_of_the_step() {
    // Smooth places: the tool is rounder everywhere than the wall.
    let region = FreeRegion { contours: vec![ring(&[30.0, 26.0, 31.0, 27.0, 30.0, 28.0])] };
    let ellipse = (5.0, 3.0);
    let truth = brute_force(&region, ellipse.0, ellipse.1);
    let found: Vec<(f64, f64)> = [8.0, 4.0, 2.0].map(|s| hausdorff(&region, s, &truth, ellipse)).to_vec();
    for (apart, bound) in &found {
        assert!(*apart <= bound + ALLOWED, "{apart} {bound}");
    }
    for w in found.windows(2) {
        assert!(w[0].0 / w[1].0 > 3.0 && w[0].1 / w[1].1 > 3.0, "of second order: {found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The bound holds for the boundaries and for the outline of the places.
    #[test]
    fn no_place_is_farther_off_than_the_bound(
        radii in prop::collection::vec(26.0..32.0_f64, 5..8),
        step in 1.0..6.0_f64,
        (a, b) in (2.0..4.0_f64, 2.0..4.0_f64),
    ) {
        let region = FreeRegion { contours: vec![ring(&radii)] };
        let sampled = region.sampled(step).unwrap();
        let (walls, fine) = (Boundary::new(&sampled.region), fine(&region));
        for s in sampled.region.segments() {
            prop_assert!(s.length() <= step * (1.0 + 1e-12));
            prop_assert!(fine.distance(s.at(0.5)) <= sampled.error + 1e-3);
        }
        let curve = region.contours[0].iter().flat_map(|c| (0..40).map(|k| c.at(f64::from(k) / 40.0)));
        for p in curve {
            prop_assert!(walls.distance(p) <= sampled.error);
        }
        let truth = brute_force(&region, a, b);
        let (apart, bound) = hausdorff(&region, step, &truth, (a, b));
        prop_assert!(apart <= bound + ALLOWED, "{} {}", apart, bound);
    }
}
