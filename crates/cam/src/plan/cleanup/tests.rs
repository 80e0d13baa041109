use super::forest::Forest;
use super::prune::tours;
use super::{Piece, Place, Uncut, Way};
use pocketry_geom::{Point, Segment, point};

/// Places along the x axis with their reach, joined in a row.
fn row(places: &[(f64, f64)], roots: &[u32]) -> Piece {
    let place = |&(x, reach): &(f64, f64)| Place { at: point(x, 0.0), reach };
    let way = |k: usize| Way {
        ends: [k as u32, k as u32 + 1],
        segment: Segment::line(point(places[k].0, 0.0), point(places[k + 1].0, 0.0)),
    };
    Piece {
        places: places.iter().map(place).collect(),
        ways: (1..places.len()).map(|k| way(k - 1)).collect(),
        roots: roots.iter().map(|&r| (r, (0, 0))).collect(),
        exits: Vec::new(),
    }
}

fn lengths(piece: &Piece, radius: f64) -> Vec<f64> {
    let roots: Vec<u32> = piece.roots.iter().map(|r| r.0).collect();
    let tours = tours(&Forest::new(piece, &roots), radius);
    tours.iter().map(|t| t.iter().map(Segment::length).sum()).collect()
}

#[test]
fn a_tip_within_the_radius_needs_nothing_and_one_beyond_just_the_rest() {
    assert_eq!(lengths(&row(&[(0.0, 0.9), (0.99, 0.0)], &[0]), 1.0), [0.0]);
    let far = lengths(&row(&[(0.0, 0.9), (1.75, 0.0)], &[0]), 1.0);
    assert!((far[0] - 1.5).abs() < 1e-12, "there and back: {far:?}");
}

#[test]
fn a_place_that_answers_for_more_is_visited_nearer() {
    let near = lengths(&row(&[(0.0, 0.5), (2.0, 0.5), (2.4, 0.0)], &[0]), 1.0);
    assert!((near[0] - 3.0).abs() < 1e-12, "the stop is at 1.5: {near:?}");
}

#[test]
fn a_neck_is_shared_by_its_two_ends() {
    let neck = row(&[(0.0, 0.0), (10.0, 0.0)], &[0, 1]);
    assert_eq!(neck.kind(), Uncut::Neck);
    let both = lengths(&neck, 1.0);
    assert!(both.iter().all(|l| (l - 8.0).abs() < 1e-12), "each up to its half less the radius: {both:?}");
}

#[test]
fn branches_are_travelled_there_and_back_without_a_jump() {
    let mut piece = row(&[(0.0, 0.0), (3.0, 0.0), (6.0, 0.0)], &[0]);
    piece.places.push(Place { at: point(3.0, 3.0), reach: 0.0 });
    piece.ways.push(Way { ends: [1, 3], segment: Segment::line(point(3.0, 0.0), point(3.0, 3.0)) });
    let tour = tours(&Forest::new(&piece, &[0]), 1.0).remove(0);
    let (first, last): (Point, Point) = (tour[0].start(), tour[tour.len() - 1].end());
    assert_eq!((first, last), (Point::ORIGIN, Point::ORIGIN));
    assert!(tour.windows(2).all(|w| w[0].end() == w[1].start()));
    let length: f64 = tour.iter().map(Segment::length).sum();
    assert!((length - 14.0).abs() < 1e-12, "{length}");
}
