use super::PairwiseEngine;
use crate::contour::Contour;
use crate::distance::Boundary;
use crate::offset::{Degenerate, OffsetEngine, OffsetError, OffsetOptions, VoronoiEngine};
use crate::point::Point;
use crate::region::Region;
use crate::repair::{RepairOptions, build};

fn region(loops: &[Vec<[f64; 3]>]) -> Region {
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    build(contours, &RepairOptions::default()).unwrap().region
}

fn square(half: f64) -> Vec<[f64; 3]> {
    vec![[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]]
}

/// A square whose lower right corner is a fillet of many tiny segments.
fn filleted(count: usize, radius: f64) -> Vec<[f64; 3]> {
    let mut points = square(10.0);
    let turn = |k: usize| std::f64::consts::FRAC_PI_2 * (k as f64 / count as f64 - 1.0);
    let center = Point::new(10.0 - radius, -10.0 + radius);
    let fillet = (0..=count).map(|k| [center.x + radius * turn(k).cos(), center.y + radius * turn(k).sin(), 0.0]);
    points.splice(1..2, fillet);
    points
}

#[test]
fn a_fillet_of_a_thousand_segments_vanishes_like_a_corner() {
    let region = region(&[filleted(1000, 1.0)]);
    let found = PairwiseEngine.with_ranges(&region, &[2.0]).unwrap().remove(0);
    let contour = &found.offset.loops[0].contour;
    assert_eq!((found.offset.loops.len(), contour.segments.len()), (1, 4));
    assert!((contour.area() - 256.0).abs() < 1e-9);
    let fillet = found.interferences.iter().find(|i| i.degenerate.distance(Point::new(8.0, -8.0)) < 1e-9).unwrap();
    assert!(fillet.local);
    assert!(fillet.from.distance(Point::new(8.0, -10.0)) < 1e-9 && fillet.to.distance(Point::new(10.0, -8.0)) < 1e-9);
}

#[test]
fn a_neck_parts_a_loop_and_is_a_global_range() {
    let bone = vec![
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 7.0, 0.0],
        [30.0, 7.0, 0.0],
        [30.0, 0.0, 0.0],
        [50.0, 0.0, 0.0],
        [50.0, 20.0, 0.0],
        [30.0, 20.0, 0.0],
        [30.0, 12.0, 0.0],
        [20.0, 12.0, 0.0],
        [20.0, 20.0, 0.0],
        [0.0, 20.0, 0.0],
    ];
    let region = region(&[bone]);
    let found = PairwiseEngine.with_ranges(&region, &[2.0, 3.0]).unwrap();
    assert_eq!((found[0].offset.loops.len(), found[1].offset.loops.len()), (1, 2));
    assert_eq!(found[1].interferences.iter().filter(|i| !i.local).count(), 2);
    let walls = Boundary::new(&region);
    for i in &found[1].interferences {
        assert!((walls.distance(i.degenerate) - 3.0).abs() < 1e-9);
        assert!((i.degenerate.distance(i.from) - 3.0).abs() < 1e-9 && (i.degenerate.distance(i.to) - 3.0).abs() < 1e-9);
    }
}

#[test]
fn an_island_too_near_to_its_wall_leaves_nothing() {
    // Both raw curves cross nothing, and the outer one lies inside the other: the paper's figure 8.
    let region = region(&[square(10.0), square(8.0)]);
    assert!(PairwiseEngine.offsets(&region, &[1.5], &OffsetOptions::default()).unwrap()[0].loops.is_empty());
    assert_eq!(PairwiseEngine.offsets(&region, &[0.5], &OffsetOptions::default()).unwrap()[0].loops.len(), 2);
}

#[test]
fn arcs_become_chords_within_the_tolerance() {
    let region = region(&[vec![[10.0, 0.0, 1.0], [-10.0, 0.0, 1.0]]]);
    let options = OffsetOptions::default();
    let pairwise = PairwiseEngine.offsets(&region, &[3.0], &options).unwrap()[0].loops[0].contour.area();
    let exact = VoronoiEngine.offsets(&region, &[3.0], &options).unwrap()[0].loops[0].contour.area();
    let most = exact - std::f64::consts::PI * (7.0 - PairwiseEngine::chord_tolerance(3.0)).powi(2);
    assert!(pairwise < exact && exact - pairwise < most, "{pairwise} {exact}");
}

#[test]
fn what_it_cannot_do_is_refused() {
    let region = region(&[square(10.0)]);
    let keep = OffsetOptions { degenerate: Degenerate::Keep };
    assert!(matches!(PairwiseEngine.offsets(&region, &[1.0], &keep), Err(OffsetError::Region { .. })));
    for d in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = PairwiseEngine.offsets(&region, &[d], &OffsetOptions::default());
        assert!(matches!(refused, Err(OffsetError::Distance(_))));
    }
}
