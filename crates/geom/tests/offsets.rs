//! Every offset engine on random regions: exact distances, closed and nested loops that do not cross, and the same offsets
//! wherever and however a region is drawn.

use pocketry_geom::distance::{Boundary, between};
use pocketry_geom::offset::{Offset, OffsetEngine, OffsetOptions, PairwiseEngine, VoronoiEngine};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::check::CheckOptions;
use pocketry_geom::{Point, Region, Segment};
use pocketry_testkit::{Loops, Transform, corpus, shapes, strategies};
use proptest::prelude::*;

/// How far a point of an offset may be off, relative to the region's size.
const ACCURACY: f64 = 1e-7;

fn engines() -> Vec<Box<dyn OffsetEngine>> {
    vec![Box::new(VoronoiEngine), Box::new(PairwiseEngine)]
}

fn region(loops: &Loops) -> Region {
    corpus::region(loops).expect("a valid region")
}

/// Shares of the largest clearance that are tried.
fn distances(region: &Region) -> Vec<f64> {
    let skeleton = Skeleton::build(region).expect("a skeleton");
    let highest = skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
    [0.03, 0.2, 0.45, 0.71, 0.96].iter().map(|share| share * highest).collect()
}

/// Whether the skeleton is right: its own tests judge that; here it is taken for granted.
fn sound(region: &Region) -> bool {
    Skeleton::build(region).is_ok_and(|s| s.check(region, &CheckOptions::default()).is_ok())
}

fn offsets(engine: &dyn OffsetEngine, region: &Region, distances: &[f64]) -> Result<Vec<Offset>, String> {
    engine.offsets(region, distances, &OffsetOptions::default()).map_err(|e| e.to_string())
}

fn exact(offset: &Offset, walls: &Boundary, tolerance: f64) -> Result<(), String> {
    for s in offset.loops.iter().flat_map(|l| &l.contour.segments) {
        for p in (0..=6).map(|k| s.at(f64::from(k) / 6.0)) {
            let off = (walls.distance(p) - offset.distance).abs();
            if off > tolerance || !walls.contains(p) {
                return Err(format!("at distance {}: {p:?} of {s:?} is off by {off}", offset.distance));
            }
        }
    }
    Ok(())
}

fn closed(offset: &Offset) -> Result<(), String> {
    for l in &offset.loops {
        let s = &l.contour.segments;
        if s.len() < 2 || (0..s.len()).any(|k| s[k].end() != s[(k + 1) % s.len()].start()) {
            return Err(format!("a loop at distance {} is open", offset.distance));
        }
    }
    Ok(())
}

/// Segments that are not neighbours keep apart.
fn simple(offset: &Offset) -> Result<(), String> {
    let all: Vec<(usize, usize, usize, &Segment)> = offset
        .loops
        .iter()
        .enumerate()
        .flat_map(|(l, c)| c.contour.segments.iter().enumerate().map(move |(k, s)| (l, k, c.contour.segments.len(), s)))
        .collect();
    for (i, a) in all.iter().enumerate() {
        for b in &all[i + 1..] {
            let neighbours = a.0 == b.0 && ((a.1 + 1) % a.2 == b.1 || (b.1 + 1) % a.2 == a.1);
            if !neighbours && between(a.3, b.3) == 0.0 {
                return Err(format!("at distance {}: {:?} crosses {:?}", offset.distance, a.3, b.3));
            }
        }
    }
    Ok(())
}

/// What the loops enclose: the area, which nesting and orientation decide, and the length.
fn measure(offset: &Offset) -> (f64, f64) {
    let sum = |f: &dyn Fn(&pocketry_geom::Contour) -> f64| offset.loops.iter().map(|l| f(&l.contour)).sum::<f64>();
    (sum(&pocketry_geom::Contour::area), sum(&pocketry_geom::Contour::length))
}

fn holds(loops: &Loops) -> Result<(), String> {
    let region = region(loops);
    if !sound(&region) {
        return Ok(());
    }
    let (walls, size, at) = (Boundary::new(&region), region.bbox().size(), distances(&region));
    let arcs = region.segments().any(|s| matches!(s, Segment::Arc(_)));
    for engine in engines() {
        let chords = if arcs && engine.name() == "pairwise" { PairwiseEngine::chord_tolerance(at[0]) } else { 0.0 };
        let found = offsets(&*engine, &region, &at)?;
        for (k, offset) in found.iter().enumerate() {
            closed(offset)?;
            exact(offset, &walls, ACCURACY * size + chords)?;
            simple(offset)?;
            let area = measure(offset).0;
            let before = k.checked_sub(1).map_or(region.area(), |j| measure(&found[j]).0);
            if !(area > 0.0 && area < before) {
                return Err(format!("area {area} at distance {} inside {before}", offset.distance));
            }
        }
        if chords > 0.0 {
            // Chords lie elsewhere on every copy.
            continue;
        }
        copies_agree(&*engine, loops, &found, &at, size)?;
    }
    Ok(())
}

/// Copies of the region have copies of the offsets: every point of each lies on the other.
fn copies_agree(
    engine: &dyn OffsetEngine,
    loops: &Loops,
    found: &[Offset],
    at: &[f64],
    size: f64,
) -> Result<(), String> {
    let plain = Transform::default();
    let copies = [
        Transform { rotate: 0.3, ..plain },
        Transform { mirror: true, ..plain },
        Transform { reverse: true, start: 1, ..plain },
        Transform { translate: [1e4, -1e4], ..plain },
        Transform { scale: 1e2, ..plain },
    ];
    for copy in copies {
        let scaled: Vec<f64> = at.iter().map(|d| d * copy.scale).collect();
        let region = region(&copy.apply(loops));
        if !sound(&region) {
            continue;
        }
        let images = offsets(engine, &region, &scaled)?;
        let (walls, tolerance) = (Boundary::new(&region), ACCURACY * size * copy.scale);
        for (offset, image) in found.iter().zip(&images) {
            exact(image, &walls, tolerance).map_err(|e| format!("{copy:?}: {e}"))?;
            let points = offset.loops.iter().flat_map(|l| &l.contour.segments).map(|s| copy.apply_point(s.at(0.5)));
            let miss = |p: Point| image.loops.iter().map(|l| l.contour.distance(p)).fold(f64::INFINITY, f64::min);
            if offset.loops.len() != image.loops.len() {
                return Err(format!("{copy:?}: {} loops, not {}", image.loops.len(), offset.loops.len()));
            }
            if let Some(p) = points.into_iter().find(|p| miss(*p) > tolerance) {
                return Err(format!("{copy:?}: {p:?} is missed by {} at distance {}", miss(p), image.distance));
            }
        }
    }
    Ok(())
}

#[test]
fn shapes_have_exact_offsets() {
    for loops in [
        vec![shapes::rounded_rectangle(40.0, 25.0, 4.0)],
        vec![shapes::comb(5, 20.0)],
        vec![shapes::gear(14, 20.0, 25.0)],
        shapes::smooth_with_islands(120, true),
    ] {
        holds(&loops).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn random_regions_have_exact_offsets(loops in strategies::region()) {
        prop_assert_eq!(holds(&loops), Ok(()));
    }
}

/// Once both branches of the bisector, which run from apex to apex, were taken to lie on one side.
#[test]
fn eccentric_rings_have_both_halves() {
    for shift in [0.1, 3.0, 16.0] {
        let circle = |y: f64, r: f64| vec![[0.0, y - r, 1.0], [0.0, y + r, 1.0]];
        let loops = vec![circle(0.0, 99.0), circle(shift, 73.0)];
        holds(&loops).unwrap();
        let offset = VoronoiEngine.offsets(&region(&loops), &[15.0], &OffsetOptions::default()).unwrap();
        for l in &offset[0].loops {
            let b = l.contour.bbox();
            assert!((b.min.x + b.max.x).abs() < 1e-9, "{shift}: {b:?}");
        }
    }
}
