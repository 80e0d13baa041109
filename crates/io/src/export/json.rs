//! JSON of offsets: `{"units": "mm", "offsets": [{"distance", "loops": [[[x, y, bulge], ...], ...]}]}`.

use super::Sheet;
use serde::Serialize;

#[derive(Serialize)]
struct File {
    units: &'static str,
    offsets: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    loops: Vec<Vec<[f64; 3]>>,
}

/// Loops in the form of region JSON, one entry a sheet.
pub fn to_json(sheets: &[Sheet]) -> String {
    let entry = |s: &Sheet| Entry {
        distance: s.distance,
        loops: s.loops.iter().map(pocketry_geom::Contour::to_vertices).collect(),
    };
    let file = File { units: "mm", offsets: sheets.iter().map(entry).collect() };
    // Numbers, strings and lists only: this can't fail.
    let mut text = serde_json::to_string(&file).unwrap_or_default();
    text.push('\n');
    text
}
