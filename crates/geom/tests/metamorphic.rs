//! What must not change a region: direction, start and order of the loops; rotation and mirroring turn it along.

use pocketry_geom::repair::{Note, RepairOptions, build};
use pocketry_geom::{Arc, Contour, Point, Region, Segment, Vec2, point, vec2};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A star-shaped loop around the origin with straight and round edges, no two of them crossing.
fn blob(count: usize, radius: f64, wobble: &[f64]) -> Vec<[f64; 3]> {
    (0..count)
        .map(|k| {
            let w = wobble[k % wobble.len()];
            let direction = Vec2::from_angle(TAU * k as f64 / count as f64) * (radius * (0.8 + 0.2 * w));
            [direction.x, direction.y, if k % 3 == 0 { 0.1 * w } else { 0.0 }]
        })
        .collect()
}

fn circle(x: f64, y: f64, r: f64) -> Contour {
    Contour::from_vertices(&[[x - r, y, 1.0], [x + r, y, 1.0]])
}

/// A wall with nested loops, an island that touches it and two that touch each other.
fn drawing(count: usize, wobble: &[f64]) -> Vec<Contour> {
    let wall = [[-100.0, -100.0, 0.0], [100.0, -100.0, 0.0], [100.0, 100.0, 0.0], [-100.0, 100.0, 0.0]];
    let mut loops = vec![Contour::from_vertices(&wall)];
    loops.extend([50.0, 20.0, 10.0].map(|r| Contour::from_vertices(&blob(count, r, wobble))));
    loops.extend([circle(75.0, -90.0, 10.0), circle(-80.0, 80.0, 5.0), circle(-70.0, 80.0, 5.0)]);
    loops
}

fn region(loops: Vec<Contour>) -> (Region, Vec<Note>) {
    let healed = build(loops, &RepairOptions::default()).unwrap();
    (healed.region, healed.notes)
}

/// What stays the same: numbers of contours, edges and islands, area, length.
fn assert_alike(a: &Region, b: &Region) {
    let islands = |r: &Region| {
        let mut counts: Vec<usize> = r.pockets().iter().map(|p| p.islands.len()).collect();
        counts.sort_unstable();
        counts
    };
    let sizes = |r: &Region| {
        let mut sizes: Vec<(usize, i64)> =
            r.contours().iter().map(|c| (c.segments.len(), (c.area() * 1e4).round() as i64)).collect();
        sizes.sort_unstable();
        sizes
    };
    assert_eq!(islands(a), islands(b));
    for (x, y) in sizes(a).into_iter().zip(sizes(b)) {
        assert!(x.0 == y.0 && (x.1 - y.1).abs() <= 1, "{x:?} {y:?}");
    }
    assert_eq!(a.contours().len(), b.contours().len());
    let length = |r: &Region| r.contours().iter().map(Contour::length).sum::<f64>();
    assert!((length(a) - length(b)).abs() < 1e-7);
}

fn mapped(loops: &[Contour], map: impl Fn(Point) -> Point, mirrored: bool) -> Vec<Contour> {
    let segment = |s: &Segment| match *s {
        Segment::Line(l) => Segment::line(map(l.start), map(l.end)),
        Segment::Arc(a) => Segment::Arc(Arc {
            start: map(a.start),
            end: map(a.end),
            center: map(a.center),
            ccw: a.ccw != mirrored,
            ..a
        }),
    };
    loops.iter().map(|c| Contour::new(c.segments.iter().map(segment).collect())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn direction_start_and_order_do_not_matter(
        count in 5_usize..20, wobble in prop::collection::vec(-1.0..1.0_f64, 3..9),
        reverse in prop::collection::vec(any::<bool>(), 7), start in 0_usize..40, turn in 0_usize..7,
    ) {
        let loops = drawing(count, &wobble);
        let (expected, notes) = region(loops.clone());
        prop_assert_eq!(notes.len(), 2);
        let mut changed: Vec<Contour> = loops
            .into_iter()
            .zip(&reverse)
            .map(|(c, &r)| {
                let mut c = if r { c.reversed() } else { c };
                let n = c.segments.len();
                c.segments.rotate_left(start % n);
                c
            })
            .collect();
        changed.rotate_left(turn);
        assert_alike(&expected, &region(changed).0);
    }

    #[test]
    fn rotation_mirror_and_translation_turn_the_region_along(
        count in 5_usize..20, wobble in prop::collection::vec(-1.0..1.0_f64, 3..9), angle in -PI..PI,
    ) {
        let loops = drawing(count, &wobble);
        let expected = region(loops.clone()).0;
        for angle in [angle, FRAC_PI_2, PI] {
            let rotated = mapped(&loops, |p| p.to_vec().rotated(angle).to_point(), false);
            assert_alike(&expected, &region(rotated).0);
        }
        assert_alike(&expected, &region(mapped(&loops, |p| point(p.x, -p.y), true)).0);
        assert_alike(&expected, &region(mapped(&loops, |p| point(p.y, p.x), true)).0);
        assert_alike(&expected, &region(mapped(&loops, |p| p + vec2(1e4, -3e3), false)).0);
    }

    #[test]
    fn a_point_is_inside_by_the_parity_of_the_loops(
        count in 5_usize..20, wobble in prop::collection::vec(-1.0..1.0_f64, 3..9),
        x in -110.0..110.0_f64, y in -110.0..110.0_f64,
    ) {
        let loops = drawing(count, &wobble);
        let alone = |c: &Contour| region(vec![c.clone()]).0.contains(point(x, y));
        let parity = loops.iter().filter(|c| alone(c)).count() % 2 == 1;
        let region = region(loops).0;
        prop_assert_eq!(region.contains(point(x, y)), parity);
        let inside = |c: &Contour| Region::from_parts_unchecked(vec![c.clone()], vec![None]).contains(point(x, y));
        let pocketed = region.pockets().iter().any(|p| {
            let of = |k: u32| inside(&region.contours()[k as usize]);
            of(p.outer) && !p.islands.iter().any(|&k| of(k))
        });
        prop_assert_eq!(pocketed, parity);
    }
}

/// Loops on a coarse grid: full of touches, shared edges, spikes and crossings.
fn grid_loop() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let bulge = prop_oneof![4 => Just(0.0), 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(0.5), 1 => Just(-0.414_213_562_373_095_03)];
    prop::collection::vec((0_i32..6, 0_i32..6, bulge), 2..7)
        .prop_map(|v| v.into_iter().map(|(x, y, b)| [f64::from(x), f64::from(y), b]).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn loops_on_a_grid_are_refused_or_keep_their_parity(
        loops in prop::collection::vec(grid_loop(), 1..4), points in prop::collection::vec((-1.0..7.0_f64, -1.0..7.0_f64), 20),
    ) {
        let loops: Vec<Contour> = loops.iter().map(|l| Contour::from_vertices(l)).collect();
        let Ok(healed) = build(loops.clone(), &RepairOptions::default()) else { return Ok(()) };
        let region = healed.region;
        for (contour, parent) in region.contours().iter().zip(region.parents()) {
            let n = contour.segments.len();
            prop_assert!(n > 1);
            for (k, s) in contour.segments.iter().enumerate() {
                prop_assert!(s.start() != s.end());
                prop_assert_eq!(s.end(), contour.segments[(k + 1) % n].start());
            }
            prop_assert_eq!(parent.is_none(), contour.area() > 0.0, "{:?}", contour);
        }
        if healed.notes.iter().any(|n| matches!(n, Note::Duplicate { .. })) {
            return Ok(());
        }
        let raw = Region::from_parts_unchecked(loops.clone(), vec![None; loops.len()]);
        for p in points.into_iter().map(|(x, y)| point(x, y)) {
            if raw.segments().all(|s| s.distance(p) > 1e-3) {
                prop_assert_eq!(region.contains(p), raw.contains(p), "{:?}", p);
            }
        }
    }
}
