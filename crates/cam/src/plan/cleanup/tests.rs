use super::forest::Forest;
use super::prune::tours;
use super::rounded::drop_around;
use super::{Piece, Place, Uncut, Way};
use pocketry_geom::{Point, Segment, Vec2, point, vec2};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

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

fn out_and_back(points: &[Point]) -> Vec<Segment> {
    let out: Vec<Segment> = points.windows(2).map(|w| Segment::line(w[0], w[1])).collect();
    out.iter().copied().chain(out.iter().rev().map(Segment::reversed)).collect()
}

fn heading(degrees: f64) -> Vec2 {
    Vec2::from_angle(degrees.to_radians())
}

#[test]
fn a_drop_is_entered_and_left_straight_on_and_lies_about_its_path() {
    for turn in [0.0, 1e-9, 30.0, 90.0, 150.0, 179.0, -0.5, -60.0, -90.0, -170.0] {
        // East, then turned; what lies between straight on and straight back, on the outer side.
        let [before, after] = [heading(0.0), heading(turn)];
        let outward = if turn < 0.0 { 0.5 * (180.0 + turn) } else { -0.5 * (180.0 - turn) };
        for aside in [0.0, 0.1, -0.1] {
            let tip = point(2.0, 3.0) + heading(outward * (1.0 + aside)) * 0.7;
            let tour = out_and_back(&[point(2.0, 3.0), tip]);
            let drop =
                drop_around(&tour, [before, after], 1.0, 2.0).unwrap_or_else(|| panic!("turn {turn}, aside {aside}"));
            let ends = drop[0].start() == tour[0].start() && drop.last().unwrap().end() == tour[0].start();
            assert!(ends && drop.windows(2).all(|w| w[0].end() == w[1].start()), "{drop:?}");
            let smooth = |a: Vec2, b: Vec2| a.dot(b) > 1.0 - 1e-9;
            assert!(smooth(drop[0].start_tangent(), before) && smooth(drop.last().unwrap().end_tangent(), after));
            assert!(drop.windows(2).all(|w| smooth(w[0].end_tangent(), w[1].start_tangent())), "turn {turn}: {drop:?}");
            let nearest = drop.iter().map(|s| s.distance(tip)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "turn {turn}, aside {aside}: the tip lies {nearest} off");
        }
    }
}

#[test]
fn drops_that_do_not_fit_are_not_made() {
    let square = [heading(0.0), heading(90.0)];
    let at = |tip: Point| out_and_back(&[point(0.0, 0.0), tip]);
    let diagonal = at(point(FRAC_1_SQRT_2, -FRAC_1_SQRT_2));
    let drop = drop_around(&diagonal, square, 1.0, 1.01).unwrap();
    let length: f64 = drop.iter().map(Segment::length).sum();
    let expected = (2.0 + 1.5 * PI) * FRAC_1_SQRT_2 / (1.0 + FRAC_1_SQRT_2);
    assert!((length - expected).abs() < 1e-12, "{length} {expected}");
    assert!(drop_around(&diagonal, square, 0.4, 2.0).is_none(), "its arc is wider than the tool");
    assert!(drop_around(&diagonal, square, 1.0, 0.99).is_none(), "it is longer than there is room");
    assert!(drop_around(&at(point(-0.5, -0.6)), square, 1.0, 2.0).is_none(), "it is not between the sides");
    let bent = out_and_back(&[point(0.0, 0.0), point(0.3, -0.3), point(0.5, -0.6)]);
    assert!(drop_around(&bent, square, 1.0, 2.0).is_some());
    let back = out_and_back(&[point(0.0, 0.0), point(0.5, -0.5), point(0.4, 0.2)]);
    assert!(drop_around(&back, square, 1.0, 2.0).is_none(), "it comes back over the side");
    let nothing: [Segment; 0] = [];
    assert!(drop_around(&nothing, [vec2(1.0, 0.0); 2], 1.0, 1.0).is_none());
}
