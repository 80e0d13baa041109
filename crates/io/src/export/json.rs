//! JSON of offsets: `{"units": "mm", "offsets": [{"distance", "loops": [[[x, y, bulge], ...], ...]}]}`.

use super::Sheet;
use pocketry_geom::Region;
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

#[derive(Serialize)]
struct RegionLine<'a> {
    id: &'a str,
    units: &'static str,
    loops: Vec<Vec<[f64; 3]>>,
}

/// A region as one line of region JSON, as importers read it.
pub fn to_region_json(id: &str, region: &Region) -> String {
    let loops = region.contours().iter().map(pocketry_geom::Contour::to_vertices).collect();
    // Numbers, strings and lists only: this can't fail.
    let mut text = serde_json::to_string(&RegionLine { id, units: "mm", loops }).unwrap_or_default();
    text.push('\n');
    text
}
