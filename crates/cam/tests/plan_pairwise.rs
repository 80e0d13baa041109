//! Plans from the pair-wise engine's offsets, against those over the skeleton.

use pocketry_cam::{Plan, PlanError, PocketJob, Uncut, plan, plan_pairwise};
use pocketry_geom::repair::{self, RepairOptions};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Contour, Region};
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
