//! Stars, gears, combs and labyrinths with and without islands; copies; random regions.

use crate::corpus::{LIMIT, compare, well_formed};
use pocketry_geom::Contour;
use pocketry_geom::offset::{BisectorEngine, Offset, OffsetEngine, OffsetOptions, bisector};
use pocketry_testkit::corpus::region;
use pocketry_testkit::{Loops, Transform, shapes, strategies};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A star of straight points, and the same a little smaller as an island.
fn star(points: usize, islands: bool) -> Loops {
    let at = |scale: f64| {
        shapes::polar(2 * points, |t| {
            if ((t / TAU * 2.0 * points as f64).round() as usize).is_multiple_of(2) {
                20.0 * scale
            } else {
                9.0 * scale
            }
        })
    };
    if islands { vec![at(1.0), at(0.3)] } else { vec![at(1.0)] }
}

/// A gear of lines.
fn gear(islands: bool) -> Loops {
    let mut outline = shapes::gear(12, 18.0, 23.0);
    for v in &mut outline {
        v[2] = 0.0;
    }
    let holes = (0..4).map(|k| f64::from(k) * TAU / 4.0).map(|t| shapes::ngon(6, 3.0, [9.0 * t.cos(), 9.0 * t.sin()]));
    std::iter::once(outline).chain(holes.take(if islands { 4 } else { 0 })).collect()
}

/// A square spiral of channels 4 wide and walls 2 thick.
fn labyrinth(islands: bool) -> Loops {
    let (mut wall, mut inner) = (vec![[0.0, 0.0, 0.0]], Vec::new());
    let mut side = 60.0;
    let (mut x, mut y): (f64, f64) = (0.0, 0.0);
    for k in 0..12 {
        let (dx, dy) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][k % 4];
        (x, y) = (x + side * dx, y + side * dy);
        wall.push([x, y, 0.0]);
        // The other side of the channel, 4 to the left of this corner's two walls.
        inner.push([x - 4.0 * dx - 4.0 * dy, y - 4.0 * dy + 4.0 * dx, 0.0]);
        if k > 0 {
            side -= 6.0;
        }
    }
    let end = inner.len() - 1;
    wall.pop();
    let last = wall[wall.len() - 1];
    wall.push([last[0] + 4.0, last[1], 0.0]);
    inner.truncate(end - 1);
    let mut outline = wall;
    outline.extend(inner.iter().rev());
    outline.push([0.0, 4.0, 0.0]);
    if islands { vec![outline, shapes::ngon(5, 0.8, [20.0, 2.0])] } else { vec![outline] }
}

fn all() -> Vec<Loops> {
    let mut all = vec![
        vec![shapes::comb(5, 20.0)],
        vec![shapes::ngon(7, 10.0, [0.0; 2])],
        shapes::smooth_with_islands(400, false),
    ];
    for islands in [false, true] {
        all.extend([star(7, islands), star(16, islands), gear(islands), labyrinth(islands)]);
    }
    all.push(vec![shapes::comb(4, 9.0), vec![[2.3, 0.3, 0.0], [4.1, 0.3, 0.0], [4.1, 0.6, 0.0], [2.3, 0.6, 0.0]]]);
    all.push(shapes::die_cavity(700));
    all
}

#[test]
fn shapes_like_figure_12_agree_with_the_definition_and_the_peer() {
    for (k, loops) in all().iter().enumerate() {
        let outcome = compare(&region(loops).expect("a region"), &[0.1, 0.4, 0.5, 0.7, 1.3, 2.0, 3.7, 6.1]);
        assert_eq!(outcome.wrong, Vec::<String>::new(), "shape {k}");
    }
}

/// A circle of edges far shorter than the distance, on whose spikes stand mitres of up to ten distances.
fn noisy_circle(n: usize) -> Loops {
    let mut state = 1_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let radii: Vec<f64> = (0..n).map(|_| 50.0 - 2.0 * noise()).collect();
    vec![shapes::polar(n, |t| radii[(t / TAU * n as f64).round() as usize % n])]
}

/// The mitres leave small triangles between them, and from some distance on nothing.
#[test]
fn a_noisy_circle_keeps_the_loops_that_its_mitres_leave_and_no_others() {
    let region = region(&noisy_circle(1500)).expect("a region");
    let distances: Vec<f64> = (2..=12).map(f64::from).collect();
    let engine = BisectorEngine { mitre_limit: Some(LIMIT), ..BisectorEngine::default() };
    let offsets = engine.offsets(&region, &distances, &OffsetOptions::default()).expect("offsets");
    let counts: Vec<usize> = offsets.iter().map(|o| o.loops.len()).collect();
    assert!(counts[0] > 0 && counts.ends_with(&[0]), "from many loops to none: {counts:?}");
    assert_eq!(compare(&region, &distances).wrong, Vec::<String>::new());
}

fn area(offset: &Offset) -> f64 {
    offset.loops.iter().map(|l| l.contour.area()).sum()
}

fn length(offset: &Offset) -> f64 {
    offset.loops.iter().map(|l| l.contour.length()).sum()
}

fn straight(mut loops: Loops) -> Loops {
    for v in loops.iter_mut().flatten() {
        v[2] = 0.0;
    }
    loops
}

fn copies_agree(loops: &Loops, distance: f64) -> Result<(), String> {
    let plain = Transform::default();
    let engine = BisectorEngine::default();
    let at = |loops: &Loops, d: f64| {
        let region = region(loops).map_err(|e| e.to_string())?;
        engine.offsets(&region, &[d], &OffsetOptions::default()).map(|mut o| o.remove(0)).map_err(|e| e.to_string())
    };
    let found = at(loops, distance)?;
    for copy in [
        Transform { rotate: 0.3, ..plain },
        Transform { mirror: true, ..plain },
        Transform { reverse: true, start: 1, ..plain },
        Transform { translate: [1e4, -1e4], ..plain },
        Transform { scale: 1e2, ..plain },
    ] {
        let image = at(&copy.apply(loops), distance * copy.scale)?;
        well_formed(&image)?;
        let (off, by) =
            (area(&image) / copy.scale.powi(2) - area(&found), length(&image) / copy.scale - length(&found));
        if off.abs() > 1e-5 || by.abs() > 1e-3 {
            return Err(format!("{copy:?} at {distance}: area differs by {off}, length by {by}"));
        }
    }
    Ok(())
}

#[test]
fn copies_have_copies_of_the_offsets() {
    for loops in all() {
        for d in [0.3, 0.77, 1.9] {
            assert_eq!(copies_agree(&loops, d), Ok(()));
        }
    }
}

#[test]
fn every_start_vertex_gives_the_same_loops() {
    let loops = star(7, true);
    for start in 0..14 {
        let copy = Transform { start, ..Transform::default() }.apply(&loops);
        assert_eq!(copies_agree(&copy, 1.7), Ok(()));
    }
}

#[test]
fn what_remains_is_the_profile_of_the_next_offset() {
    let engine = BisectorEngine::default();
    let first = engine.offsets(&region(&star(7, true)).unwrap(), &[0.6, 1.3], &OffsetOptions::default()).unwrap();
    let next = engine.offsets(&bisector::remaining(&first[0]), &[0.7], &OffsetOptions::default()).unwrap();
    assert!((area(&next[0]) - area(&first[1])).abs() < 1e-6);
    assert!(first[0].loops.iter().map(|l| &l.contour).map(Contour::length).sum::<f64>() > 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_regions_agree_with_the_definition_and_the_peer(loops in strategies::region(), d in 0.05..3.0) {
        if let Ok(region) = region(&straight(loops)) {
            prop_assert_eq!(compare(&region, &[d, 1.7 * d]).wrong, Vec::<String>::new());
        }
    }

    #[test]
    fn copies_of_random_regions_agree(loops in strategies::star(), d in 0.1..2.0) {
        prop_assert_eq!(copies_agree(&loops, d), Ok(()));
    }
}
