use super::bulge::Corner;
use super::forest::Forest;
use super::prune::{Tour, tours};
use super::rounded::{Room, circle_about, drop_around};
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
        least: 0.0,
        places: places.iter().map(place).collect(),
        ways: (1..places.len()).map(|k| way(k - 1)).collect(),
        roots: roots.iter().map(|&r| (r, (0, 0))).collect(),
        exits: Vec::new(),
    }
}

fn lengths(piece: &Piece, radius: f64) -> Vec<f64> {
    let roots: Vec<u32> = piece.roots.iter().map(|r| r.0).collect();
    let tours = tours(&Forest::new(piece, &roots), radius);
    tours.iter().map(|t| t.out.iter().chain(&t.back).map(Segment::length).sum()).collect()
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
fn branches_are_travelled_there_and_back_without_a_jump_the_longest_first() {
    let mut piece = row(&[(0.0, 0.0), (3.0, 0.0), (7.0, 0.0)], &[0]);
    piece.places.push(Place { at: point(3.0, 3.0), reach: 0.0 });
    piece.ways.push(Way { ends: [1, 3], segment: Segment::line(point(3.0, 0.0), point(3.0, 3.0)) });
    let Tour { out, back } = tours(&Forest::new(&piece, &[0]), 1.0).remove(0);
    assert_eq!(out.last().unwrap().end(), point(6.0, 0.0));
    let tour = [out, back].concat();
    let (first, last): (Point, Point) = (tour[0].start(), tour[tour.len() - 1].end());
    assert_eq!((first, last), (Point::ORIGIN, Point::ORIGIN));
    assert!(tour.windows(2).all(|w| w[0].end() == w[1].start()));
    let length: f64 = tour.iter().map(Segment::length).sum();
    assert!((length - 16.0).abs() < 1e-12, "{length}");
}

/// Ends of the pair-wise engine's chains may be joined the long way round. Each was visited from there.
#[test]
fn a_place_that_is_served_on_the_way_is_not_visited_from_its_end() {
    let mut piece = row(&[(0.0, 0.0), (1.5, 0.0), (4.0, 0.0)], &[0]);
    piece.places.push(Place { at: point(1.5, 0.25), reach: 0.7 });
    piece.ways.push(Way { ends: [2, 3], segment: Segment::line(point(4.0, 0.0), point(1.5, 0.25)) });
    let length = lengths(&piece, 1.0)[0];
    assert!((length - 6.0).abs() < 1e-12, "{length}");
}

fn out_and_back(points: &[Point]) -> Vec<Segment> {
    let out: Vec<Segment> = points.windows(2).map(|w| Segment::line(w[0], w[1])).collect();
    out.iter().copied().chain(out.iter().rev().map(Segment::reversed)).collect()
}

fn within(about_loop: f64) -> Room {
    Room { about_loop, about_tour: 0.0 }
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
            let drop = drop_around(&tour, [before, after], 1.0, within(2.0))
                .unwrap_or_else(|| panic!("turn {turn}, aside {aside}"));
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
    let drop = drop_around(&diagonal, square, 1.0, within(1.01)).unwrap();
    let length: f64 = drop.iter().map(Segment::length).sum();
    let expected = (2.0 + 1.5 * PI) * FRAC_1_SQRT_2 / (1.0 + FRAC_1_SQRT_2);
    assert!((length - expected).abs() < 1e-12, "{length} {expected}");
    assert!(drop_around(&diagonal, square, 0.4, within(2.0)).is_none(), "its arc is wider than the tool");
    assert!(drop_around(&diagonal, square, 1.0, within(0.99)).is_none(), "it is longer than there is room");
    assert!(drop_around(&at(point(-0.5, -0.6)), square, 1.0, within(2.0)).is_none(), "it is not between the sides");
    let bent = out_and_back(&[point(0.0, 0.0), point(0.3, -0.3), point(0.5, -0.6)]);
    assert!(drop_around(&bent, square, 1.0, within(2.0)).is_some());
    let back = out_and_back(&[point(0.0, 0.0), point(0.5, -0.5), point(0.4, 0.2)]);
    assert!(drop_around(&back, square, 1.0, within(2.0)).is_none(), "it comes back over the side");
    let nothing: [Segment; 0] = [];
    assert!(drop_around(&nothing, [vec2(1.0, 0.0); 2], 1.0, within(1.0)).is_none());
}

/// A closed path with a corner at the origin, where its third side starts; each side next to it turns by `bend` in the middle.
fn cornered(turn: f64, bend: f64) -> Vec<Segment> {
    let mut vertices = vec![Point::ORIGIN];
    for (way, bent) in [(heading(180.0), heading(180.0 + bend)), (heading(turn), heading(turn - bend))] {
        let middle = Point::ORIGIN + way * 0.35;
        let side = [middle, middle + bent * 4.0];
        if way == heading(180.0) {
            vertices.splice(0..0, side.into_iter().rev());
        } else {
            vertices.extend(side);
        }
    }
    (0..vertices.len()).map(|k| Segment::line(vertices[k], vertices[(k + 1) % vertices.len()])).collect()
}

#[test]
fn a_bulge_leaves_nothing_that_its_loop_and_path_cut_and_is_smooth() {
    let mut made = 0;
    for turn in [10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 175.0] {
        for bend in [-8.0, 0.0, 8.0] {
            for free in [0.2, 2.0] {
                let loop_path = cornered(turn, bend);
                let corner = Corner {
                    loop_path: &loop_path,
                    segment: 2,
                    free,
                    radius: 1.0,
                    room: Room { about_loop: 0.0, about_tour: 1.0 },
                };
                let half = 0.5 * (180.0_f64 - turn).to_radians();
                let tip = Point::ORIGIN + heading(0.5 * turn - 90.0) * (1.0 / half.sin() - 1.0);
                let tour = out_and_back(&[Point::ORIGIN, tip]);
                let Some(bulge) = corner.bulge(&tour) else { continue };
                made += 1;
                let before = loop_path[..=bulge.from.segment].iter().copied();
                let mut new: Vec<Segment> = before.chain(bulge.path.iter().copied()).collect();
                new[bulge.from.segment] = new[bulge.from.segment].split_at(bulge.from.at).0;
                let after = new.len();
                new.extend(&loop_path[bulge.to.segment..]);
                new[after] = new[after].split_at(bulge.to.at).1;
                let name = format!("turn {turn}, bend {bend}, free {free}");
                assert!(new.windows(2).all(|w| w[0].end() == w[1].start()), "{name}: {new:?}");
                let joints = new[bulge.from.segment..=after].windows(2);
                let turns = joints.map(|w| w[0].end_tangent().dot(w[1].start_tangent()));
                assert!(turns.into_iter().all(|cos| cos > 1.0 - 1e-9), "{name}: {new:?}");
                let length = |path: &[Segment]| path.iter().map(Segment::length).sum::<f64>();
                assert!((length(&new) - length(&loop_path) - bulge.extra).abs() < 1e-9, "{name}");
                let distance =
                    |path: &[Segment], p: Point| path.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                let old = [loop_path.clone(), tour].concat();
                for (i, j) in (0..90).flat_map(|i| (0..90).map(move |j| (i, j))) {
                    let p = Point::ORIGIN + vec2(f64::from(i) / 15.0 - 3.0, f64::from(j) / 15.0 - 3.0);
                    let cut = distance(&old, p) > 1.0 || distance(&new, p) <= 1.0 + 1e-9;
                    assert!(cut, "{name}: {p:?} is {} off", distance(&new, p));
                }
            }
        }
    }
    assert!(made >= 25, "{made}");
}

#[test]
fn bulges_that_do_not_fit_are_not_made() {
    let loop_path = cornered(90.0, 0.0);
    let corner =
        |free: f64, far: f64| Corner { loop_path: &loop_path, segment: 2, free, radius: 1.0, room: within(far) };
    let outwards = heading(-45.0);
    let to = |p: Point| out_and_back(&[Point::ORIGIN, p]);
    let tip = Point::ORIGIN + outwards * 0.4;
    assert!(corner(1.0, 1.0).bulge(&to(tip)).is_some());
    assert!(corner(1.0, 0.39).bulge(&to(tip)).is_none(), "there is a wall");
    assert!(corner(0.0, 1.0).bulge(&to(tip)).is_none(), "others leave next to it");
    assert!(corner(1.0, 1.0).bulge(&to(Point::ORIGIN - outwards * 0.4)).is_none(), "it leads inside");
    assert!(corner(1.0, 2.0).bulge(&to(Point::ORIGIN + heading(60.0) * 0.9)).is_none(), "it leads aside");
    let reversed: Vec<Segment> = loop_path.iter().rev().map(Segment::reversed).collect();
    let inner = Corner { loop_path: &reversed, segment: reversed.len() - 2, free: 1.0, radius: 1.0, room: within(1.0) };
    assert_eq!(inner.loop_path[inner.segment].start(), Point::ORIGIN);
    assert!(inner.bulge(&to(tip)).is_none(), "the corner is none seen from the wall");
}

#[test]
fn a_circle_is_entered_and_left_along_the_loop() {
    let (along, foot) = (heading(20.0), point(1.0, 2.0));
    for (aside, room) in [(along.left(), within(0.0)), (along.right(), within(0.8))] {
        let tour = out_and_back(&[foot, foot + aside * 0.8]);
        let circle = circle_about(&tour, [along; 2], 0.41, room).unwrap();
        assert_eq!([circle[0].start(), circle[1].end()], [foot; 2]);
        assert_eq!(circle[0].end(), tour[0].end());
        assert!(circle[0].start_tangent().dot(along) > 1.0 - 1e-9 && circle[1].end_tangent().dot(along) > 1.0 - 1e-9);
        assert!(circle_about(&tour, [along; 2], 0.39, room).is_none(), "it is wider than the tool");
        assert!(circle_about(&tour, [along, heading(50.0)], 0.41, room).is_none(), "there is a corner");
        let slanted = out_and_back(&[foot, foot + aside * 0.7 + along * 0.3]);
        assert!(circle_about(&slanted, [along; 2], 0.41, room).is_none());
    }
    let outside = out_and_back(&[foot, foot + along.right() * 0.8]);
    assert!(circle_about(&outside, [along; 2], 0.41, within(0.79)).is_none(), "there is a wall");
}
