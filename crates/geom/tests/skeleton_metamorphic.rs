//! A skeleton does not depend on where, how large, which way round or which vertex first a region is drawn.

use pocketry_geom::Segment;
use pocketry_geom::offset::OffsetOptions;
use pocketry_geom::offset::voronoi::VoronoiOffsetter;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::check::CheckOptions;
use pocketry_testkit::{Loops, Transform, corpus, graph, shapes, strategies};
use proptest::prelude::*;

/// Builds and judges the skeleton of loops; gives it with the region's size.
fn skeleton(loops: &Loops) -> Result<(Skeleton, f64), String> {
    let region = corpus::region(loops).map_err(|e| e.to_string())?;
    let skeleton = Skeleton::build(&region).map_err(|e| e.to_string())?;
    let report = skeleton.check(&region, &CheckOptions::default());
    let fault = report.faults.first().map(|f| format!("{f}"));
    fault.map_or(Ok((skeleton, report.size)), Err)
}

/// The copies that a skeleton must not notice.
fn copies(loops: &Loops) -> Vec<(String, Transform)> {
    let plain = Transform::default();
    let mut all = vec![
        ("turned".to_string(), Transform { rotate: 0.3, ..plain }),
        ("mirrored".into(), Transform { mirror: true, ..plain }),
        ("reversed".into(), Transform { reverse: true, ..plain }),
        ("moved".into(), Transform { translate: [1e4, -1e4], ..plain }),
        ("smaller".into(), Transform { scale: 1e-2, ..plain }),
        ("larger".into(), Transform { scale: 1e2, ..plain }),
    ];
    let longest = loops.iter().map(Vec::len).max().unwrap_or(0);
    all.extend((1..longest).map(|start| (format!("from vertex {start}"), Transform { start, ..plain })));
    all
}

/// Offsets at shares of the largest clearance that no shape here has a pass or a peak at.
fn same_offsets(a: &Skeleton, b: &Skeleton, transform: &Transform, tolerance: f64) -> Result<(), String> {
    let (here, there) = (VoronoiOffsetter::new(a), VoronoiOffsetter::new(b));
    let deepest = a.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
    for share in [0.0917, 0.3371, 0.7713] {
        let d = share * deepest;
        let x = here.offset(d, &OffsetOptions::default()).map_err(|e| e.to_string())?;
        let y = there.offset(d * transform.scale, &OffsetOptions::default()).map_err(|e| e.to_string())?;
        if x.loops.len() != y.loops.len() {
            return Err(format!("{} loops at {d} became {}", x.loops.len(), y.loops.len()));
        }
        let images: Vec<Segment> = y.loops.iter().flat_map(|l| l.contour.segments.clone()).collect();
        for segment in x.loops.iter().flat_map(|l| &l.contour.segments) {
            for t in [0.0, 0.31, 0.62] {
                let p = transform.apply_point(segment.at(t));
                let off = images.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                if off > tolerance {
                    return Err(format!("offset at {d} is {off:.1e} off at ({}, {})", p.x, p.y));
                }
            }
        }
    }
    Ok(())
}

fn holds_for_all_copies(loops: &Loops) -> Result<(), String> {
    let (original, size) = skeleton(loops)?;
    for (name, transform) in copies(loops) {
        let (image, _) = skeleton(&transform.apply(loops)).map_err(|e| format!("{name}: {e}"))?;
        let tolerance = 1e-8 * size * transform.scale;
        graph::same(&original, &image, &transform, tolerance).map_err(|e| format!("{name}: {e}"))?;
        same_offsets(&original, &image, &transform, 10.0 * tolerance).map_err(|e| format!("{name}: {e}"))?;
    }
    Ok(())
}

/// Drawn with six decimals, so that arcs meet the lines beside them, and one another, all but smoothly.
#[test]
fn joints_that_rounding_has_bent() {
    let bent = 0.414_954_191;
    let chevron: Loops = vec![vec![
        [22.7875, 86.5875, -bent],
        [27.2125, 86.5875, 0.0],
        [50.0, 63.79375, 0.0],
        [72.7875, 86.5875, -0.999_999_985],
        [77.2125, 82.1625, 0.0],
        [52.2125, 57.1625, -bent],
        [47.7875, 57.1625, 0.0],
        [22.7875, 82.1625, -bent],
    ]];
    let ring: Loops = vec![
        vec![[50.0, 93.75, 1.0], [50.0, 43.75, 1.0]],
        vec![
            [18.75, 68.75, -0.650_214_682],
            [70.963_283, 91.925_096, -0.650_214_682],
            [53.125, 37.656_25, 0.0],
            [53.125, 25.0, 0.0],
            [46.875, 25.0, 0.0],
            [46.875, 37.656_25, -0.385_173_995],
        ],
    ];
    for loops in [chevron, ring] {
        if let Err(fault) = skeleton(&loops) {
            panic!("{fault}: {loops:?}");
        }
    }
}

/// Once wrong: a cusp judged by directions that rounding had crossed, an apex between circles with all but one centre, a
/// search that began at an unlucky corner, and feet compared across the gap of a wide arc.
#[test]
fn cusps_lenses_and_wide_arcs() {
    let heart: Loops = vec![vec![
        [-490.341_87, 346.555_761, -0.668_178_637_919_299_1],
        [-489.196_441, 346.057_645, 0.0],
        [-489.246_641, 343.190_141, -0.668_178_637_919_298_9],
        [-490.408_802, 342.732_422, 0.0],
        [-494.165_209, 346.622_694, -0.668_178_637_919_298_9],
        [-493.667_093, 347.768_122, 0.0],
        [-490.799_588, 347.717_923, -0.668_178_637_919_299_1],
    ]];
    let lens: Loops = vec![vec![[-415.0, -458.0, 0.999_999_998_75], [-367.0, -496.0, 0.999_999_998_75]]];
    let spiral: Loops = vec![vec![
        [-320.520_86, 402.788_331, 1.0],
        [-354.118_463, 448.267_92, 1.0],
        [-317.936_429, 399.289_901, 1.0],
        [-319.473_804, 401.370_977, -1.0],
        [-352.581_089, 446.186_844, -1.0],
        [-322.058_235, 404.869_407, 0.0],
    ]];
    let slot: Loops = vec![vec![
        [-187.0, 48.0, -2.730_072_27],
        [-139.0, 38.0, 0.0],
        [-144.0, 48.0, 2.730_072_27],
        [-177.0, 55.0, 0.0],
    ]];
    for loops in [heart, lens, spiral, slot] {
        if let Err(fault) = skeleton(&loops) {
            panic!("{fault}: {loops:?}");
        }
    }
}

#[test]
fn fixed_shapes() {
    let shapes: [(&str, Loops); 6] = [
        ("rounded rectangle", vec![shapes::rounded_rectangle(100.0, 60.0, 10.0)]),
        ("plate with a hole", vec![shapes::rounded_rectangle(100.0, 60.0, 10.0), shapes::circle(8.0, [30.0, 25.0])]),
        ("comb", vec![shapes::comb(5, 3.0)]),
        ("gear", vec![shapes::gear(9, 8.0, 10.0)]),
        ("polygon", vec![shapes::ngon(7, 5.0, [0.0; 2])]),
        ("polygons", vec![shapes::ngon(11, 9.0, [0.0; 2]), shapes::ngon(3, 2.0, [1.0, 2.0])]),
    ];
    let wrong: Vec<String> = shapes
        .iter()
        .filter_map(|(name, loops)| holds_for_all_copies(loops).err().map(|e| format!("{name}: {e}")))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_regions(loops in strategies::region(), rotate in 0.0..6.0, start in 0..20_usize, mirror: bool, reverse: bool) {
        let failed = |e: String| TestCaseError::fail(format!("{e}\n{loops:?}"));
        let (original, size) = skeleton(&loops).map_err(failed)?;
        let transform = Transform { rotate, start, mirror, reverse, translate: [40.0, -3.0], scale: 1.7 };
        let (image, _) = skeleton(&transform.apply(&loops)).map_err(failed)?;
        graph::same(&original, &image, &transform, 1e-7 * size).map_err(failed)?;
    }
}
