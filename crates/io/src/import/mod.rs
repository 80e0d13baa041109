//! Drawings become regions: DXF, SVG and region JSON.
//!
//! Every reader ends in the same place: entities become closed loops and loose segments in millimetres (`sketch`),
//! loose segments are chained, and the loops are nested and healed into a [`Region`] (`assemble`). Lines and circular
//! arcs stay what they are; ellipses, splines and Béziers become arcs within [`ImportOptions::fit_tolerance`]
//! (`fit`). What can't be made a region is an [`ImportError`] that says where; what was healed or assumed is a
//! [`Warning`].

mod affine;
mod assemble;
mod bezier;
mod curve;
mod dxf;
mod error;
mod fit;
mod json;
pub mod mesh;
mod nurbs;
mod sketch;
mod spline_fit;
mod svg;
mod units;

pub use error::{Fault, FaultKind, ImportError, Place, Warning};
pub use json::{BatchLine, parse_region_json, read_batch};
pub use sketch::Source;
pub use units::{Units, UnknownUnits};

use pocketry_geom::{Region, tolerance};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Files larger than this are refused, bytes.
const MAX_FILE: u64 = 1 << 30;

/// Where the drawing's zero point goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// Where the drawing has it.
    #[default]
    Keep,
    /// The lower left corner of the region's box.
    LowerLeft,
    /// The middle of the region's box.
    Center,
}

/// How a drawing is read.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportOptions {
    /// Layers (DXF) or groups (SVG) to read; all visible ones where empty.
    pub layers: Vec<String>,
    /// The unit of the drawing's numbers, in place of what the file says.
    pub units: Option<Units>,
    /// Where the zero point goes.
    pub origin: Origin,
    /// How far apart two ends may lie and still be joined, mm. Default: [`tolerance::JOIN`].
    pub join_tolerance: f64,
    /// How far the arcs that replace a free-form curve may lie from it, mm. Default: [`tolerance::FIT`].
    pub fit_tolerance: f64,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            layers: Vec::new(),
            units: None,
            origin: Origin::default(),
            join_tolerance: tolerance::JOIN,
            fit_tolerance: tolerance::FIT,
        }
    }
}

impl ImportOptions {
    fn check(&self) -> Result<(), ImportError> {
        let bad = |what: &str, value: f64| {
            let problem = format!("a {what} of {value} mm makes no sense");
            ImportError::new(FaultKind::Options, Place::default(), problem, "give a small positive length")
        };
        if !(self.join_tolerance >= 0.0 && self.join_tolerance.is_finite()) {
            return Err(bad("join tolerance", self.join_tolerance));
        }
        if !(self.fit_tolerance >= tolerance::SMALLEST_SIZE && self.fit_tolerance.is_finite()) {
            return Err(bad("fit tolerance", self.fit_tolerance));
        }
        Ok(())
    }
}

/// A drawing that has been read.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// What is to be milled, mm.
    pub region: Region,
    /// What was healed or assumed.
    pub warnings: Vec<Warning>,
    /// The unit of the drawing's own numbers.
    pub units: Units,
    /// The region's name (region JSON).
    pub id: Option<String>,
    /// The tool radius asked for, mm (region JSON).
    pub tool_radius: Option<f64>,
    /// The interval of tool paths asked for, mm (region JSON).
    pub interval: Option<f64>,
    /// For every contour of the region: the entity that it, or its first part, was drawn by.
    pub sources: Vec<Source>,
}

/// Reads a drawing: DXF, SVG or region JSON, by its name's extension, or its content where that says nothing.
///
/// # Errors
/// [`ImportError::Io`] where the file can't be read, [`ImportError::Bad`] where it can and is no drawing of a pocket.
pub fn read(path: &Path, options: &ImportOptions) -> Result<Drawing, ImportError> {
    parse(path, &read_bytes(path)?, options)
}

/// The drawing in a file's bytes; the name serves for its extension and for messages.
///
/// # Errors
/// [`ImportError::Bad`] where the bytes are no drawing of a pocket.
pub fn parse(name: &Path, bytes: &[u8], options: &ImportOptions) -> Result<Drawing, ImportError> {
    let mut drawing = parse_kind(name, bytes, options).map_err(|error| error.in_file(name))?;
    for warning in &mut drawing.warnings {
        warning.place.file.get_or_insert_with(|| name.to_owned());
    }
    Ok(drawing)
}

fn parse_kind(name: &Path, bytes: &[u8], options: &ImportOptions) -> Result<Drawing, ImportError> {
    options.check()?;
    let known = |e: &String| ["dxf", "svg", "json"].contains(&e.as_str());
    let extension =
        name.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).filter(known).unwrap_or_default();
    match (extension.as_str(), bytes.trim_ascii_start().first()) {
        ("dxf", _) | ("", Some(b'0' | b'9')) => assemble::assemble(dxf::read(bytes, options)?, options),
        ("svg", _) | ("", Some(b'<')) => assemble::assemble(svg::read(bytes, options)?, options),
        ("json", _) | ("", Some(b'{' | b'[')) => json::parse(bytes, options),
        _ => {
            let hint = "give a .dxf, .svg or .json file";
            let problem = "not a drawing of a known kind";
            Err(ImportError::new(FaultKind::Format, Place::default(), problem, hint))
        }
    }
}

/// The whole file, if it isn't absurdly large.
fn read_bytes(path: &Path) -> Result<Vec<u8>, ImportError> {
    let io_error = |source: io::Error| ImportError::Io { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    File::open(path).map_err(io_error)?.take(MAX_FILE + 1).read_to_end(&mut bytes).map_err(io_error)?;
    if bytes.len() as u64 > MAX_FILE {
        let problem = format!("the file is larger than {} MB", MAX_FILE >> 20);
        let place = Place { file: Some(path.to_owned()), ..Place::default() };
        return Err(ImportError::new(FaultKind::Limit, place, problem, "split the drawing"));
    }
    Ok(bytes)
}
