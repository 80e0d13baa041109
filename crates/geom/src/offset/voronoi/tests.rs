//! The walk on skeletons made by hand.

use super::*;
use crate::contour::Contour;
use crate::distance::Boundary;
use crate::offset::OffsetLoop;
use crate::point::point;
use crate::repair::{self, RepairOptions};
use crate::segment::Segment;
use crate::skeleton::handmade::{annulus, clearance, disc, ell, neck, rectangle};
use crate::skeleton::{EdgeId, Skeleton};

fn at(skeleton: &Skeleton, d: f64) -> Offset {
    VoronoiOffsetter::new(skeleton).offset(d, &OffsetOptions::default()).unwrap()
}

fn kept(skeleton: &Skeleton, d: f64) -> Offset {
    VoronoiOffsetter::new(skeleton).offset(d, &OffsetOptions { degenerate: Degenerate::Keep }).unwrap()
}

fn assert_valid(skeleton: &Skeleton, offset: &Offset) {
    for OffsetLoop { contour, sites, crossings } in &offset.loops {
        let segments = &contour.segments;
        assert_eq!((segments.len(), segments.len()), (sites.len(), crossings.len()));
        for (k, s) in segments.iter().enumerate() {
            assert_eq!(s.end(), segments[(k + 1) % segments.len()].start());
            for i in 0..=8 {
                let c = clearance(skeleton, s.at(f64::from(i) / 8.0));
                assert!((c - offset.distance).abs() < 1e-12, "{s:?}: {c} instead of {}", offset.distance);
            }
        }
    }
}

#[test]
fn a_rectangle_shrinks_counter_clockwise() {
    let skeleton = rectangle(10.0, 4.0);
    for d in [1e-9, 0.5, 1.0, 1.999_999_999] {
        let offset = at(&skeleton, d);
        assert_valid(&skeleton, &offset);
        assert_eq!(offset.loops.len(), 1);
        assert!((offset.loops[0].contour.area() - (10.0 - 2.0 * d) * (4.0 - 2.0 * d)).abs() < 1e-9);
    }
}

#[test]
fn at_its_peak_a_channel_leaves_its_middle_line() {
    let skeleton = rectangle(10.0, 4.0);
    assert_eq!(at(&skeleton, 2.0), Offset { distance: 2.0, ..Offset::default() });
    let offset = kept(&skeleton, 2.0);
    assert_eq!((offset.loops.len(), offset.degenerate.len()), (0, 1));
    let path = &offset.degenerate[0];
    assert_eq!(path.attached, None);
    let (a, b) = (point(2.0, 2.0), point(8.0, 2.0));
    assert_eq!(path.tour, vec![Segment::line(a, b), Segment::line(b, a)]);
    // A tool too wide by the drawing's rounding goes in, one too wide by a micrometre of a micrometre more does not.
    assert_eq!(kept(&skeleton, 2.0 + 5e-5).degenerate.len(), 1);
    assert_eq!(kept(&skeleton, 2.0 + 5e-4).degenerate.len(), 0);
    // A channel wider than the tool by however little has a loop, and nothing degenerate.
    let offset = kept(&skeleton, 2.0 - 1e-7);
    assert_eq!((offset.loops.len(), offset.degenerate.len()), (1, 0));
}

#[test]
fn a_disc_shrinks_to_its_centre() {
    let skeleton = disc(5.0);
    let offset = at(&skeleton, 2.0);
    assert_valid(&skeleton, &offset);
    assert_eq!(offset.loops.len(), 1);
    assert!((offset.loops[0].contour.area() - 9.0 * std::f64::consts::PI).abs() < 1e-9);
    let offset = kept(&skeleton, 5.0);
    assert_eq!((offset.loops.len(), offset.degenerate.len()), (0, 1));
    assert_eq!((offset.degenerate[0].start, offset.degenerate[0].tour.len()), (point(0.0, 0.0), 0));
}

#[test]
fn an_ell_rounds_its_reflex_corner() {
    let skeleton = ell(10.0);
    for d in [0.1, 2.0, 4.999, 5.0, 5.2, 5.857] {
        let offset = at(&skeleton, d);
        assert_valid(&skeleton, &offset);
        assert_eq!(offset.loops.len(), 1, "at {d}");
        assert!(offset.loops[0].contour.area() > 0.0);
        let arcs = offset.loops[0].contour.segments.iter().filter(|s| matches!(s, Segment::Arc(_))).count();
        assert_eq!(arcs, 1);
    }
    assert!(at(&skeleton, 5.9).loops.is_empty());
}

#[test]
fn shelves_hang_on_the_loop_they_lead_to() {
    let offset = kept(&ell(10.0), 5.0);
    assert_eq!((offset.loops.len(), offset.degenerate.len()), (1, 2));
    for path in &offset.degenerate {
        let crossing = path.attached.unwrap();
        let at = offset.loops[0].crossings.iter().position(|&c| c == crossing).unwrap();
        assert_eq!(offset.loops[0].contour.segments[at].start(), path.start);
        assert!((path.tour.iter().map(Segment::length).sum::<f64>() - 10.0).abs() < 1e-12);
    }
}

#[test]
fn an_annulus_has_an_inner_loop_the_other_way_and_a_ring_in_its_middle() {
    let skeleton = annulus(10.0, 4.0);
    let offset = at(&skeleton, 1.0);
    assert_valid(&skeleton, &offset);
    let mut areas: Vec<f64> = offset.loops.iter().map(|l| l.contour.area() / std::f64::consts::PI).collect();
    areas.sort_by(f64::total_cmp);
    assert!(areas.len() == 2 && (areas[0] + 25.0).abs() < 1e-9 && (areas[1] - 81.0).abs() < 1e-9, "{areas:?}");
    let offset = kept(&skeleton, 3.0);
    assert_eq!((offset.loops.len(), offset.degenerate.len()), (0, 1));
    let tour = &offset.degenerate[0].tour;
    assert_eq!(tour.len(), 2);
    assert!((tour.iter().map(Segment::length).sum::<f64>() - 14.0 * std::f64::consts::PI).abs() < 1e-9);
    assert_eq!(tour[0].end(), tour[1].start());
}

#[test]
fn a_neck_parts_the_loop_in_two() {
    let skeleton = neck();
    for (d, loops) in [(0.5, 1), (0.999, 1), (1.0, 2), (1.2, 2), (3.999, 2), (4.0, 0)] {
        let offset = at(&skeleton, d);
        assert_valid(&skeleton, &offset);
        assert_eq!(offset.loops.len(), loops, "at {d}");
        assert!(offset.loops.iter().all(|l| l.contour.area() > 0.0));
    }
    // At the pass's own clearance the two loops touch there.
    let pass = point(0.0, 0.0);
    assert!(at(&skeleton, 1.0).loops.iter().all(|l| l.contour.distance(pass) < 1e-12));
}

#[test]
fn distances_that_are_no_lengths_are_refused() {
    let skeleton = disc(5.0);
    let offsetter = VoronoiOffsetter::new(&skeleton);
    for d in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(offsetter.offset(d, &OffsetOptions::default()), Err(OffsetError::Distance(_))));
    }
}

/// Bulges rounded to nine decimals turn half circles about one centre into arcs of a little more than half a turn about two:
/// the middle between them was drawn on the other side of the centres, through the walls. A link of bootstrap-icons'
/// `link-45deg` (MIT).
#[test]
fn the_middle_between_arcs_of_half_a_turn_stays_between_them() {
    let link = [
        [41.1625, 70.8, 0.517_547_843],
        [46.3375, 40.625, 0.0],
        [51.18125, 45.475, -0.577_279_646],
        [45.58125, 66.3875, 0.0],
        [57.0, 77.8125, -1.0],
        [74.6875, 60.125, 0.0],
        [69.73125, 55.175, -0.040_380_543],
        [70.456_747, 51.185_485, -0.040_418_673],
        [70.53125, 47.13125, 0.0],
        [79.10625, 55.70625, 1.000_000_013],
        [52.5875, 82.225, 0.0],
    ];
    let region = repair::build(vec![Contour::from_vertices(&link)], &RepairOptions::default()).unwrap().region;
    let (skeleton, walls) = (Skeleton::build(&region).unwrap(), Boundary::new(&region));
    for edge in 0..skeleton.edge_count() as EdgeId {
        let curve = EdgeCurve::new(&skeleton, 2 * edge);
        let (low, high) = (curve.low().clearance, curve.high().clearance);
        let lower_half = curve.between(low, low.midpoint(high), 1e-4);
        for s in [curve.whole(true, 1e-4), curve.whole(false, 1e-4), lower_half].concat() {
            let off = (walls.signed_distance(s.at(0.5)) - curve.clearance(s.at(0.5))).abs();
            assert!(off < 1e-3, "{s:?} is {off} off");
        }
    }
}
