use super::*;
use crate::point::point;
use crate::tolerance::JOIN;

fn line(a: [f64; 2], b: [f64; 2]) -> Segment {
    Segment::line(point(a[0], a[1]), point(b[0], b[1]))
}

/// The sides of a 100 × 60 rectangle, in no order.
fn rectangle() -> Vec<Segment> {
    vec![
        line([100.0, 60.0], [0.0, 60.0]),
        line([0.0, 0.0], [100.0, 0.0]),
        line([0.0, 0.0], [0.0, 60.0]),
        line([100.0, 60.0], [100.0, 0.0]),
    ]
}

fn closed_area(chains: &Chains) -> f64 {
    chains.closed.iter().map(|(c, _)| c.area().abs()).sum()
}

fn assert_closed(chains: &Chains) {
    for (contour, pieces) in &chains.closed {
        assert_eq!(contour.segments.len(), pieces.len());
        for (k, s) in contour.segments.iter().enumerate() {
            assert_eq!(s.end(), contour.segments[(k + 1) % pieces.len()].start());
        }
    }
}

#[test]
fn sides_in_any_order_and_direction_close() {
    let chains = chain(&rectangle(), JOIN);
    assert_closed(&chains);
    assert_eq!((chains.closed.len(), chains.open.len(), chains.notes.len()), (1, 0, 0));
    assert_eq!(closed_area(&chains), 6000.0);
}

#[test]
fn gaps_up_to_the_tolerance_are_closed_and_told() {
    for (gap, closes) in [(1e-6, true), (0.01, true), (1.0, false)] {
        let mut pieces = rectangle();
        pieces[1] = line([gap, 0.0], [100.0, 0.0]);
        let chains = chain(&pieces, JOIN);
        assert_closed(&chains);
        assert_eq!(chains.closed.len() == 1, closes);
        if closes {
            assert!(matches!(chains.notes[..], [ChainNote::Joined { count: 1, widest, .. }] if widest == gap));
        } else {
            assert_eq!(chains.open.len(), 1);
            assert_eq!((chains.open[0].pieces.len(), chains.open[0].gap), (4, 1.0));
        }
    }
}

#[test]
fn a_moved_end_keeps_the_arc_on_a_circle_with_its_bulge() {
    let arc = Segment::from_bulge(point(0.0, 0.006), point(0.0, 10.0), -1.0);
    let chains = chain(&[line([0.0, 10.0], [0.0, 0.0]), arc], JOIN);
    assert_closed(&chains);
    let arc = chains.closed[0].0.segments.iter().find_map(|s| if let Segment::Arc(a) = s { Some(*a) } else { None });
    let arc = arc.unwrap();
    assert!((arc.start.distance(arc.center) - arc.radius).abs() < 1e-12 && (arc.radius - 5.0).abs() < 1e-12);
}

#[test]
fn repeated_and_covered_pieces_are_dropped() {
    let mut pieces = rectangle();
    pieces.extend(rectangle().iter().map(Segment::reversed));
    pieces.push(line([20.0, 0.0], [70.0, 0.0]));
    let chains = chain(&pieces, JOIN);
    assert_eq!((chains.closed.len(), chains.open.len(), chains.branches.len()), (1, 0, 0));
    assert_eq!(chains.notes.len(), 5);
    assert_eq!(closed_area(&chains), 6000.0);
}

#[test]
fn a_circle_is_a_contour_and_a_dangling_line_is_open() {
    let mut pieces = rectangle();
    let center = point(30.0, 30.0);
    let at = point(40.0, 30.0);
    pieces.push(Segment::Arc(crate::Arc { start: at, end: at, center, radius: 10.0, ccw: true }));
    pieces.push(line([60.0, 20.0], [70.0, 40.0]));
    let chains = chain(&pieces, JOIN);
    assert_eq!((chains.closed.len(), chains.open.len()), (2, 1));
    assert_eq!(chains.open[0].pieces, [5]);
}

#[test]
fn branches_are_reported() {
    let mut pieces = rectangle();
    pieces.push(line([0.0, 0.0], [100.0, 60.0]));
    let chains = chain(&pieces, JOIN);
    assert_eq!((chains.closed.len(), chains.open.len(), chains.branches.len()), (0, 3, 2));
    assert_eq!(chains.branches[0].pieces.len(), 3);
}

#[test]
fn contours_that_share_a_corner_both_close() {
    let mut pieces = rectangle();
    pieces.extend(rectangle().iter().map(|s| s.translated(crate::vec2(100.0, 60.0))));
    let chains = chain(&pieces, JOIN);
    assert_closed(&chains);
    assert!(chains.branches.is_empty() && chains.open.is_empty());
    assert_eq!(closed_area(&chains), 12000.0);
}

#[test]
fn pieces_shorter_than_the_tolerance_stay_in_a_chain() {
    let n = 4000;
    let at =
        |k: usize| point(0.0, 0.0) + crate::Vec2::from_angle(std::f64::consts::TAU * k as f64 / f64::from(n)) * 2.0;
    let pieces: Vec<Segment> = (0..n as usize).map(|k| Segment::line(at(k), at((k + 1) % n as usize))).collect();
    let chains = chain(&pieces, JOIN);
    assert_closed(&chains);
    assert_eq!((chains.closed.len(), chains.open.len()), (1, 0));
}
