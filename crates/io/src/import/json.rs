//! Region JSON, `{"id", "units", "tool_radius", "interval", "loops": [[[x, y, bulge], ...], ...]}`, and lines of it.
//!
//! Loops are closed, their last point is not repeated, the fill is even-odd; `bulge` is the tangent of a quarter of the
//! edge's sweep, positive to the left. Further fields are ignored.

use super::affine::Affine;
use super::curve::Curve;
use super::error::{FaultKind, ImportError, Place};
use super::sketch::{Sketch, Source};
use super::units::Units;
use super::{Drawing, ImportOptions, assemble, read_bytes};
use pocketry_geom::{Point, point, tolerance};
use serde::Deserialize;
use std::path::Path;

/// More loops than this around a region is no job but a mistake.
const MAX_OFFSETS: f64 = 1e6;

#[derive(Deserialize)]
struct Record {
    id: Option<String>,
    units: Option<String>,
    tool_radius: Option<f64>,
    interval: Option<f64>,
    loops: Vec<Vec<[f64; 3]>>,
}

#[derive(Deserialize)]
struct Name {
    id: Option<String>,
}

/// One line of a batch, not yet read as a region.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BatchLine {
    /// Its number in the file, from 1.
    pub line: usize,
    /// Its `id`, where it has one that can be read.
    pub id: Option<String>,
    /// The line itself.
    pub text: String,
}

/// Reads the lines of a batch file; empty ones are left out. A line that is no region shows only when it is parsed.
///
/// # Errors
/// [`ImportError::Io`] where the file can't be read; a limit where it is absurdly large.
pub fn read_batch(path: &Path) -> Result<Vec<BatchLine>, ImportError> {
    let bytes = read_bytes(path)?;
    let lines = bytes.split(|&b| b == b'\n').enumerate().filter(|(_, line)| !line.trim_ascii().is_empty());
    Ok(lines
        .map(|(k, line)| {
            let text = String::from_utf8_lossy(line.trim_ascii()).into_owned();
            let id = serde_json::from_str::<Name>(&text).ok().and_then(|name| name.id);
            BatchLine { line: k + 1, id, text }
        })
        .collect())
}

/// A region from its JSON text.
///
/// # Errors
/// [`ImportError::Bad`] where the text is no region.
pub fn parse_region_json(text: &str, options: &ImportOptions) -> Result<Drawing, ImportError> {
    options.check()?;
    parse(text.as_bytes(), options)
}

pub(super) fn parse(bytes: &[u8], options: &ImportOptions) -> Result<Drawing, ImportError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let record: Record = serde_json::from_slice(bytes).map_err(|e| {
        let place = if e.line() > 0 { Place::line(e.line()) } else { Place::default() };
        let hint = "a region is {\"units\": \"mm\", \"loops\": [[[x, y, bulge], ...], ...]}";
        ImportError::new(FaultKind::Syntax, place, format!("not region JSON: {e}"), hint)
    })?;
    if !options.layers.is_empty() {
        let problem = format!("region JSON has no layers, {:?} was asked for", options.layers.join(", "));
        return Err(ImportError::new(FaultKind::Layer, Place::default(), problem, "leave the layer out"));
    }
    let units = match (options.units, &record.units) {
        (Some(units), _) => units,
        (None, Some(name)) => name.parse::<Units>()?,
        (None, None) => Units::MILLIMETER,
    };
    let scale = units.millimeters();
    let radius = positive("tool_radius", record.tool_radius)?.map(|r| r * scale);
    let interval = positive("interval", record.interval)?.map(|w| w * scale);
    let sketch = sketch(&record.loops, units, options)?;
    let mut drawing = assemble::assemble(sketch, options)?;
    if let Some(w) = interval.filter(|w| drawing.region.bbox().size() / w > MAX_OFFSETS) {
        let problem = format!("an interval of {w} mm means more than {MAX_OFFSETS:.0} loops");
        return Err(ImportError::new(FaultKind::Limit, Place::default(), problem, "give a larger interval"));
    }
    (drawing.id, drawing.tool_radius, drawing.interval) = (record.id, radius, interval);
    Ok(drawing)
}

fn positive(name: &str, value: Option<f64>) -> Result<Option<f64>, ImportError> {
    match value {
        Some(v) if !(v > 0.0 && v.is_finite()) => {
            let problem = format!("{name} is {v}");
            Err(ImportError::new(FaultKind::Value, Place::default(), problem, "it must be a length above 0"))
        }
        fine => Ok(fine),
    }
}

fn sketch(loops: &[Vec<[f64; 3]>], units: Units, options: &ImportOptions) -> Result<Sketch, ImportError> {
    let mut sketch = Sketch { units, ..Sketch::default() };
    let map = Affine::scale(units.millimeters(), units.millimeters());
    for (k, vertices) in loops.iter().enumerate() {
        let source = Source { entity: format!("loop {}", k + 1), ..Source::default() };
        if vertices.len() < 2 {
            return Err(source.error("a loop of fewer than two vertices encloses nothing", "remove it"));
        }
        let curves = polyline(vertices, true, &source, &mut Vec::new())?;
        let source = sketch.source(source);
        sketch.add(&curves, true, &map, source, options.fit_tolerance)?;
    }
    Ok(sketch)
}

/// The edges of a polyline with bulges; edges without length are left out, and named in `dropped` where they bulge.
pub(super) fn polyline(
    vertices: &[[f64; 3]],
    closed: bool,
    source: &Source,
    dropped: &mut Vec<Point>,
) -> Result<Vec<Curve>, ImportError> {
    let count = if closed { vertices.len() } else { vertices.len().saturating_sub(1) };
    let mut curves = Vec::with_capacity(count);
    for k in 0..count {
        let ([x, y, bulge], [to_x, to_y, _]) = (vertices[k], vertices[(k + 1) % vertices.len()]);
        let (start, end) = (point(x, y), point(to_x, to_y));
        if !(start.is_finite() && bulge.is_finite()) {
            return Err(source.error(format!("vertex {} is not a number", k + 1), "correct it"));
        }
        if bulge.abs() > tolerance::LARGEST_BULGE {
            let problem = format!("the bulge {bulge:e} of vertex {} is all but a full circle", k + 1);
            return Err(source.error(problem, "draw the arc with two vertices or as a circle"));
        }
        if start != end {
            let bulge = if bulge.abs() < tolerance::FLAT_BULGE { 0.0 } else { bulge };
            curves.push(Curve::from_bulge(start, end, bulge));
        } else if bulge != 0.0 {
            dropped.push(start);
        }
    }
    Ok(curves)
}
