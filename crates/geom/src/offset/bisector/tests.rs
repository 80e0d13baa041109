use super::*;
use crate::repair::{RepairOptions, build};

fn region(loops: &[&[[f64; 2]]]) -> Region {
    let contour = |l: &&[[f64; 2]]| Contour::from_vertices(&l.iter().map(|v| [v[0], v[1], 0.0]).collect::<Vec<_>>());
    build(loops.iter().map(contour).collect(), &RepairOptions::default()).unwrap().region
}

#[test]
fn a_convex_contour_with_one_valid_edge_has_no_offset_beyond_its_depth() {
    let corners =
        [[201.874_332, 34.462_776], [202.088_337, 34.604_283], [202.088_337, 34.402_494], [201.91706, 34.281_151]];
    let offsets = BisectorEngine::default().offsets(&region(&[&corners]), &[0.10415], &OffsetOptions::default());
    assert!(offsets.unwrap()[0].loops.is_empty());
}

fn offset(region: &Region, distance: f64, mitre_limit: Option<f64>) -> Offset {
    let engine = BisectorEngine { mitre_limit, ..BisectorEngine::default() };
    engine.offsets(region, &[distance], &OffsetOptions::default()).unwrap().remove(0)
}

fn area(offset: &Offset) -> f64 {
    offset.loops.iter().map(|l| l.contour.area()).sum()
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
const ISLAND: [[f64; 2]; 4] = [[4.0, 4.0], [6.0, 4.0], [6.0, 6.0], [4.0, 6.0]];

#[test]
fn a_square_with_a_square_island_keeps_its_corners() {
    let found = offset(&region(&[&SQUARE, &ISLAND]), 1.0, None);
    assert_eq!(found.loops.len(), 2);
    assert!((area(&found) - (64.0 - 16.0)).abs() < 1e-9);
    assert_eq!(remaining(&found).pockets(), [crate::region::Pocket { outer: 0, islands: vec![1] }]);
}

#[test]
fn a_boundary_and_an_island_merge() {
    let bar = [[4.0, 1.0], [6.0, 1.0], [6.0, 9.0], [4.0, 9.0]];
    let found = offset(&region(&[&SQUARE, &bar]), 1.0, None);
    assert_eq!(found.loops.len(), 2);
    assert!((area(&found) - 2.0 * 2.0 * 8.0).abs() < 1e-9);
}

#[test]
fn a_channel_exactly_as_wide_as_the_tool_vanishes() {
    let dumbbell = [
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 4.0],
        [20.0, 4.0],
        [20.0, 0.0],
        [30.0, 0.0],
        [30.0, 10.0],
        [20.0, 10.0],
        [20.0, 6.0],
        [10.0, 6.0],
        [10.0, 10.0],
        [0.0, 10.0],
    ];
    let found = offset(&region(&[&dumbbell]), 1.0, None);
    assert_eq!(found.loops.len(), 2, "{found:?}");
    assert!((area(&found) - 128.0).abs() < 1e-6);
}

#[test]
fn a_mitre_beyond_the_limit_is_cut_square_at_the_distance() {
    let spike = [[0.0, 0.0], [40.0, 0.0], [40.0, 30.0], [21.0, 30.0], [20.0, 10.0], [19.0, 30.0], [0.0, 30.0]];
    let region = region(&[&spike]);
    let lowest = |limit| {
        let loops = offset(&region, 2.0, limit).loops;
        let near = loops.iter().flat_map(|l| &l.contour.segments).map(crate::Segment::start);
        near.filter(|p| p.x > 15.0 && p.x < 25.0 && p.y > 2.5).map(|p| p.y).fold(f64::INFINITY, f64::min)
    };
    assert!((lowest(Some(10.0)) - 8.0).abs() < 1e-9);
    assert!(lowest(None) > 27.0, "the mitre of 40 mm reaches through the floor");
}

/// Interior angles of about 2π − 10^-k, down to where repair cuts spikes off: the mitre without a limit parts the
/// pocket, and the spike's walls keep their distance.
#[test]
fn extreme_angles_have_offset_points_on_their_bisectors() {
    for k in 1..11 {
        let gap = 10_f64.powi(-k);
        let spike = [
            [-50.0, 0.0],
            [50.0, 0.0],
            [50.0, 40.0],
            [20.0 * gap, 40.0],
            [0.0, 8.0],
            [-20.0 * gap, 40.0],
            [-50.0, 40.0],
        ];
        let region = region(&[&spike]);
        for (limit, loops) in [(Some(10.0), 1), (None, 2)] {
            let found = offset(&region, 1.0, limit);
            assert_eq!(found.loops.len(), loops, "{gap} {limit:?}");
            let walls = crate::distance::Boundary::new(&region);
            let points = found.loops.iter().flat_map(|l| &l.contour.segments).map(|s| s.at(0.5));
            let off = points.map(|p| (walls.distance(p) - 1.0).max(0.0)).fold(0.0, f64::max);
            assert!(limit.is_none() || off < 0.5, "{gap}: {off}");
            let nearest = found.loops.iter().flat_map(|l| &l.contour.segments).map(|s| walls.distance_to(s));
            assert!(nearest.fold(f64::INFINITY, f64::min) > 1.0 - 1e-9, "{gap}");
        }
    }
}

#[test]
fn equations_1_to_3_hold_as_printed_at_moderate_angles() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [9.0, 0.0], [8.0, 7.0], [5.0, 3.0], [1.0, 8.0]];
    let profiles = profile::Profiles::new(&region(&[&corners]), 0.1);
    let joint = corner::Joint { distance: 0.5, limit: f64::INFINITY, far: 100.0 };
    for edges in &profiles.loops {
        for k in 0..edges.len() {
            let (before, after) = (&edges[(k + edges.len() - 1) % edges.len()], &edges[k]);
            let (e1, e2) = (before.direction, after.direction);
            let theta = (-e1).angle_to(e2).abs();
            let printed = match after.half_turn {
                0.0 => e1.left() * 0.5,
                h if h > 0.0 => (e2 - e1).normalized() * (0.5 / (0.5 * theta).sin()),
                _ => (e1 - e2).normalized() * (0.5 / (0.5 * (std::f64::consts::PI - theta)).cos()),
            };
            assert!(joint.on_bisector(before, after).distance(after.start + printed) < 1e-12);
        }
    }
}

#[test]
fn arcs_become_chords_within_the_tolerance() {
    let quarter = (std::f64::consts::PI / 8.0).tan();
    let rounded = Contour::from_vertices(&[[0.0, 0.0, 0.0], [10.0, 0.0, quarter], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]]);
    let region = build(vec![rounded], &RepairOptions::default()).unwrap().region;
    let walls = crate::distance::Boundary::new(&region);
    for s in offset(&region, 1.0, None).loops.iter().flat_map(|l| &l.contour.segments) {
        assert!((walls.distance(s.start()) - 1.0).abs() < 1.1 * tolerance::FIT);
    }
}

#[test]
fn bad_options_are_refused() {
    let region = region(&[&SQUARE]);
    for engine in [
        BisectorEngine { mitre_limit: Some(0.5), ..BisectorEngine::default() },
        BisectorEngine { mitre_limit: Some(f64::NAN), ..BisectorEngine::default() },
        BisectorEngine { chord_tolerance: 0.0, ..BisectorEngine::default() },
    ] {
        assert!(engine.offsets(&region, &[1.0], &OffsetOptions::default()).is_err());
    }
    assert!(BisectorEngine::default().offsets(&region, &[-1.0], &OffsetOptions::default()).is_err());
}

/// A right-angled island: material is left from an interval of 1.707 radii on, and the clean-up move takes it away.
#[test]
fn mitred_loops_leave_material_at_right_angles_from_1707_radii_on() {
    let wall = [[-30.0, -30.0], [40.0, -30.0], [40.0, 40.0], [-30.0, 40.0]];
    let island = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    let region = region(&[&wall, &island]);
    let family = |interval: f64| {
        let distances: Vec<f64> = (0..4).map(|k| 1.0 + f64::from(k) * interval).collect();
        BisectorEngine::default().offsets(&region, &distances, &OffsetOptions::default()).unwrap()
    };
    assert!(mitre_leftovers(&region, &family(1.70), 1.0).is_empty());
    let family = family(1.75);
    let found = mitre_leftovers(&region, &family, 1.0);
    assert_eq!(found.len(), 12, "four corners between each two loops: {found:?}");
    for leftover in &found {
        assert!((leftover.turn - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let cos = 0.5_f64.sqrt();
        assert!((leftover.miss - (0.75 / cos - 1.0) * cos / (1.0 + cos)).abs() < 1e-9);
        let cleanup = leftover.cleanup.unwrap();
        assert!(cleanup.distance(leftover.farthest) < 1.0);
        let contour = &family[leftover.offset as usize].loops[leftover.contour as usize].contour;
        assert_eq!(cleanup.start, contour.segments[leftover.corner as usize].start());
        // The outer loop's tool comes just to the point that the clean-up's tool comes to as well.
        let apex = cleanup.end + (cleanup.end - cleanup.start).normalized();
        let next = &family[leftover.offset as usize + 1].loops;
        let outer = next.iter().map(|l| l.contour.distance(apex)).fold(f64::INFINITY, f64::min);
        assert!((outer - 1.0).abs() < 1e-9);
    }
}

/// A closed line whose edges are far shorter than the offset distance, with spikes of all widths.
fn ragged(n: usize, seed: u64) -> Region {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let corner = |k: usize| {
        let (t, r) = (k as f64 / n as f64 * std::f64::consts::TAU, 30.0 + 3.0 * random());
        [1.6 * r * t.cos(), r * t.sin()]
    };
    let corners: Vec<[f64; 2]> = (0..n).map(corner).collect();
    region(&[&corners])
}

#[test]
fn leaving_covered_edges_out_changes_nothing() {
    for seed in 1..6 {
        let region = ragged(600, seed);
        let profiles = profile::Profiles::new(&region, 0.1);
        for (distance, limit) in [(4.0, 1.0), (9.0, 1.5)] {
            let far = 200.0;
            let joint = corner::Joint { distance, limit, far };
            let raw = raw::Raw::new(&profiles.loops, &joint, raw::Trust::Prove);
            let all = trace::loops(&crossings::Arrangement::new(&raw).unwrap()).unwrap();
            let covered = covered::Covered::new(&profiles.loops, &joint, profiles.bbox, 1e-6);
            let fewer = crossings::Arrangement::of_uncovered(&raw, &covered).unwrap();
            assert!(4 * fewer.dead.iter().filter(|&&d| d).count() > raw.points.len(), "many edges are covered");
            let some = trace::uncovered_loops(&fewer, &covered).unwrap();
            let sorted = |loops: Vec<Vec<Point>>| {
                let areas = loops.iter().map(|l| closed(l).area());
                let mut areas: Vec<f64> = areas.filter(|a| a.abs() > 1e-9).collect();
                areas.sort_by(f64::total_cmp);
                areas
            };
            let (all, some) = (sorted(all), sorted(some));
            assert_eq!(all.len(), some.len(), "{seed} {distance} {limit}");
            assert!(!some.is_empty() && all.iter().zip(&some).all(|(a, b)| (a - b).abs() < 1e-9));
        }
    }
}
