//! What a round tool leaves, against brute force: depths against points all over the region and the offset's lines and arcs,
//! areas against clipper2's opening of the flattened region, and both wherever and however a region is drawn.

use clipper2_rust::clipper::inflate_paths_64;
use clipper2_rust::core::{Paths64, Point64, area as path_area};
use clipper2_rust::offset::{EndType, JoinType};
use pocketry_geom::distance::Boundary;
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::leftover::{Kind, Leftover, Reach};
use pocketry_geom::offset::{Degenerate, OffsetOptions, VoronoiOffsetter};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Point, Region, Segment, point};
use pocketry_testkit::{Loops, Transform, corpus, shapes, strategies};
use proptest::prelude::*;

/// Points along each side of a region's box.
const SAMPLES: u32 = 60;
/// Chords may lie this far from arcs in the polygons that clipper2 gets, relative to the region's size.
const FLATTENING: f64 = 1e-5;
/// Steps of its grid in the region's size.
const STEPS: f64 = 1e9;

fn region(loops: &Loops) -> Region {
    corpus::region(loops).expect("a valid region")
}

fn widest(skeleton: &Skeleton) -> f64 {
    skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max)
}

/// Where the axis gets to at most: the lines and arcs of the offset.
fn axis(skeleton: &Skeleton, radius: f64) -> Vec<Segment> {
    let options = OffsetOptions { degenerate: Degenerate::Keep };
    let offset = VoronoiOffsetter::new(skeleton).offset(radius, &options).unwrap();
    let mut axis: Vec<Segment> = offset.loops.into_iter().flat_map(|l| l.contour.segments).collect();
    for path in offset.degenerate {
        axis.push(Segment::line(path.start, path.start));
        axis.extend(path.tour);
    }
    axis
}

/// Whether the way between two points of the region stays in it.
fn sees(boundary: &Boundary, a: Point, b: Point) -> bool {
    (1..64).all(|k| boundary.signed_distance(a.lerp(b, f64::from(k) / 64.0)) > 0.0)
}

/// The largest depth is no less than that of any point, and no more than that of its own place.
fn assert_depths(region: &Region, radius: f64) {
    let skeleton = Skeleton::build(region).unwrap();
    let found = Leftover::new(&skeleton, Reach::of(radius)).unwrap();
    let axis = axis(&skeleton, radius);
    assert_eq!(axis.is_empty(), found.pieces.iter().all(|p| p.kind == Kind::Pocket) && !found.pieces.is_empty());
    if axis.is_empty() || found.pockets().next().is_some() {
        return;
    }
    let (index, boundary) = (SegmentIndex::new(&axis), Boundary::new(region));
    let largest = found.deepest().map_or(0.0, |d| d.size);
    let slack = 1e-4 * radius;
    let bbox = region.bbox();
    for (i, j) in (0..=SAMPLES).flat_map(|i| (0..=SAMPLES).map(move |j| (i, j))) {
        let share = |k: u32| f64::from(k) / f64::from(SAMPLES);
        let p = point(bbox.min.x + share(i) * bbox.width(), bbox.min.y + share(j) * bbox.height());
        if (0.0..radius).contains(&boundary.signed_distance(p)) {
            let depth = index.nearest(p).unwrap().1 - radius;
            assert!(depth <= largest + slack, "depth {depth} at {p:?} with radius {radius}, largest found {largest}");
        }
    }
    if let Some(d) = found.deepest() {
        for q in axis.iter().flat_map(|s| (0..=32).map(|k| s.at(f64::from(k) / 32.0))) {
            // Offsets keep the ends of corners with just too little clearance.
            let nearer = q.distance(d.at) < radius + d.size - 1e-2 * radius;
            assert!(!(nearer && sees(&boundary, d.at, q)), "{q:?} is nearer to {d:?} than {}", radius + d.size);
        }
    }
}

/// The area that is left, from clipper2's opening.
fn clipped(region: &Region, radius: f64) -> f64 {
    let (bbox, scale) = (region.bbox(), STEPS / region.bbox().size());
    let snap = |p: &Point| {
        let v = (*p - bbox.center()) * scale;
        Point64::new(v.x.round() as i64, v.y.round() as i64)
    };
    let paths: Paths64 = region
        .contours()
        .iter()
        .map(|c| {
            let mut points = Vec::new();
            c.segments.iter().for_each(|s| s.flatten(FLATTENING * bbox.size(), &mut points));
            points.iter().map(snap).collect()
        })
        .collect();
    let round = |paths: &Paths64, by: f64| {
        inflate_paths_64(paths, by * scale, JoinType::Round, EndType::Polygon, 2.0, FLATTENING * STEPS)
    };
    let opening = round(&round(&paths, -radius), radius);
    let area = |paths: &Paths64| paths.iter().map(path_area).sum::<f64>() / (scale * scale);
    area(&paths) - area(&opening)
}

fn assert_area(region: &Region, radius: f64) {
    let skeleton = Skeleton::build(region).unwrap();
    let found = Leftover::new(&skeleton, Reach::of(radius)).unwrap();
    let length: f64 = region.segments().map(Segment::length).sum();
    let allowed = 4.0 * FLATTENING * region.bbox().size() * length;
    let clipped = clipped(region, radius);
    let off = (found.area() - clipped).abs();
    assert!(off <= allowed, "left {}, by clipper2 {clipped}, radius {radius}", found.area());
}

/// Radii as shares of the largest clearance, none of which is that of a channel by construction.
fn radii(region: &Region) -> Vec<f64> {
    let widest = widest(&Skeleton::build(region).unwrap());
    [0.083, 0.31, 0.57, 0.79, 0.97].iter().map(|share| share * widest).collect()
}

/// Shapes with an answer of every kind: arcs against lines, islands, channels of constant width, narrow hubs.
fn special() -> Vec<Loops> {
    let plate = shapes::rounded_rectangle(30.0, 20.0, 2.0);
    let ring = vec![shapes::circle(10.0, [0.0; 2]), shapes::circle(4.0, [0.5, 0.0])];
    let labyrinth = vec![shapes::comb(6, 5.0)];
    let bosses = vec![
        plate.clone(),
        shapes::circle(4.0, [8.0, 10.0]),
        shapes::circle(3.0, [16.5, 9.0]),
        shapes::ngon(5, 3.0, [24.0, 11.0]),
    ];
    let hub = vec![shapes::polar(6, |t| if (3.0 * t).cos() > 0.0 { 10.0 } else { 0.9 })];
    vec![vec![plate], ring, labyrinth, bosses, hub, vec![shapes::gear(9, 8.0, 10.0)]]
}

#[test]
fn special_shapes_agree_with_brute_force() {
    for loops in special() {
        let region = region(&loops);
        for radius in radii(&region) {
            assert_depths(&region, radius);
            assert_area(&region, radius);
        }
    }
}

proptest! {
    #[test]
    fn depths_are_those_of_brute_force(loops in strategies::region(), which in 0..5_usize) {
        let region = region(&loops);
        assert_depths(&region, radii(&region)[which]);
    }

    #[test]
    fn areas_are_those_of_an_opening(loops in strategies::region(), which in 0..5_usize) {
        let region = region(&loops);
        assert_area(&region, radii(&region)[which]);
    }

    #[test]
    fn similar_regions_leave_similar_material(
        loops in strategies::region(),
        which in 0..5_usize,
        (mirror, rotate, reverse) in (prop::bool::ANY, 0.0..6.0, prop::bool::ANY),
        (scale, start) in (0.1..1.0, 0..9_usize),
    ) {
        // With radii up to 1 mm what counts as passable is in proportion.
        let loops = Transform { scale: 0.1, ..Transform::default() }.apply(&loops);
        let to = Transform { mirror, rotate, scale, translate: [3.0, -7.0], reverse, start };
        let radius = radii(&region(&loops))[which];
        let [a, b] = [(loops.clone(), radius), (to.apply(&loops), radius * scale)].map(|(loops, radius)| {
            Leftover::new(&Skeleton::build(&region(&loops)).unwrap(), Reach::of(radius)).unwrap()
        });
        let exact = 1e-6 * radius.max(0.1);
        let areas = [a.area() * scale * scale, b.area()];
        prop_assert!((areas[0] - areas[1]).abs() <= exact * radius * scale * scale + 1e-7 * areas[1], "{areas:?}");
        let depth = |l: &Leftover| l.deepest().map_or(0.0, |d| d.size);
        let depths = [depth(&a) * scale, depth(&b)];
        prop_assert!((depths[0] - depths[1]).abs() <= exact * scale, "{depths:?} {:?} {:?}", a.deepest(), b.deepest());
        prop_assert_eq!(a.necks().count(), b.necks().count());
    }
}
