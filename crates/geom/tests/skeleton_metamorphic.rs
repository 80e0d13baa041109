//! A skeleton does not depend on where, how large, which way round or which vertex first a region is drawn.

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

fn holds_for_all_copies(loops: &Loops) -> Result<(), String> {
    let (original, size) = skeleton(loops)?;
    for (name, transform) in copies(loops) {
        let (image, _) = skeleton(&transform.apply(loops)).map_err(|e| format!("{name}: {e}"))?;
        let tolerance = 1e-8 * size * transform.scale;
        graph::same(&original, &image, &transform, tolerance).map_err(|e| format!("{name}: {e}"))?;
    }
    Ok(())
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
        let (original, size) = skeleton(&loops).map_err(TestCaseError::fail)?;
        let transform = Transform { rotate, start, mirror, reverse, translate: [40.0, -3.0], scale: 1.7 };
        let (image, _) = skeleton(&transform.apply(&loops)).map_err(TestCaseError::fail)?;
        graph::same(&original, &image, &transform, 1e-7 * size).map_err(TestCaseError::fail)?;
    }
}
