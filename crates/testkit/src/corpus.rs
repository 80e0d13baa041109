//! Regions as JSON lines.

use pocketry_geom::repair::{self, RegionError, RepairOptions};
use pocketry_geom::{Contour, Region};
use serde::Deserialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Closed loops of vertices `[x, y, bulge]`, filled even-odd.
pub type Loops = Vec<Vec<[f64; 3]>>;

/// A line of a corpus file; further fields are ignored.
#[derive(Clone, Debug, Deserialize)]
pub struct Record {
    /// Its name.
    #[serde(default)]
    pub id: String,
    /// Radius of the tool meant for it, mm.
    #[serde(default)]
    pub tool_radius: f64,
    /// Tool-path interval meant for it, mm.
    #[serde(default)]
    pub interval: f64,
    /// Its boundary.
    pub loops: Loops,
}

/// The records of a file of JSON lines, or the one of a JSON file.
///
/// # Errors
/// A file that can't be read, or a line that is no record.
pub fn read(path: &Path) -> io::Result<Vec<Record>> {
    let text = fs::read_to_string(path)?;
    let lines = path.extension().is_some_and(|e| e == "jsonl");
    let parse = |text: &str| serde_json::from_str(text).map_err(io::Error::from);
    if lines { text.lines().filter(|l| !l.trim().is_empty()).map(parse).collect() } else { Ok(vec![parse(&text)?]) }
}

/// The region bounded by the loops.
///
/// # Errors
/// As [`repair::build`].
pub fn region(loops: &Loops) -> Result<Region, RegionError> {
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    repair::build(contours, &RepairOptions::default()).map(|healed| healed.region)
}

/// The folder of shared test data: `POCKETRY_SHARED`, or `../shared` beside the checkout; `None`, with a message,
/// where there is none.
pub fn shared() -> Option<PathBuf> {
    let beside = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared"));
    let folder = std::env::var_os("POCKETRY_SHARED").map_or_else(beside, PathBuf::from);
    let found = folder.is_dir();
    if !found {
        eprintln!("skipped: no shared test data at {}", folder.display());
    }
    found.then_some(folder)
}
