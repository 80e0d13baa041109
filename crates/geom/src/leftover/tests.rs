use super::*;
use crate::Contour;
use crate::repair::{RepairOptions, build};
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

fn skeleton(loops: &[&[[f64; 3]]]) -> Skeleton {
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    Skeleton::build(&build(contours, &RepairOptions::default()).unwrap().region).unwrap()
}

fn left(loops: &[&[[f64; 3]]], radius: f64) -> Leftover {
    Leftover::new(&skeleton(loops), Reach::of(radius)).unwrap()
}

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]];

#[test]
fn the_corners_of_a_square() {
    let found = left(&[&SQUARE], 2.0);
    assert_eq!(found.pieces.len(), 4);
    assert!((found.area() - 4.0 * (4.0 - PI)).abs() < 1e-12);
    assert!((found.deepest().unwrap().size - 2.0 * (SQRT_2 - 1.0)).abs() < 1e-12);
    assert!(found.pieces.iter().all(|p| p.kind == Kind::Corner && p.mouths.len() == 1));
    assert_eq!((found.necks().count(), found.pockets().count()), (0, 0));
}

#[test]
fn stock_to_leave_makes_the_region_smaller_and_not_the_tool_larger() {
    let found = Leftover::new(&skeleton(&[&SQUARE]), Reach { radius: 2.0, stock_to_leave: 0.5 }).unwrap();
    assert!((found.area() - 4.0 * (4.0 - PI)).abs() < 1e-12);
    assert!((found.deepest().unwrap().size - 2.0 * (SQRT_2 - 1.0)).abs() < 1e-12);
    assert!((found.deepest().unwrap().at.x - 0.5).abs().min((found.deepest().unwrap().at.x - 9.5).abs()) < 1e-12);
}

#[test]
fn a_tool_that_fits_exactly_leaves_the_corners_around_one_point() {
    let found = left(&[&SQUARE], 5.0);
    assert!((found.area() - 25.0 * (4.0 - PI)).abs() < 1e-9);
    assert_eq!(found.pieces.iter().map(|p| p.mouths.len()).sum::<usize>(), 4);
    assert!(left(&[&[[-3.0, 0.0, 1.0], [3.0, 0.0, 1.0]]], 3.0).pieces.is_empty());
    assert!(left(&[&[[0.0, -2.0, 0.0], [9.0, -2.0, 1.0], [9.0, 2.0, 0.0], [0.0, 2.0, 1.0]]], 2.0).pieces.is_empty());
}

#[test]
fn a_pocket_too_small_is_left_whole() {
    let found = left(&[&SQUARE], 5.1);
    assert_eq!((found.pieces.len(), found.pieces[0].kind, found.deepest()), (1, Kind::Pocket, None));
    assert!((found.area() - 100.0).abs() < 1e-12);
    let widest = found.pieces[0].widest.unwrap();
    assert!((widest.width - 10.0).abs() < 1e-12 && widest.at.distance(crate::point(5.0, 5.0)) < 1e-12);
}

/// Two squares joined by a channel 4 wide and 10 long.
const DUMBBELL: [[f64; 3]; 12] = [
    [0.0, 0.0, 0.0],
    [20.0, 0.0, 0.0],
    [20.0, 8.0, 0.0],
    [30.0, 8.0, 0.0],
    [30.0, 0.0, 0.0],
    [50.0, 0.0, 0.0],
    [50.0, 20.0, 0.0],
    [30.0, 20.0, 0.0],
    [30.0, 12.0, 0.0],
    [20.0, 12.0, 0.0],
    [20.0, 20.0, 0.0],
    [0.0, 20.0, 0.0],
];

#[test]
fn a_channel_too_narrow_is_named_with_its_middle_and_width() {
    let found = left(&[&DUMBBELL], 3.0);
    let necks: Vec<&Piece> = found.pieces.iter().filter(|p| p.kind == Kind::Neck).collect();
    assert_eq!((necks.len(), necks[0].necks.len(), necks[0].mouths.len()), (1, 1, 2));
    assert!((necks[0].necks[0].width - 4.0).abs() < 1e-12);
    assert!(necks[0].necks[0].at.distance(crate::point(25.0, 10.0)) < 1e-9);
    // Mouths lie where disks of radius 3 touch both edges of the channel's end, √5 in front of it.
    let half = (3.0_f64.powi(2) - 4.0).sqrt();
    let deepest = 7.0_f64.hypot(0.0).max((5.0 + half).hypot(2.0)) - 3.0;
    assert!((found.deepest().unwrap().size - deepest).abs() < 1e-12);
    let segment = 9.0 * (2.0 / 3.0_f64).asin() - 2.0 * half;
    assert!((necks[0].area - (40.0 - 2.0 * segment)).abs() < 1e-9);
    assert_eq!(left(&[&DUMBBELL], 2.0).necks().count(), 0);
}

#[test]
fn an_arc_is_deepest_opposite_to_the_mouth() {
    // A keyhole: a slit of width 2 into a disc that the tool doesn't reach, half a circle of radius 2 behind it.
    let keyhole = [
        [-10.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 20.0, 0.0],
        [1.0, 20.0, 0.0],
        [1.0, 26.0, 2.0],
        [-1.0, 26.0, 0.0],
        [-1.0, 20.0, 0.0],
        [-10.0, 20.0, 0.0],
    ];
    let found = left(&[&keyhole], 3.0);
    let deepest = found.deepest().unwrap();
    assert!(deepest.at.x.abs() < 1e-9 && deepest.at.y > 27.0);
    let mouth = 20.0 - 8.0_f64.sqrt();
    assert!((deepest.size - (deepest.at.y - mouth - 3.0)).abs() < 1e-12);
}

#[test]
fn the_deepest_place_may_lie_off_walls_and_skeleton() {
    // Three spikes that meet in a small hub: the tool comes up to the hub from three sides.
    let spike = |k: usize| {
        let turn = 2.0 * PI * k as f64 / 3.0;
        let at = |x: f64, y: f64| {
            let (sin, cos) = turn.sin_cos();
            [x * cos - y * sin, x * sin + y * cos, 0.0]
        };
        [at(0.7, -0.6), at(9.0, -3.0), at(9.0, 3.0), at(0.7, 0.6)]
    };
    let hub: Vec<[f64; 3]> = (0..3).flat_map(spike).collect();
    let found = left(&[&hub], 1.0);
    let neck = found.pieces.iter().find(|p| p.kind == Kind::Neck).unwrap();
    assert_eq!((neck.mouths.len(), neck.necks.len()), (3, 2));
    let depth = neck.deepest.unwrap();
    assert!(depth.at.distance(Point::ORIGIN) < 1e-9);
    assert!(neck.mouths.iter().all(|m| m.at.distance(depth.at) >= 1.0 + depth.size - 1e-12));
}

#[test]
fn disks_that_touch_the_same_reflex_vertex_count_once() {
    // The lower vertex of an island is too near to the wall: both disks touch it from its sides, wherever the island lies.
    let plate = [[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [30.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
    for k in 0..40 {
        let x = 10.0 + 0.17 * f64::from(k);
        let island = [[x + 1.0, 5.0, 0.0], [x, 6.0, 0.0], [x - 1.0, 5.0, 0.0], [x, 4.0, 0.0]];
        let found = left(&[&plate, &island], 2.3);
        let neck = found.pieces.iter().find(|p| p.kind == Kind::Neck).unwrap();
        // Below 4 the disks' circles, left and right of the vertex, meet at the same height.
        let half = 2.3_f64.powi(2) - 1.7_f64.powi(2);
        let below =
            2.0 * (2.3 * half.sqrt() - 0.5 * (half.sqrt() * 1.7 + 2.3_f64.powi(2) * (half.sqrt() / 2.3).asin()));
        assert!((neck.area - below).abs() < 1e-9, "{} {below}", neck.area);
    }
}

#[test]
fn arcs_that_meet_leave_what_circles_leave() {
    // A lens of two quarter circles of radius 10: its tips have right angles.
    let bulge = (FRAC_PI_4 / 2.0).tan();
    let half = 10.0 / SQRT_2;
    let found = left(&[&[[-half, 0.0, bulge], [half, 0.0, bulge]]], 1.0);
    assert_eq!(found.pieces.len(), 2);
    // The mouth lies where circles of radius 9 about the arcs' centres meet.
    let mouth = (81.0 - half * half).sqrt();
    assert!((found.deepest().unwrap().size - (half - mouth - 1.0)).abs() < 1e-12);
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let s = skeleton(&[&SQUARE]);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Leftover::new(&s, Reach::of(bad)).is_err());
    }
    for bad in [-1.0, f64::NAN] {
        assert!(Leftover::new(&s, Reach { radius: 1.0, stock_to_leave: bad }).is_err());
    }
}
