use super::PairwiseEngine;
use super::chords::{self, Fineness};
use super::{PairwiseOffsetter, degenerate_slack};
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

/// Chords narrow a channel, so they are fine where it is just as wide as the tool, and coarse where it is wider.
#[test]
fn a_bent_channel_just_as_wide_as_the_tool_has_room_for_it() {
    for (width, chords) in [(2.0, 1200..2400), (2.5, 200..600)] {
        let (inner, outer) = (20.0 - 0.5 * width, 20.0 + 0.5 * width);
        let cap = if width > 2.0 { 0.0 } else { 1.0 };
        let channel = vec![[outer, 0.0, 1.0], [-outer, 0.0, cap], [-inner, 0.0, -1.0], [inner, 0.0, cap]];
        let straight = PairwiseEngine::straightened(&region(&[channel]), 1.0).unwrap();
        assert!(chords.contains(&straight.edge_count()), "{width}: {} chords", straight.edge_count());
        let offset = PairwiseOffsetter::new(&straight).offset(1.0 - degenerate_slack(1.0)).unwrap();
        assert_eq!(offset.loops.len(), 1, "{width}");
    }
}

/// Of an icon: the pocket ends between a line and an arc tangent to it, whose chords come back along the line.
#[test]
fn a_pocket_that_ends_in_a_cusp_is_offset() {
    let cusp =
        [[0.0, 10.0, 0.0], [10.0, 10.0, -1.0], [10.0, 4.0, 0.0], [30.0, 4.0, 0.0], [30.0, 25.0, 0.0], [0.0, 25.0, 0.0]];
    let mirrored = cusp.iter().map(|&[x, y, bulge]| [x, -y, -bulge]).collect();
    for outline in [cusp.to_vec(), mirrored] {
        let region = region(&[outline]);
        let walls = Boundary::new(&region);
        for d in [0.5, 2.0, 4.0] {
            let found = PairwiseEngine.offsets(&region, &[d], &OffsetOptions::default()).unwrap().remove(0);
            assert_eq!(found.loops.len(), 1, "{d}");
            for s in &found.loops[0].contour.segments {
                assert!((walls.signed_distance(s.at(0.5)) - d).abs() <= PairwiseEngine::chord_tolerance(d), "{d}");
            }
        }
    }
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

#[test]
fn corners_drawn_twice_a_nanometre_apart_lose_no_loop() {
    // A star of the adversarial set, whose lengths matter to the last digit.
    let twice = vec![
        [25.0, 0.0, 0.0],
        [25.000_000_000_678_7, 7.34415e-10, 0.0],
        [45.048_443_395_120_955, 21.694_186_955_877_907, 0.0],
        [45.048_443_394_123_6, 21.694_186_955_805_176, 0.0],
        [15.587_245_046_468_34, 19.545_787_061_700_747, 0.0],
        [15.587_245_046_317_314, 19.545_787_062_689_275, 0.0],
        [11.126_046_697_815_722, 48.746_395_609_091_18, 0.0],
        [11.126_046_697_250_747, 48.746_395_608_266_07, 0.0],
        [-5.563_023_348_907_858, 24.373_197_804_545_59, 0.0],
        [-5.563_023_349_774_885, 24.373_197_805_043_85, 0.0],
        [-31.174_490_092_936_676, 39.091_574_123_401_49, 0.0],
        [-31.174_490_092_643_836, 39.091_574_122_445_33, 0.0],
        [-22.524_221_697_560_478, 10.847_093_477_938_955, 0.0],
        [-22.524_221_698_490_617, 10.847_093_477_571_748, 0.0],
        [-50.0, 6e-15, 0.0],
        [-49.999_999_999_069_864, -3.67201e-10, 0.0],
        [-22.524_221_697_560_478, -10.847_093_477_938_95, 0.0],
        [-22.524_221_697_853_317, -10.847_093_478_895_111, 0.0],
        [-31.174_490_092_936_686, -39.091_574_123_401_486, 0.0],
        [-31.174_490_092_069_66, -39.091_574_122_903_225, 0.0],
        [-5.563_023_348_907_865, -24.373_197_804_545_59, 0.0],
        [-5.563_023_348_342_889, -24.373_197_805_370_697, 0.0],
        [11.126_046_697_815_667, -48.746_395_609_091_195, 0.0],
        [11.126_046_697_966_693, -48.746_395_608_102_67, 0.0],
        [15.587_245_046_468_334, -19.545_787_061_700_747, 0.0],
        [15.587_245_047_465_686, -19.545_787_061_773_478, 0.0],
        [45.048_443_395_120_97, -21.694_186_955_877_875, 0.0],
        [45.048_443_394_442_266, -21.694_186_955_143_46, 0.0],
    ];
    let once: Vec<[f64; 3]> = twice.iter().copied().step_by(2).collect();
    for d in [0.5, 3.0, 3.4, 3.448, 4.0, 6.0, 10.0, 20.0] {
        let area = |loops: &[[f64; 3]]| -> f64 {
            let offsets = PairwiseEngine.offsets(&region(&[loops.to_vec()]), &[d], &OffsetOptions::default()).unwrap();
            offsets[0].loops.iter().map(|l| l.contour.area()).sum()
        };
        let (one, two) = (area(&once), area(&twice));
        assert!(one > 1.0 && (one - two).abs() < 1e-6, "at {d}: {two} instead of {one}");
    }
}

/// Chords of two arcs that are all but twice the distance apart cross at next to no angle: between crossings raw curves dip
/// below the offset by nanometres.
#[test]
fn bends_nearly_twice_as_wide_as_the_distance_do_not_contradict_themselves() {
    let serpentine = vec![
        [30.071_606_753, 141.721_746_762, -0.944_368_366_702],
        [29.502_587_969, 131.784_735_276, 0.0],
        [29.583_530_298, 101.723_374_923, -0.991_912_437_482],
        [29.502_587_969, 91.754_432_895, 0.0],
        [-0.165_086_655, 91.744_333_289, 0.906_347_169_019],
        [-0.165_086_655, 88.392_027_425, 0.0],
        [29.583_530_298, 61.693_072_542, -0.991_912_437_482],
        [29.502_587_969, 38.380_696_387, 0.0],
        [-1.051_615_276, 85.196_250_042, -0.898_978_771_72],
        [0.0, 95.053_644_882, 0.0],
        [29.667_674_623, 95.063_744_489, 0.906_347_169_019],
        [29.667_674_623, 98.416_050_352, 0.0],
        [-0.080_942_33, 125.115_005_235, -0.991_912_437_482],
    ];
    let region = region(&[serpentine]);
    let straight = chords::chorded(&region, Fineness { radius: 1.650_579, fine: 5e-6, coarse: 5e-6 }).unwrap();
    let found = PairwiseOffsetter::new(&straight).offset(1.650_579).unwrap();
    let walls = Boundary::new(&region);
    let segments = found.loops.iter().flat_map(|l| &l.contour.segments);
    assert!(segments.clone().count() > 0);
    for s in segments {
        assert!((walls.signed_distance(s.at(0.5)) - 1.650_579).abs() < 1e-5, "{s:?}");
    }
}
