//! Plans from the pair-wise engine's offsets, against those over the skeleton.

use pocketry_cam::{Plan, PlanError, PocketJob, Uncut, plan, plan_pairwise};
use pocketry_geom::distance::Boundary;
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::repair::{self, RepairOptions};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Arc, Contour, Region, Segment, point};
use pocketry_motion::Move;
use pocketry_testkit::{corpus, shapes};

fn region(loops: &[&[[f64; 3]]]) -> Region {
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    repair::build(contours, &RepairOptions::default()).unwrap().region
}

fn both(region: &Region, share: f64) -> [Plan; 2] {
    let job = PocketJob { stepover: share * 4.0, ..PocketJob::for_diameter(4.0) };
    [plan_pairwise(region, &job).unwrap(), plan(region, &Skeleton::build(region).unwrap(), &job).unwrap()]
}

/// How many of a kind, and how long they are together.
fn of_kind(plan: &Plan, kind: Uncut) -> (usize, f64) {
    let own = plan.cleanups.iter().filter(|c| c.kind == kind);
    (own.clone().count(), own.map(|c| c.length).sum())
}

const SQUARE: &[[f64; 3]] = &[[-15.0, -15.0, 0.0], [15.0, -15.0, 0.0], [15.0, 15.0, 0.0], [-15.0, 15.0, 0.0]];

#[test]
fn corners_are_cleaned_up_as_over_the_skeleton() {
    let square = region(&[SQUARE]);
    for share in [0.9, 0.97] {
        let [pairwise, exact] = both(&square, share);
        let (found, expected) = (of_kind(&pairwise, Uncut::Corner), of_kind(&exact, Uncut::Corner));
        assert_eq!(found.0, expected.0, "{found:?} {expected:?}");
        assert!(
            found.0 >= 4 && found.1 < 1.5 * expected.1 + 0.5 && found.1 > 0.9 * expected.1,
            "{found:?} {expected:?}"
        );
        assert_eq!(pairwise.loops.len(), exact.loops.len());
    }
}

#[test]
fn a_dumbbell_has_a_neck_for_both_engines() {
    let half = [[-20.0, -8.0], [-5.0, -8.0], [-5.0, -2.9], [5.0, -2.9], [5.0, -8.0], [20.0, -8.0]];
    let mut points: Vec<[f64; 3]> = half.iter().map(|p| [p[0], p[1], 0.0]).collect();
    points.extend(half.iter().rev().map(|p| [p[0], -p[1], 0.0]));
    let [pairwise, exact] = both(&region(&[&points]), 0.9);
    assert!(of_kind(&pairwise, Uncut::Neck).0 > 0 || of_kind(&exact, Uncut::Neck).0 == 0);
    assert_eq!(of_kind(&pairwise, Uncut::Neck).0, of_kind(&exact, Uncut::Neck).0);
}

#[test]
fn a_fan_of_branches_is_cut_back_from_its_trunk() {
    // Tips of neighbours lie nearer to one another than to the trunk: joined, each branch was travelled out and back.
    let cavity = corpus::region(&shapes::die_cavity(1500)).unwrap();
    let job = PocketJob { stepover: 19.9, ..PocketJob::for_diameter(20.0) };
    let plans =
        [plan_pairwise(&cavity, &job).unwrap(), plan(&cavity, &Skeleton::build(&cavity).unwrap(), &job).unwrap()];
    let [pairwise, exact] = plans.map(|p| p.cleanups.iter().map(|c| c.length).sum::<f64>());
    assert!(exact > 0.0 && pairwise < 1.25 * exact, "{pairwise} {exact}");
}

#[test]
fn arcs_and_islands_take_part() {
    let island: &[[f64; 3]] = &[[-4.0, 0.0, 1.0], [4.0, 0.0, 1.0]];
    let [pairwise, exact] = both(&region(&[SQUARE, island]), 0.6);
    assert_eq!(pairwise.loops.len(), exact.loops.len());
}

#[test]
fn a_tool_too_large_is_told_what_fits() {
    let job = PocketJob::for_diameter(40.0);
    match plan_pairwise(&region(&[SQUARE]), &job) {
        Err(PlanError::DoesNotFit { largest, .. }) => assert!((largest - 30.0).abs() < 1e-3, "{largest}"),
        other => panic!("{other:?}"),
    }
}

/// The cutting moves as segments of the plane.
fn paths(plan: &Plan) -> Vec<Segment> {
    let pairs = plan.program.moves.windows(2).map(|w| (w[0].to().xy(), w[1]));
    let cuts = pairs.filter(|(_, m)| !matches!(m, Move::Rapid { .. }));
    let curve = |(start, m): (_, Move)| match m {
        Move::Arc { to, center, ccw, .. } => {
            Segment::Arc(Arc { start, end: to.xy(), center, radius: center.distance(start), ccw })
        }
        _ => Segment::line(start, m.to().xy()),
    };
    cuts.map(curve).filter(|s| s.start() != s.end()).collect()
}

/// Whether the tool leaves none of a fine raster of points that its axis may go to.
fn leaves_nothing(region: &Region, plan: &Plan, radius: f64) -> bool {
    const FINENESS: u32 = 500;
    let (walls, paths, bbox) = (Boundary::new(region), SegmentIndex::new(&paths(plan)), region.bbox());
    let share = |k: u32| f64::from(k) / f64::from(FINENESS);
    (0..FINENESS * FINENESS).all(|k| {
        let p =
            point(bbox.min.x + share(k % FINENESS) * bbox.width(), bbox.min.y + share(k / FINENESS) * bbox.height());
        let clearance = || walls.signed_distance(p);
        paths.nearest_within(p, radius * (1.0 + 2e-4)).is_some() || clearance() < radius
    })
}

fn assert_nothing_is_left(loops: &[&[[f64; 2]]], diameter: f64) {
    let flat: Vec<Vec<[f64; 3]>> = loops.iter().map(|l| l.iter().map(|p| [p[0], p[1], 0.0]).collect()).collect();
    let region = region(&flat.iter().map(Vec::as_slice).collect::<Vec<_>>());
    for share in [0.75, 0.9, 0.98] {
        let job = PocketJob { stepover: share * diameter, ..PocketJob::for_diameter(diameter) };
        let plan = plan_pairwise(&region, &job).unwrap();
        assert!(leaves_nothing(&region, &plan, 0.5 * diameter), "at {share}");
    }
}

/// The ends of fibres, joined where they come close, made no path to all of this: spokes do.
#[test]
fn what_joined_fibres_miss_in_a_leaf_is_cut() {
    let leaf = [
        [17.9, 3.8],
        [24.2, 6.3],
        [23.0, 10.2],
        [17.9, 17.9],
        [14.7, 18.0],
        [7.6, 12.6],
        [-1.5, 20.4],
        [-5.6, 21.7],
        [-8.1, 4.1],
        [-8.5, 3.4],
        [-15.9, -20.6],
        [15.9, -11.8],
    ];
    assert_nothing_is_left(&[&leaf], 4.6);
}

#[test]
fn what_joined_fibres_miss_in_a_kite_and_a_boot_is_cut() {
    let kite = [
        [12.8, 5.1],
        [22.3, 13.8],
        [13.5, 17.1],
        [-1.4, 16.5],
        [-3.5, 21.5],
        [-7.3, 11.2],
        [-13.2, 3.9],
        [-1.5, -27.2],
        [3.7, -17.3],
        [27.2, -5.6],
    ];
    assert_nothing_is_left(&[&kite], 2.4);
    let boot = [
        [10.5, 2.2],
        [13.6, 11.9],
        [3.3, 13.2],
        [-6.7, 16.9],
        [-15.0, 22.9],
        [-7.6, 9.7],
        [-12.3, 15.4],
        [-18.0, 3.5],
        [-17.1, -4.7],
        [0.5, -9.5],
        [14.1, -24.3],
        [25.9, -9.6],
    ];
    assert_nothing_is_left(&[&boot], 2.4);
}

#[test]
fn an_island_in_a_star_leaves_nothing() {
    let star = [
        [20.0, 4.8],
        [21.9, 10.8],
        [-2.2, 10.8],
        [-19.0, 17.9],
        [-19.1, -20.4],
        [-6.9, -8.6],
        [10.4, -17.5],
        [8.2, -9.6],
        [18.9, -21.8],
        [11.6, -12.3],
        [25.8, -0.9],
    ];
    assert_nothing_is_left(&[&star, &[[-0.6, -1.8], [-3.1, -3.1], [-3.5, 0.3]]], 2.4);
}

/// A tipper lorry: clean-up paths moved the places from which ways between loops were tried, and with them the lifts.
#[test]
fn clean_up_paths_make_no_lifts() {
    let (wheel, hub) = (0.414_213_562, -0.414_213_562);
    let lorry = region(&[
        &[
            [83.333, 66.667, 0.0],
            [62.5, 66.667, 0.0],
            [62.5, 41.667, 0.0],
            [8.333, 41.667, 0.0],
            [8.333, 29.167, 0.0],
            [12.5, 29.167, wheel],
            [25.0, 16.667, wheel],
            [37.5, 29.167, 0.0],
            [62.5, 29.167, wheel],
            [75.0, 16.667, wheel],
            [87.5, 29.167, 0.0],
            [95.833, 29.167, 0.0],
            [95.833, 50.0, 0.0],
        ],
        &[[25.0, 22.917, hub], [18.75, 29.167, hub], [25.0, 35.417, hub], [31.25, 29.167, hub]],
        &[[75.0, 22.917, hub], [68.75, 29.167, hub], [75.0, 35.417, hub], [81.25, 29.167, hub]],
        &[[70.833, 50.0, 0.0], [70.833, 60.417, 0.0], [81.25, 60.417, 0.0], [89.417, 50.0, 0.0]],
        &[
            [75.0, 70.833, 0.0],
            [58.333, 70.833, 0.0],
            [58.333, 45.833, 0.0],
            [12.5, 45.833, 0.0],
            [6.542, 66.667, 0.0],
            [4.167, 66.667, 0.0],
            [4.167, 75.0, 0.0],
            [54.167, 75.0, 0.0],
            [58.333, 79.167, 0.0],
            [75.0, 79.167, 0.0],
        ],
    ]);
    for diameter in [1.6, 1.7, 1.8332, 2.0, 2.2] {
        let job = PocketJob { stepover: 0.98 * diameter, ..PocketJob::for_diameter(diameter) };
        let lifts = [true, false].map(|cleanup| {
            let plan = plan_pairwise(&lorry, &PocketJob { cleanup, ..job.clone() }).unwrap();
            plan.groups.len()
        });
        assert_eq!(lifts[0], lifts[1], "{diameter}");
    }
}
