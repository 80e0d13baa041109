//! Regions as JSON lines.

use pocketry_geom::{Contour, Point, Region};
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
/// None yet.
pub fn region(loops: &Loops) -> Result<Region, String> {
    let contours: Vec<Contour> = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    let inside = |p: Point, c: &Contour| {
        // winding by angle sum over a fine flattening
        let mut pts = Vec::new();
        let tol = c.bbox().size() * 1e-6;
        for s in &c.segments {
            s.flatten(tol, &mut pts);
        }
        let mut odd = false;
        for k in 0..pts.len() {
            let (a, b) = (pts[k], pts[(k + 1) % pts.len()]);
            if (a.y > p.y) != (b.y > p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x {
                odd = !odd;
            }
        }
        odd
    };
    let boxes: Vec<_> = contours.iter().map(Contour::bbox).collect();
    let mut around: Vec<Vec<usize>> = Vec::new();
    for (k, c) in contours.iter().enumerate() {
        let p = c.segments[0].at(0.37);
        around
            .push((0..contours.len()).filter(|&j| j != k && boxes[j].contains(p) && inside(p, &contours[j])).collect());
    }
    let oriented = contours
        .iter()
        .enumerate()
        .map(|(k, c)| if (c.area() > 0.0) == (around[k].len() % 2 == 0) { c.clone() } else { c.reversed() })
        .collect();
    let parents = (0..contours.len())
        .map(|k| {
            let depth = around[k].len();
            (depth % 2 == 1)
                .then(|| around[k].iter().copied().find(|&j| around[j].len() == depth - 1).map(|j| j as u32))
                .flatten()
        })
        .collect();
    Ok(Region::from_parts_unchecked(oriented, parents))
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
