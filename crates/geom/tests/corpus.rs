//! Regions of the shared corpus, where it is at hand: every one must build, with the area that its record says.

use pocketry_geom::repair::{Healed, Note, RegionError, RepairOptions, build};
use pocketry_geom::{Contour, Region};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Areas in the records are those of flattened regions.
const AREA_TOLERANCE: f64 = 5e-4;

fn corpus() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let shared = std::env::var_os("POCKETRY_SHARED").map_or_else(beside, PathBuf::from);
    let corpus = shared.join("corpus/dev");
    if corpus.is_dir() {
        return Some(corpus);
    }
    eprintln!("skipped: no corpus at {}", corpus.display());
    None
}

fn records(file: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(file).unwrap();
    text.lines().filter(|l| !l.trim().is_empty()).map(|l| serde_json::from_str(l).unwrap()).collect()
}

fn loops(record: &Value) -> Vec<Contour> {
    let vertices = |l: &Value| -> Vec<[f64; 3]> { serde_json::from_value(l.clone()).unwrap() };
    record["loops"].as_array().unwrap().iter().map(|l| Contour::from_vertices(&vertices(l))).collect()
}

fn heal(record: &Value) -> Result<Healed, RegionError> {
    build(loops(record), &RepairOptions::default())
}

fn assert_invariants(region: &Region, id: &str) {
    for (k, contour) in region.contours().iter().enumerate() {
        let segments = &contour.segments;
        assert!(segments.len() > 1, "{id}: contour {k} has one segment");
        for (j, s) in segments.iter().enumerate() {
            assert!(s.start() != s.end() && s.is_finite(), "{id}: contour {k} segment {j}");
            assert_eq!(s.end(), segments[(j + 1) % segments.len()].start(), "{id}: contour {k} segment {j}");
        }
        let parent = region.parents()[k];
        assert_eq!(parent.is_none(), contour.area() > 0.0, "{id}: contour {k} {}", contour.area());
        assert!(parent.is_none_or(|p| region.parents()[p as usize].is_none()), "{id}: contour {k}");
    }
}

#[test]
fn every_region_of_the_corpus_builds_with_its_area() {
    let Some(corpus) = corpus() else { return };
    let mut failures = Vec::new();
    for family in ["param", "adversarial", "icons", "glyphs", "geo", "pcb", "mesh", "issues"] {
        for record in records(&corpus.join(format!("{family}.jsonl"))) {
            let id = record["id"].as_str().unwrap().to_owned();
            match heal(&record) {
                Err(e) => failures.push(format!("{id}: {e}")),
                Ok(healed) => {
                    assert_invariants(&healed.region, &id);
                    let expected = record["area"].as_f64().unwrap_or(f64::NAN);
                    let area = healed.region.area();
                    if (area - expected).abs() > AREA_TOLERANCE * expected {
                        failures.push(format!("{id}: area {area} instead of {expected}; {:?}", healed.notes.first()));
                    }
                    if std::env::var_os("POCKETRY_NOTES").is_some() && !healed.notes.is_empty() {
                        println!("{id}: {} notes, {}", healed.notes.len(), healed.notes[0]);
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// Loops that cross, touch or overlap: a region or a refusal, never a panic, and a region's area is the even-odd one
/// where nothing was drawn twice.
#[test]
fn raw_loops_become_regions_or_are_refused() {
    let Some(corpus) = corpus() else { return };
    let (mut built, mut refused) = (0, 0);
    for record in records(&corpus.join("raw.jsonl")) {
        let id = record["id"].as_str().unwrap();
        match heal(&record) {
            Ok(healed) => {
                built += 1;
                assert_invariants(&healed.region, id);
                assert!(!healed.notes.is_empty(), "{id} needs healing");
                let (area, expected) = (healed.region.area(), record["area_fill_rule"].as_f64().unwrap());
                let repeats = healed.notes.iter().any(|n| matches!(n, Note::Duplicate { .. }));
                assert!(
                    repeats || (area - expected).abs() < 2e-3 * expected,
                    "{id}: area {area} instead of {expected}"
                );
            }
            Err(e) => {
                refused += 1;
                assert!(matches!(e, RegionError::Crossing { .. } | RegionError::Nothing { .. }), "{id}: {e}");
            }
        }
    }
    println!("{built} built, {refused} refused");
    assert_eq!(built + refused, 82);
}
